"""How ways to assemble a mechanism in space differ, in words that say which is meant."""

import math

import numpy as np

from ....cases.mistake import CaseError
from ....cases.scene import Anchor
from ....cases.scene.frame import SPACE
from ....cases.scene.rotation import UPRIGHT, angle_between
from ...system import Array
from .. import messages
from ..messages import DEGREES
from .closure import SpatialClosure

ALIKE = 1e-6  # rad or sizes: what differs by less is the same in all ways


def several_ways(closure: SpatialClosure, ways: list[Array]) -> CaseError:
    """Names the joint's coordinate in which the ways differ most, with its values."""
    name, apart = _most(closure, ways)
    if apart < ALIKE:
        name, told = _attitudes(closure, ways)
    else:
        told = [_told(closure, q, name) for q in ways]
    return messages.several(closure.case, len(ways), name, list(dict.fromkeys(told)))


def alike(closure: SpatialClosure, ways: list[Array]) -> bool:
    """Whether no coordinate with a name tells them apart."""
    return _most(closure, ways)[1] < ALIKE


def unnamed(closure: SpatialClosure, q: Array) -> float:
    """The largest turn [rad] of a joint that has turns without a name."""
    joints = closure.scene.joints.values()
    loose = (joint.name for joint in joints if any(not turn.name for turn in joint.turns))
    turned = (closure.given.attitude(name, q) for name in loose)
    return max((float(angle_between(np.array(UPRIGHT), e)) for e in turned), default=0.0)


def _most(closure: SpatialClosure, ways: list[Array]) -> tuple[str, float]:
    """The coordinate with a name in which ways differ most, and by how much, in rad or sizes."""
    values = [_coordinates(closure, q) for q in ways]
    apart = {
        name: max(_differ(closure, at, other[name]) for other in values)
        for name, at in values[0].items()
    }
    name = max(apart, key=apart.__getitem__, default="")
    return name, apart.get(name, 0.0)


def distance(closure: SpatialClosure, q: Array) -> float:
    """How far q is from what `near` says, in rad or sizes; 0 if nothing is said."""
    return max(_apart(closure, q).values(), default=0.0)


def _apart(closure: SpatialClosure, q: Array) -> dict[str, float]:
    """How far q is from all that `near` says, by name: attitudes and points in all directions."""
    found: dict[str, float] = {}
    for equation in closure.given.places(closure.case.near, q):
        off = equation.residual / (1.0 if closure.about_turn(equation) else closure.size)
        name = _whole(equation.name)
        found[name] = math.hypot(found.get(name, 0.0), off)
    return found


def _whole(name: str) -> str:
    """`a.P` of the component `a.P.x`; a body's own x stands by itself."""
    return name.rpartition(".")[0] if name.count(".") > 1 else name


def none_near(closure: SpatialClosure, ways: list[Array]) -> CaseError:
    """Ways to assemble, of which none is where `near` says."""
    apart = _apart(closure, ways[0])
    name = max(apart, key=apart.__getitem__)
    return messages.none_near(closure.case, name, [_told(closure, q, name) for q in ways])


def _told(closure: SpatialClosure, q: Array, name: str) -> str:
    """The value that q has of a name, as a file says it."""
    if name in (known := _coordinates(closure, q)):
        return _shown(*known[name])
    part, _, field = name.partition(".")
    if field == "attitude":
        return _turn(closure.given.attitude(part, q))
    if field in closure.scene.bodies[part].points:
        _, place = closure.given.point(Anchor(part, field), q)
        return f"[{', '.join(f'{x:.4g}' for x in place)}]"
    return _shown(float(q[closure.where.slots[part].r + "xyz".index(field)]), turns=False)


def _coordinates(closure: SpatialClosure, q: Array) -> dict[str, tuple[float, bool]]:
    """The coordinates of joints by their names: each with whether it is a turn."""
    return {
        f"{joint.name}.{freedom.name}": (value, freedom.kind == "turn")
        for joint in closure.scene.joints.values()
        for freedom, value, _ in closure.given.coordinates(joint, q)
        if freedom.name
    }


def _differ(closure: SpatialClosure, a: tuple[float, bool], b: tuple[float, bool]) -> float:
    """In rad, or in sizes."""
    off = a[0] - b[0]
    return abs(math.remainder(off, math.tau)) if a[1] else abs(off) / closure.size


def _shown(value: float, turns: bool) -> str:
    return f"{value * DEGREES:.4g} deg" if turns else f"{value:.4g} m"


def _attitudes(closure: SpatialClosure, ways: list[Array]) -> tuple[str, list[str]]:
    """The name, and each way's attitude in words, of the body whose attitudes differ most."""
    still = np.zeros(closure.where.size)
    poses = [closure.where.poses(q, still) for q in ways]
    known = {body: np.array([pose[body][SPACE.attitude] for pose in poses]) for body in poses[0]}
    apart = {body: float(np.max(angle_between(e[0], e))) for body, e in known.items()}
    body = max(apart, key=apart.__getitem__)
    return f"{body}.attitude", [_turn(e) for e in known[body]]


def _turn(e: Array) -> str:
    """A unit quaternion as a file has it."""
    size = float(np.linalg.norm(e[1:]))
    axis = np.round(e[1:] / size, 4) + 0.0 if size else (0.0, 0.0, 1.0)  # no −0
    x, y, z = (f"{component:g}" for component in axis)
    angle = 2 * math.atan2(size, float(e[0])) * DEGREES
    return f"{{axis: [{x}, {y}, {z}], angle: {angle:.4g} deg}}"
