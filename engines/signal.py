"""Named laws in time in words, for every engine: each is an amplitude times one factor of time.

As the force laws of law.py they are written three times on purpose.
"""

import math
from bisect import bisect_right
from collections.abc import Callable
from itertools import pairwise
from typing import Any

from ..cases.fields.signal import Law, Signal

Factor = Callable[[float], float]
NEAR = 1e-6  # of a step: so near a corner is at the end of a step, whatever rounding made of it


def value(signal: Signal, t: float) -> tuple[float, ...]:
    """The law in time at t [s]: N for a push, N m for a torque."""
    size = factor(signal)(t)
    return tuple([amplitude * size for amplitude in signal.amplitude])


def rate(signal: Signal, t: float) -> tuple[float, ...]:
    """How fast `value` changes at t [s], per second."""
    size = change(signal)(t)
    return tuple([amplitude * size for amplitude in signal.amplitude])


def in_time(signal: Signal) -> Callable[[float], tuple[float, ...]]:
    """`value` of one law, for a loop: what does not change is looked up once."""
    amplitude, size = signal.amplitude, factor(signal)
    if signal.law == "constant":
        return lambda t: amplitude
    if len(amplitude) == 1:
        (first,) = amplitude
        return lambda t: (first * size(t),)
    if len(amplitude) == 2:
        x, y = amplitude

        def in_the_plane(t: float) -> tuple[float, ...]:
            now = size(t)
            return x * now, y * now

        return in_the_plane

    def along_axes(t: float) -> tuple[float, ...]:
        now = size(t)
        return tuple([each * now for each in amplitude])

    return along_axes


def acting(signal: Signal, step: float) -> Callable[[float], tuple[float, ...]]:
    """The law's value in the step [s] that begins at t [s]: of one with a corner the mean.

    Else the value in its middle: of a jump that would be all or nothing. step: 0 for the present.
    """
    usual, share = in_time(signal), mean(signal, step)
    corners, amplitude = signal.corners, signal.amplitude

    def now(t: float) -> tuple[float, ...]:
        if any(touches(corner, t, step) for corner in corners):
            return tuple([each * share(t) for each in amplitude])
        return usual(t + step / 2)

    return now if corners and step else lambda t: usual(t + step / 2)


def touches(corner: float, t: float, step: float) -> bool:
    """Whether a corner [s] is in a step from t [s], or at one of its ends."""
    return t - NEAR * step <= corner <= t + step + NEAR * step


def mean(signal: Signal, step: float) -> Factor:
    """The mean of the factor over the step that begins at t [s], of a law with corners."""
    area = AREAS[signal.law] if signal.corners else None

    def over(t: float) -> float:
        assert area
        return (area(signal, t + step) - area(signal, t)) / step

    return over


def factor(signal: Signal) -> Factor:
    """The factor of the amplitude, by the time t [s]; on a jump what it is after it."""
    return FACTORS[signal.law](signal)


def change(signal: Signal) -> Factor:
    """How fast the factor changes, per second; on a kink how it does after it."""
    return CHANGES[signal.law](signal)


def derivative(signal: Signal) -> list[Signal]:
    """The laws whose sum is how fast a law changes; of a table a step at each of its corners.

    Raises KeyError of a law that jumps: nothing that does is prescribed.
    """
    return DERIVATIVES[signal.law](signal)


def _of_sine(signal: Signal) -> list[Signal]:
    frequency, ahead = signal.angular_frequency, signal.phase + math.pi / 2
    return [_scaled(signal, frequency, "sine", angular_frequency=frequency, phase=ahead)]


def _of_polynomial(signal: Signal) -> list[Signal]:
    values = tuple(k * c for k, c in enumerate(signal.values))[1:]
    return [Signal("polynomial", signal.amplitude, values=values)] if any(values) else []


def _of_table(signal: Signal) -> list[Signal]:
    corners = zip(signal.times, signal.values, strict=True)
    rises = ((s1 - s0) / (t1 - t0) for (t0, s0), (t1, s1) in pairwise(corners))
    bends = zip(signal.times, pairwise([0.0, *rises, 0.0]), strict=True)
    return [_scaled(signal, after - before, "step", times=(t,)) for t, (before, after) in bends]


