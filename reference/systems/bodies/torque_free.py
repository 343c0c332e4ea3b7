"""Rigid body without a moment, thrown or left alone: Euler's equations about principal axes.

q = (r, e): the place of the centre and the unit quaternion e = (w, x, y, z) that turns body axes
into ground axes; v = (ṙ, ω), ω in body axes, which are the principal ones.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...coverage import Numbered
from ...system import Array, Load, Mass, Mode, Pose, Vector
from ..elliptic import Amplitude, amplitude, first, third


@dataclass(frozen=True)
class TorqueFree(Mode):
    """Moments A > B > C [kg m²] about axes 1, 2, 3, thrown from the origin, z up.

    vx, vy, vz: its first velocity [m/s], in ground axes; w1, w2, w3: its first ω [rad/s], in body
    axes. It is put up by turns of psi0 about z, theta0 about the new x, phi0 about the new z [rad].
    """

    m: float
    A: float
    B: float
    C: float
    gravity: float  # m/s²; `g` is the right side of constraints
    vx: float
    vy: float
    vz: float
    psi0: float
    theta0: float
    phi0: float
    w1: float
    w2: float
    w3: float

    coordinates = ("x", "y", "z", "e_w", "e_x", "e_y", "e_z")

    def __post_init__(self) -> None:
        if not self.A > self.B > self.C > 0.0:
            raise ValueError("its axes are numbered so that A > B > C > 0")
        if self.A > self.B + self.C:
            raise ValueError("no body has a moment above the sum of the other two: A > B + C")
        J = np.diag([self.A, self.B, self.C])
        object.__setattr__(self, "masses", {"body": Mass(self.m, J)})

    def start(self) -> tuple[Array, Array]:
        """At the origin, with the given attitude and velocities."""
        c, s = math.cos(self.theta0 / 2), math.sin(self.theta0 / 2)
        plus, minus = (self.psi0 + self.phi0) / 2, (self.psi0 - self.phi0) / 2
        e = [c * math.cos(plus), s * math.cos(minus), s * math.sin(minus), c * math.sin(plus)]
        v = [self.vx, self.vy, self.vz, self.w1, self.w2, self.w3]
        return np.array([0.0, 0.0, 0.0, *e]), np.array(v)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.33) A ω̇₁ = (B − C) ω₂ ω₃, B ω̇₂ = (C − A) ω₃ ω₁, C ω̇₃ = (A − B) ω₁ ω₂; r̈ = g, (6,)."""
        A, B, C = self.A, self.B, self.C
        w1, w2, w3 = v[3:].tolist()
        spin = [(B - C) / A * w2 * w3, (C - A) / B * w3 * w1, (A - B) / C * w1 * w2]
        return np.array([0.0, 0.0, -self.gravity, *spin])

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.5) ė = ½ e ∘ (0, ω), ω in body axes; ṙ as it is: q̇ (7,)."""
        w, x, y, z = q[3:]
        w1, w2, w3 = v[3:]
        e_dot = [
            -x * w1 - y * w2 - z * w3, w * w1 + y * w3 - z * w2,
            w * w2 + z * w1 - x * w3, w * w3 + x * w2 - y * w1,
        ]  # fmt: skip
        return np.concatenate([v[:3], np.array(e_dot) / 2])

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """(2.33) Jacobi's solution; the attitude by the precession about D, which stays.

        None on the separatrix, where ω turns over once and never again.
        """
        given = (self.psi0, self.theta0, self.phi0)
        solution = Polhode.starting((self.A, self.B, self.C), (self.w1, self.w2, self.w3), given)
        if solution is None:
            return None
        r = [self.vx * t, self.vy * t, self.vz * t - self.gravity * t * t / 2]
        v = [self.vx, self.vy, self.vz - self.gravity * t]
        return np.array([*r, *solution.attitude(t)]), np.array([*v, *solution.omega(t)])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m ṙ² + ½ (A ω₁² + B ω₂² + C ω₃²), (0, ω) = 2 ē ∘ ė/|e|² [J]."""
        w, x, y, z = q[3:]
        w_dot, x_dot, y_dot, z_dot = v[3:]
        w1 = w * x_dot - x * w_dot - y * z_dot + z * y_dot
        w2 = w * y_dot - y * w_dot - z * x_dot + x * z_dot
        w3 = w * z_dot - z * w_dot - x * y_dot + y * x_dot
        size = w**2 + x**2 + y**2 + z**2
        spin = self.A * w1**2 + self.B * w2**2 + self.C * w3**2
        return self.m * (v[0] ** 2 + v[1] ** 2 + v[2] ** 2) / 2 + 2 * spin / size**2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g z [J]."""
        return self.m * self.gravity * q[2]

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = r, E₁ by e/|e|: its length, which rounding changes, has no meaning."""
        e = q[3:]
        size = np.sqrt(e[0] ** 2 + e[1] ** 2 + e[2] ** 2 + e[3] ** 2)
        return {"body": (*q[:3], *(e / size), *v)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight m g at the centre."""
        x, y, z = q[:3].tolist()
        return [Load("body", (x, y, z), (0.0, 0.0, -self.m * self.gravity))]


# Jacobi's solution of Euler's equations without a moment: the closed form of `torque_free`.


Three = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]


@dataclass(frozen=True)
class Polhode(Numbered):
    """ω_s = σ c dn, ω_p = a cn, ω_m = −σ b sn of λ t + τ₀: Landau and Lifshitz, Mechanics, § 37.

    s: the axis (1 or 3) whose ω never changes its sign σ; m: axis 2, the middle one; p: the other.
    What is small near an axis is a sum of squares here, and no difference of energies.
    """

    I: Three  # p, m, s
    about_first: bool  # whether s is axis 1
    sigma: float
    abc: Three
    k1: float  # √(1 − k²)
    rate: float  # λ
    phase: Amplitude  # the amplitude at t = 0
    D: float  # |J ω|
    given: Three  # ψ, θ, φ from ground to body axes at t = 0

    @staticmethod
    def starting(moments: Three, w: Three, given: Three) -> "Polhode | None":
        """The solution that begins with ω = w, turned as given; None on the separatrix."""
        A, B, C = moments
        # D² − 2 E B: beyond the separatrix ω goes about axis 1, else about axis 3.
        about_first = A * (A - B) * w[0] ** 2 > C * (B - C) * w[2] ** 2
        p, s = (2, 0) if about_first else (0, 2)
        Ip, Im, Is = moments[p], B, moments[s]
        ps, ms, pm = abs(Is - Ip), abs(Is - Im), abs(Im - Ip)
        X = Ip * ps * w[p] ** 2 + Im * ms * w[1] ** 2  # |2 E I_s − D²|
        Y = Im * pm * w[1] ** 2 + Is * ps * w[s] ** 2  # |D² − 2 E I_p|
        Z = Is * ms * w[s] ** 2 - Ip * pm * w[p] ** 2  # |D² − 2 E I_m|
        if not Z > 0.0:
            return None
        sigma = math.copysign(1.0, w[s])
        a, b, c = math.sqrt(X / (Ip * ps)), math.sqrt(X / (Im * ms)), math.sqrt(Y / (Is * ps))
        k1 = math.sqrt(ps * Z / (ms * Y))
        sn, cn = -sigma * w[1] * math.sqrt(Im * ms), w[p] * math.sqrt(Ip * ps)  # and √X
        size = math.hypot(sn, cn)
        phase = Amplitude(sn / size, cn / size) if size else Amplitude(0.0, 1.0)
        D = math.sqrt(sum((I * x) ** 2 for I, x in zip(moments, w, strict=True)))
        rate = math.sqrt(ms * Y / (Ip * Im * Is))
        moments = (Ip, Im, Is)
        return Polhode(moments, about_first, sigma, (a, b, c), k1, rate, phase, D, given)

    def omega(self, t: float) -> Three:
        """(2.33) ω [rad/s] in body axes."""
        p, m, s = self._at(self._amplitude(t))
        return (s, m, p) if self.about_first else (p, m, s)

    def attitude(self, t: float) -> Quaternion:
        """(2.27) D stays in the ground's axes: the quaternion from body axes to those."""
        w, x, y, z = self._about_D(0.0)
        return _product(_product(_zxz(*self.given), (w, -x, -y, -z)), self._about_D(t))

    def _about_D(self, t: float) -> Quaternion:
        """(2.27) From body axes to axes with z along D.

        Turns ψ about D, θ, φ about axis s. ψ̇ = D (I_p ω_p² + I_m ω_m²)/(I_p² ω_p² + I_m² ω_m²),
        tan θ and tan φ by the components of D in body axes.
        """
        Ip, Im, Is = self.I
        am = self._amplitude(t)
        rho = math.sqrt(Im * abs(Is - Ip) / (Ip * abs(Is - Im)))  # I_m b/(I_p a)
        integral = third(am, self.k1, rho**2) - third(self.phase, self.k1, rho**2)
        psi = self.D / Ip * (t + rho**2 * (Ip / Im - 1) / self.rate * integral)
        p, m, s = self._at(am)
        theta = math.atan2(math.hypot(Ip * p, Im * m), Is * s)
        chi = math.atan2(rho * am.sin, am.cos) + 2 * math.pi * am.turns
        if not self.about_first:
            return _zxz(psi, theta, math.pi / 2 + self.sigma * chi)
        # Axis 1 in the third place: half a turn about the bisector of axes 1 and 3.
        swap = (0.0, math.sqrt(0.5), 0.0, math.sqrt(0.5))
        return _product(_zxz(psi, theta, math.pi / 2 - self.sigma * chi), swap)

    def _at(self, am: Amplitude) -> Three:
        """ω_p, ω_m, ω_s."""
        a, b, c = self.abc
        dn = math.hypot(am.cos, self.k1 * am.sin)
        return a * am.cos, -self.sigma * b * am.sin, self.sigma * c * dn

    def _amplitude(self, t: float) -> Amplitude:
        return amplitude(self.rate * t + first(self.phase, self.k1), self.k1)


def _product(a: Quaternion, b: Quaternion) -> Quaternion:
    """a ∘ b: first turned by b, then by a."""
    return (
        a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
        a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
        a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
        a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0],
    )


def _zxz(psi: float, theta: float, phi: float) -> Quaternion:
    """Turns about z, the new x and the new z: smooth in all three angles."""
    c, s = math.cos(theta / 2), math.sin(theta / 2)
    plus, minus = (psi + phi) / 2, (psi - phi) / 2
    return c * math.cos(plus), s * math.cos(minus), s * math.sin(minus), c * math.sin(plus)
