"""Ring, or any body with a round rim, that rolls on the floor without slip and tilts.

q = (x, y, θ, β, φ): the point of the floor that it touches, the heading, the tilt, and its turn
about its axle, as turns about z, the new x (along the track) and the new y (the axle); β is 0
upright and positive if it leans to the right. At β = ±90° it lies flat, and θ and φ are one.
v = (ẋ, ẏ, ω₁, ω₂, ω₃), ω along the track, the axle and the steepest line of the disk: axes that
tilt with it but do not roll, in which the vertical is (0, sin β, cos β).
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import MOVING, Array, Cut, Load, Mass, Mode, Pose, System, Vector

G = 9.80665  # m/s²
STEADY = 1e-14  # of the moments that cancel in a steady motion: what rounding leaves of them


@dataclass(frozen=True)
class TiltingRing(Mode):
    """Mass m [kg], radius R [m]; C [kg m²] about the axle, A about a diameter.

    It starts with its centre above the origin,
    heading along x, tilted by beta0 [rad], with ω = (w1, w2, w3) [rad/s]: so w1 is β̇.
    """

    m: float
    R: float
    A: float
    C: float
    mu: float  # friction of the floor: must only be enough
    beta0: float
    w1: float
    w2: float
    w3: float

    coordinates = ("x", "y", "theta", "beta", "phi")

    def __post_init__(self) -> None:
        if not abs(self.beta0) < math.pi / 2:
            raise ValueError("flat on the floor it does not roll on its rim: |beta0| < 90°")
        J = np.diag([self.A, self.C, self.A])
        object.__setattr__(self, "masses", {"disk": Mass(self.m, J)})

    def start(self) -> tuple[Array, Array]:
        """Rolling: the centre above the origin, so what it touches is R sin β₀ to the left."""
        q = np.array([0.0, self.R * math.sin(self.beta0), 0.0, self.beta0, 0.0])
        roll = self.w2 - self.w3 * math.tan(self.beta0)
        return q, np.array([self.R * roll, 0.0, self.w1, self.w2, self.w3])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.33) about the centre, without the force (2.23) m (r̈_c − g) at the rim: v̇ (5,).

        (A + m R²) ω̇₁ = (C + m R²) ω₂ ω₃ − A ω₃² tan β + m g R sin β,
        (C + m R²) ω̇₂ = −m R² ω₃ ω₁, A ω̇₃ = (A ω₃ tan β − C ω₂) ω₁;
        (2.19) ẋ = R φ̇ cos θ, ẏ = R φ̇ sin θ give ẍ and ÿ.
        """
        _, _, theta, beta, _ = q.tolist()
        _, _, w1, w2, w3 = v.tolist()
        A, C, square = self.A, self.C, self.m * self.R**2
        sin, cos = math.sin(beta), math.cos(beta)
        tan = sin / cos
        leans = (C + square) * w2 * w3 - A * w3 * w3 * tan + self.m * G * self.R * sin
        w1_dot = leans / (A + square)
        w2_dot = -square * w3 * w1 / (C + square)
        w3_dot = (w3 * tan - C / A * w2) * w1
        roll = w2 - w3 * tan  # φ̇
        roll_dot = w2_dot - w3_dot * tan - w3 * w1 / (cos * cos)
        along, left = self.R * roll_dot, self.R * roll * w3 / cos
        c, s = math.cos(theta), math.sin(theta)
        return np.array([along * c - left * s, along * s + left * c, w1_dot, w2_dot, w3_dot])

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.4) ω₁ = β̇, ω₂ = φ̇ + θ̇ sin β, ω₃ = θ̇ cos β, solved: q̇ (5,)."""
        cos, tan = np.cos(q[3]), np.tan(q[3])
        return np.array([v[0], v[1], v[4] / cos, v[2], v[3] - v[4] * tan])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) F = m (r̈_c − g) [N], ṙ_c = R (ω₂, −ω₁, 0) in the axes of v: the floor on the disk.

        They turn with (ω₁, ω₃ tan β, ω₃), which (2.5) adds to what ṙ_c changes by.
        """
        _, _, theta, beta, _ = q.tolist()
        _, _, w1, w2, w3 = v.tolist()
        _, _, w1_dot, w2_dot, _ = self.accelerations(t, q, v).tolist()
        sin, cos, mR, weight = math.sin(beta), math.cos(beta), self.m * self.R, self.m * G
        track = mR * (w2_dot + w3 * w1)
        axle = mR * (w2 * w3 - w1_dot) + weight * sin
        steep = -mR * (w1 * w1 + w2 * w3 * sin / cos) + weight * cos
        left = axle * cos - steep * sin
        return {
            "touch.fx": track * math.cos(theta) - left * math.sin(theta),
            "touch.fy": track * math.sin(theta) + left * math.cos(theta),
            "touch.normal": axle * sin + steep * cos,
        }

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """(2.19) A steady motion: θ̇, β and φ̇ stay, and it rolls along a circle or a line.

        None unless it starts so: ω₁ = 0, (C + m R²) ω₂ ω₃ = A ω₃² tan β − m g R sin β.
        """
        A, C, square = self.A, self.C, self.m * self.R**2
        sin, cos = math.sin(self.beta0), math.cos(self.beta0)
        moments = [
            (C + square) * self.w2 * self.w3, -A * self.w3**2 * sin / cos,
            self.m * G * self.R * sin,
        ]  # fmt: skip
        if self.w1 != 0.0 or abs(sum(moments)) > STEADY * max(map(abs, moments)):
            return None
        turn, roll = self.w3 / cos, self.w2 - self.w3 * sin / cos
        theta = turn * t
        chord = self.R * roll * t * float(np.sinc(theta / 2 / math.pi))
        x, y = chord * math.cos(theta / 2), chord * math.sin(theta / 2)
        q = [x, self.R * sin + y, theta, self.beta0, roll * t]
        u = [self.R * roll * math.cos(theta), self.R * roll * math.sin(theta)]
        return np.array(q), np.array([*u, self.w1, self.w2, self.w3])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m ṙ_c² + ½ (A β̇² + C (φ̇ + θ̇ sin β)² + A (θ̇ cos β)²) [J].

        ṙ_c = (ẋ, ẏ, 0) + R d/dt (sin β sin θ, −sin β cos θ, cos β), whether it rolls or slips.
        """
        A, C, R = self.A, self.C, self.R
        x_dot, y_dot, theta_dot, beta_dot, phi_dot = v
        sin, cos, s, c = np.sin(q[3]), np.cos(q[3]), np.sin(q[2]), np.cos(q[2])
        x_c_dot = x_dot + R * (cos * s * beta_dot + sin * c * theta_dot)
        y_c_dot = y_dot - R * (cos * c * beta_dot - sin * s * theta_dot)
        z_c_dot = -R * sin * beta_dot
        spin = A * (beta_dot**2 + (theta_dot * cos) ** 2) + C * (phi_dot + theta_dot * sin) ** 2
        return (self.m * (x_c_dot**2 + y_c_dot**2 + z_c_dot**2) + spin) / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g R cos β [J]."""
        return self.m * G * self.R * np.cos(q[3])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15), (2.19) ẋ − R φ̇ cos θ = 0, ẏ − R φ̇ sin θ = 0, φ̇ = ω₂ − ω₃ tan β: (2, 5) on v."""
        R, s, c, tan = self.R, np.sin(q[2]), np.cos(q[2]), np.tan(q[3])
        return np.array(
            [[1.0, 0.0, 0.0, -R * c, R * c * tan], [0.0, 1.0, 0.0, -R * s, R * s * tan]]
        )

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x + R sin β sin θ, y − R sin β cos θ, R cos β); E₁ by half angles.

        (2.6) ṙ_c of the touching point's place, which moves along the floor and is no point of the
        disk; ω of v, turned back by φ into body axes.
        """
        x, y, theta, beta, phi = q
        x_dot, y_dot, w1, w2, w3 = v
        R, sin, cos, s, c = self.R, np.sin(beta), np.cos(beta), np.sin(theta), np.cos(theta)
        theta_dot = w3 / cos
        a, b = (np.cos(theta / 2), np.sin(theta / 2)), (np.cos(beta / 2), np.sin(beta / 2))
        d = np.cos(phi / 2), np.sin(phi / 2)
        return {
            "disk": (
                x + R * sin * s, y - R * sin * c, R * cos,
                a[0] * b[0] * d[0] - a[1] * b[1] * d[1], a[0] * b[1] * d[0] - a[1] * b[0] * d[1],
                a[0] * b[0] * d[1] + a[1] * b[1] * d[0], a[0] * b[1] * d[1] + a[1] * b[0] * d[0],
                x_dot + R * (cos * s * w1 + sin * c * theta_dot),
                y_dot - R * (cos * c * w1 - sin * s * theta_dot),
                -R * sin * w1,
                w1 * np.cos(phi) - w3 * np.sin(phi), w2, w1 * np.sin(phi) + w3 * np.cos(phi),
            )
        }  # fmt: skip

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight m g at the centre."""
        x, y, z, *_ = self.poses(t, q, v)["disk"]
        return [Load("disk", (x, y, z), (0.0, 0.0, -self.m * G))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The point of the rim that touches the floor."""
        names, axes = ("touch.fx", "touch.fy", "touch.normal"), np.eye(3).tolist()
        touch = (float(q[0]), float(q[1]), 0.0)
        return [Cut(names, None, "disk", touch, tuple(map(tuple, axes)))]


# Thin homogeneous disk that rolls on the floor without slip and tilts: a ring of its moments.


@dataclass(frozen=True)
class TiltingDisk(System):
    """Mass m [kg], radius R [m]; it starts as the ring does, with beta0 [rad], ω [rad/s]."""

    m: float
    R: float
    mu: float  # friction of the floor: must only be enough
    beta0: float
    w1: float
    w2: float
    w3: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "modes", {MOVING: self._ring()})

    def _ring(self) -> TiltingRing:
        """(2.32) J₁₁ = J₃₃ = m R²/4, J₂₂ = m R²/2 about the axle [kg m²] (Exercise 2.2)."""
        A, C = self.m * self.R**2 / 4, self.m * self.R**2 / 2
        return TiltingRing(
            self.m, self.R, A, C, self.mu, self.beta0, self.w1, self.w2, self.w3
        )  # fmt: skip

    def start(self) -> tuple[str, Array, Array]:
        """As the ring starts."""
        return MOVING, *self.modes[MOVING].start()

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """(2.19) As the ring knows it: of a steady motion."""
        return self.modes[MOVING].closed_form(t)
