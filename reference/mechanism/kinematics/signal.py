"""Laws in time, real or complex, and their rates: A s(t), one s for all axes."""

from bisect import bisect_right
from collections.abc import Callable
from typing import Any

import numpy as np

from ....cases.fields.signal import Law, Signal


def signal(law: Signal, t: Any) -> tuple[Any, ...]:
    """A push's components [N] or a torque [N m] at time t: A s(t); on a jump those after it."""
    if law.law == "constant":
        return law.amplitude
    size = SIZES[law.law](law, t)
    return tuple(entry * size for entry in law.amplitude)


def slope(law: Signal, t: Any) -> tuple[Any, ...]:
    """The rate at time t of what `signal` says: A ṡ(t); on a kink that after it."""
    size = SLOPES[law.law](law, t)
    return tuple(entry * size for entry in law.amplitude)


def bend(law: Signal, t: Any) -> tuple[Any, ...]:
    """The rate of `slope`: A s̈(t), of what moves a point."""
    size = BENDS[law.law](law, t)
    return tuple(entry * size for entry in law.amplitude)


def _polynomial(coefficients: tuple[float, ...], t: Any) -> Any:
    """c₀ + t (c₁ + t (c₂ + …))."""
    size = 0.0
    for c in reversed(coefficients):
        size = size * t + c
    return size


def _derivative(coefficients: tuple[float, ...]) -> tuple[float, ...]:
    """c₁, 2 c₂, 3 c₃ …"""
    return tuple(k * c for k, c in enumerate(coefficients))[1:]


def _line(law: Signal, t: Any) -> tuple[float, float, float]:
    """The line of a table at time t: a time on it, the value there, and its slope."""
    i = bisect_right(law.times, t.real)
    if i in (0, len(law.times)):
        return law.times[0], law.values[0 if i == 0 else -1], 0.0
    (t0, t1), (s0, s1) = law.times[i - 1 : i + 1], law.values[i - 1 : i + 1]
    return t0, s0, (s1 - s0) / (t1 - t0)


def _table(law: Signal, t: Any) -> Any:
    t0, s0, s_dot = _line(law, t)
    return s0 + s_dot * (t - t0)


SIZES: dict[Law, Callable[[Signal, Any], Any]] = {
    "constant": lambda law, t: 1.0,
    "ramp": lambda law, t: t,
    "sine": lambda law, t: np.sin(law.angular_frequency * t + law.phase),
    "step": lambda law, t: float(t.real >= law.times[0]),
    "pulse": lambda law, t: float(law.times[0] <= t.real < law.times[1]),
    "polynomial": lambda law, t: _polynomial(law.values, t),
    "table": _table,
}
"""s(t)."""

SLOPES: dict[Law, Callable[[Signal, Any], Any]] = {
    "constant": lambda law, t: 0.0,
    "ramp": lambda law, t: 1.0,
    "sine": lambda law, t: law.angular_frequency * np.cos(law.angular_frequency * t + law.phase),
    "polynomial": lambda law, t: _polynomial(_derivative(law.values), t),
    "table": lambda law, t: _line(law, t)[2],
}
"""ṡ(t); nothing that jumps is prescribed."""

BENDS: dict[Law, Callable[[Signal, Any], Any]] = {
    "ramp": lambda law, t: 0.0,
    "sine": lambda law, t: -(law.angular_frequency**2) * SIZES["sine"](law, t),
    "polynomial": lambda law, t: _polynomial(_derivative(_derivative(law.values)), t),
}
"""s̈(t)."""
