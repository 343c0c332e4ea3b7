"""Non-holonomic modes: a sleigh on a blade that may be driven, and a wheel that rolls upright."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from textmech.reference.system import Array, Cut, Load, Mass, Mode, Pose, Vector

GX, GY = 1.3, -2.1  # m/s², an inclined plane


@dataclass(frozen=True)
class Sleigh(Mode):
    """q = (x, y, θ) of the blade P, the centre C a ahead of it; v = q̇.

    The blade is turned by δ = d t² against the body and moves sideways with w₀ + w₁ t; a force F
    pushes C ahead, the plane brakes θ̇ by c θ̇.
    """

    m: float = 1.4
    J: float = 0.3
    a: float = 0.35
    d: float = 0.0
    w0: float = 0.0
    w1: float = 0.0
    F: float = 0.8
    c: float = 0.2
    masses: Mapping[str, Mass] = field(default_factory=lambda: {"sleigh": Mass(1.4, 0.3)})
    coordinates: tuple[str, ...] = ("x", "y", "theta")

    def blade(self, t: Any) -> tuple[Any, Any, Any, Any]:
        """δ, δ̇, w, ẇ."""
        return self.d * t * t, 2 * self.d * t, self.w0 + self.w1 * t, self.w1

    def slowed(self, t: float, q: Array, v: Array) -> tuple[float, float, float, float]:
        """u, u̇, ω̇ and the side force λ on the blade, from Newton's and Euler's equations."""
        delta, delta_dot, w, w_dot = self.blade(t)
        (x_dot, y_dot, omega), angle = v, q[2] + delta
        e, n = np.array([math.cos(angle), math.sin(angle)]), [-math.sin(angle), math.cos(angle)]
        u, Omega, m, a = x_dot * e[0] + y_dot * e[1], omega + delta_dot, self.m, self.a
        cos, sin = math.cos(delta), math.sin(delta)
        push = [GX + self.F / m * math.cos(q[2]), GY + self.F / m * math.sin(q[2])]
        side = w_dot + u * Omega + a * omega**2 * sin - np.dot(push, n)
        omega_dot = (-a * m * cos * side - self.c * omega) / (self.J + m * a**2 * cos**2)
        u_dot = w * Omega - a * omega_dot * sin + a * omega**2 * cos + np.dot(push, e)
        return u, float(u_dot), float(omega_dot), float(m * (side + a * omega_dot * cos))

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        delta, delta_dot, w, w_dot = self.blade(t)
        u, u_dot, omega_dot, _ = self.slowed(t, q, v)
        angle, Omega = q[2] + delta, v[2] + delta_dot
        ahead, aside = u_dot - w * Omega, w_dot + u * Omega
        cos, sin = math.cos(angle), math.sin(angle)
        return np.array([ahead * cos - aside * sin, ahead * sin + aside * cos, omega_dot])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        x_dot = v[0] - self.a * v[2] * np.sin(q[2])
        y_dot = v[1] + self.a * v[2] * np.cos(q[2])
        return self.m * (x_dot**2 + y_dot**2) / 2 + self.J * v[2] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        x, y = q[0] + self.a * np.cos(q[2]), q[1] + self.a * np.sin(q[2])
        return -self.m * (GX * x + GY * y)

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        return self.c * v[-1] ** 2 / 2

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        return self.F * np.array([math.cos(q[2]), math.sin(q[2]), 0.0])

    def f_a(self, t: Any, q: Vector) -> Vector:
        angle = q[2] + self.blade(t)[0]
        return np.array([[-np.sin(angle), np.cos(angle), 0.0 * angle]])

    def g(self, t: Any, q: Vector) -> Vector:
        return np.array([self.blade(t)[2]])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        x_dot, y_dot, omega = self.rates(t, q, v)
        cos, sin, a = np.cos(q[2]), np.sin(q[2]), self.a
        place = (q[0] + a * cos, q[1] + a * sin, q[2])
        return {"sleigh": (*place, x_dot - a * omega * sin, y_dot + a * omega * cos, omega)}

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        return {"blade.side": self.slowed(t, q, self.rates(t, q, v))[3]}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        x, y, *_ = self.poses(t, q, v)["sleigh"]
        cos, sin, m = math.cos(q[2]), math.sin(q[2]), self.m
        force = (m * GX + self.F * cos, m * GY + self.F * sin)
        return [Load("sleigh", (x, y), force, -self.c * float(v[-1]))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        angle = q[2] + self.blade(t)[0]
        across = (-math.sin(angle), math.cos(angle))
        return [Cut(("blade.side",), None, "sleigh", (q[0], q[1]), (across,))]


@dataclass(frozen=True)
class SleighAhead(Sleigh):
    """The same with v = (u, ω): nothing is left to bind it, and q̇ = N v + n₀."""

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        delta, _, w, _ = self.blade(t)
        cos, sin = np.cos(q[2] + delta), np.sin(q[2] + delta)
        return np.array([v[0] * cos - w * sin, v[0] * sin + w * cos, v[1] + 0.0 * cos])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        return np.array(self.slowed(t, q, self.rates(t, q, v))[1:3])

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        return np.array([self.F * math.cos(self.blade(t)[0]), 0.0])

    def f_a(self, t: Any, q: Vector) -> Vector:
        return np.zeros((0, 2))

    def g(self, t: Any, q: Vector) -> Vector:
        return np.zeros(0)


@dataclass(frozen=True)
class UprightWheel(Mode):
    """Example 2.2 on an inclined plane: q = (x, y, θ, φ), v = q̇; a push along y at the centre."""

    m: float = 1.1
    R: float = 0.4
    J1: float = 0.05
    J3: float = 0.09
    F: float = 0.7
    masses: Mapping[str, Mass] = field(
        default_factory=lambda: {"wheel": Mass(1.1, np.diag([0.05, 0.09, 0.05]))}
    )
    coordinates: tuple[str, ...] = ("x", "y", "theta", "phi")

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        theta_dot, phi_dot = v[2:]
        cos, sin, R = math.cos(q[2]), math.sin(q[2]), self.R
        push = self.m * GX * cos + (self.m * GY + self.F) * sin
        phi_ddot = push * R / (self.m * R**2 + self.J3)
        turning = phi_dot * theta_dot
        x_ddot, y_ddot = R * (phi_ddot * cos - turning * sin), R * (phi_ddot * sin + turning * cos)
        return np.array([x_ddot, y_ddot, 0.0, phi_ddot])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        turning = self.J1 * v[2] ** 2 + self.J3 * v[3] ** 2
        return self.m * (v[0] ** 2 + v[1] ** 2) / 2 + turning / 2

    def U(self, t: Any, q: Vector) -> Any:
        return -self.m * (GX * q[0] + GY * q[1])

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        return np.array([0.0, self.F, 0.0, 0.0])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.20) ẋ = R φ̇ cos θ, ẏ = R φ̇ sin θ."""
        x, y = -self.R * np.cos(q[2]), -self.R * np.sin(q[2])
        return np.array([[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y]])

    def g(self, t: Any, q: Vector) -> Vector:
        return np.zeros(2)

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        theta, phi = q[2] / 2, q[3] / 2
        ct, st, cp, sp = np.cos(theta), np.sin(theta), np.cos(phi), np.sin(phi)
        omega = (-v[2] * np.sin(q[3]), v[3], v[2] * np.cos(q[3]))
        attitude = (ct * cp, -st * sp, ct * sp, st * cp)
        return {"wheel": (q[0], q[1], self.R, *attitude, v[0], v[1], 0.0, *omega)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        force = (self.m * GX, self.m * GY + self.F, -9.0 * self.m)
        return [Load("wheel", (q[0], q[1], self.R), force)]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The floor, and the couple about the heading that holds it upright."""
        names = ("touch.fx", "touch.fy", "touch.normal", "upright.couple")
        xyz, ahead = np.eye(3).tolist(), (math.cos(q[2]), math.sin(q[2]), 0.0)
        ways = tuple(tuple(row) for row in xyz)
        return [Cut(names, None, "wheel", (q[0], q[1], 0.0), ways, moments=(ahead,))]
