"""Disk launched with slip on a floor with friction, level or inclined: it slides, then rolls.

q = (x_c, y_c, φ), x down the slope of angle β; φ counts the rolling to +x as the book does, which
is clockwise, so the angle of the body is −φ.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Guard, Load, Mass, Mode, Pose, System, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class _Disk(Mode):
    """Slipping to +x (σ = 1) or −x (σ = −1), or rolling (σ = 0)."""

    m: float
    R: float
    mu: float
    beta: float
    sigma: int

    coordinates = ("x_c", "y_c", "phi")

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"wheel": Mass(self.m, self._J33())})

    def _J33(self) -> float:
        """(2.32) J₃₃ = m R²/2 [kg m²]."""
        return self.m * self.R**2 / 2

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.87), (2.34) ẍ_c = g (sin β − σ μ cos β), R φ̈ = 2 σ μ g cos β; rolling R φ̈ = ⅔ g sin β.

        [m/s², m/s², rad/s²], (3,).
        """
        along, friction = G * math.sin(self.beta), self.sigma * self.mu * G * math.cos(self.beta)
        if self.sigma == 0:
            return np.array([2 / 3 * along, 0.0, 2 / 3 * along / self.R])
        return np.array([along - friction, 0.0, 2 * friction / self.R])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.87) F_N = m g cos β, F_fr = −σ μ F_N; rolling: −⅓ m g sin β [N]: on the wheel."""
        weight = self.m * G
        F_N, rolling = weight * math.cos(self.beta), -weight * math.sin(self.beta) / 3
        tangent = -self.sigma * self.mu * F_N if self.sigma else rolling
        return {"touch.tangent": tangent, "touch.normal": F_N}

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m (ẋ_c² + ẏ_c²) + ½ J₃₃ φ̇² [J]."""
        return self.m * (v[0] ** 2 + v[1] ** 2) / 2 + self._J33() * v[2] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g (y_c cos β − x_c sin β) [J]."""
        return self.m * G * (q[1] * math.cos(self.beta) - q[0] * math.sin(self.beta))

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q = (F_fr, 0, −R F_fr), F_fr = −σ μ m g cos β of sliding [N, N, N m]."""
        F_fr = -self.sigma * self.mu * self.m * G * math.cos(self.beta)
        return np.array([F_fr, 0.0, -self.R * F_fr])

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.18) y_c − R = 0 [m]."""
        return np.array([q[1] - self.R])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15), (2.17) ẏ_c = 0, and rolling ẋ_c − R φ̇ = 0: λ are normal force and friction."""
        rows = np.array([[0.0, 1.0, 0.0], [1.0, 0.0, -self.R]])
        return rows[:1] if self.sigma else rows

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x_c, y_c), angle = −φ."""
        return {"wheel": (q[0], q[1], -q[2], v[0], v[1], -v[2])}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight in the axes of the slope; the friction of sliding where it touches."""
        x, y = q[:2].tolist()
        weight = self.m * G
        down = (weight * math.sin(self.beta), -weight * math.cos(self.beta))
        friction = (-self.sigma * self.mu * weight * math.cos(self.beta), 0.0)
        return [Load("wheel", (x, y), down), Load("wheel", (x, y - self.R), friction)]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The point that touches: its normal force always, its friction where it rolls."""
        touch = (float(q[0]), float(q[1]) - self.R)
        if self.sigma == 0:
            return [Cut(("touch.tangent", "touch.normal"), None, "wheel", touch)]
        return [Cut(("touch.normal",), None, "wheel", touch, ((0.0, 1.0),))]


@dataclass(frozen=True)
class SlidingDisk(System):
    """m [kg], R [m], μ, β; thrown up the slope with v0 [m/s], turning clockwise with w0 [rad/s]."""

    m: float
    R: float
    mu: float
    beta: float
    v0: float
    w0: float

    def __post_init__(self) -> None:
        sigmas = {"slips forward": 1, "slips backward": -1, "rolling": 0}
        modes = {
            name: _Disk(self.m, self.R, self.mu, self.beta, sigma) for name, sigma in sigmas.items()
        }
        object.__setattr__(self, "modes", modes)

    def start(self) -> tuple[str, Array, Array]:
        """x_c = 0 on the floor, ẋ_c = −v₀, φ̇ = w₀."""
        q, v = np.array([0.0, self.R, 0.0]), np.array([-self.v0, 0.0, self.w0])
        slip = self.slip(v)
        mode = (
            "slips forward"
            if slip > 0.0
            else "slips backward"
            if slip < 0.0
            else self._without_slip()
        )
        return mode, q, v

    def slip(self, v: Array) -> float:
        """(2.16) ẋ_c − R φ̇ [m/s]: the velocity of the point that touches."""
        return float(v[0] - self.R * v[2])

    def _without_slip(self) -> str:
        """(2.89) without slip it rolls if |tan β| ≤ 3 μ, else it slips down the slope."""
        if abs(math.sin(self.beta)) <= 3 * self.mu * math.cos(self.beta):
            return "rolling"
        return "slips forward" if self.beta > 0.0 else "slips backward"

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.89) `rolls` where the slip ends; too steep for that, the slip turns."""
        if mode == "rolling":
            return ()
        sigma, after = (1.0 if mode == "slips forward" else -1.0), self._without_slip()

        def then(t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
            return after, q, np.array([v[0], 0.0, v[0] / self.R])

        event = "rolls" if after == "rolling" else None
        return (Guard(event, lambda t, q, v: sigma * self.slip(v), then),)

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.87) x_c = −v₀ t + ½ a t², R φ = R w₀ t + ½ b t² while it slips, and so on.

        a = g (sin β − σ μ cos β), b = 2 σ μ g cos β with σ of the slip; after it a = b = ⅔ g sin β,
        or σ = sign β where that is too steep.
        """
        t1, friction = self._ends(), self.mu * G * math.cos(self.beta)
        x, u, w = 0.0, -self.v0, self.R * self.w0
        turned = 0.0  # R φ
        for sigma, tau in ((math.copysign(1.0, u - w), min(t, t1)), (self._after(), t - t1)):
            if tau > 0.0:
                a = G * math.sin(self.beta) - sigma * friction
                b = 2 * sigma * friction
                if sigma == 0.0:
                    a = b = G * math.sin(self.beta) / 1.5
                x, u = x + u * tau + a * tau**2 / 2, u + a * tau
                turned, w = turned + w * tau + b * tau**2 / 2, w + b * tau
        return np.array([x, self.R, turned / self.R]), np.array([u, 0.0, w / self.R])

    def closed_events(self, until: float) -> list[tuple[str, float]]:
        """(2.87) rolls at t₁, if it slips before and can."""
        t1 = self._ends()
        return [("rolls", t1)] if 0.0 < t1 <= until and self._after() == 0.0 else []

    def _ends(self) -> float:
        """(2.87) No slip at t₁ = |s₀|/(g (3 μ cos β ∓ sin β)) [s], − where it is forward, or never.

        s₀ = −v₀ − R w₀.
        """
        slip = -self.v0 - self.R * self.w0
        if slip == 0.0:
            return 0.0
        down = math.copysign(math.sin(self.beta), slip * self.beta)
        brake = G * (3 * self.mu * math.cos(self.beta) - down)
        return abs(slip) / brake if brake > 0.0 else math.inf

    def _after(self) -> float:
        """(2.89) σ after the slip: 0, it rolls, if |tan β| ≤ 3 μ, else down the slope."""
        rolls = abs(math.tan(self.beta)) <= 3 * self.mu
        return 0.0 if rolls else math.copysign(1.0, self.beta)

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.87) |F_fr| ≤ μ F_N where it rolls, F_N > 0."""
        forces = self.modes[mode].reactions(t, q, v)
        normal, tangent = forces["touch.normal"], forces["touch.tangent"]
        if not normal > 0.0:
            return f"the floor would have to pull: touch.normal = {normal:.3g} N"
        if mode == "rolling" and abs(tangent) > self.mu * normal:
            return f"rolling needs friction {abs(tangent) / normal:.4g}, there is {self.mu:.4g}"
        return None
