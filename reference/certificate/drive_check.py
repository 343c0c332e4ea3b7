"""Checks what a file prescribes in time, from the states of the bodies and from the file alone.

No row, force or law of the mechanism has a part in what is read: places and rates are the joints'
own reading of the states, and a law is its number in `cases.signal`, its integral by quadrature.
"""

from collections.abc import Iterator

import numpy as np

from ...cases.case import Case
from ...cases.fields.signal import Signal
from ...cases.scene.frame import PLANE
from ...cases.scene.observe import motion_of, observe
from ...cases.scene.quantity import table
from ...cases.trajectory import Array, Trajectory
from ..mechanism.modes.mechanism import Mechanism
from .agreement import Check, worst
from .reading import Size

PLACE_OF = {"omega": "angle", "speed": "shift"}  # of the other rates it is the name before `_dot`
NODES = 10  # of Gauss and Legendre: exact up to t¹⁹
TURN = 1.0  # rad of a sine in one piece, of which that many nodes leave nothing but rounding
ALGEBRA = 1e-12  # of the largest: written in two ways, and no integrator in it
SEED = 8  # of rates that make a force's power tell all of it: any


def prescribed(
    case: Case, motion: Trajectory, generated: Mechanism, size: Size, own: float
) -> Iterator[Check]:
    """Drives, blades, points and forces against their laws; own: what the motion is known to.

    A drive is held by its rate, so its place sums up the integrator's errors, as all places do.
    """
    if found := [*_drives(case, motion, size), *_blades(case, motion, size)]:
        yield Check("drives follow their laws", worst(found), own)
    if found := [*_points(case, generated, size)]:
        yield Check("driven points follow their laws", worst(found), ALGEBRA)
    if found := [*_forces(case, motion, generated)]:
        yield Check("forces follow their laws", worst(found), ALGEBRA)


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
    found: Array = sums[np.searchsorted(edges, times)]
    return found


def _drives(case: Case, motion: Trajectory, size: Size) -> Iterator[float]:
    """For each driven freedom: the errors of its way since the start and of its rate, relative."""
    known = table(case.scene)
    for quantity, law in case.scene.drives.items():
        part, _, rate = quantity.rpartition(".")
        name = f"{part}.{PLACE_OF.get(rate, rate.removesuffix('_dot'))}"
        place, skew = observe(case.scene, motion, name), _skewness(case, part)
        gone = integral(law, motion.times)[:, 0]
        yield size.apart(known[name].unit, place - place[0], gone) / skew
        own = observe(case.scene, motion, quantity)
        yield size.apart(known[quantity].unit, own, law.at(motion.times)[:, 0]) / skew


def _skewness(case: Case, part: str) -> float:
    """How much larger than its rounding a coordinate's may be: skew axes may nearly cancel."""
    joint = case.scene.joints[part]
    if joint.frame is PLANE:
        return 1.0
    each = [[freedom.axis for freedom in free] for free in (joint.shifts, joint.turns)]
    return max(float(np.linalg.norm(np.linalg.pinv(axes), 2)) for axes in each if axes)


def _blades(case: Case, motion: Trajectory, size: Size) -> Iterator[float]:
    """The speed along a blade has no place: it is its law at every sample."""
    for name, edge in case.scene.constraints.items():
        if (law := edge.speed) is not None:
            speed = observe(case.scene, motion, f"{name}.speed")
            yield size.apart("m/s", speed, law.at(motion.times)[:, 0])


def _points(case: Case, generated: Mechanism, size: Size) -> Iterator[float]:
    """Where the mechanism has the ground's points that move, and how fast: at every sample."""
    for name, point in case.scene.points.items():
        if not point.driven:
            continue
        wanted = point.states(case.times)
        read = np.array([generated.driven_point(name, t) for t in case.times.tolist()])
        for unit, columns in zip(("m", "m/s"), np.hsplit(read - wanted, 2), strict=True):
            yield size.apart(unit, columns, 0.0 * columns)


def _forces(case: Case, motion: Trajectory, generated: Mechanism) -> Iterator[float]:
    """The power of what acts by a law, at the motion's places and any rates.

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
        for name, found in states.items():
            found.append(poses[name])
        for name, power in generated.powers(t, q, v).items():
            theirs[name].append(power)
    moved = Trajectory(motion.times, {n: np.array(s, float) for n, s in states.items()}, {})
    for law in laws:
        own = law.power(motion_of(case.scene, moved))
        least = worst(np.abs(law.signal.at(motion.times)).ravel())
        yield worst(np.abs(own - theirs[law.name])) / (max(least, worst(np.abs(own))) or 1.0)
