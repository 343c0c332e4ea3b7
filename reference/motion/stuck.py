"""Where a motion ends before its time: the steps shrink, or the equations cannot be solved."""

import numpy as np

from ..integrators.march import IntegrationError, Slope, Vector
from ..system import Array, Mode

WATCHED = 6000  # evaluations, 500 explicit steps: enough to recover from any first step
CRAWL = 1e-6  # of the duration in that many: at this pace the motion takes 5e8 steps


class Stuck(Exception):
    """A motion that cannot be followed beyond `time`; q and v are about where it was then."""

    def __init__(self, reason: str, mode: Mode, time: float, y: Array) -> None:
        super().__init__(reason)
        self.mode, self.time = mode, time
        self.q, self.v = mode.parted(y)


def slope(mode: Mode) -> Slope:
    """ẏ = (q̇, v̇(t, q, v)) of y = (q, v)."""
    n = len(mode.coordinates)

    def f(t: float, y: Vector) -> Vector:
        q, v, y_dot = y[:n], y[n:], np.empty_like(y)
        y_dot[:n] = mode.rates(t, q, v)
        y_dot[n:] = mode.accelerations(t, q, v)
        return y_dot

    return f


class Watched:
    """A mode's ẏ(t, y), which remembers where it was and sees when steps no longer get anywhere.

    Towards a singular pose the integrators take ever shorter steps and would never end.
    """

    def __init__(self, mode: Mode, duration: float, y: Array) -> None:
        self.slope, self.duration, self.y = slope(mode), duration, y
        self.calls, self.earliest, self.mark = 0, np.inf, -np.inf

    def __call__(self, t: float, y: Vector) -> Vector:
        self.y = y
        self.calls += 1
        if t < self.earliest:  # others look ahead, at what comes later or is refused
            self.earliest = t
        if self.calls % WATCHED == 0:
            if self.earliest - self.mark < CRAWL * self.duration:
                raise IntegrationError("the steps shrink to nothing", t)
            self.mark, self.earliest = self.earliest, np.inf
        return self.slope(t, y)
