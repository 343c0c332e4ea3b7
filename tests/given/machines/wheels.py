"""The wheels that roll upright on a plane, as their cases set them, and their random states."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from textmech.reference.system import MOVING, Array, Mode
from textmech.reference.systems import written

WHEEL = {"m": 1.3, "R": 0.25, "mu": 1.0}
DRIVES = {"Omega": 1.2, "k": 0.8, "A": 0.9, "nu": 3.0}
PARAMETERS = {
    "upright_wheel": {**WHEEL, "alpha": math.radians(10), "w": 6.0, "Omega": 1.2},
    "driven_wheel": {**WHEEL, "alpha": math.radians(10), "w": 6.0, **DRIVES},
}
FROM_ABOVE = {
    "wheel_from_above": {
        "M": 1.95, "J": 0.0203125, "gravity": 2 * 9.80665 / 3, "alpha": math.radians(10),
        "u0": 1.5, "w0": 1.2,
    },
}  # fmt: skip
"""The free wheel on its incline, seen from above: a knife edge with the mass 3/2 m."""
CIRCLE, WEAVE, CLOTHOID = {"k": 0.0, "A": 0.0}, {"Omega": 0.0, "k": 0.0}, {"Omega": 0.0, "A": 0.0}
# Changes of the parameters, of which a closed form is known.
CLOSED = {
    "free on an incline": ("upright_wheel", {}),
    "free on the level": ("upright_wheel", {"alpha": 0.0}),
    "free, hardly turning": ("upright_wheel", {"Omega": 1e-6}),
    "free, straight down": ("upright_wheel", {"Omega": 0.0}),
    "driven on a circle": ("driven_wheel", CIRCLE),
    "driven on a clothoid": ("driven_wheel", CLOTHOID),
    "driven on a clothoid to the right": ("driven_wheel", {**CLOTHOID, "k": -0.8}),
}


def wheel(name: str, **changed: float) -> Mode:
    """The only mode of the system, with some of its parameters changed."""
    return written(name, {**PARAMETERS[name], **changed}).modes[MOVING]


def states(mode: Any, count: int = 20) -> Iterator[tuple[float, Array, Array]]:
    """Random t, q, v that roll, and have the prescribed rates where they are."""
    random = np.random.default_rng(1)
    for _ in range(count):
        t, q = random.uniform(0.0, 5.0), random.uniform(-3.0, 3.0, 4)
        rates = random.uniform(-5.0, 5.0, 2)
        if len(mode.f_a(t, q)) == 4:
            rates = np.asarray(mode.g(t, q))[2:]
        rolling = mode.R * rates[1] * np.array([math.cos(q[2]), math.sin(q[2])])
        yield t, q, np.array([*rolling, *rates])
