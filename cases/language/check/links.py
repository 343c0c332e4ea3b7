"""References between the parts of a scene: every name means one thing that is there."""

from collections.abc import Iterator

from ...mistake import Path
from ...scene import FLOOR, GROUND, Edge, Force, Joint, Scene
from ..grammar.scene import Scene as Spec
from ..parse import NAMED, Finding, Parsed
from .about import about, rubbing
from .anchor import no_point
from .axis import turns_freely
from .contact import contacts
from .drive import drives
from .start import starts

_FIELDS = ("x", "y", "angle", "vx", "vy", "omega", "speed", "ax", "ay", "alpha")
# `crank.x` is a quantity, and a start stands `on` a point
_TAKEN = (*_FIELDS, "on")
_TAKEN_IN_SPACE = (*_FIELDS, "z", "vz", "attitude", "omega_1", "omega_2", "omega_3")


def links(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in how the sound parts of the scene refer to each other."""
    spec = parsed.file.scene
    if spec.incline is not None and (spec.gravity == 0 or isinstance(spec.gravity, tuple)):
        own = "a vector `gravity`" if isinstance(spec.gravity, tuple) else "`gravity: none`"
        yield ("scene", "incline"), f"cannot stand beside {own}"
    if not spec.bodies and not parsed.lacks("scene"):
        yield ("scene", "bodies"), "should not be empty"
    for path, before in twice(parsed):
        yield path, f"{path[-1]!r} already names one of the {before}"
    yield from _points(parsed)
    for name, joint in scene.joints.items():
        yield from _refers(parsed, scene, ("scene", "joints", name, joint.word), joint)
    for name, edge in scene.constraints.items():
        path = ("scene", "constraints", name, edge.word)
        yield from _refers(parsed, scene, path, edge)
        if what := edge.unfit(scene.bodies.get(edge.at.body)):
            yield path, what
    for name, force in scene.forces.items():
        path = ("scene", "forces", name, force.word)
        yield from _refers(parsed, scene, path, force)
        if what := force.unfit(scene.bodies):
            yield path, what
        if force.about is not None:
            yield from about(parsed, scene, path, force)
    if scene.frame.dimension == 3:
        yield from turns_freely(parsed, scene)
    else:
        yield from rubbing(scene)
        yield from _views(parsed.file.scene, scene)
    yield from contacts(parsed, scene)
    yield from starts(parsed, scene)
    yield from drives(parsed, scene)


def _views(spec: Spec, scene: Scene) -> Iterator[Finding]:
    """Seen from above there is a slope, and no floor that could be stood on."""
    if spec.seen is None:
        return
    if spec.incline is None:
        yield ("scene", "seen"), "needs an `incline`; on a level plane write `gravity: none`"
    elif scene.contacts:
        yield ("scene", "seen"), "has no floor for contacts: the floor is a line seen from the side"


def twice(parsed: Parsed) -> Iterator[tuple[Path, str]]:
    """Names given twice: where the name stands again, and the section before."""
    spec = parsed.file.scene
    places: list[Path] = [("scene", s, name) for s in NAMED for name in getattr(spec, s)]
    places += [("events", name) for name in parsed.file.events]  # `rolls.time` is a quantity
    first: dict[str | int, str] = {}
    for place in places:
        *_, section, name = place
        if name in first:
            yield place, first[name]
        first.setdefault(name, str(section))


def _points(parsed: Parsed) -> Iterator[Finding]:
    taken = _TAKEN if parsed.file.scene.space is None else _TAKEN_IN_SPACE
    if FLOOR in parsed.file.scene.points:
        yield ("scene", "points", FLOOR), f"the name {FLOOR!r} is taken"
    for name, body in parsed.file.scene.bodies.items():
        for point in getattr(body, "points", {}):
            if point in (*body.own_points, *taken):
                yield ("scene", "bodies", name, "points", point), f"the name {point!r} is taken"


def _refers(
    parsed: Parsed, scene: Scene, path: Path, element: Joint | Edge | Force
) -> Iterator[Finding]:
    """The points it refers to, one under its word or a list of two."""
    points = element.refers()
    for i, at in enumerate(points):
        yield from no_point(parsed, scene, (*path, i) if len(points) > 1 else path, at)
    if len(points) > 1 and len({at.body for at in points}) == 1:
        body = points[0].body
        yield path, f"joins {'the ground' if body == GROUND else repr(body)} with itself"
