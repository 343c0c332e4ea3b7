"""Heavy symmetric top on a fixed point O, its tip: precession, nutation, spin.

q = (ψ, θ, φ), Euler's angles: turns about z, the new x and the axis of the top, which is axis 3 of
the body; θ is counted from upright. v = q̇. ω₃ = φ̇ + ψ̇ cos θ.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...coverage import Numbered
from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector
from ..elliptic import Amplitude, amplitude, first, third

G = 9.80665  # m/s²


@dataclass(frozen=True)
class HeavyTop(Mode):
    """Mass m [kg], its centre l [m] above the tip; A, A, C [kg m²] about the centre.

    It starts at ψ = φ = 0, θ = theta0 [rad], with ω = (w1, w2, w3) [rad/s] in body axes: there w1
    is θ̇, w2 is ψ̇ sin θ.
    """

    m: float
    l: float
    A: float
    C: float
    theta0: float
    w1: float
    w2: float
    w3: float

    coordinates = ("psi", "theta", "phi")

    def __post_init__(self) -> None:
        if not 0.0 < self.theta0 < math.pi:
            raise ValueError("upright or hanging, ψ and φ are not told apart: 0 < theta0 < π")
        if not self.l > 0.0:
            raise ValueError(f"its centre lies above O on the axis: l > 0, not {self.l}")
        J = np.diag([self.A, self.A, self.C])
        object.__setattr__(self, "masses", {"top": Mass(self.m, J)})

    def _A_O(self) -> float:
        """(2.35) A_O = A + m l² [kg m²], about any axis through O across that of the top."""
        return self.A + self.m * self.l**2

    def start(self) -> tuple[Array, Array]:
        """Leaning by theta0, towards −y."""
        sin, cos = math.sin(self.theta0), math.cos(self.theta0)
        psi_dot = self.w2 / sin
        v = [psi_dot, self.w1, self.w3 - psi_dot * cos]
        return np.array([0.0, self.theta0, 0.0]), np.array(v)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.33) A_O θ̈ = (A_O ψ̇ cos θ − C ω₃) ψ̇ sin θ + m g l sin θ, ω̇₃ = 0 [rad/s²], (3,).

        A_O ψ̈ sin θ = (C ω₃ − 2 A_O ψ̇ cos θ) θ̇, φ̈ = ψ̇ θ̇ sin θ − ψ̈ cos θ.
        """
        _, theta, _ = q.tolist()
        psi_dot, theta_dot, phi_dot = v.tolist()
        sin, cos, A_O = math.sin(theta), math.cos(theta), self._A_O()
        D3 = self.C * (phi_dot + psi_dot * cos)
        theta_ddot = ((A_O * psi_dot * cos - D3) * psi_dot + self.m * G * self.l) * sin / A_O
        psi_ddot = (D3 - 2 * A_O * psi_dot * cos) * theta_dot / (A_O * sin)
        return np.array([psi_ddot, theta_ddot, psi_dot * theta_dot * sin - psi_ddot * cos])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) F = m (r̈_c − g) [N], r_c = l (sin θ sin ψ, −sin θ cos ψ, cos θ): O on the top."""
        psi, theta, _ = q.tolist()
        psi_dot, theta_dot, _ = v.tolist()
        psi_ddot, theta_ddot, _ = self.accelerations(t, q, v).tolist()
        s, s_dot = math.sin(theta), math.cos(theta) * theta_dot
        s_ddot = math.cos(theta) * theta_ddot - s * theta_dot**2
        radial = s_ddot - s * psi_dot**2  # along (sin ψ, −cos ψ)
        across = s * psi_ddot + 2 * s_dot * psi_dot  # along (cos ψ, sin ψ)
        z_ddot = -(s * theta_ddot + math.cos(theta) * theta_dot**2)
        ml = self.m * self.l
        return {
            "pivot.fx": ml * (radial * math.sin(psi) + across * math.cos(psi)),
            "pivot.fy": ml * (across * math.sin(psi) - radial * math.cos(psi)),
            "pivot.fz": ml * z_ddot + self.m * G,
        }

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """(2.27) cos θ = u₁ + (u₂ − u₁) sn²(λ t + τ₀); ψ and φ by integrals of the third kind.

        None where the nutation takes for ever: one of its ends is an upright top.
        """
        A_O = self.A + self.m * self.l**2
        w = (self.w1, self.w2, self.w3)
        nutation = Nutation.starting(A_O, self.C, self.m * G * self.l, self.theta0, w)
        return None if nutation is None else nutation.at(t)

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ A_O (θ̇² + ψ̇² sin² θ) + ½ C (φ̇ + ψ̇ cos θ)² [J]."""
        across = v[1] ** 2 + (v[0] * np.sin(q[1])) ** 2
        return (self._A_O() * across + self.C * (v[2] + v[0] * np.cos(q[1])) ** 2) / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g l cos θ [J]."""
        return self.m * G * self.l * np.cos(q[1])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = l (sin θ sin ψ, −sin θ cos ψ, cos θ); E₁ by half angles, smooth in all three.

        (2.4) ω = (ψ̇ sin θ sin φ + θ̇ cos φ, ψ̇ sin θ cos φ − θ̇ sin φ, φ̇ + ψ̇ cos θ).
        """
        psi, theta, phi = q
        psi_dot, theta_dot, phi_dot = v
        sin, cos, l = np.sin(theta), np.cos(theta), self.l
        c, s, plus, minus = np.cos(theta / 2), np.sin(theta / 2), (psi + phi) / 2, (psi - phi) / 2
        out, turns = cos * theta_dot, sin * psi_dot
        return {
            "top": (
                l * sin * np.sin(psi), -l * sin * np.cos(psi), l * cos,
                c * np.cos(plus), s * np.cos(minus), s * np.sin(minus), c * np.sin(plus),
                l * (out * np.sin(psi) + turns * np.cos(psi)),
                l * (turns * np.sin(psi) - out * np.cos(psi)),
                -l * sin * theta_dot,
                turns * np.sin(phi) + theta_dot * np.cos(phi),
                turns * np.cos(phi) - theta_dot * np.sin(phi),
                phi_dot + psi_dot * cos,
            )
        }  # fmt: skip

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight m g at the centre."""
        x, y, z, *_ = self.poses(t, q, v)["top"]
        return [Load("top", (x, y, z), (0.0, 0.0, -self.m * G))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The tip."""
        names, axes = ("pivot.fx", "pivot.fy", "pivot.fz"), tuple(map(tuple, np.eye(3).tolist()))
        return [Cut(names, None, "top", (0.0, 0.0, 0.0), axes)]


# The nutation of a heavy symmetric top by elliptic functions: the closed form of `heavy_top`.


Three = tuple[float, float, float]


@dataclass(frozen=True)
class Nutation(Numbered):
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
    def starting(A_O: float, C: float, mgl: float, theta0: float, w: Three) -> "Nutation | None":
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
