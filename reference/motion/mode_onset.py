"""A mode that has just begun: what its guards say may be nothing but rounding.

What is pushed a little harder than friction holds has a speed of the wrong sign as long as the
difference is less than the rounding of both, which is no stop.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.linalg import LinAlgError

from ..integrators.march import AT_ONCE, span
from ..integrators.slope import Slope, leaps, noise
from ..system import Array
from .event_location import INSIDE, Fall, Rounding

# Times the noise: rest and motion may compute a force in two ways, that differ by some ulp all
# along, which is no noise. A push that is above friction by 1e-13 of itself is still heard.
HEARD = 100.0


@dataclass(frozen=True)
class Early:
    """Since when a mode lasts, from which y, by which slope, and the times to come."""

    f: Slope
    y: Array
    times: Sequence[float]

    @cached_property
    def lasts(self) -> float:
        """How long it is early [s]."""
        return AT_ONCE * span(self.times)

    @cached_property
    def noise(self) -> Array | None:
        """The rounding of ẏ as it begins; None if that is no small part of it."""
        f, t, far = self.f, self.times[0], self.lasts
        with np.errstate(all="ignore"):
            try:
                least, later = leaps(f, t, self.y, far), np.abs(f(self.times[-1], self.y))
                return noise(f, t, self.y, far, np.abs(self.y), least, later)
            except (ArithmeticError, ValueError, LinAlgError):  # it may not be defined so far out
                return None

    def rounding(self, t: float, points: Sequence[float]) -> Rounding | None:
        """A function for a guard's rounding in a step from t; None: early no more, or not known."""
        began = self.times[0]
        if t - began > self.lasts or self.noise is None:
            return None
        least = INSIDE[0] * points[-1]  # what is looked at before has rounding of its own
        ages = np.array([t - began + max(at, least) for at in points])
        blur = np.diag(HEARD * ages[-1] * self.noise)

        def rounding(guard: Fall, y: Array) -> Array:
            there, end = guard(t + points[-1], y), t + points[-1]
            return sum(abs(guard(end, y + each) - there) for each in blur) * ages / ages[-1]

        return rounding
