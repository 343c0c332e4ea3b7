"""The systems that switch, as their cases set them, and random states of each mode."""

import math
from collections.abc import Iterator

import numpy as np

from textmech.reference.system import Array, System
from textmech.reference.systems import written

BOOK = {"F_minus": 3.0, "F_plus": 3.0, "Fs_minus": 6.0, "Fs_plus": 6.0}
SMOOTH = {"Delta": 5e-4, "A": 1e5}
PARAMETERS: dict[str, dict[str, float]] = {
    "anisotropic_drift": {
        "m": 1.0, "A": 5.0, "w": 2 * math.pi,
        "F_minus": 3.0, "F_plus": 1.0, "Fs_minus": 4.0, "Fs_plus": 1.5,
    },
    "bouncing_disk": {"m": 0.8, "R": 0.2, "e": 1.0, "y0": 0.7},
    "dynamometer": {"m": 1.0, "c": 2.0, "u": 2.0, **BOOK},
    "growing_force": {"m": 1.0, "b": 1.0, **BOOK},
    "sliding_block": {
        "m": 1.4, "mu_s": 0.5, "mu_k": 0.4, "beta": math.radians(20), "v0": -2.0,
    },
    "sliding_disk": {
        "m": 1.3, "R": 0.25, "mu": 0.4, "beta": math.radians(10), "v0": 3.0, "w0": 20.0,
    },
    "smooth_dynamometer": {"m": 1.0, "c": 2.0, "u": 2.0, **BOOK, **SMOOTH},
    "smooth_growing_force": {"m": 1.0, "b": 1.0, **BOOK, **SMOOTH},
}  # fmt: skip


def example(name: str, **changed: float) -> System:
    """The system of the case, with some of its parameters changed."""
    return written(name, {**PARAMETERS[name], **changed})


def states(name: str, mode: str, count: int = 50) -> Iterator[tuple[float, Array, Array]]:
    """Random t, q, v that the mode's constraints allow."""
    random = np.random.default_rng(1)
    system = example(name).modes[mode]
    for _ in range(count):
        t, n = random.uniform(0.0, 5.0), len(system.coordinates)
        q, v = random.uniform(-2.0, 2.0, n), random.uniform(-5.0, 5.0, n)
        if n == 3:
            q[1] = 0.25
        if name == "bouncing_disk":
            q = np.array([0.2]) if mode == "rest" else q + 2.2
        rows = system.f_a(t, q)
        yield t, q, v - np.linalg.pinv(rows) @ (rows @ v) if len(rows) else v
