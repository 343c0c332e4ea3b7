"""Elements that hold on one side, beside contacts with the ground: pairs, ropes, stops, springs.

| element | state       | what holds          | what ends it, falling to zero             |
| pair    | as contacts | as contacts         | as contacts                               |
| limit   | open        | nothing             | its gap: it is struck                     |
| limit   | acts        | the gap stays 0     | its force, the multiplier: it lets go     |
| spring  | acts        | F = −c (λ − λ₀)     | λ passes λ₀: slackens                     |
| spring  | slack       | nothing             | λ passes λ₀: tightens                     |

Each is a gap with the row that holds it. A pair slips along another row as a contact does; a limit,
a rope's end or a stop of a joint's turn, slips along nothing. At λ₀ a spring's force is zero on
both sides, so q̇ and q̈ go through the event, and the rates of q̈ jump.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from ....cases.scene import CENTER, GROUND, Anchor, Limit, Scene
from ....cases.scene.forces.force import Spring
from ....cases.scene.forces.limit import Rope, Stops
from ....cases.scene.pair import Pair
from ...coverage import equation
from ...system import Array
from ..constraints.constraint import Constraint, row
from ..constraints.constraint_terms import (
    FIRST,
    SECOND,
    Apart,
    Around,
    Distance,
    Line,
    Term,
    Turning,
)
from ..kinematics.kinematics import Layout
from .element import Element, State, Touching


def unilateral(scene: Scene, where: Layout) -> Iterator[Element]:
    """Yields an element for each pair, each side of a limit and one-sided spring of the scene."""
    for pair in scene.pairs.values():
        yield paired(pair, where)
    for limit in scene.limits():
        for side in limit.sides:
            yield LIMITS[type(limit)](scene, limit, side, where)
    for spring in scene.one_sided():
        yield OneSided(name=spring.name, spring=spring, line=_line(spring, where))


# Pairs. The body a is touched on its rim or on a face, b touches it with a rim of radius R or a
# point (R is 0). n is the normal, from a to b, and u has n to its left.


def paired(pair: Pair, where: Layout) -> Touching:
    """The states of two bodies that touch each other: as of a contact on a plane."""
    return Touching(
        name=pair.name,
        normal=pair_normal(pair, where),
        slip=pair_tangent(pair, where),
        static=pair.static,
        kinetic=pair.kinetic,
        restitution=pair.restitution,
        frictionless=pair.static == 0.0,
        plane=pair.on,
        two=True,
    )


@equation
def pair_normal(pair: Pair, where: Layout) -> Constraint:
    """(2.14) Closed, |r_b − r_a| = R + R_a of two rims, n·(r_P − r_a) = R on a face; λ pushes."""
    row: tuple[Term, ...] = (Apart(FIRST, SECOND),)
    if pair.face:
        row = (Line(FIRST, SECOND, pair.side.normal),)
    bodies = where.scene.bodies
    held = (pair.radius(bodies) + pair.reach(bodies),)
    return Constraint(pair.name, _ends(pair), (row,), (("normal",),), held, where)


@equation
def pair_tangent(pair: Pair, where: Layout) -> Constraint:
    """(2.15) Nothing slips where both touch; λ is the friction on b.

    On a rim u·(ṙ_b − ṙ_a) + R ω_b + R_a ω_a = 0; on a face d/dt u·(r_P − r_a) + R (ω_b − ω_a) = 0,
    u fixed in a.
    """
    R, R_a = pair.radius(where.scene.bodies), pair.reach(where.scene.bodies)
    row: tuple[Term, ...]
    row = (Around(FIRST, SECOND), Turning(SECOND, R), Turning(FIRST, R_a))
    if pair.face:
        row = (Line(FIRST, SECOND, pair.side.along), Turning(SECOND, R), Turning(FIRST, -R))
    return Constraint(pair.name, _ends(pair), (row,), (("tangent",),), None, where)


def _ends(pair: Pair) -> tuple[Anchor, Anchor]:
    return pair.corner if pair.face else Anchor(pair.touched, CENTER), pair.at


# Limits.


@dataclass(frozen=True, kw_only=True)
class Limited(Element):
    """It shares its friction with nothing: it has none. quantity: the reaction of its row."""

    quantity: str
    rest: tuple[State, ...] = ("acts",)

    @property
    def push(self) -> str:
        return self.quantity

    @property
    def together(self) -> tuple[str, str]:
        """Itself alone: it shares its friction with no other."""
        return self.name, ""

    def constraints(self, state: State) -> list[Constraint]:
        """Nothing, or its row."""
        return [self.normal] if state == "acts" and self.normal is not None else []


@dataclass(frozen=True, kw_only=True)
class Roped(Limited):
    """An element of a rope: open while slack, held by its row at its full length."""

    endings: tuple[str, str] = ("slackens", "tightens")

    def amiss(self, depth: float, speed: float) -> str:
        if depth:
            return f"{self.name} starts {depth * 1e3:.3g} mm longer than it is"
        return f"{self.name} starts taut, and with its ends parting by {speed:.3g} m/s"

    @property
    def pulls(self) -> str:
        return f"{self.name} would have to push"


@equation
def roped(scene: Scene, rope: Rope, side: str, where: Layout) -> Limited:
    """(2.14) −λ = −L; its multiplier pulls both ends together."""
    sense, at = rope.sides[side]
    row = (Distance(FIRST, SECOND),)
    taut = Constraint(rope.name, (rope.a, rope.b), (row,), ((side,),), (sense * at,), where)
    quantity = f"{rope.name}.{side}"
    return Roped(
        name=rope.name,
        quantity=quantity,
        normal=taut,
        plane="end of its length",
        two=_both_bodies(rope.a, rope.b),
    )


@dataclass(frozen=True, kw_only=True)
class Stopped(Limited):
    """One of the two stops of a joint's turn (2.14): φ − low ≥ 0 and high − φ ≥ 0."""

    endings: tuple[str, str] = ("leaves", "strikes")

    def amiss(self, depth: float, speed: float) -> str:
        if depth:
            return f"{self.name} is passed by {math.degrees(depth):.3g}° at the start"
        return f"{self.name} is where it starts, and it turns into it with {speed:.3g} rad/s"

    @property
    def pulls(self) -> str:
        return f"{self.name} would have to hold what leaves it"


