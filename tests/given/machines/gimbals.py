"""The sprung gimbal as its case sets it, damped and driven, and its random states."""

from collections.abc import Iterator
from math import radians

import numpy as np

from textmech.reference.system import MOVING, Array, Mode
from textmech.reference.systems import written

GIMBAL = {
    "m": 2.0, "R": 0.3, "a": 3.0, "b": 4.0, "c1": 2.4, "theta0": radians(-15), "d1": 0.05,
    "c2": 1.7, "phi0": radians(25), "d2": 0.02, "M": 0.6, "Omega": 7.0,
    "theta": radians(40), "phi": radians(-30), "w1": 0.7, "w2": -1.0,
}  # fmt: skip
PARAMETERS = {"sprung_gimbal": GIMBAL}
# Changes of the parameters: each has its closed form.
VARIANTS: dict[str, dict[str, float]] = {
    "driven": {},
    "free": {"d1": 0.0, "d2": 0.0, "M": 0.0},
    "creeping": {"d1": 2.0, "d2": 3.0},
    "crossed at a right angle": {"b": 0.0},
    "leaning back": {"b": -4.0},
}


def gimbal(**changed: float) -> Mode:
    """The only mode, with some of its parameters changed."""
    return written("sprung_gimbal", {**GIMBAL, **changed}).modes[MOVING]


def states(count: int = 20) -> Iterator[tuple[float, Array, Array]]:
    """Random t, q, v."""
    random = np.random.default_rng(2)
    for _ in range(count):
        yield random.uniform(0.0, 5.0), random.uniform(-3.0, 3.0, 2), random.uniform(-5.0, 5.0, 2)
