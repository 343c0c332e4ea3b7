"""The frame of a scene: a plane or space, and what the columns of a body's states mean there.

Plane: x right, y up, angles counter-clockwise. Space: z up; an attitude is a unit quaternion
(w, x, y, z) that turns body axes into ground axes, and ω stands in body axes.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

import numpy as np

from ..trajectory import Array
from .chain import orthogonal_complement
from .rotation import turned

Anything = TypeVar("Anything")


@dataclass(frozen=True, eq=False)
class Frame:
    """The axes of the ground, and where place, attitude, velocity and ω stand in a state."""

    name: str  # PLANE or SPACE: all else follows
    axes: ClassVar[tuple[str, ...]]
    inertias: ClassVar[tuple[str, ...]]  # names of the moments of inertia, as a body has them
    place: ClassVar[slice]
    attitude: ClassVar[slice]
    velocity: ClassVar[slice]
    spin: ClassVar[slice]

    def __reduce__(self) -> str:
        return self.name  # there are two: another process has its own

    @property
    def dimension(self) -> int:
        """Number of coordinates of a place: 2 or 3."""
        return len(self.axes)

    @property
    def width(self) -> int:
        """The number of columns of a body's states."""
        return self.spin.stop

    def alike(self, unit: str) -> Sequence[int]:
        """The columns of a unit; an attitude in space has none of its own."""
        columns = {"m": self.place, "m/s": self.velocity, "rad/s": self.spin}
        if self.dimension == 2:
            columns["rad"] = self.attitude
        return range(self.width)[columns[unit]] if unit in columns else ()

    def along_axes(self, fields: Mapping[str, Anything]) -> dict[str, Anything]:
        """The fields but for those along an axis that there is not: `vz` in the plane."""
        absent = {"x", "y", "z"} - {*self.axes}
        return {name: of for name, of in fields.items() if name[-1] not in absent}

    def tensor(self, inertia: Sequence[float]) -> Array:
        """J in body axes about the centre of mass, (1, 1) or (3, 3) [kg m²] (2.32); none is 0."""
        raise NotImplementedError

    def turned(self, attitude: Array, vector: Any) -> Array:
        """(N, d) the components in ground axes of a vector that is given in body axes."""
        raise NotImplementedError

    def omega(self, states: Array) -> Array:
        """(N, 1) or (N, 3) how fast a body turns [rad/s], in ground axes."""
        raise NotImplementedError

    def moved(self, states: Array, point: Any) -> Array:
        """(N, 2 d) place and velocity of a point of a body (2.1), (2.6), in ground axes."""
        raise NotImplementedError

    def level(self, vectors: Array) -> Array:
        """(N, 2) unit vectors along what is level of vectors: their shadows on the floor."""
        raise NotImplementedError

    def size(self, vectors: Array) -> Array:
        """(N,) the lengths of vectors (N, d)."""
        raise NotImplementedError

    def mobility(self, inertia: Sequence[float], arm: Sequence[float]) -> float:
        """The largest of d̃ᵀ J⁻¹ d̃ [1/kg]: how easily a body turns out of the way of a force."""
        raise NotImplementedError

    def least_moment(self, inertia: Sequence[float], arm: Sequence[float]) -> float:
        """The least moment of inertia [kg m²] about an axis through the centre, across an arm."""
        raise NotImplementedError


class _Plane(Frame):
    axes = ("x", "y")
    inertias = ("inertia",)
    place, attitude, velocity, spin = slice(0, 2), slice(2, 3), slice(3, 5), slice(5, 6)

    def tensor(self, inertia: Sequence[float]) -> Array:
        return np.reshape([*inertia] or 0.0, (1, 1))

    def turned(self, attitude: Array, vector: Any) -> Array:
        (x, y), cos, sin = vector, np.cos(attitude[:, 0]), np.sin(attitude[:, 0])
        return np.stack([cos * x - sin * y, sin * x + cos * y], axis=1)

    def omega(self, states: Array) -> Array:
        return states[:, self.spin]

    def moved(self, states: Array, point: Any) -> Array:
        x, y, _, vx, vy, omega = states.T
        dx, dy = self.turned(states[:, self.attitude], point).T
        return np.stack([x + dx, y + dy, vx - omega * dy, vy + omega * dx], axis=1)

    def level(self, vectors: Array) -> Array:
        return vectors  # seen from above

    def size(self, vectors: Array) -> Array:
        return np.hypot(*vectors.T)

    def mobility(self, inertia: Sequence[float], arm: Sequence[float]) -> float:
        return math.hypot(*arm) ** 2 / inertia[0] if inertia else 0.0

    def least_moment(self, inertia: Sequence[float], arm: Sequence[float]) -> float:
        return inertia[0] if inertia else 0.0


class _Space(Frame):
    axes = ("x", "y", "z")
    inertias = tuple(f"inertia_{ik}" for ik in ("11", "22", "33", "12", "13", "23"))
    place, attitude, velocity, spin = slice(0, 3), slice(3, 7), slice(7, 10), slice(10, 13)

    def tensor(self, inertia: Sequence[float]) -> Array:
        a, b, c, d, e, f = inertia or (0.0,) * 6
        return np.array([[a, d, e], [d, b, f], [e, f, c]])

    def turned(self, attitude: Array, vector: Any) -> Array:
        return turned(attitude, vector)

    def omega(self, states: Array) -> Array:
        return turned(states[:, self.attitude], states[:, self.spin])

    def moved(self, states: Array, point: Any) -> Array:
        place, velocity, q = (states[:, c] for c in (self.place, self.velocity, self.attitude))
        if not np.any(point):
            return np.hstack([place, velocity])
        moving = turned(q, np.cross(states[:, self.spin], point))
        return np.hstack([place + turned(q, point), velocity + moving])

    def level(self, vectors: Array) -> Array:
        shadow = vectors[:, :2]
        return shadow / np.linalg.norm(shadow, axis=1, keepdims=True)

    def size(self, vectors: Array) -> Array:
        return np.linalg.norm(vectors, axis=1)

    def mobility(self, inertia: Sequence[float], arm: Sequence[float]) -> float:
        d = np.cross(np.eye(3), arm)
        turning = d.T @ np.linalg.pinv(self.tensor(inertia), hermitian=True) @ d
        return float(np.linalg.eigvalsh(turning)[-1])

    def least_moment(self, inertia: Sequence[float], arm: Sequence[float]) -> float:
        axes = np.array(orthogonal_complement([arm] if any(arm) else []))
        least = float(np.linalg.eigvalsh(axes @ self.tensor(inertia) @ axes.T)[0])
        return max(least, 0.0)


PLANE: Frame = _Plane("PLANE")
SPACE: Frame = _Space("SPACE")


def frame_of(width: int) -> Frame:
    """The frame in which a body's states have so many columns."""
    return {frame.width: frame for frame in (PLANE, SPACE)}[width]
