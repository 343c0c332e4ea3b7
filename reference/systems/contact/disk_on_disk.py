"""Disk on a disk that turns about its fixed centre: it rolls down, slips, and leaves.

q = (ρ, θ, φ, ψ): the disk's centre in polar coordinates about that of the drum, θ from x on, and
the angles of disk and drum, all counter-clockwise. N pushes outwards, F along −e_θ, downhill on
the right.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Guard, Load, Mass, Mode, Pose, System, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class _Disks(Mode):
    """In contact, where it rolls (sigma 0) or slips (sigma its sign); or in flight."""

    m: float
    M: float
    R: float
    r: float
    mu: float
    sigma: int
    flies: bool = False

    coordinates = ("rho", "theta", "phi", "psi")

    def __post_init__(self) -> None:
        masses = {"drum": Mass(self.M, self._J_D), "wheel": Mass(self.m, self._J)}
        object.__setattr__(self, "masses", masses)

    @property
    def _J(self) -> float:
        """(2.32) J₃₃ = m r²/2 [kg m²]."""
        return self.m * self.r**2 / 2

    @property
    def _J_D(self) -> float:
        return self.M * self.R**2 / 2

    def normal(self, q: Array, v: Array) -> float:
        """(2.23) N = m (g sin θ − ρ θ̇²) [N], ρ being R + r; nothing in flight."""
        return 0.0 if self.flies else self.m * float(G * np.sin(q[1]) - q[0] * v[1] ** 2)

    def friction(self, q: Array, v: Array) -> float:
        """F = −g cos θ/(3/m + 2/M) where it rolls, by (2.34) with (2.16); (2.87) else [N]."""
        if self.flies or self.sigma:
            return -self.sigma * self.mu * self.normal(q, v)
        return -G * math.cos(q[1]) / (3 / self.m + 2 / self.M)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.23) m (ρ̈ − ρ θ̇²) = N − m g sin θ, m (ρ θ̈ + 2 ρ̇ θ̇) = −F − m g cos θ; (2.34)
        J φ̈ = r F, J_D ψ̈ = R F [m/s², rad/s²], (4,).
        """
        (rho, theta, *_), (rho_dot, theta_dot, *_) = q.tolist(), v.tolist()
        F = self.friction(q, v)
        outwards = rho * theta_dot**2 - G * math.sin(theta) if self.flies else 0.0
        around = -F / self.m - G * math.cos(theta) - 2 * rho_dot * theta_dot
        return np.array([outwards, around / rho, self.r * F / self._J, self.R * F / self._J_D])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) N and F, and what carries the drum: its weight, N and F [N]."""
        N, F = self.normal(q, v), self.friction(q, v)
        cos, sin = math.cos(q[1]), math.sin(q[1])
        return {
            "touch.normal": N, "touch.tangent": F,
            "axle.fx": N * cos + F * sin, "axle.fy": self.M * G + N * sin - F * cos,
        }  # fmt: skip

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m (ρ̇² + ρ² θ̇²) + ½ J φ̇² + ½ J_D ψ̇² [J]."""
        moves = self.m * (v[0] ** 2 + q[0] ** 2 * v[1] ** 2)
        return (moves + self._J * v[2] ** 2 + self._J_D * v[3] ** 2) / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g ρ sin θ [J]."""
        return self.m * G * q[0] * np.sin(q[1])

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q = F (0, −ρ, r, R) of the friction that slides: it does the power F · slip."""
        if self.flies or not self.sigma:
            return np.zeros(4)
        F = -self.sigma * self.mu * self.m * (G * np.sin(q[1]) - q[0] * v[1] ** 2)
        return np.array([0.0 * F, -q[0] * F, self.r * F, self.R * F])

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.14) ρ = R + r in contact [m]."""
        return np.zeros(0) if self.flies else np.array([q[0] - self.R - self.r])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) ρ̇ = 0, and −ρ θ̇ + r φ̇ + R ψ̇ = 0 where it rolls: λ are N and F."""
        if self.flies:
            return np.zeros((0, 4))
        unit, none = 0.0 * q[0] + 1.0, 0.0 * q[0]
        rows = [[unit, none, none, none]]
        return np.array(rows if self.sigma else [*rows, [none, -q[0], self.r, self.R]])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = 0, R₂ = ρ e_ρ."""
        cos, sin = np.cos(q[1]), np.sin(q[1])
        x_dot, y_dot = v[0] * cos - q[0] * v[1] * sin, v[0] * sin + q[0] * v[1] * cos
        return {
            "drum": (0.0, 0.0, q[3], 0.0, 0.0, v[3]),
            "wheel": (q[0] * cos, q[0] * sin, q[2], x_dot, y_dot, v[2]),
        }

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weights, and the friction that slides where both touch."""
        rho, cos, sin = float(q[0]), math.cos(q[1]), math.sin(q[1])
        weights = [
            Load("drum", (0.0, 0.0), (0.0, -self.M * G)),
            Load("wheel", (rho * cos, rho * sin), (0.0, -self.m * G)),
        ]
        if self.flies or not self.sigma:
            return weights
        F, at = self.friction(q, v), (self.R * cos, self.R * sin)
        slides = Load("wheel", at, (F * sin, -F * cos)), Load("drum", at, (-F * sin, F * cos))
        return [*weights, *slides]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The drum's axle, and where both touch: outwards, and downhill where it rolls."""
        cos, sin = math.cos(q[1]), math.sin(q[1])
        cuts = [Cut(("axle.fx", "axle.fy"), None, "drum", (0.0, 0.0))]
        names, ways = ("touch.normal", "touch.tangent"), ((cos, sin), (sin, -cos))
        if not self.flies:
            k, at = 1 if self.sigma else 2, (self.R * cos, self.R * sin)
            cuts.append(Cut(names[:k], "drum", "wheel", at, ways[:k]))
        return cuts


