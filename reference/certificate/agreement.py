"""How far two motions of the same bodies are apart, relative to their size."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

from ...cases.scene.frame import SPACE, frame_of
from ...cases.trajectory import Trajectory
from ..system import Array


@dataclass(frozen=True)
class Check:
    """One comparison of two answers: `difference` relative to the size, and its bound.

    certified: what is known of an observed quantity, in its unit, where the check is about one.
    measured: whether the bound follows from how far two answers are apart. Of a motion that is not
    sensitive that is rounding's, and another on another processor.
    """

    name: str
    difference: float
    bound: float
    certified: float | None = None
    unit: str = ""
    measured: bool = False

    @property
    def holds(self) -> bool:
        return bool(self.difference <= self.bound)  # false for NaN


def worst(values: Iterable[float]) -> float:
    """The largest, 0 of none; NaN if there is one, where `max` may lose it."""
    return float(np.max([0.0, *values]))


def gravest(checks: Sequence[Check]) -> Check:
    """The check that is nearest to failing, of checks of one name; one of NaN if there is any."""

    def near(check: Check) -> float:
        if check.holds and not check.bound:
            return 0.0
        return (
            check.difference / check.bound if check.difference < np.inf and check.bound else np.inf
        )

    return max(checks, key=near)


def relative(a: Array, b: Array, *, least: float = 0.0) -> float:
    """max |a − b| relative to max |a|, or to `least` if that is larger; absolute if both are 0."""
    return worst(np.abs(a - b).ravel()) / (max(worst(np.abs(a).ravel()), least) or 1.0)


def difference(
    a: Trajectory, b: Trajectory, inner: Iterable[str] = (), *, far: float = 0.0
) -> float:
    """Largest difference of places, angles, velocities and rates, each relative to its size.

    inner: the inner states, which stand among the reactions, too. far: how far [m] from the origin
    the motion gets, whatever its samples find.

    A mechanism at rest moves by rounding only, so sizes are not taken below what would carry it
    through its own size, or 1 rad, in the duration.
    """
    x, y = (np.concatenate([motion.states[name] for name in a.states]) for motion in (a, b))
    duration = float(a.times[-1] - a.times[0])
    frame = frame_of(x.shape[1])
    size = max(far, worst(np.abs(x[:, frame.place]).ravel()))
    if frame is SPACE:  # a quaternion and its opposite are the same attitude
        same = np.sum(x[:, frame.attitude] * y[:, frame.attitude], axis=1, keepdims=True) >= 0
        y[:, frame.attitude] *= np.where(same, 1.0, -1.0)
    groups = [(frame.place, far), (frame.attitude, 1.0)]
    groups += [(frame.velocity, size / duration), (frame.spin, 1.0 / duration)]
    errors = [relative(x[:, g], y[:, g], least=least) for g, least in groups]
    return worst([*errors, *(relative(a.reactions[u], b.reactions[u]) for u in inner)])


def times_apart(first: Sequence[float], second: Sequence[float]) -> float:
    """The largest difference [s] of times in their order; infinite if their counts differ."""
    if len(first) != len(second):
        return float("inf")
    return worst(abs(a - b) for a, b in zip(first, second, strict=True))
