"""Laws in time, real or complex, and their rates."""

from typing import Any

import numpy as np

from ...cases.signal import Signal


def signal(law: Signal, t: Any) -> tuple[Any, ...]:
    """A push's components [N] or a torque [N m] at time t: A, A t or A sin(w t + phase)."""
    if law.law == "constant":
        return law.amplitude
    size = t if law.law == "ramp" else np.sin(law.angular_frequency * t + law.phase)
    return tuple(entry * size for entry in law.amplitude)


def slope(law: Signal, t: Any) -> tuple[Any, ...]:
    """The rate at time t of what `signal` says: 0, A or A w cos(w t + phase)."""
    w = law.angular_frequency
    size = {"constant": 0.0, "ramp": 1.0, "sine": w * np.cos(w * t + law.phase)}[law.law]
    return tuple(entry * size for entry in law.amplitude)
