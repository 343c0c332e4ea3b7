"""Mass on a vertical guide, hung on a spring beside a damper, released from rest.

q = (y,), below the hook O: the length of the spring is λ = −y, so y < 0 throughout.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class SpringMassDamper(Mode):
    """m [kg] on a spring c [N/m], rest length l0 [m], and a damper d [N s/m], from y0 [m]."""

    m: float
    c: float
    d: float
    l0: float
    y0: float

    coordinates = ("y",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"mass": Mass(self.m, None)})

    def start(self) -> tuple[Array, Array]:
        """At rest at y0."""
        return np.array([self.y0]), np.zeros(1)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.44) m ÿ = −m g − c (y + λ₀) − d ẏ [m/s²], (1,)."""
        return np.array([-G - (self.c * (q[0] + self.l0) + self.d * v[0]) / self.m])

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.44) z = z₀ e^{−δt} (C + δ S), ż = −z₀ ω₀² e^{−δt} S, z = y + λ₀ + m g/c.

        δ = d/(2m), ω₀² = c/m; (C, S) = (cos ωt, sin ωt/ω) with ω² = ω₀² − δ² > 0, (1, t) for
        ω = 0, (cosh κt, sinh κt/κ) with κ² = −ω² else, there taken together with e^{−δt}.
        """
        delta, omega02 = self.d / (2 * self.m), self.c / self.m
        omega2 = omega02 - delta * delta
        if omega2 > 0:
            omega = math.sqrt(omega2)
            C, S = math.cos(omega * t), math.sin(omega * t) / omega
            fade = math.exp(-delta * t)
        elif omega2 == 0:
            C, S, fade = 1.0, t, math.exp(-delta * t)
        else:
            kappa = math.sqrt(-omega2)
            C = (1 + math.exp(-2 * kappa * t)) / 2
            S = -math.expm1(-2 * kappa * t) / (2 * kappa)
            fade = math.exp(-omega02 / (kappa + delta) * t)  # δ − κ without its cancellation
        rest = -self.l0 - self.m * G / self.c
        z0 = self.y0 - rest
        return (
            np.array([rest + z0 * fade * (C + delta * S)]),
            np.array([-z0 * omega02 * fade * S]),
        )

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m ẏ² [J]."""
        return self.m * v[0] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = ½ c (λ − λ₀)² + m g y, λ = −y [J]."""
        return self.c * (-q[0] - self.l0) ** 2 / 2 + self.m * G * q[0]

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.46), (2.47) D = ½ d ẏ² [W], Q = −∂D/∂ẏ."""
        return self.d * v[0] ** 2 / 2

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (0, y)."""
        return {"mass": (0.0, q[0], 0.0, 0.0, v[0], 0.0)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight, (2.82) spring F = −c (λ − λ₀) along the spring, (2.47) damper −d ẏ."""
        y, y_dot = float(q[0]), float(v[0])
        pull = self.c * (-y - self.l0)  # upwards, towards the hook
        forces = (-self.m * G, pull, -self.d * y_dot)
        return [Load("mass", (0.0, y), (0.0, force)) for force in forces]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The guide holds the mass sideways only."""
        return [Cut(("guide.fx",), None, "mass", (0.0, float(q[0])), ((1.0, 0.0),))]
