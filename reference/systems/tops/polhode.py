"""Jacobi's solution of Euler's equations without a moment: the closed form of `torque_free`."""

import math
from dataclasses import dataclass

from ..elliptic import Amplitude, amplitude, first, third

Three = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]


@dataclass(frozen=True)
class Polhode:
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
    def of(moments: Three, w: Three, given: Three) -> "Polhode | None":
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
