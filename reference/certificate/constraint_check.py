"""Checks the constraints of joints, blades and rolling, from the states of the bodies alone.

The mechanism has rows for all of it; here nothing but the nouns of the file is asked.
"""

from collections.abc import Iterator

import numpy as np

from ...cases.case import Case
from ...cases.scene.frame import SPACE
from ...cases.scene.joint import Joint, axes_of
from ...cases.scene.motion import Motion
from ...cases.scene.observe import motion_of, observe
from ...cases.scene.rotation import angle_between, product
from ...cases.trajectory import Array, Trajectory
from .agreement import Check, worst
from .reading import Size


def constraint_checks(case: Case, motion: Trajectory, size: Size, own: float) -> Iterator[Check]:
    """How far joints come apart or turn where they may not, and what slips that must not."""
    gaps = [size.apart("m", gap, 0.0) for gap in _gaps(case, motion)]
    seen, joints = motion_of(case.scene, motion), case.scene.joints.values()
    turned = [size.apart("rad", _turned(joint, seen), 0.0) for joint in joints]
    if gaps:
        yield Check("joints hold", worst([*gaps, *turned]), own)
    if slips := [size.apart("m/s", slip, 0.0) for slip in _slips(case, motion)]:
        yield Check("nothing slips", worst(slips), own)


def _gaps(case: Case, motion: Trajectory) -> Iterator[Array]:
    """Yields the gaps of joints, of blades whose height is kept, and of contacts that only roll."""
    held = [name for name, edge in case.scene.constraints.items() if edge.kept]
    for name in (*case.scene.joints, *held, *_rolling(case)):
        yield observe(case.scene, motion, f"{name}.gap")


def _rolling(case: Case) -> list[str]:
    """The contacts that stay what they are: wheels that only roll, and in space pivots."""
    return [name for name, contact in case.scene.contacts.items() if not contact.switches]


def _turned(joint: Joint, motion: Motion) -> Array:
    """(N,) [rad] how far the second part is from where the freedoms of the joint take it."""
    return _in_space(joint, motion) if joint.frame is SPACE else _in_plane(joint, motion)


def _in_plane(joint: Joint, motion: Motion) -> Array:
    bodies = [motion.bodies[at.body] for at in joint.refers() if at.body in motion.bodies]
    if joint.turns or not all(body.turns for body in bodies):
        return np.zeros_like(motion.trajectory.times)
    off: Array = np.remainder(joint.turn(motion)[0] - joint.angle + np.pi, 2 * np.pi) - np.pi
    return off


def _in_space(joint: Joint, motion: Motion) -> Array:
    """The turns that the joint reads, one after the other, have to make the attitude."""
    bodies = [motion.bodies[at.body] for at in joint.refers() if at.body in motion.bodies]
    if not joint.holds_attitude or not all(body.turns for body in bodies):
        return np.zeros_like(motion.trajectory.times)
    (first, _), (second, _) = (axes_of(motion, at.body) for at in joint.refers())
    angles = joint.coordinates(motion)[0][:, len(joint.shifts) :]
    for turn, angle in zip(joint.turns, angles.T, strict=True):
        half = angle[:, None] / 2
        first = product(first, np.hstack([np.cos(half), np.sin(half) * np.array(turn.axis)]))
    return angle_between(first, second)


def _slips(case: Case, motion: Trajectory) -> Iterator[Array]:
    """Across blades, and of what only rolls."""
    for name in (*case.scene.constraints, *_rolling(case)):
        yield observe(case.scene, motion, f"{name}.slip")
