"""A rigid body (fig 2.4, 2.9) at any state, described from a point Ω that is not its centre C.

q = (x, y, z, ψ, θ, φ): the place of Ω, and turns about the body's own e₃, e₂, e₁ in this order.
ω follows from Ė by (2.3), (2.4); what moves it from (2.23) and, about Ω, from (2.28).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...laws.inertia import steiner
from ...laws.momentum import (
    angular_momentum,
    moment_change,
    momentum,
    of_general_point,
    spin_change,
)
from ...laws.rotation import acceleration, angular_velocity, axis_rates, point, velocity
from ...stated import Stated
from ...system import Array, Pose, Vector

G: Array = np.array([0.0, 0.0, -9.80665])  # m/s²


@dataclass(frozen=True)
class MovingBody(Stated):
    """m [kg]; J [kg m²] about C, a = ΩC and p = CP [m], all in body axes."""

    m: float
    J11: float
    J22: float
    J33: float
    J12: float
    J13: float
    J23: float
    a1: float
    a2: float
    a3: float
    p1: float
    p2: float
    p3: float

    coordinates = ("held.x", "held.y", "held.z", "held.psi", "held.theta", "held.phi")

    @property
    def J(self) -> Array:
        """(2.32) the matrix of moments and products of inertia about C, (3, 3)."""
        return np.array(
            [
                [self.J11, self.J12, self.J13],
                [self.J12, self.J22, self.J23],
                [self.J13, self.J23, self.J33],
            ]
        )

    def _kinematics(self, q: Vector, v: Vector) -> tuple[Any, Any]:
        """E (3, 3) and ω (3,) in body axes."""
        E, E_dot = frame(*q[3:]), np.tensordot(v[3:], np.array(slopes(*q[3:])), 1)
        return E, angular_velocity(E, E_dot)

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.9) X_i and E_ij of six parameters, (2.6) ṙ_c = ṙ_Ω + ω × a."""
        E, omega = self._kinematics(q, v)
        a = np.array([self.a1, self.a2, self.a3])
        c_dot = velocity(v[:3], omega @ E, a @ E)
        return {"body": (*point(q[:3], E, a), *quaternion(*q[3:]), *c_dot, *omega)}

    def quantities(self, q: Array, v: Array, a: Array) -> dict[str, Any]:
        """The point P, the body's accelerations, energy and momenta, and what moves it about Ω."""
        E, omega = self._kinematics(q, v)
        omega_dot = spin_rates(q[3:], v[3:], a[3:])
        to_c = np.array([self.a1, self.a2, self.a3])
        to_p = to_c + np.array([self.p1, self.p2, self.p3])
        spin, spin_dot = omega @ E, omega_dot @ E
        d = to_c @ E
        c_ddot = acceleration(a[:3], spin_dot, spin, d)
        J_Omega = steiner(self.J, self.m, to_c)
        T = of_general_point(self.m, J_Omega, E @ v[:3], omega, to_c)
        c, c_dot = point(q[:3], E, to_c), velocity(v[:3], spin, d)
        J_ground = E.T @ self.J @ E
        D = angular_momentum(self.m, J_ground, c, c_dot, spin)
        pull: Any = np.cross(d, self.m * G)
        weight = moment_change(pull, self.m, a[:3], d)
        moment = spin_change(J_Omega, omega, omega_dot) @ E - weight
        efforts = [*(self.m * (c_ddot - G)), *(hinges(*q[3:]) @ moment)]
        names = ("x_force", "y_force", "z_force", "psi_torque", "theta_torque", "phi_torque")
        return {
            **_by_axis("body.P.", point(q[:3], E, to_p)),
            **_by_axis("body.P.v", v[:3] + to_p @ axis_rates(E, omega)),
            **_by_axis("body.P.a", acceleration(a[:3], spin_dot, spin, to_p @ E)),
            **_by_axis("body.a", c_ddot),
            **_by_axis("body.alpha_", spin_dot),
            **_by_axis("momentum.", momentum(self.m, c_dot)),
            **_by_axis("momentum.angular_", D),
            "energy.kinetic": T,
            **{f"held.{name}": x for name, x in zip(names, efforts, strict=True)},
        }


def frame(psi: Any, theta: Any, phi: Any) -> Any:
    """E (3, 3) with the body's axes as its rows, after turns about e₃, e₂, e₁."""
    return _about(0, phi) @ _about(1, theta) @ _about(2, psi)


def slopes(psi: Any, theta: Any, phi: Any) -> tuple[Any, Any, Any]:
    """∂E/∂ψ, ∂E/∂θ, ∂E/∂φ, (3, 3) each."""
    roll, pitch, yaw = _about(0, phi), _about(1, theta), _about(2, psi)
    return (
        roll @ pitch @ _about(2, psi, slope=True),
        roll @ _about(1, theta, slope=True) @ yaw,
        _about(0, phi, slope=True) @ pitch @ yaw,
    )


def spin_rates(q: Array, v: Array, a: Array) -> Array:
    """ω̇ (3,) in body axes, of ω = ψ̇ (−sin θ, cos θ sin φ, cos θ cos φ) + θ̇ (0, cos φ, −sin φ)
    + φ̇ (1, 0, 0)."""
    (_, theta, phi), (psi_dot, theta_dot, phi_dot) = q.tolist(), v.tolist()
    s, c, sf, cf = np.sin(theta), np.cos(theta), np.sin(phi), np.cos(phi)
    e1, e2 = np.array([-s, c * sf, c * cf]), np.array([0.0, cf, -sf])
    e1_dot = theta_dot * np.array([-c, -s * sf, -s * cf]) + phi_dot * np.array(
        [0.0, c * cf, -c * sf]
    )
    e2_dot = phi_dot * np.array([0.0, -sf, -cf])
    e3 = np.array([1.0, 0.0, 0.0])
    return a @ np.array([e1, e2, e3]) + psi_dot * e1_dot + theta_dot * e2_dot


def hinges(psi: Any, theta: Any, phi: Any) -> Any:
    """(3, 3) the axes of the three turns as rows, in ground axes."""
    turned = _about(1, theta) @ _about(2, psi)
    return np.array([[0.0, 0.0, 1.0], _about(2, psi)[1], turned[0]])


def _about(axis: int, angle: Any, *, slope: bool = False) -> Any:
    """(3, 3) the turn about one axis, or its derivative by the angle."""
    c, s, unit = (np.cos(angle), np.sin(angle), 1.0)
    if slope:
        c, s, unit = -s, c, 0.0
    i, j = (axis + 1) % 3, (axis + 2) % 3
    E = np.zeros((3, 3), np.result_type(angle, float))
    E[axis, axis], E[i, i], E[j, j], E[i, j], E[j, i] = unit, c, c, s, -s
    return E


def quaternion(psi: Any, theta: Any, phi: Any) -> tuple[Any, Any, Any, Any]:
    """The unit quaternion of three turns as products of half angles: smooth in all of them."""
    (a, b, c), (d, e, f) = ([f(x / 2) for x in (psi, theta, phi)] for f in (np.cos, np.sin))
    return (
        a * b * c + d * e * f,
        a * b * f - d * e * c,
        a * e * c + d * b * f,
        d * b * c - a * e * f,
    )


def _by_axis(begin: str, vector: Any) -> dict[str, float]:
    return {f"{begin}{axis}": float(x) for axis, x in zip("xyz", vector, strict=True)}
