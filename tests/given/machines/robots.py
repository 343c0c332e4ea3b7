"""The five-axis robots, as their cases set them, and their random states."""

import math
from collections.abc import Iterator
from typing import Any

import numpy as np

from textmech.reference.system import MOVING, Array, Mode
from textmech.reference.systems import written

AXES = range(1, 6)


def _numbered(letter: str, *values: float) -> dict[str, float]:
    return {f"{letter}{k}": value for k, value in zip(AXES, values, strict=True)}


RAISED = _numbered("q", *map(math.radians, (20.0, -40.0, 65.0, 35.0, -25.0)))
LOWERED = _numbered("q", *map(math.radians, (20.0, 40.0, 25.0, -20.0, -25.0)))
DRIVES = {
    **_numbered("S", 1.2, 0.8, -1.1, 1.5, 2.3),
    **_numbered("n", 1.7, 2.6, 3.1, 4.3, 5.2),
}
PARAMETERS: dict[str, dict[str, float]] = {
    "driven_robot": {**RAISED, **DRIVES},
    "five_axis_robot": {**LOWERED, **_numbered("w", 0.8, -0.5, 0.9, -1.1, 2.0)},
    "robot_knife": {**RAISED, "w3": 0.9, "w4": -1.1, "w5": 6.0},
}


def robot(name: str, **changed: float) -> Mode:
    """The only mode of the system, with some of its parameters changed."""
    return written(name, {**PARAMETERS[name], **changed}).modes[MOVING]


def states(mode: Any, count: int = 20) -> Iterator[tuple[float, Array, Array]]:
    """Random t, q, v, with the prescribed rates where there are any, and without side slip.

    They keep away from where the edge's rows lose their rank, and those of q̇₁, q̇₂ theirs: there
    Voronets' equations are singular.
    """
    random = np.random.default_rng(1)
    while count:
        t, q, v = random.uniform(0, 5), *random.uniform(-3, 3, (2, 5))
        rows = np.asarray(mode.f_a(t, q))
        if len(rows) == 2 and abs(np.linalg.det(rows[:, :2])) < 0.1:
            continue
        if len(rows):
            v = v - np.linalg.pinv(rows) @ (rows @ v - mode.g(t, q))
        count -= 1
        yield t, q, v
