"""Mass on a spring that is pinned: the elastic pendulum (fig 2.16, a leg that swings and bounces).

q = (λ, φ): the spring's length, and its direction from the pin to the mass, counted from x.
"""

import math
from dataclasses import dataclass
from typing import Any, ClassVar

import numpy as np

from ...system import Array, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class ElasticPendulum(Mode):
    """m [kg] on a spring c [N/m], l0 [m], released at the length r0 [m] in direction phi0 [rad]."""

    m: float
    c: float
    l0: float
    r0: float
    phi0: float

    body: ClassVar[str] = "bob"
    coordinates = ("lambda", "phi")

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {self.body: Mass(self.m, None)})

    def start(self) -> tuple[Array, Array]:
        """At rest."""
        return np.array([self.r0, self.phi0]), np.zeros(2)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.44) λ̈ = λ φ̇² − g sin φ − c/m (λ − λ₀), φ̈ = −(2 λ̇ φ̇ + g cos φ)/λ, (2,)."""
        (l, phi), (l_dot, phi_dot) = q, v
        along = l * phi_dot**2 - G * math.sin(phi) - self.c / self.m * (l - self.l0)
        return np.array([along, -(2 * l_dot * phi_dot + G * math.cos(phi)) / l])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m (λ̇² + λ² φ̇²) [J]."""
        return self.m * (v[0] ** 2 + (q[0] * v[1]) ** 2) / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g λ sin φ + ½ c (λ − λ₀)² [J]."""
        return self.m * G * q[0] * np.sin(q[1]) + self.c * (q[0] - self.l0) ** 2 / 2

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = λ (cos φ, sin φ)."""
        cos, sin = np.cos(q[1]), np.sin(q[1])
        x_dot = v[0] * cos - q[0] * v[1] * sin
        y_dot = v[0] * sin + q[0] * v[1] * cos
        return {self.body: (q[0] * cos, q[0] * sin, 0.0, x_dot, y_dot, 0.0)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight, (2.82) spring F = −c (λ − λ₀) along itself."""
        cos, sin = math.cos(q[1]), math.sin(q[1])
        at, push = (float(q[0]) * cos, float(q[0]) * sin), -self.c * (float(q[0]) - self.l0)
        forces = ((0.0, -self.m * G), (push * cos, push * sin))
        return [Load(self.body, at, force) for force in forces]
