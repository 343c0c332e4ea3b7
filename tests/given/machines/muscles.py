"""The hand-written muscles as their cases set them: places and an inner state."""

from collections.abc import Iterator

import numpy as np

from textmech.reference.system import MOVING, Array, Mode
from textmech.reference.systems import written

SPRINGS = {"cs": 30000.0, "cp": 4000.0, "L": 0.3}
PARAMETERS: dict[str, dict[str, float]] = {
    "linear_muscle_load": {"m": 5.0, "F0": 1000.0, "b": 2000.0, **SPRINGS},
    "muscle_isometric": {
        "m": 1.0, "F0": 1000.0, "a": 250.0, "b": 0.15, **SPRINGS, "l": 0.32, "u0": 0.315,
    },
    "muscle_load": {"m": 5.0, "F0": 1000.0, "a": 250.0, "b": 0.15, **SPRINGS},
}  # fmt: skip


def muscle(name: str, **changed: float) -> Mode:
    """The system of the case, with some of its parameters changed."""
    return written(name, {**PARAMETERS[name], **changed}).modes[MOVING]


def drawn(name: str, count: int = 30) -> Iterator[tuple[float, Array, Array]]:
    """Random states: what contracts bears from −100 N to 1500 N; what is held stays held."""
    random = np.random.default_rng(2)
    held = name == "muscle_isometric"
    for _ in range(count):
        y = -0.32 if held else random.uniform(-0.4, -0.2)
        u = -y - random.uniform(-100.0, 1500.0) / 30000.0
        v = 0.0 if held else random.uniform(-2.0, 2.0)
        yield random.uniform(0.0, 1.0), np.array([y, u]), np.array([v])
