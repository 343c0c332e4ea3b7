"""Laws in time, where the ground and its driven points are, and what joints hold."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, NamedTuple

import numpy as np

from second.bodies import Body, Pose, three
from second.moving import Array, Length, Vector, cross, dot, fixed, size

# Laws in time, and where the ground and its driven points are.


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


# Joints: what they hold as rows between the rates, and what they leave as coordinates.


PLANAR = {"pin": (0, 1), "slide": (1, 0), "slot": (1, 1), "weld": (0, 0)}
"""How many lengths and angles a planar joint leaves."""
KINDS = (*PLANAR, "distance", "hinge", "ball", "universal", "freedoms")


@dataclass(frozen=True)
class Joint:
    """A joint from its first point to its second.

    slides: directions in the first part's axes along which it shifts; hinges: axes about which it
    turns, each in the axes that the ones before leave. free: it turns in any way (a ball). turns:
    False where one part is a particle, whose attitude no joint holds. names: of its coordinates,
    slides first. length: of a distance, if it is given. cross: directions in the first part's axes
    along which it does not shift; beside: two that are perpendicular to its only hinge.
    """

    name: str
    kind: str
    ends: tuple[str, str]
    slides: tuple[Array, ...]
    hinges: tuple[Array, ...]
    names: tuple[str, ...]
    free: bool
    turns: bool
    space: bool
    angle: float = 0.0
    length: float | None = None
    cross: tuple[Array, ...] = ()
    beside: tuple[Array, ...] = ()

    @property
    def parts(self) -> tuple[str, str]:
        """The names of both parts."""
        return self.ends[0].split(".")[0], self.ends[1].split(".")[0]

    @property
    def rates(self) -> tuple[str, ...]:
        """The names of the rates of its coordinates."""
        plain = {"angle": "omega"} if self.space else {"angle": "omega", "shift": "speed"}
        return tuple(plain.get(name, f"{name}_dot") for name in self.names)


def joint(name: str, told: dict[str, Any], layout: Layout) -> Joint:
    """The joint that a map describes."""
    kind = next(word for word in KINDS if word in told)
    ends = tuple(told["of"] if kind == "freedoms" else told[kind])
    parts = [end.split(".")[0] for end in ends]
    turns = all(part == "ground" or layout.bodies[part].turns for part in parts)
    slides: list[Array] = []
    hinges: list[Array] = []
    names: list[str] = []
    if kind == "freedoms":
        for freedom, says in told["freedoms"].items():
            names.append(freedom)
            (slides if "slide" in says else hinges).append(three(next(iter(says.values()))))
    elif kind == "universal":
        hinges = [three(axis) for axis in told["axes"]]
    elif kind == "hinge":
        hinges, names = [three(told["axis"])], ["angle"]
    elif kind in ("slide", "slot"):
        slides, names = [three(told["along"])], ["shift"]
    if kind in ("pin", "slot") and turns:
        hinges, names = [np.array([0.0, 0.0, 1.0])], [*names, "angle"]
    slides = [s / np.linalg.norm(s) for s in slides]
    hinges = [h / np.linalg.norm(h) for h in hinges]
    beside = perpendicular_to(hinges, 3) if len(hinges) == 1 else ()
    return Joint(
        name, kind, (ends[0], ends[1]), tuple(slides), tuple(hinges), tuple(names),
        kind == "ball", turns, layout.space, told.get("angle", 0.0), told.get("length"),
        perpendicular_to(slides, 3 if layout.space else 2), beside,
    )  # fmt: skip


def perpendicular_to(directions: list[Array], dimension: int) -> tuple[Array, ...]:
    """Directions of one length that are perpendicular to these, and to each other."""
    if not directions:
        return tuple(np.eye(3)[:dimension])
    S = np.array(directions)[:, :dimension]
    *_, V = np.linalg.svd(S)
    return tuple(three(row) for row in V[np.linalg.matrix_rank(S) :])


class Held:
    """A joint at one instant: the way from its first point to its second, and both parts' axes."""

    def __init__(self, joint: Joint, layout: Layout, poses: Any, t: float, turned: Array) -> None:
        """turned: its angles in space, which the motion sums up."""
        self.joint, self.layout, self.turned = joint, layout, turned
        self.first, self.second = (poses[part] for part in joint.parts)
        points = [layout.point(poses, end, t) for end in joint.ends]
        self.way = points[1].minus(points[0])
        self.point = points[1]

    def rows(self, x: Array) -> list[Length]:
        """What the joint holds at zero, as lengths and cosines."""
        j = self.joint
        if j.kind == "distance":
            l = size(self.way)
            return [Length(l.p - (j.length or 0.0), *l[1:])]
        held = [dot(self.first.direction(e), self.way) for e in j.cross]
        if j.free or not j.turns:
            return held
        if not j.space:
            if not j.hinges:
                a = self.angle(x)
                held.append(Length(a.p - j.angle, *a[1:]))
            return held
        A, B = self.first.direction, self.second.direction
        if len(j.hinges) == 0:
            e = np.eye(3)
            held += [dot(A(e[i]), B(e[k])) for i, k in ((0, 1), (1, 2), (2, 0))]
        elif len(j.hinges) == 1:
            held += [dot(A(e), B(j.hinges[0])) for e in j.beside]
        elif len(j.hinges) == 2:
            c = dot(A(j.hinges[0]), B(j.hinges[1]))
            held.append(Length(c.p - float(j.hinges[0] @ j.hinges[1]), *c[1:]))
        return held

    def angle(self, x: Array) -> Length:
        """In the plane: the second part's angle against the first."""
        total = Length(0.0, 0.0, np.zeros(self.layout.n), 0.0)
        for part, sign, pose in zip(self.joint.parts, (-1, 1), (self.first, self.second),
                                    strict=True):  # fmt: skip
            if part != "ground":
                p = self.layout.of(x, self.layout.bodies[part])[2]
                total = Length(
                    total.p + sign * p, total.v + sign * pose.w[2], total.J + sign * pose.Jw[2], 0.0
                )
        return total

    def axes(self) -> list[Vector]:
        """The axes of its hinges in space, as they lie, with how they turn."""
        e, A, B = self.joint.hinges, self.first, self.second
        if len(e) == 1:
            return [A.direction(e[0])]
        if len(e) == 2:
            return [A.direction(e[0]), B.direction(e[1])]
        one = A.direction(e[0])
        middle = A.direction(turn(e[0], self.turned[0]) @ e[1])
        w = np.array([one.p, middle.p, B.direction(e[2]).p]).T
        rate = np.linalg.solve(w, B.w - A.w)[0]
        spun = Vector(middle.p, np.cross(A.w + rate * one.p, middle.p), middle.J, middle.b)
        return [one, spun, B.direction(e[2])]

    def turnings(self) -> list[Length]:
        """In space: the angle of each hinge, its rate and its row."""
        e = self.axes()
        W = np.array([axis.p for axis in e]).T
        P = W.T if len(e) == 1 else np.linalg.pinv(W)
        rates = P @ (self.second.w - self.first.w)
        b = -P @ (np.array([axis.v for axis in e]).T @ rates)
        J = P @ (self.second.Jw - self.first.Jw)
        return [Length(float(self.turned[i]), rates[i], J[i], b[i]) for i in range(len(e))]

    def shifts(self) -> list[Length]:
        """How far it is shifted along each slide."""
        S = np.array(self.joint.slides)
        P = S if len(S) == 1 else np.linalg.pinv(S.T)
        return [dot(self.first.direction(row), self.way) for row in P]

    def coordinates(self, x: Array) -> dict[str, Length]:
        """Its coordinates by their names."""
        j = self.joint
        found = self.shifts() if j.slides else []
        if j.hinges:
            found += self.turnings() if j.space else [self.angle(x)]
        return dict(zip(j.names, found, strict=False))
