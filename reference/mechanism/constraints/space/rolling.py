"""Rows of what rolls without slip on the floor z = 0, and of prescribed rates."""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...kinematics.signal import signal, slope
from ...kinematics.space.attitude import cross, dot, skew
from ...kinematics.space.kinematics import Bodies, Fixed, Layout, back
from .constraint_terms import Slots, targets
from .joint_constraints import Drive, Rim

UP = np.array([0.0, 0.0, 1.0])


class Rims:
    """`Rim`: ṙ_c + ω × ρ = 0, ρ from the centre to the lowest point (2.19).

    ρ = −R (z − (z·n) n)/√(1 − (z·n)²), n the axle; of a sphere ρ = −R z.
    """

    def __init__(self, parts: Sequence[Rim], layout: Layout, first: int) -> None:
        self.size, n, slots = 3 * len(parts), layout.where.size, Slots.of(layout)
        self._body = np.array([layout.numbers[p.body] for p in parts], np.intp)
        self._R = np.array([p.radius for p in parts])[:, None]
        self._rim = np.array([p.axle is not None for p in parts])[:, None]
        self._axle = Fixed(self._body, [p.axle or (0.0, 0.0, 0.0) for p in parts])
        self.rows = first + np.arange(self.size).reshape(-1, 3)
        omegas = np.repeat(slots.omega[self._body][:, None], 3, axis=1)
        self.targets = targets(self.rows, omegas, n).ravel()
        self._r_dot = slots.r_dot[self._body]

    def constants(self, rows: Any) -> None:
        for k, begin in enumerate(self._r_dot.tolist()):
            rows[self.rows[k], begin + np.arange(3)] = 1.0

    def arm(self, bodies: Bodies) -> tuple[Any, Any]:
        """ρ and its rate (K, 3): n turns with the body, and the lowest point with n."""
        n, n_dot, _ = self._axle.at(bodies).swapaxes(0, 1)
        z, z_dot = n[:, 2:], n_dot[:, 2:]
        size = np.sqrt(1 - z * z)
        steep = (UP - z * n) / size
        steep_dot = (-z_dot * n - z * n_dot) / size + steep * (z * z_dot) / (1 - z * z)
        return -self._R * steep, -self._R * np.where(self._rim, steep_dot, 0.0)

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """(2.19) f = (1, −[ρ]× E): ṙ_c + ω × ρ = 0; its rate has ω × ρ̇ beside accelerations."""
        rho, rho_dot = self.arm(bodies)
        blocks = -skew(rho) @ bodies.R.take(self._body, axis=0)
        gamma = -cross(bodies.spin.take(self._body, axis=0), rho_dot)
        return [blocks.ravel()], np.zeros(self.size), gamma.ravel()

    def places(self, t: Any, bodies: Bodies) -> Any:
        """The height of the lowest point; along the floor only rates are known."""
        low = bodies.r.take(self._body, axis=0) + self.arm(bodies)[0]
        low[:, :2] = np.nan
        return low.ravel()


class Drives:
    """`Drive`: m·(ω_b − ω_a) = g(t) of a turn, d/dt u·Δ = g(t) of a shift.

    Of two turns about n₁, fixed in a, and n₂, fixed in b, with n₁·n₂ = c, ω_rel = θ̇₁ n₁ + θ̇₂ n₂
    and m₁ = (n₁ − c n₂)/(1 − c²); of one m = n.
    """

    def __init__(self, parts: Sequence[Drive], layout: Layout, first: int) -> None:
        self.size, n, slots = len(parts), layout.where.size, Slots.of(layout)
        self._laws = [p.rate for p in parts]
        self._ends = ends = layout.attached([*(p.a for p in parts), *(p.b for p in parts)])
        none = (0.0, 0.0, 0.0)
        turns = [
            *(p.turns[:1] or (none,) for p in parts),
            *(p.turns[-1:] or (none,) for p in parts),
        ]
        self._turns = Fixed(ends.body, turns)
        self._weights = np.array([_weights(p) for p in parts], float).reshape(-1, 2, 1)
        self._shift = Fixed(ends.body[: self.size], [_dual(p) for p in parts])
        rows = np.tile(first + np.arange(self.size), 2)
        begins = (slots.r_dot[ends.body], slots.omega[ends.body])
        self.targets = np.concatenate([targets(rows, begin, n).ravel() for begin in begins])
        self._driven = ends.velocity[: self.size] - ends.velocity[self.size :]

    def constants(self, rows: Any) -> None:
        """None."""

    def axes(self, bodies: Bodies) -> tuple[Any, Any]:
        """m and ṁ (size, 3) in ground axes; 0 of a shift."""
        found = self._turns.at(bodies)[:, :2]
        both = self._weights[:, :1] * found[: self.size] + self._weights[:, 1:] * found[self.size :]
        return both[:, 0], both[:, 1]

    def direction(self, bodies: Bodies) -> Any:
        """(size, 3) u of a shift in ground axes; 0 of a turn."""
        return self._shift.at(bodies)[:, 0]

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """γ = ġ − ṁ·(ω_b − ω_a) of a turn; of a shift as `Lines` has it."""
        m, m_dot = self.axes(bodies)
        ends, (u, u_dot, u_turning) = (
            self._ends.at(t, bodies),
            self._shift.at(bodies).swapaxes(0, 1),
        )
        gap, gap_dot, turning = ends.between(self.size)
        omega = bodies.spin.take(self._ends.body, axis=0)
        beside = m_dot * (omega[self.size :] - omega[: self.size]) + 2 * u_dot * gap_dot
        laws = np.array([(*signal(law, t), *slope(law, t)) for law in self._laws])
        gamma = laws[:, 1] - (beside + u_turning * gap + u * turning).sum(axis=1)
        arms = np.concatenate((-gap - ends.d[: self.size], ends.d[self.size :]))
        turned = cross(arms, np.concatenate((u, u))) + np.concatenate((-m, m))
        values = [
            -u.ravel(),
            u.ravel(),
            back(bodies.R.take(self._ends.body, axis=0), turned).ravel(),
        ]
        return values, laws[:, 0] + dot(u, self._driven), gamma

    def places(self, t: Any, bodies: Bodies) -> Any:
        """Only rates are known."""
        return np.full(self.size, np.nan)


def _weights(drive: Drive) -> tuple[float, float]:
    """Weights of the first and the last axis in m."""
    if drive.shift is not None:
        return 0.0, 0.0
    if len(drive.turns) == 1:
        return 1.0, 0.0
    c = float(np.dot(drive.turns[0], drive.turns[1]))
    own, other = 1 / (1 - c * c), -c / (1 - c * c)
    return (own, other) if drive.number == 0 else (other, own)


def _dual(drive: Drive) -> Any:
    """The vector whose product with a sum of shifts is the driven one's share."""
    if drive.shift is None:
        return np.zeros(3)
    axes = np.array(drive.shifts, float)
    return np.linalg.pinv(axes.T)[drive.shifts.index(drive.shift)]
