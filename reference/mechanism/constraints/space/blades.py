"""Velocity constraints of single points in space: blades, and pivots that stand on the floor.

A blade's point does not move across its heading, as a skate's, or not upward where its height is
kept. Each class has all constraints of its kind and computes their rows at once: see `Kind` of
`constraint_terms` for what the methods return, and for γ.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...kinematics.space.attitude import cross, dot, skew
from ...kinematics.space.kinematics import Bodies, Fixed, Layout, back
from .constraint_terms import Slots, targets
from .joint_constraints import Blade, Pivot

UP = np.array([0.0, 0.0, 1.0])


class Blades:
    """`Blade`: one row each, u·ṙ_P = 0: u level, to the left of the heading h, or upward.

    h is the shadow of the long axis on the floor, its projection along z.
    u = (−h_y, h_x, 0)/|h|, and so u̇ = −ψ̇ (h_x, h_y, 0)/|h| with ψ̇ = (h_x ḣ_y − h_y ḣ_x)/|h|².
    """

    def __init__(self, parts: Sequence[Blade], layout: Layout, first: int) -> None:
        self.size, n, slots = len(parts), layout.where.size, Slots.of(layout)
        self._at = layout.attached([p.at for p in parts])
        # One that goes upward has no long axis: what stands in its place is not used.
        self._along = Fixed(self._at.body, [p.along or (1.0, 0.0, 0.0) for p in parts])
        # Which rows are across a heading; the others are upward.
        self._level = np.array([p.along is not None for p in parts])[:, None]
        rows = first + np.arange(self.size)
        begins = (slots.r_dot[self._at.body], slots.omega[self._at.body])
        self.targets = np.concatenate([targets(rows, begin, n).ravel() for begin in begins])

    def constants(self, rows: Any) -> None:
        """Enters nothing: u turns with the body, so that no entry stays."""

    def directions(self, bodies: Bodies) -> tuple[Any, Any]:
        """u and u̇ (size, 3) each, in ground axes."""
        h, h_dot, _ = self._along.at(bodies).swapaxes(0, 1)
        (x, y, _), (x_dot, y_dot, _) = h.T, h_dot.T
        # A row that goes upward has no heading: its stand-in may be upright, and have no shadow.
        squared = np.where(self._level[:, 0], x * x + y * y, 1.0)
        size = np.sqrt(squared)
        turning = (x * y_dot - y * x_dot) / squared
        nil = np.zeros_like(x)
        u = np.stack([-y / size, x / size, nil], axis=1)
        u_dot = np.stack([-turning * x / size, -turning * y / size, nil], axis=1)
        return np.where(self._level, u, UP), np.where(self._level, u_dot, 0.0)

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """(2.6), (2.7) γ = −u·(ω × (ω × d)) − u̇·ṙ_P; the entries are u at ṙ_c and d × u at ω."""
        P = self._at.at(t, bodies)
        u, u_dot = self.directions(bodies)
        gamma = -dot(u, P.turning) - dot(u_dot, P.r_dot)
        at_omega = back(bodies.R.take(self._at.body, axis=0), cross(P.d, u))
        return [u.ravel(), at_omega.ravel()], np.zeros(self.size), gamma

    def places(self, t: Any, bodies: Bodies) -> Any:
        """nan for each: only rates are known, also of a height: it stays as it is at the start."""
        return np.full(self.size, np.nan)


class Pivots:
    """`Pivot`: three rows each, ṙ_c + ω × d = 0 of a point that stands on the floor z = 0.

    d is the way from the centre of mass to the point, x the same in body axes: d = R x.
    """

    def __init__(self, parts: Sequence[Pivot], layout: Layout, first: int) -> None:
        self.size, n, slots = 3 * len(parts), layout.where.size, Slots.of(layout)
        self._at = layout.attached([p.at for p in parts])
        self._arms = -skew(self._at.x)
        self._rows = first + np.arange(self.size).reshape(-1, 3)
        omegas = np.repeat(slots.omega[self._at.body][:, None], 3, axis=1)
        self.targets = targets(self._rows, omegas, n).ravel()
        self._r_dot = slots.r_dot[self._at.body]

    def constants(self, rows: Any) -> None:
        """Enters the ones of ṙ_c, which do not change with the state."""
        for k, begin in enumerate(self._r_dot.tolist()):
            rows[self._rows[k], begin + np.arange(3)] = 1.0

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """(2.6) ṙ_P = ṙ_c − R [x]× ω, ω in body axes; (2.7) γ = −ω × (ω × d)."""
        blocks = bodies.R.take(self._at.body, axis=0) @ self._arms
        return [blocks.ravel()], np.zeros(self.size), -self._at.at(t, bodies).turning.ravel()

    def places(self, t: Any, bodies: Bodies) -> Any:
        """The height of the point; nan along the floor, where only rates are known."""
        r = self._at.at(t, bodies).r.copy()
        r[:, :2] = np.nan
        return r.ravel()
