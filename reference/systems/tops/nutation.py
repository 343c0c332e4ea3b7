"""The nutation of a heavy symmetric top by elliptic functions: the closed form of `heavy_top`."""

import math
from dataclasses import dataclass

import numpy as np

from ...system import Array
from ..elliptic import Amplitude, amplitude, first, third

Three = tuple[float, float, float]


@dataclass(frozen=True)
class Nutation:
    """u = cos θ between u₁ and u₂, the roots of u̇² = (1 − u²)(ε − β (u − u₀)) − (b − a u)².

    Goldstein, Classical Mechanics, § 5.7: a = C ω₃/A_O, b = D_z/A_O, β = 2 m g l/A_O; here
    ε = θ̇₀² + ψ̇₀² sin² θ₀, and all is counted from u₀, where it starts: s = u − u₀ is small where
    the nutation is, and 1 ± u₀ is known by half angles.
    """

    low: float  # s₁ ≤ 0
    high: float  # s₂ ≥ 0
    below: float  # 1 − u₀
    above: float  # 1 + u₀
    spin: float  # ω₃
    a: float
    down: float  # b − a
    up: float  # b + a
    k1: float  # √(1 − k²)
    rate: float  # λ
    phase: Amplitude  # the amplitude at t = 0

    @staticmethod
    def of(A_O: float, C: float, mgl: float, theta0: float, w: Three) -> "Nutation | None":
        """As it starts, with ω = w; None where a root is double that it would have to reach."""
        sin, u0 = math.sin(theta0), math.cos(theta0)
        below, above = 2 * math.sin(theta0 / 2) ** 2, 2 * math.cos(theta0 / 2) ** 2
        w1, w2, w3 = w
        a, beta = C * w3 / A_O, 2 * mgl / A_O
        e, p = w1**2 + w2**2, w2 * sin  # ε, and b − a u₀
        cubic = [
            beta, 2 * u0 * beta - e - a * a, 2 * p * a - sin * sin * beta - 2 * u0 * e,
            (sin * w1) ** 2,
        ]  # fmt: skip
        low, high, far = _roots(cubic)
        width = far - low
        if not far > high:
            return None
        # u̇₀ = −sin θ₀ θ̇₀: it starts on the rising or on the falling half.
        size = math.sqrt(high - low)
        sn, cn = math.copysign(math.sqrt(-low), -w1), math.sqrt(high)
        phase = Amplitude(sn / size, cn / size) if size else Amplitude(0.0, 1.0)
        return Nutation(
            low, high, below, above, w3, a, p - a * below, p + a * above,
            math.sqrt((far - high) / width), math.sqrt(beta * width) / 2, phase,
        )  # fmt: skip

    def at(self, t: float) -> tuple[Array, Array]:
        """(2.27) D_z and D₃ stay: ψ̇ = (b − a u)/(1 − u²), φ̇ = ω₃ − ψ̇ u; q and v."""
        am = amplitude(self.rate * t + first(self.phase, self.k1), self.k1)
        sn, cn, _ = am
        dn = math.hypot(cn, self.k1 * sn)
        s = self.low * cn * cn + self.high * sn * sn
        below, above = self.below - s, self.above + s
        sin = math.sqrt(below * above)
        theta_dot = -2 * (self.high - self.low) * self.rate * sn * cn * dn / sin
        # 2 (b − a u)/(1 − u²) = (b − a)/(1 − u) + (b + a)/(1 + u), and the same of its integral.
        down, up = self.down / below, self.up / above
        downs = self.down * self._integral(self.below - self.low, self.below - self.high, t, am)
        ups = self.up * self._integral(self.above + self.low, self.above + self.high, t, am)
        q = [
            (downs + ups) / 2, 2 * math.atan2(math.sqrt(below), math.sqrt(above)),
            (self.spin - self.a) * t - (downs - ups) / 2,
        ]  # fmt: skip
        return np.array(q), np.array(
            [(down + up) / 2, theta_dot, self.spin - self.a - (down - up) / 2]
        )

    def _integral(self, low: float, high: float, t: float, am: Amplitude) -> float:
        """∫₀ᵗ dt/(x₁ cn² + x₂ sn²), which is 1 ∓ u: x₁ where u = u₁, x₂ where u = u₂."""
        p = high / low
        change = third(am, self.k1, p) - third(self.phase, self.k1, p)
        return (t + (1 - p) / self.rate * change) / low


def _roots(cubic: list[float]) -> tuple[float, float, float]:
    """s₁ ≤ 0 ≤ s₂ ≤ s₃ of a cubic that is not negative at s = 0, by Newton from their floats."""
    low, high, far = (_polished(cubic, root) for root in np.sort(np.roots(cubic).real).tolist())
    return min(low, 0.0), max(high, 0.0), far


def _polished(cubic: list[float], s: float) -> float:
    """A root with all its digits; a double one stays as it is."""
    a, b, c, d = cubic
    for _ in range(3):
        slope = (3 * a * s + 2 * b) * s + c
        s -= (((a * s + b) * s + c) * s + d) / slope if slope else 0.0
    return s
