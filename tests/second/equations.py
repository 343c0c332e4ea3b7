"""The equations of motion: accelerations of all bodies and what every row exerts, together."""

from typing import Any, NamedTuple

import numpy as np

from second.moving import Array, Length, cross

STEADY = 6.0  # 1/s: what has drifted away from a row comes back so fast (Baumgarte); it is 1e-10


class Row(NamedTuple):
    """A row that holds: whose it is, what of it, and with what slope friction follows its force."""

    owner: str
    what: str
    length: Length
    follows: Array | None = None


class Solved(NamedTuple):
    """Accelerations of all rates, and the force of each row."""

    a: Array
    forces: Array
    rows: list[Row]

    def of(self, owner: str, what: str) -> float:
        """The force of one row, 0 where it does not hold."""
        return float(sum(f for f, r in zip(self.forces, self.rows, strict=True)
                         if (r.owner, r.what) == (owner, what)))  # fmt: skip


def applied(now: Any) -> Array:
    """All that acts on the bodies, but what the rows exert."""
    m = now.model
    Q = np.zeros(now.n)
    for name, b in m.bodies.items():
        c, w = b.columns
        Q[c] += b.mass * m.gravity[: c.stop - c.start]
        if b.space:
            pose = now.poses[name]
            Q[w] -= cross(pose.w, pose.R @ (b.inertia @ (pose.R.T @ pose.w)))
    for effect in now.effects.values():
        for thing, amount in effect.on:
            Q += amount @ thing.J if np.ndim(amount) else amount * thing.J
    return Q


def mass(now: Any) -> Array:
    """The mass matrix now."""
    return now.model.mass({name: now.poses[name].R for name in now.model.bodies})


def solve(now: Any, rows: list[Row], extra: Array | None = None, redundant: bool = False) -> Solved:
    """M u̇ = Q + Gᵀ f with J u̇ + b = 0 in every row; of redundant rows the least forces."""
    Q = applied(now) + (0 if extra is None else extra)
    n, k = now.n, len(rows)
    A, r = np.zeros((n + k, n + k)), np.zeros(n + k)
    A[:n, :n], r[:n] = mass(now), Q
    for i, row in enumerate(rows):
        l = row.length
        A[n + i, :n] = l.J
        A[:n, n + i] = -(l.J if row.follows is None else l.J + row.follows)
        r[n + i] = -l.b - 2 * STEADY * l.v - STEADY**2 * l.p
    z = np.linalg.lstsq(A, r, rcond=1e-11)[0] if redundant else np.linalg.solve(A, r)
    return Solved(z[:n], z[n:], rows)


def redundant(now: Any, rows: list[Row]) -> bool:
    """Whether some rows say the same: what each exerts is then not determined."""
    n, k = now.n, len(rows)
    A = np.zeros((n + k, n + k))
    A[:n, :n] = mass(now)
    for i, row in enumerate(rows):
        A[n + i, :n] = A[:n, n + i] = row.length.J / np.linalg.norm(row.length.J)
    return bool(np.linalg.cond(A) > 1e10)
