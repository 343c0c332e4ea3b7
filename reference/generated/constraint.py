"""The constraints of planar joints in maximal coordinates, and the list of all of a scene.

Each constraint writes its rows f_a (2.15), f_a q̇ᵃ = g, and the right side γ of f_a q̈ᵃ = γ,
derived by hand from its residual f (2.14). With the rows as written, the multipliers are the
force (and moment) of the first part on the second.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

from ...cases.scene import GROUND, Anchor, Joint, Scene, Vector
from .coordinates import Coordinates, Point, trigonometry
from .rolling import Roll, Touch

Numbers = Sequence[Any]


class Constraint(Protocol):
    """`size` rows; `part` is the joint or contact they belong to."""

    @property
    def part(self) -> str: ...

    @property
    def size(self) -> int: ...

    def f(self, t: Any, q: Numbers) -> list[Any]: ...

    def fill(
        self, t: Any, q: Numbers, v: Numbers, rows: Any, g: Any, gamma: Any, at: int
    ) -> None: ...

    def reactions(self, t: float, q: Numbers, multipliers: Numbers) -> dict[str, float]: ...


@dataclass(frozen=True)
class Coincide:
    """A pin: r_B − r_A = 0."""

    part: str
    a: Anchor
    b: Anchor
    where: Coordinates
    size: int = 2

    def f(self, t: Any, q: Numbers) -> list[Any]:
        """(2.14) f = r_B − r_A."""
        a, b = self.where.point(self.a, t, q, q), self.where.point(self.b, t, q, q)
        return [b.r[0] - a.r[0], b.r[1] - a.r[1]]

    def fill(self, t: Any, q: Numbers, v: Numbers, rows: Any, g: Any, gamma: Any, at: int) -> None:
        """(2.15) ṙ_B − ṙ_A = 0; differentiated by (2.7): γ = ω_B² d_B − ω_A² d_A."""
        a, b = self.where.point(self.a, t, q, v), self.where.point(self.b, t, q, v)
        for sign, p in ((1, b), (-1, a)):
            if p.xy is None:
                g[at] -= sign * p.r_dot[0]
                g[at + 1] -= sign * p.r_dot[1]
                continue
            rows[at, p.xy] += sign
            rows[at + 1, p.xy + 1] += sign
            if p.phi is not None:
                rows[at, p.phi] -= sign * p.d[1]
                rows[at + 1, p.phi] += sign * p.d[0]
                gamma[at] += sign * p.omega * p.omega * p.d[0]
                gamma[at + 1] += sign * p.omega * p.omega * p.d[1]

    def reactions(self, t: float, q: Numbers, multipliers: Numbers) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: here λ is the force itself."""
        return {f"{self.part}.fx": multipliers[0], f"{self.part}.fy": multipliers[1]}