def _scaled(signal: Signal, by: float, law: Law, **numbers: Any) -> Signal:
    return Signal(law, tuple(by * each for each in signal.amplitude), **numbers)


def _sine(signal: Signal) -> Factor:
    frequency, phase = signal.angular_frequency, signal.phase
    return lambda t: math.sin(frequency * t + phase)


def _sine_change(signal: Signal) -> Factor:
    frequency, phase = signal.angular_frequency, signal.phase
    return lambda t: frequency * math.cos(frequency * t + phase)


def _step(signal: Signal) -> Factor:
    (begins,) = signal.times
    return lambda t: 1.0 if t >= begins else 0.0


def _pulse(signal: Signal) -> Factor:
    begins, ends = signal.times
    return lambda t: 1.0 if begins <= t < ends else 0.0


def _polynomial(signal: Signal) -> Factor:
    terms = list(enumerate(signal.values))
    return lambda t: sum([c * t**k for k, c in terms])


def _polynomial_change(signal: Signal) -> Factor:
    terms = [(k, k * c) for k, c in enumerate(signal.values) if k]
    return lambda t: sum([c * t ** (k - 1) for k, c in terms])


def table(times: tuple[float, ...], values: tuple[float, ...], t: float) -> float:
    """The value at t [s]: on a line between two of them, or the nearest."""
    if t <= times[0]:
        return values[0]
    if t >= times[-1]:
        return values[-1]
    i = bisect_right(times, t)
    share = (t - times[i - 1]) / (times[i] - times[i - 1])
    return (1 - share) * values[i - 1] + share * values[i]


def under(times: tuple[float, ...], values: tuple[float, ...], t: float) -> float:
    """The area under a table from its first time to t [s]."""
    area = (min(t, times[0]) - times[0]) * values[0] + (max(t, times[-1]) - times[-1]) * values[-1]
    for (a, b), (p, q) in zip(pairwise(times), pairwise(values), strict=True):
        end = min(max(t, a), b)
        area += (end - a) * (p + (q - p) * (end - a) / (b - a) / 2)
    return area


def _table_change(signal: Signal) -> Factor:
    times, values = signal.times, signal.values

    def slope(t: float) -> float:
        i = bisect_right(times, t)
        if i in (0, len(times)):
            return 0.0
        return (values[i] - values[i - 1]) / (times[i] - times[i - 1])

    return slope


FACTORS: dict[Law, Callable[[Signal], Factor]] = {
    "constant": lambda signal: lambda t: 1.0,
    "ramp": lambda signal: lambda t: t,
    "sine": _sine,
    "step": _step,
    "pulse": _pulse,
    "polynomial": _polynomial,
    "table": lambda signal: lambda t: table(signal.times, signal.values, t),
}

CHANGES: dict[Law, Callable[[Signal], Factor]] = {
    "constant": lambda signal: lambda t: 0.0,
    "ramp": lambda signal: lambda t: 1.0,
    "sine": _sine_change,
    "polynomial": _polynomial_change,
    "table": _table_change,
}
"""Of what can be prescribed: nothing that jumps."""

DERIVATIVES: dict[Law, Callable[[Signal], list[Signal]]] = {
    "constant": lambda signal: [],
    "ramp": lambda signal: [Signal("constant", signal.amplitude)],
    "sine": _of_sine,
    "polynomial": _of_polynomial,
    "table": _of_table,
}
"""Of what can be prescribed, and of a ramp's constant."""

AREAS: dict[Law, Callable[[Signal, float], float]] = {
    "step": lambda signal, t: max(0.0, t - signal.times[0]),
    "pulse": lambda signal, t: min(max(t, signal.times[0]), signal.times[1]) - signal.times[0],
    "table": lambda signal, t: under(signal.times, signal.values, t),
}
"""The area under the factor of what has corners, up to t [s]."""
