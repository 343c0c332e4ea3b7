"""Rows of constraints in space: f_a v = g (2.15), γ of f_a v̇ = γ, and the places (2.14).

Rows of a kind are computed together. v holds ω in body axes, so that f_a has body components
there, and ω̇ in ground axes is E ω̇ of body axes.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ...kinematics.space.attitude import cross, crossed, dot, skew
from ...kinematics.space.kinematics import Bodies, Fixed, Layout, back
from .joint_constraints import Dot, Line, Together

Entries = tuple[Any, ...]


class Kind(Protocol):
    """Some rows, numbered from `first` on."""

    size: int
    targets: Any  # where `values` stand, in the matrix of all rows row by row; −1: nowhere

    def constants(self, rows: Any) -> None:
        """Enters what does not change with the state."""
        ...

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """The numbers at the targets, g and γ (size,)."""
        ...

    def places(self, t: Any, bodies: Bodies) -> Any:
        """(size,) what the rows are the rates of, less what it is held at; nan: only rates."""
        ...


@dataclass(frozen=True)
class Slots:
    """Where bodies' ṙ and ω stand in a row of n numbers; −1 for what has none."""

    r_dot: Any
    omega: Any

    @classmethod
    def of(cls, layout: Layout) -> "Slots":
        """The slots of a scene's bodies by number, the ground last."""
        at = list(layout.where.columns.values())
        omegas = [-1 if c.omega is None else c.omega for c in at]
        return cls(np.array([*(c.r_dot for c in at), -1]), np.array([*omegas, -1]))


def targets(rows: Any, begins: Any, n: int) -> Any:
    """(…, 3): the three entries from `begins` on in each row; −1 where there are none."""
    places = (rows * n + begins)[..., None] + np.arange(3)
    return np.where(begins[..., None] < 0, -1, places)


class Points:
    """`Together`: three rows each, r_B − r_A = 0."""

    def __init__(self, parts: Sequence[Together], layout: Layout, first: int) -> None:
        self._count, n, slots = len(parts), layout.where.size, Slots.of(layout)
        self.size = 3 * self._count
        self._ends = ends = layout.attached([*(p.a for p in parts), *(p.b for p in parts)])
        self._arms = skew(ends.x)
        self._arms[self._count :] *= -1
        self._rows = np.tile(first + np.arange(self.size).reshape(-1, 3), (2, 1))
        omegas = np.repeat(slots.omega[ends.body][:, None], 3, axis=1)
        self.targets = targets(self._rows, omegas, n).ravel()
        self._r_dot = slots.r_dot[ends.body]
        self._g = (ends.velocity[: self._count] - ends.velocity[self._count :]).ravel()

    def constants(self, rows: Any) -> None:
        for k, begin in enumerate(self._r_dot.tolist()):
            if begin >= 0:
                rows[self._rows[k], begin + np.arange(3)] = -1.0 if k < self._count else 1.0

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """(2.6) ṙ_P = ṙ_c − R [x]× ω; γ is what (2.7) has beside the accelerations."""
        blocks = bodies.R.take(self._ends.body, axis=0) @ self._arms
        turning = self._ends.arms.at(bodies)[:, 2]
        gamma = turning[: self._count] - turning[self._count :]
        return [blocks.ravel()], self._g, gamma.ravel()

    def places(self, t: Any, bodies: Bodies) -> Any:
        r = self._ends.at(t, bodies).r
        return (r[self._count :] - r[: self._count]).ravel()


class Dots:
    """`Dot`: d/dt u·w = (ω_b − ω_a)·(w × u)."""

    def __init__(self, parts: Sequence[Dot], layout: Layout, first: int) -> None:
        self.size, n, slots = len(parts), layout.where.size, Slots.of(layout)
        names = [*(p.a for p in parts), *(p.b for p in parts)]
        self._both = np.array([layout.numbers[name] for name in names], np.intp)
        self._axes = Fixed(self._both, [*(p.u for p in parts), *(p.w for p in parts)])
        self._c = np.array([p.c for p in parts])
        rows = np.tile(first + np.arange(self.size), 2)
        self.targets = targets(rows, slots.omega[self._both], n).ravel()

    def constants(self, rows: Any) -> None:
        """None."""

    def axes(self, bodies: Bodies) -> tuple[Any, Any]:
        """(size, 3) u and w in ground axes."""
        found = self._axes.at(bodies)[:, 0]
        return found[: self.size], found[self.size :]

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """γ = −(ω_b − ω_a)·d/dt (w × u), u̇ = ω_a × u and ẇ = ω_b × w."""
        found = self._axes.at(bodies)[:, :2].reshape(-1, 6)
        s, s_dot = crossed(found[self.size :], found[: self.size])
        omega = bodies.spin.take(self._both, axis=0)
        gamma = dot(omega[: self.size] - omega[self.size :], s_dot)
        at_both = back(bodies.R.take(self._both, axis=0), np.concatenate((-s, s)))
        return [at_both.ravel()], np.zeros(self.size), gamma

    def places(self, t: Any, bodies: Bodies) -> Any:
        u, w = self.axes(bodies)
        return dot(u, w) - self._c


class Lines:
    """`Line`: d/dt u·Δ = u·(ṙ_B − ṙ_A) + ω_a·(u × Δ), u fixed in a and Δ = r_B − r_A."""

    def __init__(self, parts: Sequence[Line], layout: Layout, first: int) -> None:
        self.size, n, slots = len(parts), layout.where.size, Slots.of(layout)
        self._ends = ends = layout.attached([*(p.a for p in parts), *(p.b for p in parts)])
        self._u = Fixed(ends.body[: self.size], [p.u for p in parts])
        rows = np.tile(first + np.arange(self.size), 2)
        begins = (slots.r_dot[ends.body], slots.omega[ends.body])
        self.targets = np.concatenate([targets(rows, begin, n).ravel() for begin in begins])
        self._driven = ends.velocity[: self.size] - ends.velocity[self.size :]

    def constants(self, rows: Any) -> None:
        """None: u turns, but on the ground."""

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """γ = −(2 u̇·Δ̇ + (ω_a × (ω_a × u))·Δ + u·(what (2.7) has beside the accelerations))."""
        ends, (u, u_dot, u_turning) = self._ends.at(t, bodies), self._u.at(bodies).swapaxes(0, 1)
        gap, gap_dot, turning = ends.between(self.size)
        gamma = -dot(2 * u_dot, gap_dot) - dot(u_turning, gap) - dot(u, turning)
        arms = np.concatenate((-gap - ends.d[: self.size], ends.d[self.size :]))
        at_both = back(bodies.R.take(self._ends.body, axis=0), cross(arms, np.concatenate((u, u))))
        return [-u.ravel(), u.ravel(), at_both.ravel()], dot(u, self._driven), gamma

    def direction(self, bodies: Bodies) -> Any:
        """(size, 3) u in ground axes."""
        return self._u.at(bodies)[:, 0]

    def places(self, t: Any, bodies: Bodies) -> Any:
        gap = self._ends.at(t, bodies).between(self.size)[0]
        return dot(self.direction(bodies), gap)
