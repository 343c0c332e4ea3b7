"""References between the parts of a scene: every name means one thing that is there."""

from collections.abc import Iterator, Mapping
from typing import Any

from ...mistake import Path
from ...quantity import nearest
from ...scene import CENTER, FLOOR, GROUND, Anchor, Damper, Push, Scene, Spring, Torque
from ..grammar.file import Near
from ..parse import NAMED, Finding, Parsed
from ..resolve import anchor
from .touch import touches

_TAKEN = ("x", "y", "angle", "vx", "vy", "omega", "speed")  # `crank.x` is a quantity


def links(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in how the sound parts of the scene refer to each other."""
    spec = parsed.file.scene
    if spec.gravity is not None and spec.incline is not None:
        yield ("scene", "incline"), "cannot stand beside `gravity: none`"
    if not spec.bodies and not parsed.lacks("scene"):
        yield ("scene", "bodies"), "should not be empty"
    for path, before in twice(parsed, scene):
        yield path, f"{path[-1]!r} already names one of the {before}"
    yield from _points(parsed)
    for name, joint in scene.joints.items():
        yield from _line(parsed, scene, ("scene", "joints", name, joint.kind), joint.a, joint.b)
    for name, force in scene.forces.items():
        yield from _force(parsed, scene, ("scene", "forces", name), force)
    yield from touches(parsed, scene)
    for key in ("initial", "near"):
        yield from _placed(parsed, scene, key, getattr(parsed.file, key))


def twice(parsed: Parsed, scene: Scene) -> Iterator[tuple[Path, str]]:
    """Names given twice: where the name stands again, and the section before."""
    places: list[Path] = [("scene", s, name) for s in NAMED for name in getattr(scene, s)]
    places += [("events", name) for name in parsed.file.events]  # `rolls.time` is a quantity
    first: dict[str | int, str] = {}
    for place in places:
        *_, section, name = place
        if name in first:
            yield place, first[name]
        first.setdefault(name, str(section))


def _points(parsed: Parsed) -> Iterator[Finding]:
    if FLOOR in parsed.file.scene.points:
        yield ("scene", "points", FLOOR), f"the name {FLOOR!r} is taken"
    for name, body in parsed.file.scene.bodies.items():
        ends = ("start", "end") if hasattr(body, "bar") else ()
        for point in getattr(body, "points", {}):
            if point in (CENTER, *ends, *_TAKEN):
                yield ("scene", "bodies", name, "points", point), f"the name {point!r} is taken"


def _line(parsed: Parsed, scene: Scene, path: Path, a: Anchor, b: Anchor) -> Iterator[Finding]:
    yield from _anchor(parsed, scene, (*path, 0), a)
    yield from _anchor(parsed, scene, (*path, 1), b)
    if a.body == b.body:
        what = "the ground with itself" if a.body == GROUND else f"{a.body!r} with itself"
        yield path, f"joins {what}"


def _anchor(parsed: Parsed, scene: Scene, path: Path, at: Anchor) -> Iterator[Finding]:
    if at.body == GROUND:
        if at.point == FLOOR:
            yield path, "ground.floor is not a point; only a contact touches it"
        elif at.point not in scene.points and not parsed.hides(at.point, ("points",)):
            known = parsed.names("points", scene.points)
            yield path, f"the ground has no point {at.point!r}{nearest(at.point, known)}"
        return
    yield from _body(parsed, scene, path, at.body)
    if at.body in scene.bodies and at.point not in scene.bodies[at.body].points:
        hint = nearest(at.point, scene.bodies[at.body].points)
        yield path, f"body {at.body!r} has no point {at.point!r}{hint}"


def _body(parsed: Parsed, scene: Scene, path: Path, name: str) -> Iterator[Finding]:
    if name not in scene.bodies and not parsed.hides(name):
        yield path, f"unknown body {name!r}{nearest(name, parsed.names('bodies', scene.bodies))}"


def _force(parsed: Parsed, scene: Scene, path: Path, force: Any) -> Iterator[Finding]:
    match force:
        case Spring(a=a, b=b):
            yield from _line(parsed, scene, (*path, "spring"), a, b)
        case Damper(a=a, b=b):
            yield from _line(parsed, scene, (*path, "damper"), a, b)
        case Push(at=at):
            if at.body == GROUND:
                yield (*path, "push"), "pushes the ground; a push acts on a body"
            else:
                yield from _anchor(parsed, scene, (*path, "push"), at)
        case Torque(body=body):
            yield from _body(parsed, scene, (*path, "torque"), body)
            if body in scene.bodies and not scene.bodies[body].turns:
                yield (*path, "torque"), f"{body!r} is a particle and cannot turn"


def _placed(
    parsed: Parsed, scene: Scene, key: str, places: Mapping[str, Near]
) -> Iterator[Finding]:
    for name, place in places.items():
        yield from _body(parsed, scene, (key, name), name)
        if name not in scene.bodies:
            continue
        for point in place.places:
            if point not in scene.bodies[name].points:
                yield from _anchor(parsed, scene, (key, name, point), anchor(f"{name}.{point}"))
        for turning in ("angle", "omega"):
            if not scene.bodies[name].turns and getattr(place, turning, None) is not None:
                yield (key, name, turning), f"{name!r} is a particle and cannot turn"
