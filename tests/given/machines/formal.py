"""Modes that are no case: with v other than q̇, in space, and bound by what cannot be integrated."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from textmech.reference.system import Array, Mode

from .rolling_bodies import Sleigh, SleighAhead, UprightWheel
from .turning_bodies import FreeBody, Top, unit

DRIVEN: dict[str, Any] = {"d": 0.3, "w0": 0.4, "w1": 0.7}
FORMAL: dict[str, Mode] = {
    "free body": FreeBody(),
    "top": Top(),
    "sleigh": Sleigh(),
    "sleigh on a driven blade": Sleigh(**DRIVEN),
    "sleigh by its own velocities": SleighAhead(),
    "sleigh by its own velocities on a driven blade": SleighAhead(**DRIVEN),
    "upright wheel": UprightWheel(),
}
SIZES = {"free body": 6, "top": 3} | {
    name: 2 for name in FORMAL if name.startswith("sleigh by its own")
}
EXACT = 1e-12  # of the largest term: all of it is algebra


def drawn(name: str, count: int = 100) -> Iterator[tuple[float, Array, Array]]:
    """Random t, q, v that meet the constraints of the mode."""
    mode, random = FORMAL[name], np.random.default_rng(1)
    n = SIZES.get(name, len(mode.coordinates))
    for _ in range(count):
        t, v = random.uniform(0.0, 2.0), random.uniform(-5.0, 5.0, n)
        q = random.uniform(-2.0, 2.0, len(mode.coordinates))
        if "q3" in mode.coordinates:
            q[-4:] = unit(random)
        rows = np.reshape(mode.f_a(t, q), (-1, n))
        yield t, q, v - np.linalg.pinv(rows) @ (rows @ v - mode.g(t, q))
