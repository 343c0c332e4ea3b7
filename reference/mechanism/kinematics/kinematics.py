"""Where the bodies and points of a scene are and how they move, as formulas on a tape (2.1)–(2.7).

What has r̈ or ü keeps of them what does not come from accelerations: rows need it for their γ.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any

from ....cases.scene import GROUND, Anchor, Signal
from ...coverage import Numbered
from . import signal as law
from .frame import Columns, Frame, Vec, back, carried
from .tape import Tape

NONE = Vec()


@dataclass(frozen=True)
class Slots:
    """Where a body's numbers begin: r and its attitude in q, ṙ and ω in v; None: a particle."""

    r: int
    attitude: int | None
    r_dot: int
    omega: int | None


class Layout(Numbered):
    """Where everything stands in q and v: maximal coordinates of a scene, in the plane or space."""

    frame: Frame
    scene: Any

    @cached_property
    def slots(self) -> dict[str, Slots]:
        """Where the numbers of each body begin, by its name."""
        raise NotImplementedError

    @cached_property
    def inner(self) -> dict[str, int]:
        """Where in q, behind the bodies, inner states of forces and turns that count stand."""
        raise NotImplementedError

    @cached_property
    def masses(self) -> list[float]:
        """The inertia along each velocity, (n,)."""
        raise NotImplementedError


@dataclass(frozen=True)
class Part:
    """A body, or the ground, at one state: ω in its own axes, `spin` the same in ground axes."""

    slots: Slots | None
    R: Columns
    r: Vec
    r_dot: Vec
    omega: Vec
    spin: Vec
    angle: Any  # φ in the plane

    def columns(self, F: Vec | None, M: Vec | None) -> list[tuple[int, Any]]:
        """The columns of v along which a force and a moment act, and their numbers there.

        The ground has none, and what has no ω takes no moment.
        """
        entries: list[tuple[int, Any]] = []
        if self.slots is not None:
            if F is not None:
                entries += [(self.slots.r_dot + i, x) for i, x in enumerate(F)]
            if M is not None and self.slots.omega is not None:
                entries += [(self.slots.omega + i, x) for i, x in enumerate(M)]
        return entries


@dataclass(frozen=True)
class Point:
    """(2.1) r = r_c + d, d = E x; (2.6) ṙ = ṙ_c + ω × d; in body axes `own` is d.

    beside: what r̈ has beside the accelerations of its body, ω × (ω × d) by (2.7).
    """

    part: Part
    r: Vec
    r_dot: Vec
    own: Vec
    beside: Vec


@dataclass(frozen=True)
class Direction:
    """A unit vector u with its rate; `own` in the axes of the body that carries it, if one does.

    beside: what ü has beside the acceleration of that body, ω × (ω × u).
    """

    u: Vec
    u_dot: Vec
    part: Part | None = None
    own: Vec = NONE
    beside: Vec = NONE


@dataclass
class Row:
    """A rate Σ F·ṙ + M·ω − g (2.15), linear in the velocities, and γ of its derivative.

    loads: of each part the factor F of ṙ_c and M of ω in body axes; a unit of the row's multiplier
    exerts just these force and moment (2.60).
    """

    loads: list[tuple[Part, Vec | None, Vec | None]] = field(default_factory=list)
    g: Any = 0.0
    gamma: Any = 0.0

    def __add__(self, other: "Row") -> "Row":
        return Row(self.loads + other.loads, self.g + other.g, self.gamma + other.gamma)

    def __mul__(self, factor: Any) -> "Row":
        loads = [
            (part, None if F is None else F * factor, None if M is None else M * factor)
            for part, F, M in self.loads
        ]
        return Row(loads, self.g * factor, self.gamma * factor)

    def __neg__(self) -> "Row":
        return self * -1.0

    def __sub__(self, other: "Row") -> "Row":
        return self + -other


