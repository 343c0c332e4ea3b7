"""Force laws in words, for every engine that has to be told a force from outside.

A law is written three times on purpose, because a mistake here would cancel nowhere else: with
the book's letters in `reference/`, here, and as a table of typed values in tests/engines.
"""

import math

from cases.scene import Damper, Signal, Spring


def value(signal: Signal, t: float) -> tuple[float, ...]:
    """The law in time at t [s]: N for a push, N m for a torque."""
    if signal.law == "sine":
        factor = math.sin(signal.angular_frequency * t + signal.phase)
    else:
        factor = t if signal.law == "ramp" else 1.0
    return tuple(amplitude * factor for amplitude in signal.amplitude)


def tension(force: Spring | Damper, length: float, rate: float) -> float:
    """With what force [N] a spring (2.82) or damper (2.47) pulls its two ends together."""
    if isinstance(force, Spring):
        return force.stiffness * (length - force.rest_length)
    return force.damping * rate