@dataclass(frozen=True)
class Align:
    """The straight line of a slide: n·(r_B − r_A) = 0, n fixed in the first part and ⊥ `along`."""

    part: str
    a: Anchor
    b: Anchor
    along: Vector
    where: Coordinates
    size: int = 1

    def ends(self, t: Any, q: Numbers, v: Numbers) -> tuple[Point, Point, Vector, Vector]:
        """The two points, u along the slide and n across it."""
        a, b = self.where.point(self.a, t, q, v), self.where.point(self.b, t, q, v)
        cos, sin = (1.0, 0.0) if a.phi is None else trigonometry(q[a.phi])
        u = (cos * self.along[0] - sin * self.along[1], sin * self.along[0] + cos * self.along[1])
        return a, b, u, (-u[1], u[0])

    def f(self, t: Any, q: Numbers) -> list[Any]:
        """(2.14) f = n·(r_B − r_A)."""
        a, b, _, n = self.ends(t, q, q)
        return [n[0] * (b.r[0] - a.r[0]) + n[1] * (b.r[1] - a.r[1])]

    def fill(self, t: Any, q: Numbers, v: Numbers, rows: Any, g: Any, gamma: Any, at: int) -> None:
        """(2.15) n·Δ̇ − ω_A u·Δ = 0, Δ = r_B − r_A, since ṅ = −ω_A u; γ by (2.7)."""
        a, b, u, n = self.ends(t, q, v)
        delta = (b.r[0] - a.r[0], b.r[1] - a.r[1])
        delta_dot = (b.r_dot[0] - a.r_dot[0], b.r_dot[1] - a.r_dot[1])
        for sign, p in ((1, b), (-1, a)):
            if p.xy is None:
                g[at] -= sign * (n[0] * p.r_dot[0] + n[1] * p.r_dot[1])
                continue
            rows[at, p.xy] += sign * n[0]
            rows[at, p.xy + 1] += sign * n[1]
            if p.phi is not None:
                rows[at, p.phi] += sign * (n[1] * p.d[0] - n[0] * p.d[1])
                gamma[at] += sign * p.omega * p.omega * (n[0] * p.d[0] + n[1] * p.d[1])
        if a.phi is not None:
            rows[at, a.phi] -= u[0] * delta[0] + u[1] * delta[1]
            gamma[at] += 2 * a.omega * (u[0] * delta_dot[0] + u[1] * delta_dot[1])
            gamma[at] += a.omega * a.omega * (n[0] * delta[0] + n[1] * delta[1])

    def reactions(self, t: float, q: Numbers, multipliers: Numbers) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: a force λ n, across the slide."""
        _, _, _, n = self.ends(t, q, q)
        return {f"{self.part}.fx": multipliers[0] * n[0], f"{self.part}.fy": multipliers[0] * n[1]}


@dataclass(frozen=True)
class Lock:
    """The held angle of a slide or weld: φ_B − φ_A = angle."""

    part: str
    a: int | None  # columns of the angles; None on the ground
    b: int | None
    angle: float
    size: int = 1

    def f(self, t: Any, q: Numbers) -> list[Any]:
        """(2.14) f = φ_B − φ_A − angle."""
        b = 0.0 if self.b is None else q[self.b]
        return [b - (0.0 if self.a is None else q[self.a]) - self.angle]

    def fill(self, t: Any, q: Numbers, v: Numbers, rows: Any, g: Any, gamma: Any, at: int) -> None:
        """(2.15) φ̇_B − φ̇_A = 0."""
        for sign, column in ((1, self.b), (-1, self.a)):
            if column is not None:
                rows[at, column] += sign

    def reactions(self, t: float, q: Numbers, multipliers: Numbers) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: here λ is the moment."""
        return {f"{self.part}.torque": multipliers[0]}


def constraints(
    scene: Scene, where: Coordinates, start: Sequence[float] | None = None
) -> list[Constraint]:
    """All constraints that always hold; without a start, rolling is known as a rate only."""
    found: list[Constraint] = []
    for joint in scene.joints.values():
        parts = _joint(joint, where)
        found += parts if start is None else [_started(part, start) for part in parts]
    for contact in scene.contacts.values():
        if contact.switches:
            continue  # what it holds, and when, is for its modes to say
        xy, phi = where.columns[contact.body]
        R = scene.bodies[contact.body].radius
        assert R is not None  # the loader lets only disks touch the floor
        assert phi is not None
        C1 = None if start is None else start[xy] + R * start[phi]
        found += [Touch(contact.name, xy, R), Roll(contact.name, xy, phi, R, C1)]
    return found


def _started(part: Constraint, start: Sequence[float]) -> Constraint:
    """A held angle on the turn at which the start stands: 370° is held as well as 10°."""
    if not isinstance(part, Lock):
        return part
    turns = round(part.f(0.0, start)[0] / math.tau)
    return replace(part, angle=part.angle + turns * math.tau)


def _joint(joint: Joint, where: Coordinates) -> Iterator[Constraint]:
    if joint.shifts:
        yield Align(joint.name, joint.a, joint.b, joint.along, where)
    else:
        yield Coincide(joint.name, joint.a, joint.b, where)
    if joint.turns:
        return
    columns = [
        None if end.body == GROUND else where.columns[end.body][1] for end in (joint.a, joint.b)
    ]
    turning = [
        end.body == GROUND or where.scene.bodies[end.body].turns for end in (joint.a, joint.b)
    ]
    if all(turning):
        yield Lock(joint.name, columns[0], columns[1], joint.angle)