@dataclass(frozen=True)
class DiskOnDisk(System):
    """m and r of the disk, M and R of the drum [kg, m], friction mu; from rest at theta0 [rad].

    L = R + r [m] is where the disk's centre starts.
    """

    m: float
    M: float
    R: float
    r: float
    mu: float
    theta0: float
    L: float

    def __post_init__(self) -> None:
        if not math.isclose(self.L, self.R + self.r, rel_tol=1e-12):
            raise ValueError(f"it starts on the drum: L = R + r = {self.R + self.r}, not {self.L}")
        if not 0.0 < self.theta0 < math.pi / 2:
            raise ValueError(f"it rolls down on the right: 0 < theta0 < 90°, not {self.theta0} rad")
        sizes = (self.m, self.M, self.R, self.r, self.mu)
        modes = {
            "rolls": _Disks(*sizes, 0),
            "slips": _Disks(*sizes, 1),
            "flies": _Disks(*sizes, 0, True),
        }
        object.__setattr__(self, "modes", modes)

    def start(self) -> tuple[str, Array, Array]:
        """At rest; it rolls if friction is enough."""
        q, v = np.array([self.L, self.theta0, 0.0, 0.0]), np.zeros(4)
        return "rolls" if self._margin(0.0, q, v) >= 0 else "slips", q, v

    def guards(self, mode: str) -> Sequence[Guard]:
        """μ N = |F|: it slips, and ever faster; N = 0: it leaves."""
        leaves = Guard("leaves", self._push, lambda t, q, v: ("flies", q, v))
        if mode == "rolls":
            return leaves, Guard("slips", self._margin, lambda t, q, v: ("slips", q, v))
        return (leaves,) if mode == "slips" else ()

    def _disks(self, mode: str) -> _Disks:
        disks = self.modes[mode]
        assert isinstance(disks, _Disks)
        return disks

    def _push(self, t: float, q: Array, v: Array) -> float:
        return self._disks("rolls").normal(q, v)

    def _margin(self, t: float, q: Array, v: Array) -> float:
        """(2.89) μ N − |F| of rolling [N]."""
        rolls = self._disks("rolls")
        return self.mu * rolls.normal(q, v) - abs(rolls.friction(q, v))

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.89) |F| ≤ μ N where it rolls, N ≥ 0, ρ ≥ R + r in flight; slipping downhill."""
        disks = self._disks(mode)
        N, small = disks.normal(q, v), 1e-9 * self.m * G
        if mode == "flies":
            depth = self.L - float(q[0])
            return f"the disk is {depth:.3g} m in the drum" if depth > 1e-9 * self.L else None
        if -small > N:
            return f"the drum would have to pull with {-N:.6g} N"
        if mode == "rolls" and self._margin(t, q, v) < -small:
            return f"rolling takes {abs(disks.friction(q, v)):.6g} N, there is {self.mu * N:.6g}"
        slip = -q[0] * v[1] + self.r * v[2] + self.R * v[3]
        if mode == "slips" and slip < -1e-9 * abs(q[0] * v[1]):
            return "it slips uphill"
        return None
