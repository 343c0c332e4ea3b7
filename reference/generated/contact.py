"""What a contact on the floor or a slide at rest holds, and what rubs when it does not rest.

The rows are written as those of joints are; the floor is y = 0, and R is the radius of a rim (0 for
a particle or a point of a bar), whose lowest point touches.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...cases.scene import Anchor, Contact, Joint
from .constraint import Align, Constraint
from .coordinates import Coordinates

Numbers = Sequence[Any]


@dataclass(frozen=True)
class Press:
    """A closed contact: the lowest point stays on the floor, y − R = 0."""

    part: str
    at: Anchor
    R: float
    where: Coordinates
    size: int = 1

    def f(self, t: Any, q: Numbers) -> list[Any]:
        """(2.14) f = y_P − R."""
        return [self.where.point(self.at, t, q, q).r[1] - self.R]

    def fill(self, t: Any, q: Numbers, v: Numbers, rows: Any, g: Any, gamma: Any, at: int) -> None:
        """(2.15) ẏ_P = 0; differentiated by (2.7): γ = ω² d_y."""
        p = self.where.point(self.at, t, q, v)
        assert p.xy is not None  # the ground does not touch the ground
        rows[at, p.xy + 1] = 1
        if p.phi is not None:
            rows[at, p.phi] = p.d[0]
            gamma[at] = p.omega * p.omega * p.d[1]

    def reactions(self, t: float, q: Numbers, multipliers: Numbers) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: here λ is the normal force."""
        return {f"{self.part}.normal": multipliers[0]}


@dataclass(frozen=True)
class Grip:
    """A contact that sticks, for a rim: that rolls; what it slips over the floor, ẋ_P + R ω = 0."""

    part: str
    at: Anchor
    R: float
    where: Coordinates
    size: int = 1

    def f(self, t: Any, q: Numbers) -> list[Any]:
        """(2.14) nothing: where it sticks is not known beforehand."""
        return []

    def fill(self, t: Any, q: Numbers, v: Numbers, rows: Any, g: Any, gamma: Any, at: int) -> None:
        """(2.16) ẋ_P + R ω = 0; differentiated by (2.7): γ = ω² d_x."""
        p = self.where.point(self.at, t, q, v)
        assert p.xy is not None
        rows[at, p.xy] = 1
        if p.phi is not None:
            rows[at, p.phi] = self.R - p.d[1]
            gamma[at] = p.omega * p.omega * p.d[0]

    def reactions(self, t: float, q: Numbers, multipliers: Numbers) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: here λ is the friction force."""
        return {f"{self.part}.tangent": multipliers[0]}


@dataclass(frozen=True)
class Catch:
    """A slide at rest: d/dt u·(r_B − r_A) = 0, u fixed in the first part along the slide."""

    part: str
    line: Align
    size: int = 1

    def f(self, t: Any, q: Numbers) -> list[Any]:
        """(2.14) nothing: where it rests is not known beforehand."""
        return []

    def fill(self, t: Any, q: Numbers, v: Numbers, rows: Any, g: Any, gamma: Any, at: int) -> None:
        """(2.15) u·Δ̇ + ω_A n·Δ = 0, Δ = r_B − r_A, since u̇ = ω_A n; γ by (2.7)."""
        a, b, u, n = self.line.ends(t, q, v)
        delta = (b.r[0] - a.r[0], b.r[1] - a.r[1])
        delta_dot = (b.r_dot[0] - a.r_dot[0], b.r_dot[1] - a.r_dot[1])
        for sign, p in ((1, b), (-1, a)):
            if p.xy is None:
                g[at] -= sign * (u[0] * p.r_dot[0] + u[1] * p.r_dot[1])
                continue
            rows[at, p.xy] += sign * u[0]
            rows[at, p.xy + 1] += sign * u[1]
            if p.phi is not None:
                rows[at, p.phi] += sign * (u[1] * p.d[0] - u[0] * p.d[1])
                gamma[at] += sign * p.omega * p.omega * (u[0] * p.d[0] + u[1] * p.d[1])
        if a.phi is not None:
            rows[at, a.phi] += n[0] * delta[0] + n[1] * delta[1]
            gamma[at] -= 2 * a.omega * (n[0] * delta_dot[0] + n[1] * delta_dot[1])
            gamma[at] += a.omega * a.omega * (u[0] * delta[0] + u[1] * delta[1])

    def reactions(self, t: float, q: Numbers, multipliers: Numbers) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: a force λ u along the slide."""
        _, _, u, _ = self.line.ends(t, q, q)
        force = multipliers[0]
        return {
            f"{self.part}.fx": force * u[0],
            f"{self.part}.fy": force * u[1],
            f"{self.part}.friction": force,
        }


@dataclass(frozen=True)
class Rub:
    """A contact that slides: λ_t = factor λ_n, by (2.87) factor = −μ sign(slip)."""

    press: Constraint
    grip: Constraint
    factor: float


@dataclass(frozen=True)
class Drag:
    """A slide that moves: a friction force [N] on the second part, along +u."""

    catch: Constraint
    force: Callable[[float, Any, Any], float]


def touching(contact: Contact, where: Coordinates) -> tuple[Press, Grip]:
    """The two rows of a contact: a disk named by its centre touches with its rim."""
    body = where.scene.bodies[contact.body]
    R = body.radius if body.radius is not None and contact.at.point == "center" else 0.0
    return (
        Press(contact.name, contact.at, R, where),
        Grip(contact.name, contact.at, R, where),
    )


def catch(joint: Joint, where: Coordinates) -> Catch:
    """The row along a slide."""
    return Catch(joint.name, Align(joint.name, joint.a, joint.b, joint.along, where))


def row(part: Constraint, t: float, q: Any, v: Any) -> tuple[Any, float, float]:
    """f_a (n,), g and γ of a constraint of one row."""
    rows, g, gamma = np.zeros((1, len(q))), np.zeros(1), np.zeros(1)
    part.fill(t, q.tolist(), v.tolist(), rows, g, gamma, 0)
    return rows[0], float(g[0]), float(gamma[0])
