"""References between the parts of a scene: every name means one thing that is there."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from ...mistake import Path, list_hint, nearest
from ...scene import FLOOR, GROUND, Edge, Force, Joint, Scene
from ...scene.body import Body
from ...scene.point import Anchor
from ...scene.solid import without_inertia
from ...trajectory import Array
from ..grammar.scene import Scene as Spec
from ..parse import NAMED, Finding, Parsed
from .anchor import no_point
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
    for path, before in duplicate_names(parsed):
        yield path, f"{path[-1]!r} already names one of the {before}"
    yield from _points(parsed)
    for name, joint in scene.joints.items():
        yield from _check_points(parsed, scene, ("scene", "joints", name, joint.word), joint)
    for name, edge in scene.constraints.items():
        path = ("scene", "constraints", name, edge.word)
        yield from _check_points(parsed, scene, path, edge)
        if what := edge.why_unfit(scene.bodies.get(edge.at.body)):
            yield path, what
    for name, force in scene.forces.items():
        path = ("scene", "forces", name, force.word)
        yield from _check_points(parsed, scene, path, force)
        if what := force.why_unfit(scene.bodies):
            yield path, what
        if force.about is not None:
            yield from check_joint(parsed, scene, path, force)
    if scene.frame.dimension == 3:
        yield from turns_freely(parsed, scene)
    else:
        yield from check_dry_pins(scene)
        yield from _check_seen_from(parsed.file.scene, scene)
    yield from contacts(parsed, scene)
    yield from starts(parsed, scene)
    yield from drives(parsed, scene)


def _check_seen_from(spec: Spec, scene: Scene) -> Iterator[Finding]:
    """Mistakes of `seen: from above`, which needs a slope and has no floor."""
    if spec.seen is None:
        return
    if spec.incline is None:
        yield ("scene", "seen"), "needs an `incline`; on a level plane write `gravity: none`"
    elif scene.contacts:
        yield ("scene", "seen"), "has no floor for contacts: the floor is a line seen from the side"


def duplicate_names(parsed: Parsed) -> Iterator[tuple[Path, str]]:
    """Yields duplicate names: the path of the second, and the section of the first."""
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
    names = _TAKEN if parsed.file.scene.space is None else _TAKEN_IN_SPACE
    if FLOOR in parsed.file.scene.points:
        yield ("scene", "points", FLOOR), f"the name {FLOOR!r} is taken"
    for name, body in parsed.file.scene.bodies.items():
        for point in getattr(body, "points", {}):
            if point in (*body.own_points, *names):
                yield ("scene", "bodies", name, "points", point), f"the name {point!r} is taken"


def _check_points(
    parsed: Parsed, scene: Scene, path: Path, element: Joint | Edge | Force
) -> Iterator[Finding]:
    """Mistakes in the points to which an element refers, one or a list of two."""
    points = element.refers()
    for i, at in enumerate(points):
        yield from no_point(parsed, scene, (*path, i) if len(points) > 1 else path, at)
    if len(points) > 1 and len({at.body for at in points}) == 1:
        body = points[0].body
        yield path, f"joins {'the ground' if body == GROUND else repr(body)} with itself"


# Checks of what acts about or along a joint, or rubs in it: its parts may turn, or may shift.


def check_joint(parsed: Parsed, scene: Scene, path: Path, force: Force) -> Iterator[Finding]:
    """Yields what is wrong with the joint's name, the joint, or the turn that is meant."""
    name = force.about
    assert name is not None
    if name not in scene.joints:
        if not parsed.hides(name):
            known = parsed.names("joints", scene.joints)
            yield path, f"unknown joint {name!r}{nearest(name, known)}"
        return
    joint = scene.joints[name]
    if scene.frame.dimension == 2 and joint.swings:
        yield path, f"{name!r} is a {joint.kind}, and no axis about which anything could act"
        return
    if force.freedom == "shift":
        if not joint.shifts:
            yield path, f"{name!r} is a {joint.kind}, and lets nothing shift"
        return
    if not joint.turns:
        yield path, f"{name!r} is a {joint.kind}, and lets nothing turn"
        return
    if scene.frame.dimension == 3:
        if what := no_turn(joint, force):
            yield path, what
        return
    if force.turn:
        yield path, f"in the plane {name!r} has one turn without a name: write {name!r}"
    yield from unturnable_parts(scene, path, joint)


