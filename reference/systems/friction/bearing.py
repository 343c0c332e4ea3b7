"""Rotor in a bearing with dry and viscous friction, driven by a torque (2.34), (2.89).

q = (φ,), the turn of a disk about its axle, which carries its weight.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Guard, Load, Mass, Mode, Pose, System, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class _Rotor(Mode):
    """A disk m, R that turns forward against M_k + d φ̇ [N m]; M_k is None where it sticks."""

    m: float
    R: float
    M_k: float | None
    d: float
    M: float
    k: float

    coordinates = ("phi",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"disk": Mass(self.m, self.m * self.R**2 / 2)})

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.34) J₃₃ φ̈ = M + k t − M_k − d φ̇ [N m]; φ̈ = 0 where it sticks, (1,) [rad/s²]."""
        if self.M_k is None:
            return np.zeros(1)
        moment = self.M + self.k * t - self.M_k - self.d * v[0]
        return np.array([2 * moment / (self.m * self.R**2)])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) the axle holds the weight; (2.89) M_fr = −M_k, −(M + k t) where it sticks."""
        friction = -(self.M + self.k * t) if self.M_k is None else -self.M_k
        return {"axle.fx": 0.0, "axle.fy": self.m * G, "axle.friction": friction}

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ J₃₃ φ̇² [J]."""
        return self.m * self.R**2 / 4 * v[0] ** 2

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.46) D = ½ d φ̇² [W]."""
        return self.d * v[0] ** 2 / 2

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q = M + k t − M_k: the drive, and the dry friction of turning [N m], (1,)."""
        return np.array([self.M + self.k * t - (self.M_k or 0.0)])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) φ̇ = 0 where it sticks: λ is the moment of friction."""
        return np.ones((1, 1)) if self.M_k is None else np.zeros((0, 1))

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) the centre stays at the axle, angle = φ."""
        still = 0.0 * q[0]
        return {"disk": (still, still, q[0], still, still, v[0])}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight, the drive, and the moments of friction but that of rest."""
        at = (0.0, 0.0)
        brakes = -self.d * float(v[0]) - (self.M_k or 0.0)
        return [
            Load("disk", at, (0.0, -self.m * G), brakes),
            Load("disk", at, (0.0, 0.0), self.M + self.k * t),
        ]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The axle; where it sticks, with its moment."""
        names, at = ("axle.fx", "axle.fy"), (0.0, 0.0)
        if self.M_k is None:
            return [Cut((*names, "axle.friction"), None, "disk", at, moment=True)]
        return [Cut(names, None, "disk", at)]


@dataclass(frozen=True)
class Bearing(System):
    """m [kg], R [m]; dry friction M_s, M_k [N m], viscous d [N m s]; it starts with w0 [rad/s].

    The drive is M + k t [N m]. All push forward or nowhere, so that it never turns back.
    """

    m: float
    R: float
    M_s: float
    M_k: float
    d: float
    M: float
    k: float
    w0: float

    def __post_init__(self) -> None:
        if not self.M_s >= self.M_k >= 0.0:
            raise ValueError(f"0 ≤ M_k ≤ M_s is broken by M_k = {self.M_k}, M_s = {self.M_s}")
        if min(self.d, self.M, self.k, self.w0) < 0.0:
            raise ValueError("d, M, k and w0 must not be negative: it would turn back")
        shared = (self.d, self.M, self.k)
        modes = {
            "turns": _Rotor(self.m, self.R, self.M_k, *shared),
            "sticks": _Rotor(self.m, self.R, None, *shared),
        }
        object.__setattr__(self, "modes", modes)

    def start(self) -> tuple[str, Array, Array]:
        """At φ = 0 with w0; (2.89) from rest it turns if M > M_s."""
        turns = self.w0 > 0.0 or self.M_s < self.M
        return "turns" if turns else "sticks", np.zeros(1), np.array([self.w0])

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.89) `stops` where φ̇ = 0, `slips` where M + k t comes to M_s."""
        if mode == "turns":
            at_rest = lambda t, q, v: ("sticks", q, np.zeros(1))  # noqa: E731
            return (Guard("stops", lambda t, q, v: float(v[0]), at_rest),)
        loose = lambda t, q, v: ("turns", q, v)  # noqa: E731
        return (Guard("slips", lambda t, q, v: self.M_s - (self.M + self.k * t), loose),)

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.89) |M_fr| ≤ M_s where it sticks."""
        holds = -self.modes[mode].reactions(t, q, v)["axle.friction"]
        if mode == "sticks" and holds > self.M_s:
            return f"sticking against {holds:.6g} N m, there is {self.M_s:.6g}"
        return None

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """(2.34) ω = c + (ω₀ − c) e^{−t/T}, T = J/d, c = (M − M_k)/d; ω₀ + (M − M_k) t/J if d = 0.

        From a rest that ends at t₀ by the ramp: J ω̇ + d ω = (M_s − M_k) + k τ, τ = t − t₀.
        None where it starts turning and the ramp is on: when it stops is no known function.
        """
        J = self.m * self.R * self.R / 2
        if self.k and self.w0:
            return None
        begins = self._breaks_loose()
        tau = max(0.0, min(t, self._halts()) - begins)
        over = (self.M_s if begins else self.M) - self.M_k
        if not self.d:
            angle = self.w0 * tau + (over * tau**2 / 2 + self.k * tau**3 / 6) / J
            rate = self.w0 + (over * tau + self.k * tau**2 / 2) / J
        else:
            T, c, ramp = J / self.d, over / self.d, self.k / self.d
            fades, transient = -math.expm1(-tau / T), self.w0 - c + ramp * T
            rate = self.w0 - transient * fades + ramp * tau
            angle = transient * T * fades + (c - ramp * T) * tau + ramp * tau**2 / 2
        return np.array([angle]), np.array([rate if t < self._halts() else 0.0])

    def closed_events(self, until: float) -> list[tuple[str, float]] | None:
        """(2.34) stops at T ln(1 + d ω₀/(M_k − M)), or J ω₀/(M_k − M); slips at (M_s − M)/k."""
        if self.k and self.w0:
            return None
        stops, slips = self._halts(), self._breaks_loose()
        if stops <= until:
            return [("stops", stops)]
        return [("slips", slips)] if 0.0 < slips <= until else []

    def _halts(self) -> float:
        J, brakes = self.m * self.R * self.R / 2, self.M_k - self.M
        if not self.w0 or brakes <= 0.0:
            return math.inf
        if not self.d:
            return J * self.w0 / brakes
        return J / self.d * math.log1p(self.d * self.w0 / brakes)

    def _breaks_loose(self) -> float:
        """From when on it turns [s]: 0 if at once."""
        if self.w0 or self.M_s < self.M:
            return 0.0
        return (self.M_s - self.M) / self.k if self.k else math.inf
