"""Random states beside a motion, such as the mode allows: what the motion itself never shows.

A pendulum that swings in a plane never turns out of it. Places are moved along q̇ = N v, so that a
unit quaternion stays one, and brought back to where f = 0 (2.14); then f_a v = g (2.15).
"""

from collections.abc import Iterator

import numpy as np

from ..formalisms.lagrange import constraint_rows, derivative, rate_matrix
from ..system import Array, Mode

SEED = 8
FAR = 0.1  # of what the fastest of the motion would do in its time
SMALLER = 40  # halvings: after them the motion's own states are drawn, but for rounding
CLOSED = 1e-13  # of the largest coordinate, or of 1: f is 0 but for rounding
TURNS = 60  # of the fixed point: it gains a digit in four, or the way is too long


def drawn(mode: Mode, times: Array, y: Array, count: int) -> Iterator[tuple[float, Array, Array]]:
    """t, q (m,), v (n,): as many as asked for, beside samples y (N, ·) of a motion in this mode.

    What never moves in the motion moves as fast as the slowest of the others.
    """
    random = np.random.default_rng(SEED)
    states = [mode.parted(row) for row in y]
    fastest = np.max(np.abs([v for _, v in states]), axis=0, initial=0.0)
    moving = fastest[fastest > 0.0]
    fastest = np.where(fastest > 0.0, fastest, moving.min() if len(moving) else 1.0)
    way = FAR * (float(times[-1] - times[0]) or 1.0) * fastest
    for _ in range(count):
        at = int(random.integers(len(times)))
        t, (q, v) = float(times[at]), states[at]
        turn, quick = random.uniform(-1.0, 1.0, (2, len(v)))
        for halved in 0.5 ** np.arange(SMALLER):
            place = _closed(mode, t, q, halved * turn * way)
            if place is not None:
                yield t, place, _bound(mode, t, place, v + halved * quick * fastest)
                break


def moved(mode: Mode, t: float, q: Array, way: Array) -> Array | None:
    """q of one step of the implicit midpoint rule along q̇ = N · way, None where it has none.

    The rule keeps the length of a quaternion, however long the step is.
    """
    if rate_matrix(mode, t, q, way) is None:
        return q + way
    there = q
    for _ in range(TURNS):
        middle, before = (q + there) / 2, there
        there = q + mode.rates(t, middle, way) - mode.rates(t, middle, 0.0 * way)
        if np.max(np.abs(there - before)) <= np.finfo(float).eps * np.max(np.abs(there)):
            return there
    return None


def _closed(mode: Mode, t: float, q: Array, way: Array) -> Array | None:
    """Where f = 0, by Newton's method from beside q; None if that does not get there."""
    try:
        place = moved(mode, t, q, way)
        for _ in range(TURNS):
            if place is None or not np.all(np.isfinite(place)):
                return None
            f = np.asarray(mode.f(t, place), dtype=np.float64)
            if np.max(np.abs(f), initial=0.0) <= CLOSED * max(1.0, float(np.max(np.abs(place)))):
                return place if _answers(mode, t, place, way) else None
            place = moved(mode, t, place, -np.linalg.pinv(_slopes(mode, t, place, way)) @ f)
    except (ArithmeticError, np.linalg.LinAlgError):
        pass  # such as a spring without length: another state will do
    return None


def _slopes(mode: Mode, t: float, q: Array, v: Array) -> Array:
    """∂f/∂q N, (·, n)."""
    N = rate_matrix(mode, t, q, v)
    ways = np.eye(len(q)) if N is None else N.T
    return np.stack([derivative(lambda q: mode.f(t, q), (q,), (way,)) for way in ways], axis=1)


def _answers(mode: Mode, t: float, q: Array, v: Array) -> bool:
    """Whether the mode knows its accelerations there; raises ArithmeticError if not."""
    return bool(np.all(np.isfinite(mode.accelerations(t, q, v))))


def _bound(mode: Mode, t: float, q: Array, v: Array) -> Array:
    """The nearest velocities that f_a v = g allows."""
    rows = np.asarray(constraint_rows(mode, t, q, len(v)), dtype=np.float64)
    return v - np.linalg.pinv(rows) @ (rows @ v - mode.g(t, q))
