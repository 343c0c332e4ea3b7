"""Contacts in space: what rolls on the floor, or stands there on a point."""

from collections.abc import Iterator

from ....mistake import nearest
from ....point import FLOOR, GROUND
from ....space.body import SpatialBody
from ....space.scene import SpatialScene
from ...parse import Finding, Parsed


def rolls(parsed: Parsed, scene: SpatialScene) -> Iterator[Finding]:
    """Every mistake in the sound contacts."""
    first: dict[str, str] = {}
    for name, contact in parsed.file.scene.contacts.items():
        path = ("scene", "contacts", name, "between")
        touching, floor = contact.between
        part, _, point = touching.partition(".")
        body = scene.bodies.get(part)
        if body is None:
            if not parsed.hides(part):
                hint = nearest(part, parsed.names("bodies", scene.bodies))
                yield (*path, 0), f"unknown body {part!r}{hint}"
        elif contact.ideal == "pivot":
            if what := _no_pivot(body, point):
                yield (*path, 0), what
        elif body.radius is None:
            round_ = "a disk, a sphere or a rigid body with a `radius`"
            yield (*path, 0), f"{part!r} is a {body.shape}; in space only {round_} rolls"
        elif point:
            with_it = "with its rim" if body.axle else "anywhere"
            yield (*path, 0), f"{part!r} touches {with_it}: write {part!r}"
        elif part in first:
            yield (*path, 0), f"{part!r} already touches in {first[part]!r}"
        first.setdefault(part, name)
        if floor != f"{GROUND}.{FLOOR}":
            yield (*path, 1), f"should be {GROUND}.{FLOOR}, is {floor!r}"


def _no_pivot(body: SpatialBody, point: str) -> str | None:
    """Why the body cannot stand on the point."""
    if not body.turns:
        return f"{body.name!r} is a particle: a pivot lets a body turn about its point"
    if not point:
        return f"a pivot is a point: write '{body.name}.point'"
    if point not in body.points:
        return f"body {body.name!r} has no point {point!r}{nearest(point, body.points)}"
    return None
