"""Checks what all answers might share: laws, joints and the start, from states and times alone."""

import math
from collections.abc import Iterator

import numpy as np

from ...cases.case import Case, Placement
from ...cases.fields.signal import Signal
from ...cases.scene.frame import PLANE, SPACE
from ...cases.scene.joint import Joint, axes_of
from ...cases.scene.motion import Motion
from ...cases.scene.observe import motion_of, observe
from ...cases.scene.point import GROUND, Anchor, anchor
from ...cases.scene.quantity import table
from ...cases.scene.rotation import angle_between, inverse, product, turned
from ...cases.trajectory import Array, Trajectory
from ..integrators.march import EPS
from ..mechanism.modes.mechanism import Mechanism
from ..motion.bodies import Answer
from ..start.assembly import size_of
from ..system import instant
from .agreement import Check, worst
from .reading import Size, size


def as_the_file_says(
    case: Case, answer: Answer, generated: Mechanism, motion: Trajectory, own: float
) -> Iterator[Check]:
    """Yields the checks of what the file prescribes, of its constraints and of its start."""
    lengths = size_of(case)
    large = size(case.scene.frame, motion, lengths, case.duration)
    yield from prescribed(case, motion, generated, large, own)
    yield from constraint_checks(case, motion, large, own)
    yield from started(case, answer, motion, lengths)


# Checks what a file prescribes in time, from the states of the bodies and from the file alone.
#
# No row, force or law of the mechanism has a part in what is read: places and rates are the
# joints' own reading of the states, and a law is its number in `cases.signal`, its integral by
# quadrature.


PLACE_OF = {"omega": "angle", "speed": "shift"}  # of the other rates it is the name before `_dot`
NODES = 10  # of Gauss and Legendre: exact up to t¹⁹
TURN = 1.0  # rad of a sine in one piece, of which that many nodes leave nothing but rounding
ALGEBRA = 1e-12  # of the largest: written in two ways, and no integrator in it
SEED = 8  # of rates that make a force's power tell all of it: any


def prescribed(
    case: Case, motion: Trajectory, generated: Mechanism, size: Size, own: float
) -> Iterator[Check]:
    """Checks drives, blades, points and forces against their laws; own: the motion's own error.

    A drive is held by its rate, so its place sums up the integrator's errors, as all places do.
    """
    if errors := [*_drives(case, motion, size), *_blades(case, motion, size)]:
        yield Check("drives follow their laws", worst(errors), own, measured=True)
    if errors := [*_points(case, generated, size)]:
        yield Check("driven points follow their laws", worst(errors), ALGEBRA)
    if errors := [*_forces(case, motion, generated)]:
        yield Check("forces follow their laws", worst(errors), ALGEBRA)


