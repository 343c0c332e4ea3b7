"""Checks the start that a file gives, and what it says is near, by the motion's first states.

The search for the start has no part in it: the nouns of the file read the states of the bodies.
"""

import math
from collections.abc import Iterator

import numpy as np

from ...cases.case import Case, Placement
from ...cases.scene.frame import SPACE
from ...cases.scene.joint import axes_of
from ...cases.scene.motion import Motion
from ...cases.scene.observe import motion_of, observe
from ...cases.scene.point import GROUND, Anchor, anchor
from ...cases.scene.quantity import table
from ...cases.scene.rotation import angle_between, inverse, product, turned
from ...cases.trajectory import Trajectory
from ..motion.bodies import Answer
from .agreement import Check, worst
from .reading import Size, size

GIVEN = 1e-11  # ten times what the search for a start leaves open, in sizes and rad
NEAR = math.pi / 2  # rad, or as many sizes: what is farther is not what `near` says
AT_ONCE = 1e-12  # s: what happens at the start leaves the first sample as it is afterwards


def started(case: Case, answer: Answer, motion: Trajectory, lengths: float) -> Iterator[Check]:
    """Checks all of `initial`, turns of angles too, and of `near`. lengths [m]: on the bodies."""
    first = _first(case, answer, motion)
    begins = Trajectory(first.times[:1], {b: rows[:1] for b, rows in first.states.items()}, {})
    large = size(case.scene.frame, begins, lengths, case.duration)
    if found := [*_given(case, first, large)]:
        yield Check("starts as it is given", worst(found), GIVEN)
    if near := [*_near(case, first, lengths)]:
        yield Check("starts near what is said", worst(near), NEAR)


def _first(case: Case, answer: Answer, motion: Trajectory) -> Trajectory:
    """The motion; or the start by itself, if something happens at it."""
    if not any(change.time <= AT_ONCE for change in answer.followed.changes):
        return motion
    name, q, v = answer.system.start()
    poses = answer.system.modes[name].poses(0.0, q, v)
    return Trajectory(np.zeros(1), {b: np.array([poses[b]], float) for b in motion.states}, {})


def _given(case: Case, motion: Trajectory, large: Size) -> Iterator[float]:
    seen, known = motion_of(case.scene, motion), table(case.scene)
    for name, start in case.initial.items():
        for field, value in start.given.items():
            if (quantity := known.get(f"{name}.{field}")) is not None:
                read = observe(case.scene, motion, quantity.name)[0]
                yield large.apart(quantity.unit, float(read), value)
        if name in case.scene.bodies:
            yield from _of_body(case, name, start, seen, large)
        elif start.attitude is not None or "omega_1" in start.given:
            yield from _of_ball(case, name, start, seen, large)


def _of_body(case: Case, name: str, start: Placement, seen: Motion, large: Size) -> Iterator[float]:
    d = case.scene.frame.dimension
    for point, at in start.points.items():
        yield large.apart("m", seen.point(Anchor(name, point))[0, :d], np.array(at))
    for point in start.on:
        yield from _stands(case, Anchor(name, point), seen, large)
    if start.attitude is not None:
        read = seen.trajectory.states[name][0, SPACE.attitude]
        yield float(angle_between(np.array(start.attitude), read))
    if start.polar is not None:
        from_, length, direction = start.polar
        x, y = (seen.point(Anchor(name, "center")) - seen.point(anchor(from_)))[0, :2].tolist()
        yield large.apart("m", math.hypot(x, y), length)
        yield abs(math.remainder(math.atan2(y, x) - direction, math.tau))


def _stands(case: Case, at: Anchor, seen: Motion, large: Size) -> Iterator[float]:
    """A point on its plane, or on its side, does not slip; without a contact it is the floor's."""
    pressing = {**case.scene.touching, **case.scene.pairs}
    mine = [contact for contact in pressing.values() if contact.at == at]
    if not mine:
        _, y, vx, vy = seen.point(at)[0].tolist()
        yield large.apart("m", y, 0.0)
        yield large.apart("m/s", math.hypot(vx, vy), 0.0)
    for contact in mine[:1]:
        yield large.apart("m", contact.observe(seen, "gap")[:1], 0.0)
        yield large.apart("m/s", contact.observe(seen, "slip")[:1], 0.0)


def _of_ball(case: Case, name: str, start: Placement, seen: Motion, large: Size) -> Iterator[float]:
    """Its second part's attitude and rate against the first, in the axes of the second."""
    (a, spin_a), (b, spin_b) = (axes_of(seen, at.body) for at in case.scene.joints[name].refers())
    between = product(inverse(a[0]), b[0])
    if start.attitude is not None:
        yield float(angle_between(np.array(start.attitude), between))
    for i, spin in enumerate(spin_b[0] - turned(inverse(between), spin_a[0])):
        if (given := start.given.get(f"omega_{i + 1}")) is not None:
            yield large.apart("rad/s", float(spin), given)


def _near(case: Case, motion: Trajectory, lengths: float) -> Iterator[float]:
    """How far the start is from each thing that is said, in rad or sizes.

    An angle in the plane counts its turns; in space what is said of one is told by its attitude.
    """
    seen, known = motion_of(case.scene, motion), table(case.scene)
    for name, guess in case.near.items():
        for field, value in guess.given.items():
            quantity = known[f"{name}.{field}"]
            off = float(observe(case.scene, motion, quantity.name)[0]) - value
            if quantity.unit == "rad":
                yield abs(math.remainder(off, math.tau) if case.scene.frame is SPACE else off)
            else:
                yield abs(off) / lengths
        for point, at in guess.points.items():
            read = seen.point(Anchor(name, point))[0, : len(at)]
            yield float(np.linalg.norm(read - at)) / lengths
        if guess.attitude is not None:
            joint = case.scene.joints.get(name)
            ends = [at.body for at in joint.refers()] if joint else [GROUND, name]
            a, b = (axes_of(seen, part)[0][0] for part in ends)
            yield float(angle_between(np.array(guess.attitude), product(inverse(a), b)))
