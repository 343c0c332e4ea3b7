"""Rows of blades in space: a point does not move across a heading, nor up if its height is kept."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...kinematics.space.attitude import cross, dot, skew
from ...kinematics.space.kinematics import Bodies, Fixed, Layout, back
from .constraint_terms import Slots, targets
from .joint_constraints import Blade, Pivot

UP = np.array([0.0, 0.0, 1.0])


class Blades:
    """`Blade`: u·ṙ_P = 0, u level and across the shadow h of the long axis, or upward.

    u = (−h_y, h_x, 0)/|h|, and so u̇ = −ψ̇ (h_x, h_y, 0)/|h| with ψ̇ = (h_x ḣ_y − h_y ḣ_x)/|h|².
    """

    def __init__(self, parts: Sequence[Blade], layout: Layout, first: int) -> None:
        self.size, n, slots = len(parts), layout.where.size, Slots.of(layout)
        self._at = layout.attached([p.at for p in parts])
        self._along = Fixed(self._at.body, [p.along or (1.0, 0.0, 0.0) for p in parts])
        self._level = np.array([p.along is not None for p in parts])[:, None]
        rows = first + np.arange(self.size)
        begins = (slots.r_dot[self._at.body], slots.omega[self._at.body])
        self.targets = np.concatenate([targets(rows, begin, n).ravel() for begin in begins])

    def constants(self, rows: Any) -> None:
        """None: u turns with the body."""

    def directions(self, bodies: Bodies) -> tuple[Any, Any]:
        """u and u̇ (size, 3), in ground axes."""
        h, h_dot, _ = self._along.at(bodies).swapaxes(0, 1)
        (x, y, _), (x_dot, y_dot, _) = h.T, h_dot.T
        size = np.sqrt(x * x + y * y)
        turning = (x * y_dot - y * x_dot) / (x * x + y * y)
        nil = np.zeros_like(x)
        u = np.stack([-y / size, x / size, nil], axis=1)
        u_dot = np.stack([-turning * x / size, -turning * y / size, nil], axis=1)
        return np.where(self._level, u, UP), np.where(self._level, u_dot, 0.0)

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """(2.6), (2.7) γ = −u·(ω × (ω × d)) − u̇·ṙ_P."""
        P = self._at.at(t, bodies)
        u, u_dot = self.directions(bodies)
        gamma = -dot(u, P.turning) - dot(u_dot, P.r_dot)
        at_omega = back(bodies.R.take(self._at.body, axis=0), cross(P.d, u))
        return [u.ravel(), at_omega.ravel()], np.zeros(self.size), gamma

    def places(self, t: Any, bodies: Bodies) -> Any:
        """Only rates are known, also of a height: it stays what it is at the start."""
        return np.full(self.size, np.nan)


# Rows of a point that stands on the floor z = 0.


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
