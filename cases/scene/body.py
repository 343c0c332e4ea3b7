"""Rigid bodies. Lengths on a body are in body axes from its centre of mass."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..fields.kind import Fields
from ..trajectory import ANGLE, OMEGA, VX, VY, Array, X, Y
from .point import CENTER, Vector

_POINT: Fields = {
    "x": ("m", "coordinate"),
    "y": ("m", "coordinate"),
    "vx": ("m/s", "velocity"),
    "vy": ("m/s", "velocity"),
    "speed": ("m/s", "velocity"),
}
_TURNING: Fields = {
    "angle": ("rad", "coordinate"),
    "omega": ("rad/s", "velocity"),
}
_ACCELERATION: Fields = {  # as the producer gives it
    "ax": ("m/s²", "acceleration"),
    "ay": ("m/s²", "acceleration"),
}
_ANGULAR: Fields = {"alpha": ("rad/s²", "acceleration")}


@dataclass(frozen=True)
class Body:
    """A rigid body. A particle has no inertia and no angle."""

    name: str
    shape: Literal["bar", "disk", "block", "particle", "rigid", "spokes"]  # as the file calls it
    mass: float  # kg
    inertia: float | None  # about the centre of mass, kg m²; None: it cannot turn
    points: Mapping[str, Vector]  # m, in body axes from the centre of mass; `center` is (0, 0)
    radius: float | None = None  # of a disk or what else is round, m: its rim touches, no point
    tips: tuple[str, ...] = ()  # of spokes: the points with which it touches, counter-clockwise
    size: Vector | None = None  # of a block, m

    @property
    def turns(self) -> bool:
        """Whether it has an angle: a particle has none."""
        return self.inertia is not None

    def quantities(self) -> dict[str, Fields]:
        """Its fields, and those of each of its points."""
        own = {**_POINT, **_ACCELERATION, **({**_TURNING, **_ANGULAR} if self.turns else {})}
        return {self.name: own, **{f"{self.name}.{point}": _POINT for point in self.points}}

    def numbers(self) -> dict[str, float]:
        """mass [kg] and, if it turns, inertia [kg m²]."""
        return {"mass": self.mass} | ({} if self.inertia is None else {"inertia": self.inertia})

    def mobility(self, point: str) -> float:
        """1/m + d²/J [1/kg]: how easily the point of the free body moves across its arm d."""
        d = math.hypot(*self.points[point])
        return 1 / self.mass + (d**2 / self.inertia if self.inertia else 0.0)

    def about(self, point: str) -> float:
        """J + m d² [kg m²] about the point."""
        return (self.inertia or 0.0) + self.mass * math.hypot(*self.points[point]) ** 2

    def observe(self, states: Array, point: str, field: str) -> Array:
        """(N,) a field of the point ("": of itself), from its states (N, 6); else KeyError."""
        if field in _TURNING:
            return states[:, ANGLE if field == "angle" else OMEGA]
        p = self.point(states, point or CENTER)
        if field == "speed":
            return np.hypot(p[:, 2], p[:, 3])
        return p[:, {"x": 0, "y": 1, "vx": 2, "vy": 3}[field]]

    def point(self, states: Array, point: str) -> Array:
        """(N, 4): x, y, vx, vy of a point (2.1), (2.6)."""
        a, b = self.points[point]
        cos, sin = np.cos(states[:, ANGLE]), np.sin(states[:, ANGLE])
        dx, dy = cos * a - sin * b, sin * a + cos * b
        vx, vy = states[:, VX] - states[:, OMEGA] * dy, states[:, VY] + states[:, OMEGA] * dx
        return np.stack([states[:, X] + dx, states[:, Y] + dy, vx, vy], axis=1)
