"""Checks that a scene in space fits together, in addition to what is checked in the plane."""

from collections.abc import Iterator
from typing import Any

from ....mistake import nearest
from ....scene import Scene
from ....scene.body import Body
from ....scene.point import FLOOR, GROUND
from ...parse import Finding, Parsed
from ..drive import fits, unknown
from .axis import turns_freely
from .start import starts


def spatial(parsed: Parsed, scene: Any) -> Iterator[Finding]:
    """Every mistake in the sound parts that only a scene in space can have."""
    for check in (turns_freely, rolls, drives, blades):
        yield from check(parsed, scene)
    for key in ("initial", "near"):
        yield from starts(parsed, scene, key)


# Blades in space: what can carry one.


def blades(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound constraints that is not one of a name."""
    for name, edge in scene.constraints.items():
        if what := edge.unfit(scene.bodies.get(edge.at.body)):
            yield ("scene", "constraints", name, edge.word), what


# Prescribed rates against the freedoms that joints name.


def drives(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound drives."""
    for quantity, drive in parsed.file.scene.drive.items():
        path = ("scene", "drive", quantity)
        part, _, rate = quantity.rpartition(".")
        if part not in scene.joints:
            yield from unknown(parsed, scene, path, part)
            continue
        rates = scene.joints[part].rates
        if rate not in rates:
            yield path, _no_rate(scene, part, rate)
            continue
        if rates[rate].kind == "turn" and len(scene.joints[part].turns) > 2:
            why = "their middle axis is fixed in neither part; put a body between, on a joint more"
            yield path, f"{part!r} leaves three turns, and of these none can be driven: {why}"
        unit = "m/s" if rates[rate].kind == "shift" else "rad/s"
        yield from fits(path, drive, unit)


def _no_rate(scene: Scene, part: str, rate: str) -> str:
    rates = scene.joints[part].rates
    for name, freedom in rates.items():
        if freedom.name == rate:
            return f"{rate!r} is a coordinate; a drive prescribes its rate, '{part}.{name}'"
    if not rates:
        return f"{part!r} has no freedom with a name, and so no rate to prescribe"
    known = [f"{part}.{name}" for name in rates]
    return f"{part!r} has no rate {rate!r}{nearest(f'{part}.{rate}', known)}"


# Contacts in space: what rolls on the floor, or stands there on a point.


def rolls(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
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


def _no_pivot(body: Body, point: str) -> str | None:
    """Why the body cannot stand on the point."""
    if not body.turns:
        return f"{body.name!r} is a particle: a pivot lets a body turn about its point"
    if not point:
        return f"a pivot is a point: write '{body.name}.point'"
    if point not in body.points:
        return f"body {body.name!r} has no point {point!r}{nearest(point, body.points)}"
    return None
