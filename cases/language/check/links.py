"""References between the parts of a scene: every name means one thing that is there."""

from collections.abc import Iterator, Mapping

from ...mistake import Path, nearest
from ...scene import FLOOR, GROUND, Anchor, Edge, Force, Joint, Scene
from ...scene.joint import WORDS
from ...scene.point import anchor
from ..grammar.file import Initial, Near
from ..grammar.file import Scene as Spec
from ..parse import NAMED, Finding, Parsed
from .about import about, rubbing
from .drive import drives
from .pair import pairs
from .space.spatial import spatial
from .touch import planes, touches

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
        yield from _refers(parsed, scene, ("scene", "constraints", name, edge.word), edge)
    for name, force in scene.forces.items():
        path = ("scene", "forces", name, force.word)
        yield from _refers(parsed, scene, path, force)
        if what := force.unfit(scene.bodies):
            yield path, what
        if force.about is not None:
            yield from about(parsed, scene, path, force)
    if scene.frame.dimension == 3:
        yield from spatial(parsed, scene)
        return
    yield from rubbing(scene)
    yield from _views(spec, scene)
    yield from planes(parsed)
    yield from touches(parsed, scene)
    yield from pairs(parsed, scene)
    for key in ("initial", "near"):
        yield from _placed(parsed, scene, key, getattr(parsed.file, key))
    yield from edges(parsed, scene)
    yield from polar(parsed, scene)
    yield from posed(parsed, scene)
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
        yield from _anchor(parsed, scene, (*path, i) if len(points) > 1 else path, at)
    if len(points) > 1 and len({at.body for at in points}) == 1:
        body = points[0].body
        yield path, f"joins {'the ground' if body == GROUND else repr(body)} with itself"


def _anchor(parsed: Parsed, scene: Scene, path: Path, at: Anchor) -> Iterator[Finding]:
    if at.body == GROUND:
        planes = getattr(parsed.file.scene, "planes", {})
        if at.point == FLOOR or at.point in planes.keys() - scene.points.keys():
            yield path, f"ground.{at.point} is not a point; only a contact touches it"
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


def _nobody(parsed: Parsed, scene: Scene, key: str, name: str) -> str:
    """A start may be given by a joint, a guess only by a body."""
    known = parsed.names("bodies", scene.bodies)
    if key == "near" and name in scene.joints:
        return f"{name!r} is a joint; a guess is given by a body"
    if key == "initial":
        known += parsed.names("joints", scene.joints)
    kinds = "body or joint" if key == "initial" else "body"
    return f"unknown {kinds} {name!r}{nearest(name, known)}"


def _placed(
    parsed: Parsed, scene: Scene, key: str, places: Mapping[str, Near]
) -> Iterator[Finding]:
    for name, place in places.items():
        if key == "initial" and (name in scene.constraints or name in scene.joints):
            continue
        if name not in scene.bodies:
            if not parsed.hides(name):
                yield (key, name), _nobody(parsed, scene, key, name)
            continue
        for point in place.places:
            if point not in scene.bodies[name].points:
                yield from _anchor(parsed, scene, (key, name, point), Anchor(name, point))
        for i, point in enumerate(place.stands_on):
            path = (key, name, "on", i) if len(place.stands_on) > 1 else (key, name, "on")
            yield from _anchor(parsed, scene, path, Anchor(name, point))
        for turning in ("angle", "omega"):
            if not scene.bodies[name].turns and getattr(place, turning, None) is not None:
                yield (key, name, turning), f"{name!r} is a particle and cannot turn"


# Edges: what can carry one, and with which speed it starts.


def edges(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound edges and in the speeds of the start."""
    for name, edge in scene.constraints.items():
        if what := edge.unfit(scene.bodies.get(edge.at.body)):
            yield ("scene", "constraints", name, edge.word), what
    for name, start in parsed.file.initial.items():
        given = sorted(start.keys)
        if name not in scene.constraints:
            if "speed" in given and name not in scene.joints:
                what = "only an edge or a joint that slides starts with a `speed`"
                yield ("initial", name, "speed"), what
            continue
        for key in given:
            if key != "speed":
                yield ("initial", name, key), f"{name!r} is an edge and starts with a `speed`"
            elif scene.constraints[name].speed is not None:
                yield ("initial", name, key), f"the speed of {name!r} is prescribed"


# Starts that give a place by its distance from a point of the ground, in some direction.


KEYS = ("from", "length", "direction")


def polar(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in the sound starts."""
    for name, start in parsed.file.initial.items():
        given = [key for key in KEYS if key in start.keys]
        if not given or name not in scene.bodies:
            continue
        for key in (key for key in KEYS if key not in given):
            yield ("initial", name), f"needs `{key}` beside {' and '.join(given)}"
        for key in sorted({"x", "y", *start.places} & start.keys):
            yield ("initial", name, key), "cannot stand beside `from`, which gives the place too"
        yield from _origin(parsed, scene, name, start)


def _origin(parsed: Parsed, scene: Scene, name: str, start: Initial) -> Iterator[Finding]:
    if start.from_ is None:
        return
    at, path = anchor(start.from_), ("initial", name, "from")
    if at.body != GROUND:
        yield path, f"should be a point of the ground, is {start.from_!r}"
    elif at.point not in scene.points and not parsed.hides(at.point, ("points",)):
        known = parsed.names("points", scene.points)
        yield path, f"the ground has no point {at.point!r}{nearest(at.point, known)}"


# Starts by joints: only the coordinates that a joint has can be given, and their rates.


def posed(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Every mistake in starts by sound joints, and the shift of what is no joint."""
    left = scene.coordinates()
    for name, start in parsed.file.initial.items():
        if name not in scene.joints:
            if "shift" in start.model_fields_set:
                yield ("initial", name, "shift"), "only a joint that slides starts with a `shift`"
            continue
        kind = scene.joints[name].kind
        for key in (*start.given, *start.places):
            if key not in left[name]:
                yield ("initial", name, key), _unknown(name, kind, key, list(left[name]))


def _unknown(name: str, kind: str, key: str, known: list[str]) -> str:
    if not known:
        return f"{name!r} is a {kind} and leaves nothing that could be given"
    if key in WORDS:
        return f"{name!r} is a {kind} and has no {key}; it starts by {' and '.join(known)}"
    return f"{name!r} is a {kind} and starts by {' and '.join(known)}{nearest(key, known)}"
