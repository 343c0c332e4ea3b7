"""The rows of many constraints at once: f_a, g and γ of f_a q̇ᵃ = g (2.15) and f_a q̈ᵃ = γ.

What does not change with the state stands in them from the beginning: of a pin all but the columns
of the angles.  The rest are levers, the points off the centre of a body that turns, and lines, the
directions that turn with a body; all of a kind are computed together.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ....cases.scene import Signal, Vector
from ...system import Array
from ..kinematics.coordinates import ORIGIN, Attached, moved
from ..kinematics.signal import bend, signal, slope
from .constraint_terms import FIRST, GAMMA, SECOND, G, Line, Term, Way, opposite

NOWHERE = -1  # the target of what a particle or a point of the ground has no column for

Row = tuple[Sequence[Attached], Sequence[Term]]
"""The points that the terms name by their place here, and the terms."""
Lever = tuple[int, Attached, Vector]
"""The number of its row, the point, and the direction u."""
Turn = tuple[int, Attached, Attached, Way]
"""The number of its row, the points a and b, and what tells its direction."""


class Rows:
    """Rows of n + 2 numbers, as functions of t, q (n,) and v (n,), real or complex."""

    def __init__(self, rows: Sequence[Row], n: int) -> None:
        self._fixed = np.zeros((len(rows), n + 2))
        self._levers: list[Lever] = []
        self._turns: list[Turn] = []
        self._blades: list[Lever] = []
        self._laws: list[tuple[int, Signal]] = []
        self._moves: list[tuple[int, Signal, Vector]] = []
        for i, (ends, terms) in enumerate(rows):
            for term in terms:
                term.enter(i, ends, self)
        self._kinds: list[Levers | Lines | Blades | Laws | Moves] = []
        if self._levers:
            self._kinds.append(Levers(self._levers, n + 2))
        if self._turns:
            self._kinds.append(Lines(self._turns, n + 2))
        if self._blades:
            self._kinds.append(Blades(self._blades, n + 2))
        if self._laws:
            self._kinds.append(Laws(self._laws, n + 2))
        if self._moves:
            self._kinds.append(Moves(self._moves, n + 2))
        self._target()
        self._keep()

    @property
    def size(self) -> int:
        """The number r of rows."""
        return len(self._fixed)

    @property
    def constant(self) -> bool:
        """Whether they are the same at every state."""
        return not self._kinds

    def __call__(self, t: Any, q: Any, v: Any) -> tuple[Any, Any, Any]:
        """(2.15) f_a (r, n) and g (r,), and γ (r,) of f_a q̈ᵃ = γ."""
        numbers = self._fixed.astype(np.result_type(t, q, v))
        if self._kinds:
            numbers.reshape(-1)[self._targets] = self._changing(t, q, v)
        return numbers[:, :G], numbers[:, G], numbers[:, GAMMA]

    def entries(self, t: float, q: Array, v: Array) -> tuple[Array, Array]:
        """(2.15) Those of the f_a that `pattern` names, and γ (r,)."""
        numbers = self._kept.copy()
        if self._kinds:
            numbers[self._places] = self._changing(t, q, v)
        return numbers[: len(self.pattern[0])], numbers[-self.size :]

    def _changing(self, t: Any, q: Any, v: Any) -> Any:
        values = np.concatenate([values for kind in self._kinds for values in kind(t, q, v)])
        return self._standing + np.add.reduceat(values[self._order], self._starts)

    def along(self, i: int, p: Attached, u: Vector) -> None:
        """(2.15) u·ṙ_p with ṙ_p = ṙ_c + ω × d: f = (u, d × u); of a ground point g = −u·ṙ_p."""
        if p.xy is None:
            self._fixed[i, G] -= u[0] * p.velocity[0] + u[1] * p.velocity[1]
            if p.moves is not None:
                self._moves.append((i, p.moves, u))
            return
        self._fixed[i, p.xy : p.xy + 2] += u
        if p.phi is not None and p.at is not None:
            self._levers.append((i, p, u))

    def turning(self, i: int, p: Attached, axis: float) -> None:
        """(2.15) ω = φ̇: f = the axis, at φ; γ = 0; what has no angle does not turn."""
        if p.phi is not None:
            self._fixed[i, p.phi] += axis

    def line(self, i: int, a: Attached, b: Attached, u: Vector) -> None:
        """`Along` u, if a does not turn; else one of those that are computed at each state."""
        if a.phi is None:
            self.along(i, b, u)
            self.along(i, a, opposite(u))
        else:
            self._turns.append((i, a, b, Line(FIRST, SECOND, u)))

    def between(self, i: int, a: Attached, b: Attached, way: Way) -> None:
        """(2.15) What has a direction that follows both points."""
        self._turns.append((i, a, b, way))

    def carried(self, i: int, p: Attached, u: Vector) -> None:
        """(2.15) u·ṙ_p, u turning with p: f = (u, d × u), d × u being the same in any axes."""
        self._blades.append((i, p, u))
        if p.phi is not None and p.at is not None:
            self._fixed[i, p.phi] += p.at[0] * u[1] - p.at[1] * u[0]

    def given(self, i: int, law: Signal) -> None:
        """(2.15) −s(t): g = s."""
        self._laws.append((i, law))

    def _target(self) -> None:
        """Sorts the changing numbers by where they go: those for one place are added up."""
        targets = np.concatenate([np.zeros(0, int), *(kind.targets for kind in self._kinds)])
        order = np.argsort(targets, kind="stable")
        self._order = order[np.searchsorted(targets[order], 0) :]
        self._targets, self._starts = np.unique(targets[self._order], return_index=True)
        self._standing = self._fixed.reshape(-1)[self._targets]

    def _keep(self) -> None:
        """Where the f_a are not always zero: these numbers stand without the others, then γ."""
        r, width = self._fixed.shape
        numbers = self._fixed != 0.0
        numbers.reshape(-1)[self._targets] = True
        self.pattern = row, column = np.nonzero(numbers[:, :G])
        kept = np.concatenate([row * width + column, np.arange(r) * width + width + GAMMA])
        places = np.full(self._fixed.size, len(row))  # of a changing g, which is not asked for
        places[kept] = np.arange(len(kept)) + (np.arange(len(kept)) >= len(row))
        self._places = places[self._targets]
        self._kept = np.insert(self._fixed.reshape(-1)[kept], len(row), 0.0)


class Places:
    """Places that rows of points along fixed directions and of turns are the rates of, at once.

    A chain has nothing else, and one point after the other is most of what its residuals cost.
    """

    def __init__(self, rows: Sequence[Row], n: int) -> None:
        self._fixed, self._at, self._rate = np.zeros((len(rows), n)), *np.zeros((2, len(rows)))
        self._levers: list[Lever] = []
        self._moves: list[tuple[int, Signal, Vector]] = []
        for i, (ends, terms) in enumerate(rows):
            for term in terms:
                term.enter(i, ends, self)
        self._rows = np.array([i for i, _, _ in self._levers], int)
        self._phi = np.array([p.phi for _, p, _ in self._levers], int)
        at = np.array([p.at for _, p, _ in self._levers]).reshape(-1, 2)
        u = np.array([u for _, _, u in self._levers]).reshape(-1, 2)
        self._along, self._across = np.sum(at * u, axis=1), at[:, 0] * u[:, 1] - at[:, 1] * u[:, 0]

    def __call__(self, t: Any, q: Any) -> Any:
        """(2.1) u·r_p = u·r_c + cos φ u·x + sin φ (x × u) [m], or the turns [rad], (r,)."""
        found = self._fixed.dot(q[: self._fixed.shape[1]]) + self._at + self._rate * t
        phi = q[self._phi]
        np.add.at(found, self._rows, np.cos(phi) * self._along + np.sin(phi) * self._across)
        for i, law, (ux, uy) in self._moves:
            x, y = signal(law, t)
            found[i] += ux * x + uy * y
        return found

    def along(self, i: int, p: Attached, u: Vector) -> None:
        """u·r_p, of a point of the ground as it moves."""
        if p.xy is None:
            x, y = p.at or ORIGIN
            self._at[i] += u[0] * x + u[1] * y
            self._rate[i] += u[0] * p.velocity[0] + u[1] * p.velocity[1]
            if p.moves is not None:
                self._moves.append((i, p.moves, u))
            return
        self._fixed[i, p.xy : p.xy + 2] += u
        if p.phi is not None and p.at is not None:
            self._levers.append((i, p, u))

    def turning(self, i: int, p: Attached, axis: float) -> None:
        """φ times the axis."""
        if p.phi is not None:
            self._fixed[i, p.phi] += axis

    def line(self, i: int, a: Attached, b: Attached, u: Vector) -> None:
        """Its direction turns with a: TypeError."""
        raise TypeError

    def between(self, i: int, a: Attached, b: Attached, way: Way) -> None:
        """Its direction turns with both: TypeError."""
        raise TypeError

    def carried(self, i: int, p: Attached, u: Vector) -> None:
        """(2.15) The rate of nothing: TypeError."""
        raise TypeError

    def given(self, i: int, law: Signal) -> None:
        """(2.15) The rate of nothing: TypeError."""
        raise TypeError


class Levers:
    """The changing numbers of `Along`, for all points p with a lever d = E x from c to p."""

    def __init__(self, levers: Sequence[Lever], width: int) -> None:
        rows, points, directions = zip(*levers, strict=True)
        row, self._phi = np.array(rows), np.array([p.phi for p in points])
        (x, y), (ux, uy) = np.transpose([p.at for p in points]), np.transpose(directions)
        self._cross, self._dot = x * uy - y * ux, x * ux + y * uy
        self.targets = np.concatenate([row * width + self._phi, (row + 1) * width + GAMMA])

    def __call__(self, t: Any, q: Any, v: Any) -> list[Any]:
        """(2.15) d × u at φ; differentiated by (2.7), u·r̈_p = f_a q̈ᵃ + u·(ω × ḋ): γ = ω² u·d.

        d × u = cos φ (x × u) − sin φ x·u and u·d = cos φ x·u + sin φ (x × u).
        """
        phi, omega = q[self._phi], v[self._phi]
        cos, sin = np.cos(phi), np.sin(phi)
        return [
            cos * self._cross - sin * self._dot,
            omega * omega * (cos * self._dot + sin * self._cross),
        ]


class Lines:
    """`Line` for all a on bodies that turn, b being anywhere, and what is `between` two."""

    def __init__(self, turns: Sequence[Turn], width: int) -> None:
        self._turns = [turn[1:] for turn in turns]
        self.targets = np.array([self._places(*turn[:3], width) for turn in turns]).ravel()

    def _places(self, row: int, a: Attached, b: Attached, width: int) -> list[int]:
        """Where the numbers of `Line.numbers` stand."""
        columns = [a.xy, _next(a.xy), a.phi, b.xy, _next(b.xy), b.phi, width + G, width + GAMMA]
        return [NOWHERE if at is None else row * width + at for at in columns]

    def __call__(self, t: Any, q: Any, v: Any) -> list[Any]:
        """One by one: there are few."""
        q, v = q.tolist(), v.tolist()
        return [
            _bent(way.numbers(moved(a, t, q, v), moved(b, t, q, v)), t, a, b)
            for a, b, way in self._turns
        ]


def _bent(numbers: tuple[Any, ...], t: Any, a: Attached, b: Attached) -> tuple[Any, ...]:
    """The numbers of a row, γ with u·r̈ of ground points that move by a law; u stands in f of b."""
    if a.moves is None and b.moves is None:
        return numbers
    *others, gamma = numbers
    x, y = others[3:5]
    for point, way in ((a, 1.0), (b, -1.0)):
        if point.moves is not None:
            ax, ay = bend(point.moves, t)
            gamma = gamma + way * (x * ax + y * ay)
    return (*others, gamma)


def _next(column: int | None) -> int | None:
    return None if column is None else column + 1


# The numbers that change in the rows of blades: their directions, and prescribed speeds.


class Blades:
    """The changing numbers of `Carried`, for all points p; u in the axes of their bodies."""

    def __init__(self, blades: Sequence[tuple[int, Attached, Vector]], width: int) -> None:
        rows, points, directions = zip(*blades, strict=True)
        row, self._phi = np.array(rows), np.array([p.phi for p in points])
        self._xy = np.array([p.xy for p in points])
        self._x, self._y = np.transpose(directions)
        x, gamma = row * width + self._xy, (row + 1) * width + GAMMA
        self.targets = np.concatenate([x, x + 1, gamma])

    def __call__(self, t: Any, q: Any, v: Any) -> list[Any]:
        """(2.15) u at x and y; differentiated, u·r̈_p + u̇·ṙ_p with u̇ = ω × u, (2.6) and (2.7).

        u·r̈_p = f_a q̈ᵃ − ω² u·d and u̇·ṙ_p = ω (u × ṙ_c) + ω² u·d: γ = −ω (u × ṙ_c).
        """
        cos, sin = np.cos(q[self._phi]), np.sin(q[self._phi])
        x, y = cos * self._x - sin * self._y, sin * self._x + cos * self._y
        return [x, y, v[self._phi] * (y * v[self._xy] - x * v[self._xy + 1])]


class Laws:
    """The right sides that `Given` prescribes, for all laws."""

    def __init__(self, laws: Sequence[tuple[int, Signal]], width: int) -> None:
        self._laws = [law for _, law in laws]
        end = (np.array([i for i, _ in laws]) + 1) * width
        self.targets = np.concatenate([end + G, end + GAMMA])

    def __call__(self, t: Any, q: Any, v: Any) -> list[Any]:
        """(2.15) g = s(t), and γ = ṡ(t)."""
        return [[signal(law, t)[0] for law in self._laws], [slope(law, t)[0] for law in self._laws]]


class Moves:
    """The share in `Along` of points of the ground that move by a law."""

    def __init__(self, moves: Sequence[tuple[int, Signal, Vector]], width: int) -> None:
        self._moves = [(law, u) for _, law, u in moves]
        end = (np.array([i for i, *_ in moves]) + 1) * width
        self.targets = np.concatenate([end + G, end + GAMMA])

    def __call__(self, t: Any, q: Any, v: Any) -> list[Any]:
        """(2.15) g = −u·ṙ_p, and γ = −u·r̈_p."""
        return [[self._along(u, rate(law, t)) for law, u in self._moves] for rate in (slope, bend)]

    @staticmethod
    def _along(u: Vector, rate: Sequence[Any]) -> Any:
        return -(u[0] * rate[0] + u[1] * rate[1])
