"""A bar, a disk and a rectangle that move freely in the plane, at any state.

q = (x, y, angle) of each. Their kinetic energy is König's (2.54).
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...laws.momentum import angular_momentum, momentum, of_center, spin_momentum
from ...laws.rotation import point, velocity
from ...stated import Stated
from ...system import Array, Pose, Vector

NAMES = ("rod", "wheel", "box")


@dataclass(frozen=True)
class PlanarBodies(Stated):
    """Masses m [kg]; the bar's length l, the radius R, the edges w, h [m]; P at (p1, p2) [m]."""

    m_bar: float
    l: float
    m_disk: float
    R: float
    m_box: float
    w: float
    h: float
    p1: float
    p2: float

    coordinates = tuple(f"{name}.{own}" for name in NAMES for own in ("x", "y", "angle"))

    def inertias(self) -> tuple[tuple[float, float], ...]:
        """m and J₃₃ [kg m²] about C (Exercises 2.2, 2.3)."""
        return (
            (self.m_bar, self.m_bar * self.l**2 / 12),
            (self.m_disk, self.m_disk * self.R**2 / 2),
            (self.m_box, self.m_box * (self.w**2 + self.h**2) / 12),
        )

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.9) X_i and E_ij of each free body by its own parameters."""
        rows = zip(NAMES, np.reshape(q, (3, 3)), np.reshape(v, (3, 3)), strict=True)
        return {name: (*place, *rate) for name, place, rate in rows}

    def quantities(self, q: Array, v: Array, a: Array) -> dict[str, Any]:
        """Points, momenta, the energy, and J₃₃, which is D_c of ω = 1."""
        values: dict[str, Any] = {}
        T, p, D = 0.0, np.zeros(3), 0.0
        places, rates = np.reshape(q, (3, 3)), np.reshape(v, (3, 3))
        for name, (m, J), (x, y, phi), (vx, vy, w) in zip(
            NAMES, self.inertias(), places, rates, strict=True
        ):
            r, r_dot, omega = np.array([x, y, 0.0]), np.array([vx, vy, 0.0]), np.array([0, 0, w])
            tensor = np.diag([0.0, 0.0, J])
            T += of_center(m, tensor, r_dot, omega)
            p = p + momentum(m, r_dot)
            D += float(angular_momentum(m, tensor, r, r_dot, omega)[2])
            values[f"{name}.inertia"] = spin_momentum(tensor, np.array([0.0, 0.0, 1.0]))[2]
            cos, sin = np.cos(phi), np.sin(phi)
            E = np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])
            at = {"rod": np.array([self.l / 2, 0.0, 0.0]), "box": np.array([self.p1, self.p2, 0.0])}
            if name in at:
                end = f"{name}.{'end' if name == 'rod' else 'P'}"
                place, moving = point(r, E, at[name]), velocity(r_dot, omega, at[name] @ E)
                values |= {f"{end}.x": place[0], f"{end}.y": place[1]}
                values |= {f"{end}.vx": moving[0], f"{end}.vy": moving[1]}
        return {**values, "energy.kinetic": T, "momentum.x": p[0], "momentum.y": p[1],
                "momentum.angular": D}  # fmt: skip
