"""Rows of a point that stands on the floor z = 0."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...kinematics.space.attitude import skew
from ...kinematics.space.kinematics import Bodies, Layout
from .held import Pivot
from .rows import Slots, targets


class Pivots:
    """`Pivot`: ṙ_c + ω × d = 0, d from the centre to the point."""

    def __init__(self, parts: Sequence[Pivot], layout: Layout, first: int) -> None:
        self.size, n, slots = 3 * len(parts), layout.where.size, Slots.of(layout)
        self._at = layout.attached([p.at for p in parts])
        self._arms = -skew(self._at.x)
        self._rows = first + np.arange(self.size).reshape(-1, 3)
        omegas = np.repeat(slots.omega[self._at.body][:, None], 3, axis=1)
        self.targets = targets(self._rows, omegas, n).ravel()
        self._r_dot = slots.r_dot[self._at.body]

    def constants(self, rows: Any) -> None:
        for k, begin in enumerate(self._r_dot.tolist()):
            rows[self._rows[k], begin + np.arange(3)] = 1.0

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """(2.6) ṙ_P = ṙ_c − R [x]× ω; (2.7) γ = −ω × (ω × d)."""
        blocks = bodies.R.take(self._at.body, axis=0) @ self._arms
        return [blocks.ravel()], np.zeros(self.size), -self._at.at(t, bodies).turning.ravel()

    def places(self, t: Any, bodies: Bodies) -> Any:
        """The height of the point; along the floor only rates are known."""
        r = self._at.at(t, bodies).r.copy()
        r[:, :2] = np.nan
        return r.ravel()
