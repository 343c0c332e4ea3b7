"""Bodies: mass, inertia and points of each shape, and how its points and directions move."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from second.moving import Array, Vector, cross, skew

SHAPES = ("bar", "disk", "sphere", "block", "rigid", "particle", "spokes")


@dataclass(frozen=True)
class Body:
    """A rigid body: its mass, its inertia (3, 3) about the centre in body axes, and its points.

    at: its place among the bodies; turns: not of a particle; radius: of its rim, if it has one;
    axle: of a rim in space. corners: half the sides of a block.
    """

    name: str
    at: int
    space: bool
    mass: float
    inertia: Array
    points: dict[str, Array]
    turns: bool = True
    radius: float = 0.0
    axle: Array | None = None
    half: Array | None = None

    @property
    def columns(self) -> tuple[slice, slice]:
        """Of the rates u: of its centre, and of its turning."""
        i = self.at
        if self.space:
            return slice(6 * i, 6 * i + 3), slice(6 * i + 3, 6 * i + 6)
        return slice(3 * i, 3 * i + 2), slice(3 * i + 2, 3 * i + 3)


def three(p: Any) -> Array:
    """A place or a direction of two or three numbers, as three."""
    p = np.asarray(p, dtype=float)
    return p if len(p) == 3 else np.array([p[0], p[1], 0.0])


def tensor(J: list[float]) -> Array:
    """The symmetric matrix of J11, J22, J33, J12, J13, J23."""
    a, b, c, d, e, f = J
    return np.array([[a, d, e], [d, b, f], [e, f, c]])


def perpendicular(axis: Array) -> Array:
    """The matrix that leaves of a vector what is perpendicular to an axis."""
    e = axis / np.linalg.norm(axis)
    return np.eye(3) - np.outer(e, e)


def body(name: str, at: int, told: dict[str, Any], space: bool) -> Body:
    """The body that a map of one shape describes."""
    shape = next(s for s in SHAPES if s in told)
    says = told[shape]
    m = says["mass"]
    points = {"center": np.zeros(3)}
    J, turns, radius, axle, half = np.zeros((3, 3)), True, 0.0, None, None
    if shape == "bar":
        l = says["length"]
        J = m * l * l / 12 * np.diag([0.0, 1.0, 1.0])
        points |= {"start": np.array([-l / 2, 0, 0]), "end": np.array([l / 2, 0, 0])}
    elif shape == "disk":
        radius = says["radius"]
        axle = three(says["axle"]) if space else np.array([0.0, 0.0, 1.0])
        e = axle / np.linalg.norm(axle)
        J = m * radius**2 * (np.eye(3) + np.outer(e, e)) / 4
    elif shape == "sphere":
        radius = says["radius"]
        J = 2 / 5 * m * radius**2 * np.eye(3)
    elif shape == "block":
        sides = says["size"] if space else [says["width"], says["height"], 0.0]
        half = np.asarray(sides) / 2
        J = m / 3 * np.diag(half @ half - half**2)
        if not space:
            for high, y in (("lower", -1), ("upper", 1)):
                for side, x in (("left", -1), ("right", 1)):
                    points[f"{high}_{side}"] = half * [x, y, 0]
    elif shape == "rigid":
        J = tensor(says["inertia"]) if space else says["inertia"] * np.eye(3)
        radius = says.get("radius", 0.0)
        axle = three(says["axle"]) if "axle" in says else None
    elif shape == "spokes":
        J, n, l = says["inertia"] * np.eye(3), int(says["number"]), says["length"]
        for k in range(n):  # at angle 0 on tip0, left, and tip1: both half a gap beside −y
            a = -math.pi / 2 + (k - 0.5) * 2 * math.pi / n
            points[f"tip{k}"] = l * np.array([math.cos(a), math.sin(a), 0.0])
    else:
        turns = False
        J = np.eye(3)  # nothing turns it, so that any inertia leaves it at rest
    points |= {key: three(p) for key, p in (told.get("points") or {}).items()}
    return Body(name, at, space, m, J, points, turns, radius, axle, half)


@dataclass(frozen=True)
class Pose:
    """Where a body is and how it moves: its centre, axes R, angular velocity w, and their rows.

    still: the ground.
    """

    center: Vector
    R: Array
    w: Array
    Jw: Array
    still: bool = False

    def point(self, s: Array) -> Vector:
        """A point of the body, s from its centre in body axes."""
        if not s.any():
            return self.center
        r, c, w = self.R @ s, self.center, self.w
        v = cross(w, r)
        return Vector(c.p + r, c.v + v, c.J - skew(r) @ self.Jw, c.b + cross(w, v))

    def direction(self, s: Array) -> Vector:
        """A direction that is fixed in the body."""
        if self.still:
            return Vector(s, self.w, self.Jw, self.w)
        r, w = self.R @ s, self.w
        v = cross(w, r)
        return Vector(r, v, -skew(r) @ self.Jw, cross(w, v))