def check_dry_pins(scene: Scene) -> Iterator[Finding]:
    """Mistakes of dry friction in pins of which a part cannot turn."""
    for name, joint in scene.joints.items():
        if joint.dry_friction is not None and not joint.shifts:
            yield from unturnable_parts(scene, ("scene", "joints", name, "dry_friction"), joint)


def unturnable_parts(scene: Scene, path: Path, joint: Joint) -> Iterator[Finding]:
    """Yields the parts of the joint that cannot turn, as mistakes."""
    for at in joint.refers():
        if at.body in scene.bodies and not scene.bodies[at.body].turns:
            yield path, f"{joint.name!r} joins {at.body!r}, which is a particle and cannot turn"


# Forces about a joint in space: which of its turns is meant.


def no_turn(joint: Any, force: Force) -> str | None:
    """Why a force cannot act about the turn that it names, in words, or None."""
    found: Joint = joint
    name, freedom = found.name, force.turn
    turns = [f.name for f in found.turns if f.name]
    written = [f"{name}.{turn}" for turn in turns]
    if not found.holds_attitude:
        why = "their middle axis is fixed in neither part; put a body between, on a joint more"
        return f"{name!r} leaves three turns, and about these nothing can act: {why}"
    if not turns:
        return f"the turns of {name!r}, a {found.kind}, have no names: write it as `freedoms`"
    if not freedom and found.kind == "freedoms":
        return f"{name!r} leaves freedoms with names: write {' or '.join(map(repr, written))}"
    if freedom in found.rates:
        turn = f"{name}.{found.rates[freedom].name}"
        return f"{freedom!r} is a rate; the turn is {turn!r}"
    if freedom in [f.name for f in found.shifts]:
        return f"{freedom!r} slides, and nothing turns there{list_hint(written)}"
    if freedom and freedom not in turns:
        return f"{name!r} has no turn {freedom!r}{nearest(f'{name}.{freedom}', written)}"
    return None


# Bodies and the axes about which they turn: a particle has none, and a slender bar lacks one.


_NONE = "and it has no inertia about that"
NEAR = 1e-9  # sine of an angle, and of a length its part: numbers are typed with up to ten digits


def turns_freely(parsed: Parsed, scene: Scene) -> Iterator[Finding]:
    """Particles that a joint would turn, and bodies that turn freely without inertia."""
    for name, joint in scene.joints.items():
        turning = [f for f in joint.turns if f.kind == "turn"]
        for at in joint.refers():
            body = scene.bodies.get(at.body)
            if turning and body is not None and not body.turns:
                path = ("scene", "joints", name, joint.word)
                yield path, f"{at.body!r} is a particle and cannot turn; join it by a `ball`"
    for name, body in scene.bodies.items():
        if not body.turns or parsed.shaken:
            continue
        axis = without_inertia(body.inertia)
        if axis is not None and not _held(parsed, scene, name, axis):
            yield ("scene", "bodies", name), _freely(body, axis)


def _freely(body: Body, axis: Array) -> str:
    if body.shape == "bar":
        own = "nothing keeps it from turning about its own axis"
        return f"{body.name!r} is a slender bar: {own}, {_NONE}; give it as a `rigid` with a tensor"
    about = ", ".join(f"{x:.3g}" for x in axis * np.sign(axis[np.argmax(abs(axis))]) + 0.0)
    return f"nothing keeps {body.name!r} from turning about [{about}], {_NONE}"


def _held(parsed: Parsed, scene: Scene, body: str, axis: Array) -> bool:
    """Whether some joint keeps the body from turning about an axis through its centre."""
    if any(path[:2] == ("scene", "joints") for path in parsed.broken):
        return True  # perhaps that one
    return any(
        at.body == body and not _lets(scene, joint, at, axis)
        for joint in scene.joints.values()
        for at in joint.refers()
    )


def _lets(scene: Scene, joint: Joint, at: Anchor, axis: Array) -> bool:
    """Whether the joint lets the body turn about this axis wherever the joint stands."""
    point = scene.bodies[at.body].points.get(at.point)
    if point is None:
        return False
    d = np.asarray(point)
    on_it = np.linalg.norm(np.cross(axis, d)) <= NEAR * np.linalg.norm(d)
    if not on_it and len(joint.shifts) < 3:
        return False
    if not joint.holds_attitude:
        return True
    # The first axis stands in the first part and the last in the second.
    own = joint.turns[:1] if at == joint.a else joint.turns[-1:]
    return any(np.linalg.norm(np.cross(axis, f.axis)) <= NEAR for f in own)
