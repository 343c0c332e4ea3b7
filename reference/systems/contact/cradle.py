"""Three disks in a row strike each other one after the other, with restitution e, and nothing acts.

q = (x₁, x₂, x₃). Disks that touch would strike at one instant, of which rigid bodies know nothing:
they start apart.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Guard, Load, Mass, Mode, Pose, System, Vector

BODIES = ("left", "middle", "right")
PAIRS = ("first", "second")
ENDLESS = 7 - 4 * math.sqrt(3)  # of e: below, three bodies may strike without end


@dataclass(frozen=True)
class _Free(Mode):
    """Between two impacts."""

    m: tuple[float, float, float]
    R: float

    coordinates = ("x1", "x2", "x3")

    def __post_init__(self) -> None:
        masses = {name: Mass(m, m * self.R**2 / 2) for name, m in zip(BODIES, self.m, strict=True)}
        object.__setattr__(self, "masses", masses)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.23) ẍ = 0 [m/s²], (3,)."""
        return np.zeros(3)

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ Σ m ẋ² [J]."""
        return sum(m * x**2 for m, x in zip(self.m, v, strict=True)) / 2

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R_k = (x_k, 0)."""
        pairs = zip(BODIES, q, v, strict=True)
        return {name: (x, 0.0, 0.0, x_dot, 0.0, 0.0) for name, x, x_dot in pairs}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """Nothing acts."""
        return []


@dataclass(frozen=True)
class Cradle(System):
    """m1, m2, m3 [kg], R [m], restitution e; from 0, x2 and x3 [m], the first with v0 [m/s]."""

    m1: float
    m2: float
    m3: float
    R: float
    e: float
    v0: float
    x2: float
    x3: float

    def __post_init__(self) -> None:
        if not self.x2 > 2 * self.R or not self.x3 > self.x2 + 2 * self.R:
            raise ValueError(
                f"the disks must start apart: x2 = {self.x2}, x3 = {self.x3}, R = {self.R}"
            )
        if not ENDLESS < self.e <= 1.0:
            raise ValueError(f"with e = {self.e} they may strike without end: e > {ENDLESS:.4f}")
        object.__setattr__(self, "modes", {"free": _Free((self.m1, self.m2, self.m3), self.R)})

    def start(self) -> tuple[str, Array, Array]:
        """The first moves, the others rest."""
        return "free", np.array([0.0, self.x2, self.x3]), np.array([self.v0, 0.0, 0.0])

    def guards(self, mode: str) -> Sequence[Guard]:
        """x_{k+1} − x_k = 2 R: `first strikes`, `second strikes`."""
        return tuple(
            Guard(f"{name} strikes", self._gap(k), self._then(k)) for k, name in enumerate(PAIRS)
        )

    def _gap(self, k: int) -> Callable[[float, Array, Array], float]:
        return lambda t, q, v: float(q[k + 1] - q[k] - 2 * self.R)

    def _then(self, k: int) -> Callable[[float, Array, Array], tuple[str, Array, Array]]:
        return lambda t, q, v: ("free", q, self._struck(k, v))

    def _struck(self, k: int, v: Array) -> Array:
        """(2.23) over the instant: u = (m v + m' v')/(m + m') stays, and v' − v turns by −e."""
        m, n = (self.m1, self.m2, self.m3)[k : k + 2]
        v = v.copy()
        u, relative = (m * v[k] + n * v[k + 1]) / (m + n), v[k + 1] - v[k]
        v[k], v[k + 1] = u + self.e * relative * n / (m + n), u - self.e * relative * m / (m + n)
        return v

    def _pieces(self, until: float) -> list[tuple[float, int, Array, Array]]:
        """Each impact's time, pair, places and velocities after it; the start is one of none.

        The impulse Λ = (1 + e)(v − v')/(1/m + 1/m') takes Λ/m from one, and the other gets Λ/m'.
        """
        m = np.array([self.m1, self.m2, self.m3])
        q, v = np.array([0.0, self.x2, self.x3]), np.array([self.v0, 0.0, 0.0])
        impacts = [(0.0, -1, q, v)]
        while True:
            t, last, q, v = impacts[-1]
            gaps, closing = np.diff(q) - 2 * self.R, -np.diff(v)
            waits = [
                gaps[k] / closing[k] if closing[k] > 0 and k != last else math.inf for k in (0, 1)
            ]
            k = int(np.argmin(waits))
            if not t + waits[k] <= until:
                return impacts
            impulse = (1 + self.e) * closing[k] / (1 / m[k] + 1 / m[k + 1])
            blow = np.zeros(3)
            blow[k], blow[k + 1] = -impulse, impulse
            impacts.append((t + waits[k], k, q + waits[k] * v, v + blow / m))

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """x = x_k + v_k (t − t_k) since the last impact."""
        begins, _, q, v = self._pieces(t)[-1]
        return q + (t - begins) * v, v

    def closed_events(self, until: float) -> list[tuple[str, float]]:
        """The impacts up to `until`, each from the places and velocities after the one before."""
        return [(f"{PAIRS[k]} strikes", t) for t, k, *_ in self._pieces(until)[1:]]

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """x_{k+1} − x_k ≥ 2 R, but for rounding."""
        depth = 2 * self.R - float(np.min(np.diff(q)))
        return f"two disks overlap by {depth:.3g} m" if depth > 1e-12 * self.x3 else None
