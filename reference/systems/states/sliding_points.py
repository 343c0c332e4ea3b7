"""Friction of points that slide on a plane seen from above, at any state: dry and viscous, alike in
all directions or along an edge of their body and across it.

q = (x, y) of a ball, and (x, y, φ) of a sled with its points P and Q on its long axis. In the plane
velocities are complex numbers here: i is a quarter turn.
"""

import cmath
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...laws.friction import Dry, coulomb, power_law, stiction, viscous
from ...laws.momentum import momentum
from ...stated import Stated
from ...system import Array, Pose, Vector


@dataclass(frozen=True)
class SlidingPoints(Stated):
    """A ball and a sled that slide on a plane, each of the mass m [kg].

    Of the ball F = mu F_N [N], and d [N at 1 m/s] and alpha of its air.

    Of the sled P and Q at p and s [m]; at P dry F_plus, F_minus, F_across [N]; at Q viscous d_plus,
    d_minus, d_across [N at 1 m/s] to the power beta.
    """

    m: float
    F: float
    d: float
    alpha: float
    p: float
    s: float
    F_plus: float
    F_minus: float
    F_across: float
    d_plus: float
    d_minus: float
    d_across: float
    beta: float

    coordinates = ("ball.x", "ball.y", "sled.x", "sled.y", "sled.angle")

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.9) X_i and E_ij of each free body by its own parameters."""
        return {"ball": (*q[:2], 0.0, *v[:2], 0.0), "sled": (*q[2:], *v[2:])}

    def quantities(self, q: Array, v: Array, a: Array) -> dict[str, Any]:
        """For each friction: its components in ground axes, and its size; and p of both bodies."""
        ball, sled = complex(v[0], v[1]), complex(v[2], v[3])
        axis = cmath.exp(1j * q[4])
        at_P, at_Q = (sled + 1j * v[4] * r * axis for r in (self.p, self.s))
        edge = at_P / axis  # along the sled, and i times what is across it
        dry = Dry(self.F_minus, self.F_plus, self.F_minus, self.F_plus)
        gliding = complex(stiction(dry, edge.real, 0.0), coulomb(1.0, self.F_across, edge.imag))
        oiled = at_Q / axis
        d = self.d_plus if oiled.real > 0.0 else self.d_minus
        slowed = complex(
            power_law(d, self.beta, oiled.real), power_law(self.d_across, self.beta, oiled.imag)
        )
        rubbed = coulomb(1.0, self.F, abs(ball)) * ball / abs(ball)
        blown = viscous(
            lambda v: -power_law(self.d, self.alpha, float(np.hypot(*v))), [ball.real, ball.imag]
        )
        forces = {
            "pad": rubbed, "air": complex(*blown), "scales": gliding * axis, "skate": slowed * axis,
        }  # fmt: skip
        p = momentum(self.m, np.array([ball.real + sled.real, ball.imag + sled.imag, 0.0]))
        components = {
            f"{name}.{field}": x
            for name, F in forces.items()
            for field, x in (("fx", F.real), ("fy", F.imag), ("force", abs(F)))
        }
        return {**components, "momentum.x": p[0], "momentum.y": p[1]}
