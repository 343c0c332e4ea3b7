"""Laws in time: value, slope, bend, and their corners."""

import math
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np


class Law(NamedTuple):
    """A law in time, whose values are numbers or vectors.

    value, slope, bend: of t [s], with its first two derivatives; corners: s, where it bends or
    jumps. There value and slope are those behind it.
    """

    value: Callable[[float], Any]
    slope: Callable[[float], Any]
    bend: Callable[[float], Any]
    corners: tuple[float, ...] = ()


def constant(F: Any) -> Law:
    """The same at all times."""
    F = np.asarray(F, dtype=float)
    return Law(lambda t: F, lambda t: 0 * F, lambda t: 0 * F)


def sine(amplitude: Any, w: float, phase: float) -> Law:
    """amplitude sin(w t + phase)."""
    A = np.asarray(amplitude, dtype=float)
    if w == 0:
        return constant(A * math.sin(phase))
    return Law(
        lambda t: A * math.sin(w * t + phase),
        lambda t: A * w * math.cos(w * t + phase),
        lambda t: -A * w * w * math.sin(w * t + phase),
    )


def polynomial(coefficients: list[float], along: Any) -> Law:
    """The sum of coefficient · t^i, along a direction if it has one."""
    p = np.polynomial.Polynomial(coefficients)
    d, dd = p.deriv(), p.deriv(2)
    return Law(lambda t: p(t) * along, lambda t: d(t) * along, lambda t: dd(t) * along)


def lines(times: list[float], values: list[float], along: Any) -> Law:
    """Straight lines between the values, and outside the nearest."""
    T, Y = np.asarray(times), np.asarray(values)
    slopes = np.diff(Y) / np.diff(T)

    def slope(t: float) -> Any:
        i = int(np.searchsorted(T, t, side="right")) - 1
        return (slopes[i] if 0 <= i < len(slopes) else 0.0) * along

    return Law(lambda t: np.interp(t, T, Y) * along, slope, lambda t: 0.0 * along, tuple(times))


def jumps(amplitude: Any, at: float, until: float) -> Law:
    """The amplitude from one instant on until another, and nothing elsewhere."""
    A = np.asarray(amplitude, dtype=float)
    corners = (at,) if math.isinf(until) else (at, until)
    return Law(
        lambda t: A if at <= t < until else 0 * A,
        lambda t: 0 * A,
        lambda t: 0 * A,
        corners,
    )


NAMES = ("constant", "ramp", "sine", "step", "pulse", "polynomial", "table")


def law(told: Any) -> Law:
    """The law of a map that holds one of the words, or of a mere number."""
    if not isinstance(told, dict):
        return constant(told)
    word = next(name for name in NAMES if name in told)
    says = told[word]
    if word == "constant":
        return constant(says)
    if word == "ramp":
        b = np.asarray(says, dtype=float)
        return Law(lambda t: b * t, lambda t: b, lambda t: 0 * b)
    if word == "sine":
        return sine(says["amplitude"], says["angular_frequency"], says.get("phase", 0.0))
    if word == "step":
        return jumps(says["amplitude"], says["at"], math.inf)
    if word == "pulse":
        return jumps(says["amplitude"], says["from"], says["until"])
    along: Any = 1.0
    if "along" in says:
        along = np.asarray(says["along"], dtype=float)
        along = along / np.linalg.norm(along)
    if word == "polynomial":
        return polynomial(says["coefficients"], along)
    return lines(says["times"], says["values"], along)
