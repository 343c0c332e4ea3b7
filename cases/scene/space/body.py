"""Rigid bodies in space. Lengths on a body are in body axes from its centre of mass."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ...fields.kind import Fields
from ...trajectory import Array
from ..frame import SPACE
from ..point import CENTER
from ..rotation import Vector3, turned
from . import chain
from .tensor import Tensor, matrix

_POINT: Fields = {
    "x": ("m", "coordinate"),
    "y": ("m", "coordinate"),
    "z": ("m", "coordinate"),
    "vx": ("m/s", "velocity"),
    "vy": ("m/s", "velocity"),
    "vz": ("m/s", "velocity"),
    "speed": ("m/s", "velocity"),
}
_TURNING: Fields = {
    "attitude": ("rad", "coordinate"),  # its error is the angle between two attitudes
    "omega_1": ("rad/s", "velocity"),  # in body axes
    "omega_2": ("rad/s", "velocity"),
    "omega_3": ("rad/s", "velocity"),
}


@dataclass(frozen=True)
class SpatialBody:
    """A rigid body. A particle has no inertia and no attitude.

    axle: the axis (a unit vector in body axes) about which a disk's rim of `radius` is round; a
    body with a radius and without an axle is round in all directions: a sphere.
    """

    name: str
    shape: Literal["bar", "disk", "block", "sphere", "particle", "rigid"]  # as the file calls it
    mass: float  # kg
    inertia: Tensor | None  # J11, J22, J33, J12, J13, J23 about the centre of mass, kg m²
    points: Mapping[str, Vector3]  # m, in body axes from the centre of mass; `center` is (0, 0, 0)
    radius: float | None = None  # of a disk or a sphere, m
    axle: Vector3 | None = None
    size: Vector3 | None = None  # of a block, m

    @property
    def turns(self) -> bool:
        """Whether it has an attitude: a particle has none."""
        return self.inertia is not None

    @property
    def tensor(self) -> Array:
        """J (3, 3) [kg m²] in body axes about the centre of mass; zero of a particle."""
        return np.zeros((3, 3)) if self.inertia is None else matrix(self.inertia)

    def quantities(self) -> dict[str, Fields]:
        """Its fields, and those of each of its points."""
        own = {**_POINT, **(_TURNING if self.turns else {})}
        return {self.name: own, **{f"{self.name}.{point}": _POINT for point in self.points}}

    def numbers(self) -> dict[str, float]:
        """mass [kg] and, if it turns, the six of the tensor [kg m²]."""
        names = [f"inertia_{ik}" for ik in ("11", "22", "33", "12", "13", "23")]
        return {"mass": self.mass} | dict(zip(names, self.inertia or (), strict=False))

    def mobility(self, point: str) -> float:
        """The largest of 1/m + d̃ᵀ J⁻¹ d̃ [1/kg]: how easily the point of the free body moves."""
        if not self._finite(point):
            return math.nan
        d = np.cross(np.eye(3), self.points[point])
        turning = d.T @ np.linalg.pinv(self.tensor, hermitian=True) @ d
        return 1 / self.mass + float(np.linalg.eigvalsh(turning)[-1])

    def about(self, point: str) -> float:
        """The least moment of inertia [kg m²] about an axis through the point across its arm d."""
        if not self._finite(point):
            return math.nan
        d = np.asarray(self.points[point], dtype=float)
        across = np.array(chain.across([self.points[point]] if d.any() else []))
        least = float(np.linalg.eigvalsh(across @ self.tensor @ across.T)[0])
        return max(least, 0.0) + self.mass * float(d @ d)

    def _finite(self, point: str) -> bool:
        """Whether no number is missing, as a mistaken parameter's is."""
        numbers = (self.mass, *(self.inertia or ()), *self.points[point])
        return all(map(math.isfinite, numbers))

    def observe(self, states: Array, point: str, field: str) -> Array:
        """(N,) a field of the point ("": of itself), from its states (N, 13).

        Of `attitude` (N, 4): the quaternion.
        """
        if field == "attitude":
            return states[:, SPACE.attitude]
        if field in _TURNING:
            return states[:, SPACE.spin][:, int(field[-1]) - 1]
        p = self.point(states, point or CENTER)
        if field == "speed":
            return np.linalg.norm(p[:, 3:], axis=1)
        return p[:, ("x", "y", "z", "vx", "vy", "vz").index(field)]

    def point(self, states: Array, point: str) -> Array:
        """(N, 6): place and velocity of a point (2.1), (2.6), in ground axes."""
        x, q = np.asarray(self.points[point]), states[:, SPACE.attitude]
        place, velocity = states[:, SPACE.place], states[:, SPACE.velocity]
        if not self.turns or not x.any():
            return np.hstack([place, velocity])
        moving = turned(q, np.cross(states[:, SPACE.spin], x))
        return np.hstack([place + turned(q, x), velocity + moving])
