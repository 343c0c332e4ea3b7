"""Planes of the ground on which bodies stand and slide, seen from the side: straight lines."""

from dataclasses import dataclass
from typing import Any

from .point import FLOOR, Vector


@dataclass(frozen=True)
class Plane:
    """A straight line of the ground on which bodies stand."""

    name: str
    at: Vector = (0.0, 0.0)  # m, a point of it
    normal: Vector = (0.0, 1.0)  # a unit vector that points to where bodies are

    @property
    def along(self) -> Vector:
        """The unit vector with the normal to its left: x, of the floor."""
        return (self.normal[1], -self.normal[0])

    @property
    def level(self) -> bool:
        """Whether it lies along x, as the floor does."""
        return self.normal == (0.0, 1.0)

    def height(self, x: Any, y: Any) -> Any:
        """How far [m] a place is above it, or each of (N,)."""
        return self.normal[0] * (x - self.at[0]) + self.normal[1] * (y - self.at[1])


LEVEL = Plane(FLOOR)
"""The floor y = 0, which every scene in the plane has."""
FLOOR_OF_SPACE = Plane(FLOOR, (0.0, 0.0, 0.0), (0.0, 0.0, 1.0))
"""The floor z = 0, which every scene in space has, and no other plane."""
