"""Four-bar linkage (fig. 2.3): crank, coupler and rocker, slender bars of equal mass.

q = (α, β, γ), the angles of crank (from O), coupler (from the crank's end) and rocker (from the
ground point Q at x = d) against the x axis. Unit vectors e_α = (cos α, sin α) and e_α′ = de_α/dα.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class FourBar(Mode):
    """Mass m [kg] of each bar; lengths a, b, c and base d [m]; crank0 [rad] at the start."""

    m: float
    a: float
    b: float
    c: float
    d: float
    crank0: float

    coordinates = ("alpha", "beta", "gamma")

    def __post_init__(self) -> None:
        lengths = {"crank": self.a, "coupler": self.b, "rocker": self.c}
        masses = {name: Mass(self.m, self.m * l**2 / 12) for name, l in lengths.items()}
        object.__setattr__(self, "masses", masses)

    def start(self) -> tuple[Array, Array]:
        """(2.14) β = arg s + arccos((b² + s² − c²)/(2 b s)), s from B to Q, at rest; C above s."""
        sx, sy = self.d - self.a * math.cos(self.crank0), -self.a * math.sin(self.crank0)
        s = math.sqrt(sx * sx + sy * sy)
        turn = math.acos((self.b**2 + s * s - self.c**2) / (2 * self.b * s))
        beta = math.atan2(sy, sx) + turn
        gamma = math.atan2(self.b * math.sin(beta) - sy, self.b * math.cos(beta) - sx)
        return np.array([self.crank0, beta, gamma]), np.zeros(3)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) E₁ + k_β E₂ + k_γ E₃ = 0, β̈ = k_β α̈ + h_β, γ̈ = k_γ α̈ + h_γ [rad/s²], (3,).

        The loop a e_α + b e_β = d e_x + c e_γ, differentiated twice, times e_γ and times e_β:
        b sin(γ−β) β̈ = −a sin(γ−α) α̈ + a cos(γ−α) α̇² + b cos(γ−β) β̇² − c γ̇²
        c sin(γ−β) γ̈ = −a sin(β−α) α̈ + a cos(β−α) α̇² + b β̇² − c cos(γ−β) γ̇²
        Along these rates the reactions do no work: of Lagrange's equations
        E₁ = 4/3 m a² α̈ + ½ m a b (cos(β−α) β̈ − sin(β−α) β̇²) + 3/2 m g a cos α
        E₂ = 1/3 m b² β̈ + ½ m a b (cos(β−α) α̈ + sin(β−α) α̇²) + ½ m g b cos β
        E₃ = 1/3 m c² γ̈ + ½ m g c cos γ
        only their sum remains; it gives α̈.
        """
        m, a, b, c = self.m, self.a, self.b, self.c
        alpha, beta, gamma = q.tolist()
        alpha2, beta2, gamma2 = (rate * rate for rate in v.tolist())
        sin_ba, cos_ba = math.sin(beta - alpha), math.cos(beta - alpha)
        sin_ga, cos_ga = math.sin(gamma - alpha), math.cos(gamma - alpha)
        sin_gb, cos_gb = math.sin(gamma - beta), math.cos(gamma - beta)
        k_b, k_c = -a * sin_ga / (b * sin_gb), -a * sin_ba / (c * sin_gb)
        h_b = (a * cos_ga * alpha2 + b * cos_gb * beta2 - c * gamma2) / (b * sin_gb)
        h_c = (a * cos_ba * alpha2 + b * beta2 - c * cos_gb * gamma2) / (c * sin_gb)
        mixed, J_b, J_c = m * a * b * cos_ba / 2, m * b * b / 3, m * c * c / 3
        inertia = 4 / 3 * m * a * a + 2 * mixed * k_b + J_b * k_b * k_b + J_c * k_c * k_c
        rest = (
            mixed * h_b
            - m * a * b * sin_ba / 2 * beta2
            + 3 / 2 * m * G * a * math.cos(alpha)
            + k_b * (J_b * h_b + m * b * (a * sin_ba * alpha2 + G * math.cos(beta)) / 2)
            + k_c * (J_c * h_c + m * G * c * math.cos(gamma) / 2)
        )
        alpha_ddot = -rest / inertia
        return np.array([alpha_ddot, k_b * alpha_ddot + h_b, k_c * alpha_ddot + h_c])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) e_β′·C = −E₂/b, e_γ′·C = E₃/c by Cramer; B, D, A by (2.23) [N]."""
        m, a, b, c = self.m, self.a, self.b, self.c
        (ca, cb, cc), (sa, sb, sc) = np.cos(q).tolist(), np.sin(q).tolist()
        w1, w2, w3 = v.tolist()
        a1, a2, a3 = self.accelerations(t, q, v).tolist()
        # r̈ of the ends of crank, coupler and rocker against their starts
        x1, y1 = -a * (sa * a1 + ca * w1 * w1), a * (ca * a1 - sa * w1 * w1)
        x2, y2 = -b * (sb * a2 + cb * w2 * w2), b * (cb * a2 - sb * w2 * w2)
        x3, y3 = -c * (sc * a3 + cc * w3 * w3), c * (cc * a3 - sc * w3 * w3)
        # moments about B and D: m l²/3 ω̇ and m l/2 e′·(r̈ of the start), per length
        at_b = -m * (b * a2 / 3 + (-sb * x1 + cb * y1) / 2 + G * cb / 2)
        at_c = m * (c * a3 / 3 + G * cc / 2)
        det = sc * cb - sb * cc
        # e_β′·C = (−sin β, cos β)·C = at_b, e_γ′·C = (−sin γ, cos γ)·C = at_c
        Cx, Cy = (cc * at_b - cb * at_c) / det, (sc * at_b - sb * at_c) / det
        Bx, By = Cx + m * (x1 + x2 / 2), Cy + m * (y1 + y2 / 2 + G)
        return {
            "A.fx": Bx + m * x1 / 2,
            "A.fy": By + m * (y1 / 2 + G),
            "B.fx": Bx,
            "B.fy": By,
            "C.fx": Cx,
            "C.fy": Cy,
            "D.fx": m * x3 / 2 - Cx,
            "D.fy": m * (y3 / 2 + G) - Cy,
        }

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m (4/3 a² α̇² + a b cos(β − α) α̇ β̇ + b² β̇²/3 + c² γ̇²/3) [J]."""
        crank = 4 / 3 * self.a**2 * v[0] ** 2
        mixed = self.a * self.b * np.cos(q[1] - q[0]) * v[0] * v[1]
        ends = (self.b**2 * v[1] ** 2 + self.c**2 * v[2] ** 2) / 3
        return self.m / 2 * (crank + mixed + ends)

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = ½ m g (3 a sin α + b sin β + c sin γ) [J]."""
        sines = np.sin(q)
        return self.m * G / 2 * (3 * self.a * sines[0] + self.b * sines[1] + self.c * sines[2])

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.14) d e_x + c e_γ − a e_α − b e_β = 0 [m], (2,): λ is the force C on the rocker."""
        cos, sin = np.cos(q), np.sin(q)
        x = self.d + self.c * cos[2] - self.a * cos[0] - self.b * cos[1]
        return np.array([x, self.c * sin[2] - self.a * sin[0] - self.b * sin[1]])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15), (2.55) c e_γ′ γ̇ − a e_α′ α̇ − b e_β′ β̇ = 0: rows (2, 3)."""
        cos, sin = np.cos(q), np.sin(q)
        lengths = np.array([-self.a, -self.b, self.c])
        return np.array([-lengths * sin, lengths * cos])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R = (a/2) e_α, a e_α + (b/2) e_β, d e_x + (c/2) e_γ."""
        halves = np.array([self.a, self.b, self.c]) / 2
        x, y = halves * np.cos(q), halves * np.sin(q)
        u, w = -y * v, x * v
        Bx, By, Bu, Bw = 2 * x[0], 2 * y[0], 2 * u[0], 2 * w[0]
        return {
            "crank": (x[0], y[0], q[0], u[0], w[0], v[0]),
            "coupler": (Bx + x[1], By + y[1], q[1], Bu + u[1], Bw + w[1], v[1]),
            "rocker": (self.d + x[2], y[2], q[2], u[2], w[2], v[2]),
        }

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weights at the centres."""
        down = (0.0, -self.m * G)
        return [Load(name, pose[:2], down) for name, pose in self.poses(t, q, v).items()]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The cuts at all four pins."""
        B = (self.a * math.cos(q[0]), self.a * math.sin(q[0]))
        C = (self.d + self.c * math.cos(q[2]), self.c * math.sin(q[2]))
        return [
            Cut(("A.fx", "A.fy"), None, "crank", (0.0, 0.0)),
            Cut(("B.fx", "B.fy"), "crank", "coupler", B),
            Cut(("C.fx", "C.fy"), "coupler", "rocker", C),
            Cut(("D.fx", "D.fy"), None, "rocker", (self.d, 0.0)),
        ]
