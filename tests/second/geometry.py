"""Laws in time, and where the ground and its driven points are."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from second.bodies import Body, Pose, three
from second.moving import Array, Vector, cross, fixed

# Laws in time: value, slope, bend, and their corners.


class Law(NamedTuple):
    """A law in time, whose values are numbers or vectors.

    value, slope, bend: of t [s], with its first two derivatives; corners: s, where it bends or
    jumps. There value and slope are those behind it.
    """

    value: Callable[[float], Any]
    slope: Callable[[float], Any]
    bend: Callable[[float], Any]
    corners: tuple[float, ...] = ()


def constant(F: Any) -> Law:
    """The same at all times."""
    F = np.asarray(F, dtype=float)
    return Law(lambda t: F, lambda t: 0 * F, lambda t: 0 * F)


def sine(amplitude: Any, w: float, phase: float) -> Law:
    """amplitude sin(w t + phase)."""
    A = np.asarray(amplitude, dtype=float)
    if w == 0:
        return constant(A * math.sin(phase))
    return Law(
        lambda t: A * math.sin(w * t + phase),
        lambda t: A * w * math.cos(w * t + phase),
        lambda t: -A * w * w * math.sin(w * t + phase),
    )


def polynomial(coefficients: list[float], along: Any) -> Law:
    """The sum of coefficient · t^i, along a direction if it has one."""
    p = np.polynomial.Polynomial(coefficients)
    d, dd = p.deriv(), p.deriv(2)
    return Law(lambda t: p(t) * along, lambda t: d(t) * along, lambda t: dd(t) * along)


def lines(times: list[float], values: list[float], along: Any) -> Law:
    """Straight lines between the values, and outside the nearest."""
    T, Y = np.asarray(times), np.asarray(values)
    slopes = np.diff(Y) / np.diff(T)

    def slope(t: float) -> Any:
        i = int(np.searchsorted(T, t, side="right")) - 1
        return (slopes[i] if 0 <= i < len(slopes) else 0.0) * along

    return Law(lambda t: np.interp(t, T, Y) * along, slope, lambda t: 0.0 * along, tuple(times))


def jumps(amplitude: Any, at: float, until: float) -> Law:
    """The amplitude from one instant on until another, and nothing elsewhere."""
    A = np.asarray(amplitude, dtype=float)
    corners = (at,) if math.isinf(until) else (at, until)
    return Law(
        lambda t: A if at <= t < until else 0 * A,
        lambda t: 0 * A,
        lambda t: 0 * A,
        corners,
    )


NAMES = ("constant", "ramp", "sine", "step", "pulse", "polynomial", "table")


def law(told: Any) -> Law:
    """The law of a map that holds one of the words, or of a mere number."""
    if not isinstance(told, dict):
        return constant(told)
    word = next(name for name in NAMES if name in told)
    says = told[word]
    if word == "constant":
        return constant(says)
    if word == "ramp":
        b = np.asarray(says, dtype=float)
        return Law(lambda t: b * t, lambda t: b, lambda t: 0 * b)
    if word == "sine":
        return sine(says["amplitude"], says["angular_frequency"], says.get("phase", 0.0))
    if word == "step":
        return jumps(says["amplitude"], says["at"], math.inf)
    if word == "pulse":
        return jumps(says["amplitude"], says["from"], says["until"])
    along: Any = 1.0
    if "along" in says:
        along = np.asarray(says["along"], dtype=float)
        along = along / np.linalg.norm(along)
    if word == "polynomial":
        return polynomial(says["coefficients"], along)
    return lines(says["times"], says["values"], along)


# Where everything is at one instant: poses of the bodies, points of ground and bodies.


def of_quaternion(q: Array) -> Array:
    """The rotation matrix of a quaternion (w, x, y, z) of any size."""
    w, x, y, z = q / np.sqrt(q @ q)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])  # fmt: skip


def turn(axis: Any, angle: float) -> Array:
    """The rotation matrix about an axis, after Rodrigues."""
    e = np.asarray(axis, dtype=float)
    e = e / np.linalg.norm(e)
    K = np.array([[0, -e[2], e[1]], [e[2], 0, -e[0]], [-e[1], e[0], 0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def product(p: Array, q: Array) -> Array:
    """The product of two quaternions."""
    a, u = p[0], p[1:]
    b, v = q[0], q[1:]
    return np.concatenate([[a * b - u @ v], a * v + b * u + cross(u, v)])


def after(q: Array, small: Array) -> Array:
    """The quaternion behind a further turn by a rotation vector in ground axes."""
    angle = float(np.linalg.norm(small))
    half = 0.5 * np.sinc(angle / 2 / np.pi) * small
    return product(np.concatenate([[np.cos(angle / 2)], half]), q)


@dataclass
class Layout:
    """The bodies of a scene, its points of the ground, and how their coordinates are ordered.

    places x: of each body x, y, angle, or its centre and a quaternion; rates u: of each body
    vx, vy, omega, or v and ω in ground axes.
    """

    space: bool
    bodies: dict[str, Body]
    ground: dict[str, tuple[Array, Law]]
    near_by: int = field(init=False)

    def __post_init__(self) -> None:
        self.near_by = 7 if self.space else 3

    @property
    def n(self) -> int:
        """How many rates there are."""
        return (6 if self.space else 3) * len(self.bodies)

    def of(self, x: Array, body: Body) -> Array:
        """The part of the places that is a body's."""
        k = self.near_by
        return x[k * body.at : k * (body.at + 1)]

    def rest(self) -> Array:
        """All bodies in the origin, their axes parallel to the ground's."""
        one = [0, 0, 0, 1, 0, 0, 0] if self.space else [0, 0, 0]
        return np.array(one * len(self.bodies), dtype=float)

    def moved(self, x: Array, small: Array) -> Array:
        """The places behind a small motion u."""
        if not self.space:
            return x + small
        y = x.copy()
        for b in self.bodies.values():
            mine, du = self.of(y, b), small[6 * b.at : 6 * b.at + 6]
            mine[:3] += du[:3]
            mine[3:] = after(mine[3:], du[3:])
        return y

    def rate(self, x: Array, u: Array) -> Array:
        """The derivative of the places."""
        if not self.space:
            return u
        y = np.empty_like(x)
        for b in self.bodies.values():
            mine, r = self.of(y, b), u[6 * b.at : 6 * b.at + 6]
            mine[:3] = r[:3]
            mine[3:] = 0.5 * product(np.concatenate([[0.0], r[3:]]), self.of(x, b)[3:])
        return y

    def pose(self, x: Array, u: Array, body: Body) -> Pose:
        """How one body lies and moves."""
        mine, (c, w) = self.of(x, body), body.columns
        J, Jw = np.zeros((3, self.n)), np.zeros((3, self.n))
        if self.space:
            J[:, c], Jw[:, w] = np.eye(3), np.eye(3)
            return Pose(Vector(mine[:3], u[c], J, np.zeros(3)), of_quaternion(mine[3:]), u[w], Jw)
        J[0, c.start] = J[1, c.start + 1] = Jw[2, w.start] = 1
        a, b = np.cos(mine[2]), np.sin(mine[2])
        R = np.array([[a, -b, 0.0], [b, a, 0.0], [0.0, 0.0, 1.0]])
        center = Vector(
            np.array([mine[0], mine[1], 0.0]), np.array([u[c][0], u[c][1], 0.0]), J, np.zeros(3)
        )
        return Pose(center, R, np.array([0.0, 0.0, u[w][0]]), Jw)

    def poses(self, x: Array, u: Array) -> dict[str, Pose]:
        """How all bodies lie and move, and the ground."""
        found = {name: self.pose(x, u, b) for name, b in self.bodies.items()}
        none = fixed(np.zeros(3), self.n)
        return found | {"ground": Pose(none, np.eye(3), np.zeros(3), none.J, still=True)}

    def point(self, poses: dict[str, Pose], name: str, t: float) -> Vector:
        """A point `body.point` or `ground.point`."""
        owner, point = name.split(".")
        if owner != "ground":
            return poses[owner].point(self.bodies[owner].points[point])
        at, moves = self.ground[point]
        way, rate, bend = (three(f(t)) for f in moves[:3])
        return Vector(at + way, rate, np.zeros((3, self.n)), bend)


def driven(told: Any) -> tuple[Array, Law]:
    """A point of the ground: where it is without its law, and the law of its way from there."""
    if isinstance(told, list):
        return three(told), constant(np.zeros(len(told)))
    at = three(told["at"])
    if "velocity" in told:
        v = three(told["velocity"])
        return at, law({"ramp": v})
    return at, law(told["moves"])