class Kinematics(Numbered):
    """Parts, points and directions of a scene, and the rates that rows are made of."""

    def __init__(self, where: Layout) -> None:
        self.where, self.frame, self.scene = where, where.frame, where.scene
        n = len(where.masses)
        ends = [s.r + len(self.frame.axes) for s in where.slots.values()]
        ends += [s.attitude + self.frame.attitude for s in where.slots.values() if s.attitude]
        ends += [at + 1 for at in where.inner.values()]
        self.tape = tape = Tape(max(ends), n)
        self.t, self.q, self.v = tape.t, tape.q, tape.v
        still, turns = Vec([0.0] * len(self.frame.axes)), Vec([0.0] * self.frame.turns)
        self.still = still
        self._parts = {GROUND: Part(None, self.frame.axes, still, still, turns, turns, 0.0)}
        self._points: dict[Anchor, Point] = {}

    def part(self, name: str) -> Part:
        """A body by its name, or the ground."""
        if name not in self._parts:
            self._parts[name] = self._part(self.where.slots[name])
        return self._parts[name]

    def _part(self, at: Slots) -> Part:
        d, frame = len(self.frame.axes), self.frame
        r, r_dot = Vec(self.q[at.r : at.r + d]), Vec(self.v[at.r_dot : at.r_dot + d])
        R, omega, angle = frame.axes, self._parts[GROUND].omega, 0.0
        if at.attitude is not None and at.omega is not None:
            e = self.q[at.attitude : at.attitude + frame.attitude]
            R, angle = frame.rotation(self.tape, e), e[0]
            omega = Vec(self.v[at.omega : at.omega + frame.turns])
        return Part(at, R, r, r_dot, omega, frame.out(R, omega), angle)

    def point(self, at: Anchor) -> Point:
        """A point by its name; one of the ground moves as it is driven."""
        if at not in self._points:
            self._points[at] = (
                self._driven(self.scene.points[at.point])
                if at.body == GROUND
                else self.fixed_in(self.part(at.body), self.scene.bodies[at.body].points[at.point])
            )
        return self._points[at]

    def fixed_in(self, part: Part, x: Sequence[float]) -> Point:
        """(2.1), (2.6), (2.7) The point x of a body, in its axes from the centre of mass."""
        own = Vec(x)
        d = carried(part.R, own)
        whirl = self.frame.cross(part.spin, d)
        beside = self.frame.cross(part.spin, whirl)
        return Point(part, part.r + d, part.r_dot + whirl, own, beside)

    def armed(self, part: Part, arm: Vec, arm_dot: Vec) -> Point:
        """(2.19) The point of a rolling body that touches: `arm` ρ does not turn with the body.

        It has the velocity ṙ_c + ω × ρ of the body's point there; that one's rate has ω × ρ̇.
        """
        r_dot = part.r_dot + self.frame.cross(part.spin, arm)
        beside = self.frame.cross(part.spin, arm_dot)
        return Point(part, part.r + arm, r_dot, back(part.R, arm), beside)

    def _driven(self, point: Any) -> Point:
        """A point of the ground: at rest, with a constant velocity, or moved by a law in time."""
        velocity = Vec(point.velocity) if any(point.velocity) else self.still
        r, r_dot, beside = Vec(point.at) + velocity * self.t, velocity, self.still
        if point.moves is not None:
            r = r + Vec(point.moves.amplitude) * self.signal(point.moves)
            r_dot = r_dot + Vec(point.moves.amplitude) * self.signal(point.moves, law.SLOPES)
            beside = Vec(point.moves.amplitude) * self.signal(point.moves, law.BENDS)
        return Point(self._parts[GROUND], r, r_dot, self.still, beside)

    def signal(self, own: Signal, of: Any = law.SIZES) -> Any:
        """s(t) of a law A s(t), or its rate of SLOPES or BENDS."""
        if own.law == "constant":
            return of[own.law](own, 0.0)
        return self.tape.call(Timed(of[own.law], own), self.t)

    def fixed(self, u: Sequence[float]) -> Direction:
        """A direction of the ground."""
        return Direction(Vec(u), self.still)

    def carried(self, part: Part, own: Sequence[float]) -> Direction:
        """(2.6) A direction that a body carries: u̇ = ω × u."""
        u = carried(part.R, own)
        u_dot = self.frame.cross(part.spin, u)
        return Direction(u, u_dot, part, Vec(own), self.frame.cross(part.spin, u_dot))

    def along(self, p: Point, c: Direction) -> Row:
        """u·ṙ_P: (2.15) f = (u, d × u), and its derivative has u̇·ṙ_P + u·(ω × (ω × d))."""
        gamma = -(c.u @ p.beside) - c.u_dot @ p.r_dot
        if p.part.slots is None:
            return Row([], -(c.u @ p.r_dot), gamma)
        own = c.own if c.part is p.part else back(p.part.R, c.u)
        return Row([(p.part, c.u, self.frame.wedge(p.own, own))], 0.0, gamma)

    def line(self, a: Point, b: Point, c: Direction) -> Row:
        """u·Δ̇, Δ = r_b − r_a; if a part carries u, d/dt u·Δ: u·Δ̇ + ω·(u × Δ).

        The derivative of the latter has u̇·Δ̇ once more, and ω × (ω × u) at Δ.
        """
        row = self.along(b, c) - self.along(a, c)
        if c.part is None:
            return row
        gap, gap_dot = b.r - a.r, b.r_dot - a.r_dot
        swept = self.frame.wedge(c.own, back(c.part.R, gap))
        return row + Row([(c.part, None, swept)], 0.0, -(c.u_dot @ gap_dot) - c.beside @ gap)

    def turn(self, a: Part, b: Part, m: Vec, m_dot: Vec) -> Row:
        """m·(ω_b − ω_a), m (s,) and its rate in ground axes; γ = −ṁ·(ω_b − ω_a)."""
        loads: list[tuple[Part, Vec | None, Vec | None]] = [
            (part, None, self.frame.into(part.R, m * way)) for part, way in ((b, 1.0), (a, -1.0))
        ]
        return Row(loads, 0.0, -(m_dot @ (b.spin - a.spin)))


@dataclass(frozen=True)
class Timed:
    """A law at a time; of one law there is one, whoever asks."""

    of: Any
    law: Signal

    def __call__(self, t: Any) -> Any:
        return self.of(self.law, t)
