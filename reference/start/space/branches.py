"""Which solutions of the joints' rows are assemblies of these joints, and where there are several.

Rows say which directions are at right angles. That holds of a joint turned over, too.
"""

import math
from collections.abc import Iterator

import numpy as np

from ....cases.scene import GROUND, Scene
from ....cases.scene.chain import turned_by
from ....cases.scene.joint import Joint
from ....cases.scene.rotation import UPRIGHT, about, angle_between, matrix, product, turned
from ...system import Array
from ..rates import joined
from .closure import SpatialClosure
from .initial_conditions import attitude

UP, STILL = np.array([UPRIGHT]), np.zeros((1, 3))
LOCKED = 1e-5  # sine: below, rounding moves the turns about either axis by more than 1e-11
REACHED = 1e-6  # rad: near gimbal lock half of the digits of an angle are lost
ALIKE = 0.5  # between the cosine of a held axis, 1, and those of its joint turned over, 0 and -1


def closes(scene: Scene) -> bool:
    """Whether a joint joins what is joined already, be it on the ground or free of it."""
    return len(scene.joints) > 1 + len(scene.bodies) - len(chains(scene))


def chains(scene: Scene) -> list[set[str]]:
    """The bodies, and the ground, that joints hold together."""
    joints = scene.joints.values()
    return joined((GROUND, *scene.bodies), [{joint.a.body, joint.b.body} for joint in joints])


def faithful(closure: SpatialClosure, q: Array) -> bool:
    """Whether each joint's axes point the same way: rows of right angles hold of both."""
    for joint in closure.scene.joints.values():
        bodies = [closure.scene.bodies[e.body] for e in joint.refers() if e.body != GROUND]
        if len(joint.turns) > 1 or not joint.holds_attitude or not all(b.turns for b in bodies):
            continue
        a, b = (matrix(attitude(closure.mode, end.body, q)) for end in (joint.a, joint.b))
        axes = np.array([turn.axis for turn in joint.turns] or np.eye(3))
        if np.min(np.sum((axes @ a.T) * (axes @ b.T), axis=1)) < ALIKE:
            return False
    return True


def unreached(closure: SpatialClosure, q: Array) -> Iterator[Joint]:
    """Joints of three turns that make no attitude such as this: skew axes leave some out."""
    for joint in closure.scene.joints.values():
        if len(joint.turns) < 3:
            continue
        known = {freedom.name: angle for freedom, angle, _ in closure.given.coordinates(joint, q)}
        made = np.array(UPRIGHT)
        for turn in joint.turns:
            made = product(made, np.array(about(turn.axis, known[turn.name])))
        a, b = (attitude(closure.mode, end.body, q) for end in (joint.a, joint.b))
        if angle_between(product(a, made), b) > REACHED:
            yield joint


def past_lock(closure: SpatialClosure, q: Array) -> int:
    """How many joints have their middle turn of three past gimbal lock, and no word that says so.

    Three turns make an attitude in two ways: with a last turn of 0 it is another one past the lock.
    """
    found = 0
    for joint in closure.scene.joints.values():
        if len(joint.turns) < 3:
            continue
        middle, at = joint.turns[1].name, len(joint.shifts) + 1
        words = (closure.case.initial.get(joint.name), closure.case.near.get(joint.name))
        if any(said is not None and middle in said.given for said in words):
            continue
        made = closure.given.attitude(joint.name, q)[None]
        first, *_ = turned_by([t.axis for t in joint.turns], UP, STILL, made, STILL)
        _, angle, _ = closure.given.coordinates(joint, q)[at]
        found += abs(math.remainder(angle - float(first.angles[0, 1]), math.tau)) > REACHED
    return found


def locked(closure: SpatialClosure) -> Iterator[tuple[Joint, float]]:
    """Joints of three turns that are given where the first and the last are about one axis."""
    for name, placement in closure.case.initial.items():
        joint = closure.scene.joints.get(name)
        if joint is None or len(joint.turns) < 3:
            continue
        first, middle, last = joint.turns
        angle = placement.given.get(middle.name)
        if angle is None:
            continue
        there = turned(np.array(about(middle.axis, angle)), last.axis)
        if abs(float(np.dot(np.cross(first.axis, middle.axis), there))) < LOCKED:
            yield joint, angle
