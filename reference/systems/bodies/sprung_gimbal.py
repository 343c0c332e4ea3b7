"""Globe in a gimbal whose two axes are oblique, on torsion springs, damped and driven.

q = (θ, φ): θ about n₁ = e_z, which stands still, φ about n₂, which θ turns and which lies in the
globe. A globe has the same moment of inertia J about all axes, so that with n₁·n₂ = κ its two
turns are coupled linear oscillators at any amplitude.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class SprungGimbal(Mode):
    """m [kg], R [m], n₂ along (a, 0, b); c1, c2 [N m/rad] from theta0, phi0; d1, d2 [N m s/rad].

    A motor M sin Ω t [N m] is about n₁. It starts at theta, phi [rad] with w1, w2 [rad/s].
    """

    m: float
    R: float
    a: float
    b: float
    c1: float
    theta0: float
    d1: float
    c2: float
    phi0: float
    d2: float
    M: float
    Omega: float
    theta: float
    phi: float
    w1: float
    w2: float

    coordinates = ("theta", "phi")

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"globe": Mass(self.m, self.J * np.eye(3))})

    @property
    def J(self) -> float:
        """(2.30) J = 2/5 m R² [kg m²] about any axis through the centre."""
        return 2 * self.m * self.R**2 / 5

    @property
    def kappa(self) -> float:
        """κ = n₁·n₂."""
        return self.b / math.hypot(self.a, self.b)

    @property
    def sine(self) -> float:
        """|n₁ × n₂|, with the sign of a."""
        return self.a / math.hypot(self.a, self.b)

    def start(self) -> tuple[Array, Array]:
        """As the case says."""
        return np.array([self.theta, self.phi]), np.array([self.w1, self.w2])

    def _torques(self, t: Any, q: Any, v: Any) -> tuple[Any, Any]:
        """(2.45)–(2.50) what spring, damper and motor exert about n₁ and about n₂ [N m]."""
        M1 = self.M * np.sin(self.Omega * t) - self.c1 * (q[0] - self.theta0) - self.d1 * v[0]
        return M1, -self.c2 * (q[1] - self.phi0) - self.d2 * v[1]

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.44) J (θ̈ + κ φ̈) = M₁, J (κ θ̈ + φ̈) = M₂, (2,)."""
        M1, M2 = self._torques(t, q, v)
        J = self.J * (1 - self.kappa**2)
        return np.array([(M1 - self.kappa * M2) / J, (M2 - self.kappa * M1) / J])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) F = (0, 0, m g) [N]; (2.27) M = J (θ̈ n₁ + φ̈ n₂ + θ̇ φ̇ n₁ × n₂) [N m], with what
        springs, dampers and the motor exert.
        """
        a, n2 = self.accelerations(t, q, v), self._second(q)
        turning = v[0] * v[1]
        return {
            "gimbal.fx": 0.0,
            "gimbal.fy": 0.0,
            "gimbal.fz": self.m * G,
            "gimbal.mx": self.J * float(a[1] * n2[0] - turning * n2[1]),
            "gimbal.my": self.J * float(a[1] * n2[1] + turning * n2[0]),
            "gimbal.mz": self.J * float(a[0] + a[1] * self.kappa),
        }

    def _second(self, q: Any) -> tuple[Any, Any, float]:
        """n₂ in ground axes."""
        return self.sine * np.cos(q[0]), self.sine * np.sin(q[0]), self.kappa

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.44) q = q₀ + Im (A e^{iΩt}) + V e^{Λt} V⁻¹ (…), Λ and V of S in ẏ = S y.

        (C + iΩ D − Ω² J) A = (M, 0), with the matrices of inertia, damping and stiffness.
        """
        kappa = self.b / math.sqrt(self.a**2 + self.b**2)
        J = 0.4 * self.m * self.R**2 * np.array([[1.0, kappa], [kappa, 1.0]])
        D, C = np.diag([self.d1, self.d2]), np.diag([self.c1, self.c2])
        A = np.linalg.solve(C + 1j * self.Omega * D - self.Omega**2 * J, [self.M, 0.0])
        steady = np.concatenate([A, 1j * self.Omega * A])
        S = np.block([[np.zeros((2, 2)), np.eye(2)], [-np.linalg.solve(J, np.hstack([C, D]))]])
        values, vectors = np.linalg.eig(S)
        rest = np.array([self.theta0, self.phi0, 0.0, 0.0])
        begun = np.array([self.theta, self.phi, self.w1, self.w2]) - rest - steady.imag
        free = vectors @ (np.exp(values * t) * np.linalg.solve(vectors, begun))
        y = rest + (steady * np.exp(1j * self.Omega * t)).imag + free.real
        return y[:2], y[2:]

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ J (θ̇² + 2 κ θ̇ φ̇ + φ̇²) [J]."""
        return self.J * (v[0] ** 2 + 2 * self.kappa * v[0] * v[1] + v[1] ** 2) / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = ½ c₁ (θ − θ₀)² + ½ c₂ (φ − φ₀)² [J]."""
        return self.c1 * (q[0] - self.theta0) ** 2 / 2 + self.c2 * (q[1] - self.phi0) ** 2 / 2

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.46) D = ½ d₁ θ̇² + ½ d₂ φ̇² [W]."""
        return self.d1 * v[0] ** 2 / 2 + self.d2 * v[1] ** 2 / 2

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q = (M sin Ω t, 0) [N m], (2,)."""
        return np.array([self.M * np.sin(self.Omega * t), 0.0 * t])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) the centre stays; E₁ by the turns θ about n₁, then φ about n₂, which are told too.

        The quaternion is (cos θ/2, 0, 0, sin θ/2) ∘ (cos φ/2, n₂ sin φ/2), and in body axes
        ω = θ̇ n₁ + φ̇ n₂, n₁ turned by −φ about n₂.
        """
        (ct, cp), (st, sp) = np.cos(q / 2), np.sin(q / 2)
        s, k = self.sine, self.kappa
        attitude = (ct * cp - st * k * sp, ct * s * sp, st * s * sp, st * cp + ct * k * sp)
        cos, sin = np.cos(q[1]), np.sin(q[1])
        n1 = (s * k * (1 - cos), s * sin, k * k + s * s * cos)
        omega = (v[0] * n1[0] + v[1] * s, v[0] * n1[1], v[0] * n1[2] + v[1] * k)
        still = 0.0 * q[0]
        globe = (still, still, still, *attitude, still, still, still, *omega)
        return {"globe": globe, "gimbal.theta": (q[0],), "gimbal.phi": (q[1],)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight, and M₁ about n₁ and M₂ about n₂ as one moment, in the plane of both."""
        M1, M2 = self._torques(t, q, v)
        n2, free = self._second(q), 1 - self.kappa**2
        first, second = (M1 - self.kappa * M2) / free, (M2 - self.kappa * M1) / free
        moment = (second * n2[0], second * n2[1], first + second * n2[2])
        weight = (0.0, 0.0, -self.m * G)
        return [Load("globe", (0.0, 0.0, 0.0), weight, tuple(map(float, moment)))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The centre, and the couple along n₁ × n₂, about which the gimbal lets nothing turn."""
        at, n2 = (0.0, 0.0, 0.0), self._second(q)
        axes = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
        names = ("gimbal.fx", "gimbal.fy", "gimbal.fz", "gimbal.couple")
        across = (float(-n2[1]), float(n2[0]), 0.0)
        return [Cut(names, None, "globe", at, axes, moments=(across,))]
