"""Joints: what they hold as rows between the rates, and what they leave as coordinates."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from second.bodies import three
from second.geometry import Layout, turn
from second.moving import Array, Length, Vector, dot, size

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
