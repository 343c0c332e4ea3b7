"""From a system's equations to the states of its bodies at the sample times."""

from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from cases.trajectory import Trajectory
from reference.integrator import Integration
from reference.mechanism import Mechanism
from reference.system import Array, System

Method = Callable[..., Integration]
TOLERANCE = 1e-15  # per step; the integrators do not go below 4 ε, so: as well as doubles can


def integrate(system: System, times: Array, method: Method, **options: Any) -> Integration:
    """States y = (q, v), (N, 2n), of ẏ = (v, q̈(t, q, v)) at the times, by `method`."""
    q, v = system.start()
    n = len(q)

    def rates(t: float, y: Array) -> Array:
        y_dot = np.empty_like(y)
        y_dot[:n] = y[n:]
        y_dot[n:] = system.accelerations(t, y[:n], y[n:])
        return y_dot

    return method(rates, times, np.concatenate([q, v]), **options)


def instants(times: Array, y: Array) -> Iterable[tuple[float, Array, Array]]:
    """t, q, v of every sample."""
    n = y.shape[1] // 2
    return ((t, row[:n], row[n:]) for t, row in zip(times.tolist(), y, strict=True))


def motion(system: System, times: Array, y: Array, maximal: Mechanism) -> Trajectory:
    """The bodies' states along y, and the reactions: those the system derives, else maximal's."""
    states: dict[str, list[Any]] = {name: [] for name in maximal.masses}
    reactions: dict[str, list[float]] = {}
    for t, q, v in instants(times, y):
        poses = system.poses(t, q, v)
        for name in states:
            states[name].append(poses[name])
        found = maximal.reactions(t, *maximal.place(poses)) | system.reactions(t, q, v)
        for name, value in found.items():
            reactions.setdefault(name, []).append(value)
    return Trajectory(
        times,
        {name: np.array(rows, float) for name, rows in states.items()},
        {name: np.array(values, float) for name, values in reactions.items()},
    )
