"""A bar, a disk, a sphere and a cuboid, each on a hinge of the ground: their moments of inertia.

Exercises 2.2 and 2.3. Tensors are integrated over the shapes by Gauss' rule, which is exact here;
those of the bar and the disk stand in the chapter too, and are taken from there. By (2.35) they
are moved to the hinge, by (2.36) turned into its axes.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...laws.inertia import bar, disk, rotated, steiner, tensor
from ...laws.momentum import axis_moment, center
from ...stated import Stated
from ...system import Array, Pose, Vector

G = 9.80665  # m/s²
NODES, WEIGHTS = np.polynomial.legendre.leggauss(5)  # exact up to the ninth power of a place
COLUMNS = {"11": (0, 0), "22": (1, 1), "33": (2, 2), "12": (0, 1), "13": (0, 2), "23": (1, 2)}


@dataclass(frozen=True)
class Hung:
    """m [kg], J [kg m²] about C, C from the hinge [m], and the hinge's axis u: in body axes."""

    m: float
    J: Array
    a: Array
    u: Array


@dataclass(frozen=True)
class HungShapes(Stated):
    """Masses m [kg], the bar's length l, radii R, the cuboid's edges e [m].

    The bar turns about e₂ through its end. The others hang at (h, 0, k) from their centres [m]; the
    disk, whose axle is (0, s, c) of unit length, turns about e₃, the sphere about e₁, and the
    cuboid about e₂.
    """

    m_bar: float
    l: float
    m_disk: float
    R_disk: float
    s: float
    c: float
    m_ball: float
    R_ball: float
    m_box: float
    e1: float
    e2: float
    e3: float
    h: float
    k: float

    coordinates = ("rod_hinge.angle", "wheel_hinge.angle", "ball_hinge.angle", "box_hinge.angle")

    def bodies(self) -> dict[str, Hung]:
        """(2.36) the disk's principal axes turn with its axle; the hinge is at −a from C."""
        length = np.hypot(self.s, self.c)
        axle = np.array([0.0, self.s, self.c]) / length
        E = np.array([[1.0, 0.0, 0.0], np.cross(axle, [1.0, 0.0, 0.0]), axle])
        J_disk = rotated(disk(self.m_disk, self.R_disk), E.T)
        a, e = -np.array([self.h, 0.0, self.k]), np.eye(3)
        box = integrated(self.m_box, cuboid(self.e1, self.e2, self.e3))
        ball = integrated(self.m_ball, sphere(self.R_ball))
        return {
            "rod": Hung(self.m_bar, bar(self.m_bar, self.l), self.l / 2 * e[0], e[1]),
            "wheel": Hung(self.m_disk, J_disk, a, e[2]),
            "ball": Hung(self.m_ball, ball, a, e[0]),
            "box": Hung(self.m_box, box, a, e[1]),
        }

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R_k, E_k, turned about u, and (2.6) their rates."""
        poses: dict[str, Pose] = {}
        for (name, body), angle, rate in zip(self.bodies().items(), q, v, strict=True):
            r = about(body.u, angle, body.a)
            half = np.sin(angle / 2) * body.u
            r_dot = np.cross(rate * body.u, r)
            poses[name] = (*r, np.cos(angle / 2), *half, *r_dot, *(rate * body.u))
        return poses

    def quantities(self, q: Array, v: Array, a: Array) -> dict[str, Any]:
        """Torque of each hinge in addition to the weight's moment; tensors about C, M and T."""
        values: dict[str, Any] = {}
        M = np.zeros((4, 4))
        for k, ((name, body), angle) in enumerate(zip(self.bodies().items(), q, strict=True)):
            J33 = float(body.u @ steiner(body.J, body.m, body.a) @ body.u)
            down = np.array([0.0, 0.0, -body.m * G])
            weight = body.u @ np.cross(about(body.u, angle, body.a), down)
            values[f"{name}_hinge.torque"] = axis_moment(J33, a[k]) - weight
            values |= {f"{name}.inertia_{ik}": body.J[at] for ik, at in COLUMNS.items()}
            M[k, k] = J33
        T = float(v @ M @ v) / 2
        return {**values, "mass_matrix": M, "energy.kinetic": T}


def about(u: Array, angle: Any, x: Array) -> Any:
    """(3,) x turned about the unit vector u."""
    cos, sin = np.cos(angle), np.sin(angle)
    return cos * x + sin * np.cross(u, x) + (1 - cos) * (u @ x) * u


def integrated(m: float, points: Iterator[tuple[float, Array]]) -> Array:
    """J (3, 3) [kg m²] about the centre, of shares of a mass m [kg] and their places."""
    shares, x = (np.array(part) for part in zip(*points, strict=True))
    masses = m * shares / np.sum(shares)
    return tensor(masses, x - center(masses, x))


def cuboid(e1: float, e2: float, e3: float) -> Iterator[tuple[float, Array]]:
    """Weights and places of Gauss' rule."""
    for i in range(len(NODES)):
        for j in range(len(NODES)):
            for k in range(len(NODES)):
                x = np.array([e1 * NODES[i], e2 * NODES[j], e3 * NODES[k]]) / 2
                yield float(WEIGHTS[i] * WEIGHTS[j] * WEIGHTS[k]), x


def sphere(R: float) -> Iterator[tuple[float, Array]]:
    """Yields weights and places of Gauss' rule in r and in cos of the polar angle.

    There are five equal steps around.
    """
    turns = 2 * np.pi * np.arange(5) / 5
    for i, s in enumerate(NODES):
        r = R * (1 + s) / 2
        for j, z in enumerate(NODES):
            level = np.sqrt(1 - z * z)
            for turn in turns:
                x = r * np.array([level * np.cos(turn), level * np.sin(turn), z])
                yield float(WEIGHTS[i] * WEIGHTS[j] * r * r), x
