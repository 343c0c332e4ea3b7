"""How ways to assemble a mechanism in space differ, in words that say which is meant."""

import math

import numpy as np

from ....cases.frame import SPACE
from ....cases.mistake import CaseError
from ....cases.space.rotation import angle_between
from ...system import Array
from .. import messages
from ..messages import DEGREES
from .closure import SpatialClosure

ALIKE = 1e-6  # rad or sizes: what differs by less is the same in all ways


def several_ways(closure: SpatialClosure, ways: list[Array]) -> CaseError:
    """Names the joint's coordinate in which the ways differ most, with its values."""
    values = [_coordinates(closure, q) for q in ways]
    apart = {
        name: max(_differ(closure, at, other[name]) for other in values)
        for name, at in values[0].items()
    }
    name = max(apart, key=apart.__getitem__, default="")
    if not name or apart[name] < ALIKE:
        name, told = _attitudes(closure, ways)
    else:
        told = [_shown(*v[name]) for v in values]
    return messages.several(closure.case, len(ways), name, list(dict.fromkeys(told)))


def _coordinates(closure: SpatialClosure, q: Array) -> dict[str, tuple[float, bool]]:
    """Of joints by their names: each with whether it is a turn."""
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
    """Of the body whose attitudes differ most."""
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
