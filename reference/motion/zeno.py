"""Events without end in a finite time, as of a ball that bounces ever lower."""

from collections.abc import Sequence

import numpy as np

from ..system import EARLY, LAST, Array, instant

MOST = 10_000  # events
SEEN = 6  # firings of one name from which an accumulation is judged: five distances
FLIGHTS = 30.0  # of what acts over the next distance, a half of which is turned around: skew axes
ROUNDING = 1e-12  # of all velocities
NEAR = 1e-5  # of the duration: an accumulation point this close ends the motion


class ZenoError(RuntimeError):
    """Events without end in a finite time; `time` is how far it got, `event` what happens."""

    def __init__(self, event: str, time: float, reason: str) -> None:
        super().__init__(f"'{event}' {reason} at t = {time!r}")
        self.event, self.time = event, time


def accumulation(instants: Sequence[float]) -> float | None:
    """Where the last instants, if their distances shrink geometrically, pile up; else None."""
    instants = instants[-SEEN:]
    distances = np.diff(instants)
    if len(distances) < SEEN - 1:
        return None
    if not distances.any():
        return instants[-1]
    if not distances.all():
        return None
    ratio = float(np.max(distances[1:] / distances[:-1]))
    return instants[-1] + float(distances[-1]) * ratio / (1.0 - ratio) if ratio < 1.0 else None


def settles(event: str, instants: Sequence[float], duration: float) -> float | None:
    """The next distance [s] of instants that pile up, where a motion may go on from their limit.

    None where they do not. Raises ZenoError where they are one, from which no motion goes on.
    """
    if len(instants) < 3:
        return None
    previous, last = np.diff(instants[-3:]).tolist()
    if last < previous:
        following = last * last / previous
        if following <= LAST * duration or following <= EARLY * duration * (1.0 - last / previous):
            return following
    if len(instants) >= SEEN and instants[-1] - instants[-SEEN] <= instant(duration):
        raise ZenoError(event, instants[-1], "happens again and again")
    return None


def converged(then: Array, last: Array, accelerations: Array, following: float) -> bool:
    """Whether the velocities that the last of infinitely many events leaves, (n,), differ no more
    from those without end than what acts turns around in the next distance.

    Else they were not the last: two blows may come soon after each other and a long flight follow.
    """
    deleted = float(np.max(np.abs(then - last), initial=0.0))
    turned = following * float(np.max(np.abs(accelerations), initial=0.0))
    return deleted <= FLIGHTS * turned + ROUNDING * float(np.max(np.abs(then), initial=0.0))


def pile(instants: Sequence[float]) -> Array:
    """The last of the instants (≥ 3,) [s], as far back as each distance is less than the one
    before."""
    distances = np.diff(instants)
    longer = np.flatnonzero(distances[1:] >= distances[:-1])
    return np.array(instants[int(longer[-1]) + 1 if len(longer) else 0 :], dtype=np.float64)


def to_limit(pile: Array) -> float:
    """Time [s] from the last of a pile to its limit, by the ratio of the last two distances."""
    previous, last = np.diff(pile[-3:]).tolist()
    rest: float = last * last / (previous - last)
    return rest


def ends_here(limit: float, t: float, begin: float, end: float) -> bool:
    """Whether an accumulation at `limit` ends the motion that stands at t, before its end."""
    return limit <= end and limit - t <= NEAR * (end - begin)