@equation
def stopped(scene: Scene, stops: Stops, side: str, where: Layout) -> Limited:
    """(2.14) ±(φ_B − φ_A) = ±φ₀; its multiplier is a moment on the second part, or the opposite."""
    joint, (sense, at) = scene.joints[stops.joint], stops.sides[side]
    row, ends = (Turning(SECOND, sense), Turning(FIRST, -sense)), (joint.a, joint.b)
    struck = Constraint(stops.name, ends, (row,), ((side,),), (sense * at,), where)
    name = f"{stops.name}.{side}"
    return Stopped(
        name=name,
        quantity=name,
        normal=struck,
        restitution=stops.back,
        plane=f"{side} stop",
        two=_both_bodies(joint.a, joint.b),
    )


def _both_bodies(a: Anchor, b: Anchor) -> bool:
    """Whether both ends belong to bodies."""
    return GROUND not in (a.body, b.body)


LIMITS: dict[type[Limit], Callable[[Scene, Any, str, Layout], Limited]] = {
    Rope: roped,
    Stops: stopped,
}
"""What each kind of limit is at one of its sides."""


# Springs that only press or only pull: (2.82) on one side of the rest length, else slack.

OTHER: dict[State, State] = {"acts": "slack", "slack": "acts"}
HAPPENS: dict[State, str] = {"acts": "slackens", "slack": "tightens"}  # where the state ends


@dataclass(frozen=True, kw_only=True)
class OneSided(Element):
    """The spring, and how far it is from acting; `line`: its length over λ₀."""

    spring: Spring
    line: Constraint

    @property
    def way(self) -> float:
        """1 if it is slack when longer than λ₀, −1 if when shorter."""
        return 1.0 if self.spring.only == "compression" else -1.0

    def slack(self, t: float, q: Array) -> float:
        """± (λ − λ₀) [m], positive where it does not act."""
        return float(self.way * self.line.f(t, q.tolist())[0])

    def slackens(self, t: float, q: Array, v: Array) -> float:
        """± λ̇ [m/s], λ̇ = Δ·Δ̇/λ."""
        f, g, _ = row(self.line, t, q, v)
        return self.way * float(f @ v - g)

    def began(self, q: Array, v: Array, near: float) -> State:
        """Its state at the start; within `near` [m] of λ₀, by where it goes."""
        gap = self.slack(0.0, q)
        if abs(gap) > near:
            return "slack" if gap > 0.0 else "acts"
        return "slack" if self.slackens(0.0, q, v) >= 0.0 else "acts"

    def ends(self, state: State, t: float, q: Array) -> float:
        """The length [m] that falls through zero where the state ends."""
        return self.slack(t, q) if state == "slack" else -self.slack(t, q)


def _line(spring: Spring, where: Layout) -> Constraint:
    """λ − λ₀, which nothing holds."""
    ends, held = (spring.a, spring.b), (spring.rest_length,)
    return Constraint(spring.name, ends, ((Apart(FIRST, SECOND),),), ((),), held, where)