def integral(law: Signal, times: Array) -> Array:
    """(N, axes) ∫ of a law from the first time to each, by quadrature between its corners."""
    ends = np.union1d(times, [t for t in law.corners if times[0] < t < times[-1]])
    count = np.ceil(law.angular_frequency * np.diff(ends) / TURN).astype(int).clip(1)
    fine = [np.linspace(a, b, n, endpoint=False) for a, b, n in zip(ends, ends[1:], count)]  # noqa: B905
    edges = np.append(np.concatenate(fine), ends[-1])
    x, w = np.polynomial.legendre.leggauss(max(NODES, len(law.values) // 2 + 1))
    at = edges[:-1, None] + np.diff(edges)[:, None] * (x + 1) / 2
    values = law.at(at.ravel()).reshape(*at.shape, -1)
    areas = np.einsum("k,j,kja->ka", np.diff(edges) / 2, w, values)
    sums = np.vstack([np.zeros((1, areas.shape[1])), np.cumsum(areas, axis=0)])
    integrals: Array = sums[np.searchsorted(edges, times)]
    return integrals


def _drives(case: Case, motion: Trajectory, size: Size) -> Iterator[float]:
    """Yields relative errors of each driven freedom: of its way since the start and its rate."""
    known = table(case.scene)
    for quantity, law in case.scene.drives.items():
        part, _, rate = quantity.rpartition(".")
        name = f"{part}.{PLACE_OF.get(rate, rate.removesuffix('_dot'))}"
        place, skew = observe(case.scene, motion, name), _skewness(case, part)
        shift = integral(law, motion.times)[:, 0]
        yield size.difference(known[name].unit, place - place[0], shift) / skew
        own = observe(case.scene, motion, quantity)
        yield size.difference(known[quantity].unit, own, law.at(motion.times)[:, 0]) / skew


def _skewness(case: Case, part: str) -> float:
    """How much larger than its rounding a coordinate's may be: skew axes may nearly cancel."""
    joint = case.scene.joints[part]
    if joint.frame is PLANE:
        return 1.0
    each = [[freedom.axis for freedom in free] for free in (joint.shifts, joint.turns)]
    return max(float(np.linalg.norm(np.linalg.pinv(axes), 2)) for axes in each if axes)


def _blades(case: Case, motion: Trajectory, size: Size) -> Iterator[float]:
    """Yields relative errors of prescribed speeds along blades, at every sample."""
    for name, edge in case.scene.constraints.items():
        if (law := edge.speed) is not None:
            speed = observe(case.scene, motion, f"{name}.speed")
            yield size.difference("m/s", speed, law.at(motion.times)[:, 0])


def _points(case: Case, generated: Mechanism, size: Size) -> Iterator[float]:
    """Yields relative errors of the places and velocities of driven points of the ground."""
    for name, point in case.scene.points.items():
        if not point.driven:
            continue
        wanted = point.states(case.times)
        read = np.array([generated.driven_point(name, t) for t in case.times.tolist()])
        for unit, columns in zip(("m", "m/s"), np.hsplit(read - wanted, 2), strict=True):
            yield size.difference(unit, columns, 0.0 * columns)


def _forces(case: Case, motion: Trajectory, generated: Mechanism) -> Iterator[float]:
    """Yields relative errors of the power of what acts by a law, at random rates.

    Any, because a force across the motion has none there.
    """
    laws = list(case.scene.signals())
    if not laws:
        return
    random, base, inner = np.random.default_rng(SEED), generated.base, case.scene.inner()
    theirs: dict[str, list[float]] = {law.name: [] for law in laws}
    states: dict[str, list[object]] = {name: [] for name in motion.states}
    for i, t in enumerate(motion.times.tolist()):
        at = {name: tuple(rows[i]) for name, rows in motion.states.items()}
        q, v = base.place(at | {name: (motion.reactions[name][i],) for name in inner})
        v = random.uniform(-1.0, 1.0, len(v))
        poses = base.poses(t, q, v)
        for name, samples in states.items():
            samples.append(poses[name])
        for name, power in generated.powers(t, q, v).items():
            theirs[name].append(power)
    moved = Trajectory(motion.times, {n: np.array(s, float) for n, s in states.items()}, {})
    for law in laws:
        own = law.power(motion_of(case.scene, moved))
        least = worst(np.abs(law.signal.at(motion.times)).ravel())
        yield worst(np.abs(own - theirs[law.name])) / (max(least, worst(np.abs(own))) or 1.0)


# Checks the constraints of joints, blades and rolling, from the states of the bodies alone.
#
# The mechanism has rows for all of it; here nothing but the nouns of the file is asked.


def constraint_checks(case: Case, motion: Trajectory, size: Size, own: float) -> Iterator[Check]:
    """Checks gaps of joints, turns that they do not allow, and slips of what must not slip."""
    gaps = [size.difference("m", gap, 0.0) for gap in _gaps(case, motion)]
    seen, joints = motion_of(case.scene, motion), case.scene.joints.values()
    turned = [size.difference("rad", _misalignment(joint, seen), 0.0) for joint in joints]
    if gaps:
        yield Check("joints hold", worst([*gaps, *turned]), own, measured=True)
    if slips := [size.difference("m/s", slip, 0.0) for slip in _slips(case, motion)]:
        yield Check("nothing slips", worst(slips), own, measured=True)


def _gaps(case: Case, motion: Trajectory) -> Iterator[Array]:
    """Yields the gaps of joints, of blades whose height is kept, and of contacts that only roll."""
    held = [name for name, edge in case.scene.constraints.items() if edge.kept]
    for name in (*case.scene.joints, *held, *_rolling(case)):
        yield observe(case.scene, motion, f"{name}.gap")


def _rolling(case: Case) -> list[str]:
    """The contacts that stay what they are: wheels that only roll, and in space pivots."""
    return [name for name, contact in case.scene.contacts.items() if not contact.switches]


def _misalignment(joint: Joint, motion: Motion) -> Array:
    """(N,) Angle [rad] of the second part from the attitude that the joint's turns give it."""
    return _in_space(joint, motion) if joint.frame is SPACE else _in_plane(joint, motion)


def _in_plane(joint: Joint, motion: Motion) -> Array:
    bodies = [motion.bodies[at.body] for at in joint.refers() if at.body in motion.bodies]
    if joint.turns or not all(body.turns for body in bodies):
        return np.zeros_like(motion.trajectory.times)
    angle: Array = np.remainder(joint.turn(motion)[0] - joint.angle + np.pi, 2 * np.pi) - np.pi
    return angle


def _in_space(joint: Joint, motion: Motion) -> Array:
    """(N,) Angle [rad] between the attitude and the product of the turns that the joint reads."""
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
    """Yields the slips (N,) [m/s] across blades, and of what only rolls."""
    for name in (*case.scene.constraints, *_rolling(case)):
        yield observe(case.scene, motion, f"{name}.slip")


# Checks the start that a file gives, and what it says is near, by the motion's first states.
#
# The search for the start has no part in it: the nouns of the file read the states of the bodies.


GIVEN = 1e-11  # ten times what the search for a start leaves open, in sizes and rad
NEAR = math.pi / 2  # rad, or as many sizes: what is farther is not what `near` says


def started(case: Case, answer: Answer, motion: Trajectory, lengths: float) -> Iterator[Check]:
    """Checks all of `initial`, turns of angles too, and of `near`. lengths [m]: on the bodies."""
    first = _start_motion(case, answer, motion)
    begins = Trajectory(first.times[:1], {b: rows[:1] for b, rows in first.states.items()}, {})
    large = size(case.scene.frame, begins, lengths, case.duration)
    if errors := [*_initial_errors(case, first, large)]:
        yield Check("starts as it is given", worst(errors), GIVEN)
    if near := [*_near_errors(case, first, lengths)]:
        yield Check("starts near what is said", worst(near), NEAR)


def _start_motion(case: Case, answer: Answer, motion: Trajectory) -> Trajectory:
    """The motion, or the start alone if an event happens at it.

    The first sample is then as it is afterwards.
    """
    if not any(change.time <= instant(case.duration) for change in answer.followed.changes):
        return motion
    name, q, v = answer.system.start()
    poses = answer.system.modes[name].poses(0.0, q, v)
    return Trajectory(np.zeros(1), {b: np.array([poses[b]], float) for b in motion.states}, {})


def _initial_errors(case: Case, motion: Trajectory, large: Size) -> Iterator[float]:
    seen, known = motion_of(case.scene, motion), table(case.scene)
    for name, start in case.initial.items():
        for field, value in start.given.items():
            if (quantity := known.get(f"{name}.{field}")) is not None:
                read = observe(case.scene, motion, quantity.name)[0]
                yield large.difference(quantity.unit, float(read), value)
        if name in case.scene.bodies:
            yield from _of_body(case, name, start, seen, large)
        elif start.attitude is not None or "omega_1" in start.given:
            yield from _of_ball(case, name, start, seen, large)


def _of_body(case: Case, name: str, start: Placement, seen: Motion, large: Size) -> Iterator[float]:
    d = case.scene.frame.dimension
    for point, at in start.points.items():
        yield large.difference("m", seen.point(Anchor(name, point))[0, :d], np.array(at))
    for point in start.on:
        yield from _standing_errors(case, Anchor(name, point), seen, large)
    if start.attitude is not None:
        read = seen.trajectory.states[name][0, SPACE.attitude]
        yield float(angle_between(np.array(start.attitude), read))
    if start.polar is not None:
        from_, length, direction = start.polar
        x, y = (seen.point(Anchor(name, "center")) - seen.point(anchor(from_)))[0, :2].tolist()
        yield large.difference("m", math.hypot(x, y), length)
        there = seen.point(Anchor(name, "center"))[0, :2]
        rounded = EPS * float(np.max(np.abs(there))) / length  # rad, of a place far from the origin
        angle = abs(math.remainder(math.atan2(y, x) - direction, math.tau))
        yield 0.0 if angle <= rounded else angle - rounded  # and of NaN it is NaN


def _standing_errors(case: Case, at: Anchor, seen: Motion, large: Size) -> Iterator[float]:
    """Yields errors of gap and slip of a point on its plane, or without a contact on the floor."""
    pressing = {**case.scene.touching, **case.scene.pairs}
    mine = [contact for contact in pressing.values() if contact.at == at]
    if not mine:
        _, y, vx, vy = seen.point(at)[0].tolist()
        yield large.difference("m", y, 0.0)
        yield large.difference("m/s", math.hypot(vx, vy), 0.0)
    for contact in mine[:1]:
        yield large.difference("m", contact.observe(seen, "gap")[:1], 0.0)
        yield large.difference("m/s", contact.observe(seen, "slip")[:1], 0.0)


def _of_ball(case: Case, name: str, start: Placement, seen: Motion, large: Size) -> Iterator[float]:
    """Yields errors of a ball's attitude and rate against the first part, in the second's axes."""
    (a, spin_a), (b, spin_b) = (axes_of(seen, at.body) for at in case.scene.joints[name].refers())
    between = product(inverse(a[0]), b[0])
    if start.attitude is not None:
        yield float(angle_between(np.array(start.attitude), between))
    for i, spin in enumerate(spin_b[0] - turned(inverse(between), spin_a[0])):
        if (given := start.given.get(f"omega_{i + 1}")) is not None:
            yield large.difference("rad/s", float(spin), given)


def _near_errors(case: Case, motion: Trajectory, lengths: float) -> Iterator[float]:
    """Yields the distance of the start from each entry of `near`, in rad or sizes.

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
