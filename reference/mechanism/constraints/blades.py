"""What changes in the rows of blades: their directions, and speeds that are prescribed."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ....cases.scene import Signal, Vector
from ..kinematics.coordinates import Attached
from ..kinematics.signal import bend, signal, slope
from .rows import GAMMA, G


class Blades:
    """What `Carried` has beside its constants, for all points p; u in the axes of their bodies."""

    def __init__(self, blades: Sequence[tuple[int, Attached, Vector]], width: int) -> None:
        rows, points, directions = zip(*blades, strict=True)
        row, self._phi = np.array(rows), np.array([p.phi for p in points])
        self._xy = np.array([p.xy for p in points])
        self._x, self._y = np.transpose(directions)
        x, gamma = row * width + self._xy, (row + 1) * width + GAMMA
        self.targets = np.concatenate([x, x + 1, gamma])

    def __call__(self, t: Any, q: Any, v: Any) -> list[Any]:
        """(2.15) u at x and y; differentiated, u·r̈_p + u̇·ṙ_p with u̇ = ω × u, (2.6) and (2.7).

        u·r̈_p = f_a q̈ᵃ − ω² u·d and u̇·ṙ_p = ω (u × ṙ_c) + ω² u·d: γ = −ω (u × ṙ_c).
        """
        cos, sin = np.cos(q[self._phi]), np.sin(q[self._phi])
        x, y = cos * self._x - sin * self._y, sin * self._x + cos * self._y
        return [x, y, v[self._phi] * (y * v[self._xy] - x * v[self._xy + 1])]


class Laws:
    """What `Given` prescribes, for all of them."""

    def __init__(self, laws: Sequence[tuple[int, Signal]], width: int) -> None:
        self._laws = [law for _, law in laws]
        end = (np.array([i for i, _ in laws]) + 1) * width
        self.targets = np.concatenate([end + G, end + GAMMA])

    def __call__(self, t: Any, q: Any, v: Any) -> list[Any]:
        """(2.15) g = s(t), and γ = ṡ(t)."""
        return [[signal(law, t)[0] for law in self._laws], [slope(law, t)[0] for law in self._laws]]


class Moves:
    """What `Along` has of points of the ground that move by a law."""

    def __init__(self, moves: Sequence[tuple[int, Signal, Vector]], width: int) -> None:
        self._moves = [(law, u) for _, law, u in moves]
        end = (np.array([i for i, *_ in moves]) + 1) * width
        self.targets = np.concatenate([end + G, end + GAMMA])

    def __call__(self, t: Any, q: Any, v: Any) -> list[Any]:
        """(2.15) g = −u·ṙ_p, and γ = −u·r̈_p."""
        return [[self._along(u, rate(law, t)) for law, u in self._moves] for rate in (slope, bend)]

    @staticmethod
    def _along(u: Vector, rate: Sequence[Any]) -> Any:
        return -(u[0] * rate[0] + u[1] * rate[1])
