"""Events without end in a finite time, as of a ball that bounces ever lower."""

from collections.abc import Sequence

import numpy as np

from ..system import EARLY, LAST
from .event_location import TOGETHER

MOST = 10_000  # events
SEEN = 6  # firings of one name from which an accumulation is judged: five distances
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


def settles(event: str, instants: Sequence[float], duration: float) -> bool:
    """Whether the instants pile up so close to the last that the motion may go on from there.

    Raises ZenoError where they are one, from which no motion goes on.
    """
    if len(instants) < 3:
        return False
    one, two = np.diff(instants[-3:]).tolist()
    if two < one:
        following = two * two / one
        if following <= LAST * duration or following <= EARLY * duration * (1.0 - two / one):
            return True
    if len(instants) >= SEEN and instants[-1] - instants[-SEEN] <= TOGETHER:
        raise ZenoError(event, instants[-1], "happens again and again")
    return False


def ends_here(limit: float, t: float, begin: float, end: float) -> bool:
    """Whether an accumulation at `limit` ends the motion that stands at t, before its end."""
    return limit <= end and limit - t <= NEAR * (end - begin)
