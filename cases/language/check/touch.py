"""Contacts: what touches the floor, and with which of its points."""

from collections.abc import Iterator

from ...mistake import nearest
from ...scene import CENTER, FLOOR, GROUND, Anchor, Body, Scene
from ..parse import Finding, Parsed


def touches(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound contacts."""
    first: dict[Anchor, str] = {}
    for name, contact in parsed.file.scene.contacts.items():
        path = ("scene", "contacts", name)
        touching, floor = contact.between
        part, _, point = touching.partition(".")
        body = scene.bodies.get(part)
        at = scene.contacts[name].at
        if body is None:
            if not parsed.hides(part):
                hint = nearest(part, parsed.names("bodies", scene.bodies))
                yield (*path, "between", 0), f"unknown body {part!r}{hint}"
        elif what := _cannot_touch(body, point):
            yield (*path, "between", 0), what
        elif at in first:
            yield (*path, "between", 0), f"{touching!r} already touches in {first[at]!r}"
        elif contact.ideal == "rolling" and body.radius is None:
            yield (*path, "ideal"), f"{part!r} is a {body.shape}; only a disk rolls"
        first.setdefault(at, name)
        if floor != f"{GROUND}.{FLOOR}":
            yield (*path, "between", 1), f"should be {GROUND}.{FLOOR}, is {floor!r}"


def _cannot_touch(body: Body, point: str) -> str | None:
    """Why this point of the body ("": none is named) cannot touch the floor, or None."""
    if body.radius is not None or body.shape == "particle":
        if point:
            with_it = "as a point" if body.radius is None else "with its rim"
            return f"{body.name!r} is a {body.shape} and touches {with_it}: write {body.name!r}"
        return None
    if body.shape != "bar":
        return (
            f"{body.name!r} is a {body.shape}; only a disk, a particle or a point of a bar "
            "can touch the floor"
        )
    if not point:
        points = ", ".join(f"{body.name}.{p}" for p in body.points if p != CENTER)
        return f"{body.name!r} is a bar and touches with one point: {points}"
    if point not in body.points:
        return f"body {body.name!r} has no point {point!r}{nearest(point, body.points)}"
    return None
