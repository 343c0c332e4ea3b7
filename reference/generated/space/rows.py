"""Rows of constraints in space: f_a v = g (2.15), γ of f_a v̇ = γ, and the places (2.14).

Rows of a kind are computed together. v holds ω in body axes, so that f_a has body components
there, and ω̇ in ground axes is E ω̇ of body axes.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from .attitude import cross, skew
from .held import Dot, Line, Together
from .kinematics import Bodies, Layout, back, carried

Entries = tuple[Any, ...]


class Kind(Protocol):
    """Some rows, numbered from `first` on."""

    size: int
    targets: Any  # where `values` stand, in the matrix of all rows row by row; −1: nowhere

    def constants(self, rows: Any) -> None:
        """Enters what does not change with the state."""
        ...

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """What stands at the targets, g and γ (size,)."""
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
        """Of a scene's bodies by number, the ground last."""
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
        self.size, n, slots = 3 * len(parts), layout.where.size, Slots.of(layout)
        self._a, self._b = (layout.attached([end(p) for p in parts]) for end in (_a, _b))
        self._arms = skew(self._a.x), -skew(self._b.x)
        self.rows = first + np.arange(self.size).reshape(-1, 3)
        omegas = [np.repeat(slots.omega[e.body][:, None], 3, axis=1) for e in (self._a, self._b)]
        self.targets = np.concatenate([targets(self.rows, o, n).ravel() for o in omegas])
        self._r_dot = [(slots.r_dot[e.body], s) for e, s in ((self._a, -1.0), (self._b, 1.0))]
        self._g = (self._a.velocity - self._b.velocity).ravel()

    def constants(self, rows: Any) -> None:
        for begins, sign in self._r_dot:
            for k, begin in enumerate(begins.tolist()):
                if begin >= 0:
                    rows[self.rows[k], begin + np.arange(3)] = sign

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """(2.6) ṙ_P = ṙ_c − R [x]× ω; γ is what (2.7) has beside the accelerations."""
        a, b = self._a, self._b
        blocks = [np.matmul(bodies.R[e.body], X) for e, X in zip((a, b), self._arms, strict=True)]
        gamma = a.at(t, bodies).turning - b.at(t, bodies).turning
        return [block.ravel() for block in blocks], self._g, gamma.ravel()

    def places(self, t: Any, bodies: Bodies) -> Any:
        return (self._b.at(t, bodies).r - self._a.at(t, bodies).r).ravel()


class Dots:
    """`Dot`: d/dt u·w = (ω_b − ω_a)·(w × u)."""

    def __init__(self, parts: Sequence[Dot], layout: Layout, first: int) -> None:
        self.size, n, slots = len(parts), layout.where.size, Slots.of(layout)
        self._a, self._b = (
            np.array([layout.numbers[name] for name in names], np.intp)
            for names in ([p.a for p in parts], [p.b for p in parts])
        )
        self._u, self._w = (
            np.array(x, float) for x in ([p.u for p in parts], [p.w for p in parts])
        )
        self._c = np.array([p.c for p in parts])
        rows = first + np.arange(self.size)
        self.targets = np.concatenate(
            [targets(rows, slots.omega[at], n).ravel() for at in (self._a, self._b)]
        )

    def constants(self, rows: Any) -> None:
        """None."""

    def axes(self, bodies: Bodies) -> tuple[Any, Any]:
        """(size, 3) u and w in ground axes."""
        return carried(bodies.R[self._a], self._u), carried(bodies.R[self._b], self._w)

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """γ = −(ω_b − ω_a)·d/dt (w × u), u̇ = ω_a × u and ẇ = ω_b × w."""
        u, w = self.axes(bodies)
        spin = bodies.spin
        omega_a, omega_b = spin[self._a], spin[self._b]
        s = cross(w, u)
        s_dot = cross(cross(omega_b, w), u) + cross(w, cross(omega_a, u))
        gamma = ((omega_a - omega_b) * s_dot).sum(axis=1)
        at_a, at_b = back(bodies.R[self._a], s), back(bodies.R[self._b], s)
        return [-at_a.ravel(), at_b.ravel()], np.zeros(self.size), gamma

    def places(self, t: Any, bodies: Bodies) -> Any:
        u, w = self.axes(bodies)
        return (u * w).sum(axis=1) - self._c


class Lines:
    """`Line`: d/dt u·Δ = u·(ṙ_B − ṙ_A) + ω_a·(u × Δ), u fixed in a and Δ = r_B − r_A."""

    def __init__(self, parts: Sequence[Line], layout: Layout, first: int) -> None:
        self.size, n, slots = len(parts), layout.where.size, Slots.of(layout)
        self._a, self._b = (layout.attached([end(p) for p in parts]) for end in (_a, _b))
        self._u = np.array([p.u for p in parts], float)
        rows = first + np.arange(self.size)
        begins = [at[e.body] for e in (self._a, self._b) for at in (slots.r_dot, slots.omega)]
        self.targets = np.concatenate([targets(rows, begin, n).ravel() for begin in begins])

    def constants(self, rows: Any) -> None:
        """None: u turns, but on the ground."""

    def values(self, t: Any, bodies: Bodies) -> tuple[list[Any], Any, Any]:
        """γ = −(2 u̇·Δ̇ + (ω_a × (ω_a × u))·Δ + u·(what (2.7) has beside the accelerations))."""
        R_a, R_b = bodies.R[self._a.body], bodies.R[self._b.body]
        a, b = self._a.at(t, bodies), self._b.at(t, bodies)
        omega_a = bodies.spin[self._a.body]
        u = carried(R_a, self._u)
        u_dot = cross(omega_a, u)
        gap, gap_dot = b.r - a.r, b.r_dot - a.r_dot
        gamma = -(
            2 * u_dot * gap_dot + cross(omega_a, u_dot) * gap + u * (b.turning - a.turning)
        ).sum(axis=1)
        g = (u * (self._a.velocity - self._b.velocity)).sum(axis=1)
        at_a = back(R_a, cross(u, gap) - cross(a.d, u))
        at_b = back(R_b, cross(b.d, u))
        return [-u.ravel(), at_a.ravel(), u.ravel(), at_b.ravel()], g, gamma

    def direction(self, bodies: Bodies) -> Any:
        """(size, 3) u in ground axes."""
        return carried(bodies.R[self._a.body], self._u)

    def places(self, t: Any, bodies: Bodies) -> Any:
        a, b = self._a.at(t, bodies), self._b.at(t, bodies)
        return (self.direction(bodies) * (b.r - a.r)).sum(axis=1)


def _a(part: Together | Line) -> Any:
    return part.a


def _b(part: Together | Line) -> Any:
    return part.b
