"""Points of bodies and of the ground, by name.

Planar frame: x right, y up, angles counter-clockwise, SI units.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..fields.signal import Signal
from ..trajectory import Array

GROUND = "ground"
CENTER = "center"
FLOOR = "floor"

Vector = tuple[Any, ...]  # floats; so written, a type checker lets two or three of them pass
"""A place or a direction: as many numbers as the frame has axes."""


@dataclass(frozen=True)
class Anchor:
    """A named point of a body or of the ground."""

    body: str  # its name, or `ground`
    point: str  # its name on that: of a body `center` or one of its points

    def __str__(self) -> str:
        return f"{self.body}.{self.point}"


def anchor(word: str) -> Anchor:
    """The point that a case file writes as `body.point`; a body alone is its centre."""
    body, _, point = word.partition(".")
    return Anchor(body, point or CENTER)


@dataclass(frozen=True)
class GroundPoint:
    """A point of the ground, or one driven at a constant velocity, or by a law (rheonomous).

    moves: by how much [m] it is away from `at`, in ground axes.
    """

    at: Vector  # m, at t = 0
    velocity: Vector = (0.0, 0.0)  # m/s
    moves: Signal | None = None

    @property
    def driven(self) -> bool:
        return any(self.velocity) or self.moves is not None

    def states(self, times: Array) -> Array:
        """(N, 4): x, y, vx, vy at the times [s]; in space (N, 6)."""
        velocity = np.asarray(self.velocity) if self.driven else np.zeros(len(self.at))
        position = np.asarray(self.at) + velocity * times[:, None]
        rate = np.broadcast_to(velocity, position.shape)
        if self.moves is not None:
            position, rate = position + self.moves.at(times), rate + self.moves.rate(times)
        return np.hstack([position, rate])

    def state(self, t: float) -> tuple[float, ...]:
        """x, y, vx, vy at time t [s]; in space six numbers."""
        return tuple(self.states(np.array([t]))[0].tolist())
