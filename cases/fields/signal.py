"""Named laws in time."""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Literal

import numpy as np

from ..trajectory import Array

Law = Literal["constant", "ramp", "sine", "step", "pulse", "polynomial", "table"]


@dataclass(frozen=True)
class Signal:
    """A named law in time: an amplitude along each axis, times one number that follows the law.

    That is 1 of a constant, t of a ramp, sin(w t + phase) of a sine, 1 from times[0] on of a step
    (0 before), 1 from times[0] until times[1] of a pulse, Σ values[k] tᵏ of a polynomial; of a
    table the values at the times, lines between them, and outside the nearest value.
    """

    law: Law  # how the number goes
    amplitude: tuple[float, ...]  # N for a push (x, y), N m for a torque (one entry)
    angular_frequency: float = 0.0  # w of a sine, rad/s
    phase: float = 0.0  # of a sine, rad
    times: tuple[float, ...] = ()  # s, where a step, a pulse or a table has its corners
    values: tuple[float, ...] = ()  # of a table at its times; of a polynomial its coefficients

    @property
    def corners(self) -> tuple[float, ...]:
        """When [s] it is not smooth: where it jumps or has a kink."""
        return self.times

    def at(self, times: Array) -> Array:
        """(N, axes) its values at the times [s]; on a jump those after it."""
        return NUMBERS[self.law](self, times)[:, None] * np.array(self.amplitude)

    def rate(self, times: Array) -> Array:
        """(N, axes) how fast its values change at the times [s], of one that moves a point."""
        return RATES[self.law](self, times)[:, None] * np.array(self.amplitude)

    def later(self, by: float) -> "Signal":
        """Returns the same law from the time `by` [s] on, up to which none of its corners lies."""
        if self.law == "ramp":
            return replace(self, law="polynomial", values=(by, 1.0))
        if self.law == "polynomial":
            shifted = np.polynomial.Polynomial(self.values)(np.polynomial.Polynomial([by, 1.0]))
            return replace(self, values=tuple(shifted.coef.tolist()))
        phase = self.phase + self.angular_frequency * by
        return replace(self, phase=phase, times=tuple(t - by for t in self.times))

    def at_start(self) -> tuple[float, ...]:
        """Its values at t = 0."""
        return tuple(self.at(np.zeros(1))[0].tolist())


NUMBERS: dict[Law, Callable[[Signal, Array], Any]] = {
    "constant": lambda signal, t: np.ones_like(t),
    "ramp": lambda signal, t: t,
    "sine": lambda signal, t: np.sin(signal.angular_frequency * t + signal.phase),
    "step": lambda signal, t: (t >= signal.times[0]).astype(float),
    "pulse": lambda signal, t: ((t >= signal.times[0]) & (t < signal.times[1])).astype(float),
    "polynomial": lambda signal, t: np.polynomial.polynomial.polyval(t, signal.values),
    "table": lambda signal, t: np.interp(t, signal.times, signal.values),
}
"""(N,) the number that follows the law, at the times [s]."""

RATES: dict[Law, Callable[[Signal, Array], Any]] = {
    "ramp": lambda signal, t: np.ones_like(t),
    "sine": lambda signal, t: (
        signal.angular_frequency * np.cos(signal.angular_frequency * t + signal.phase)
    ),
    "polynomial": lambda signal, t: np.polynomial.polynomial.polyval(
        t, np.polynomial.polynomial.polyder(signal.values)
    ),
}
"""(N,) how fast it changes, of laws without corners."""
