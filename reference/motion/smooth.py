"""From a system's equations to the states of its bodies at the sample times."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np
from numpy.linalg import LinAlgError

from ...cases.trajectory import Trajectory
from ..generated.mechanism import Mechanism
from ..integrators.march import Integration, IntegrationError
from ..system import Array, System

Method = Callable[..., Integration]
TOLERANCE = 1e-15  # per step; the integrators do not go below 4 ε, so: as well as doubles can
WATCHED = 6000  # evaluations, 500 explicit steps: enough to recover from any first step
CRAWL = 1e-6  # of the duration in that many: at this pace the motion takes 5e8 steps


class Stuck(Exception):
    """A motion of a system that cannot be followed beyond `time`; y is about where it was then."""

    def __init__(self, reason: str, system: System, time: float, y: Array) -> None:
        super().__init__(reason)
        self.system, self.time = system, time
        self.q, self.v = np.split(y, 2)


def integrate(system: System, times: Array, method: Method, **options: Any) -> Integration:
    """States y = (q, v), (N, 2n), of ẏ = (v, q̈(t, q, v)) at the times, by `method`.

    Raises Stuck where the steps shrink to nothing or the equations cannot be solved.
    """
    rates = _Rates(system, float(times[-1] - times[0]))
    try:
        return method(rates, times, rates.y, **options)
    except IntegrationError as error:
        raise Stuck(str(error), system, error.time, rates.y) from error
    except (ArithmeticError, LinAlgError) as error:  # at the very start: no step has been tried
        raise Stuck(str(error), system, float(times[0]), rates.y) from error


class _Rates:
    """ẏ(t, y), which remembers where it was, and sees when the steps no longer get anywhere.

    Towards a singular pose the integrators take ever shorter steps and would never end.
    """

    def __init__(self, system: System, duration: float) -> None:
        self.system, self.duration = system, duration
        self.y = np.concatenate(system.start())
        self.calls, self.farthest, self.mark = 0, -np.inf, -np.inf

    def __call__(self, t: float, y: Array) -> Array:
        n = len(y) // 2
        self.y = y
        self.calls += 1
        self.farthest = max(self.farthest, t)
        if self.calls % WATCHED == 0:
            if self.farthest - self.mark < CRAWL * self.duration:
                raise IntegrationError("the steps shrink to nothing", t)
            self.mark, self.farthest = self.farthest, -np.inf
        y_dot = np.empty_like(y)
        y_dot[:n] = y[n:]
        y_dot[n:] = self.system.accelerations(t, y[:n], y[n:])
        return y_dot


def instants(times: Array, y: Array) -> Iterable[tuple[float, Array, Array]]:
    """t, q, v of every sample."""
    n = y.shape[1] // 2
    return ((t, row[:n], row[n:]) for t, row in zip(times.tolist(), y, strict=True))


def motion(system: System, times: Array, y: Array, maximal: Mechanism) -> Trajectory:
    """The bodies' states along y, and the reactions: those the system derives, else maximal's.

    Raises Stuck at a sample where maximal's are not determined.
    """
    states: dict[str, list[Any]] = {name: [] for name in maximal.masses}
    reactions: dict[str, list[float]] = {}
    for t, q, v in instants(times, y):
        poses = system.poses(t, q, v)
        for name in states:
            states[name].append(poses[name])
        try:
            found = maximal.reactions(t, *maximal.place(poses)) | system.reactions(t, q, v)
        except ArithmeticError as error:
            raise Stuck(str(error), system, t, np.concatenate([q, v])) from error
        for name, value in found.items():
            reactions.setdefault(name, []).append(value)
    return Trajectory(
        times,
        {name: np.array(rows, float) for name, rows in states.items()},
        {name: np.array(values, float) for name, values in reactions.items()},
    )
