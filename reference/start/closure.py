"""The equations of a start, in the plane and in space: what is held, and what a case gives.

A body's coordinates that are given are no unknowns; the places of points and the coordinates of
joints are equations. Lengths are counted in the mechanism's size, so that a watch and a crane are
treated alike.
"""

import math
from collections.abc import Collection, Iterable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ...cases.case import Case, Placement
from ...cases.scene import Anchor
from ...cases.scene.joint import Freedom, Joint
from ..mechanism.constraints.constraint import Constraint, residuals, tracked
from ..mechanism.constraints.constraint_terms import FIRST, SECOND, Line
from ..mechanism.constraints.equation_table import Table
from ..mechanism.constraints.joint_constraints import constraints
from ..system import Array
from .messages import DEGREES
from .search import CLOSED, least, rank


class Equation(NamedTuple):
    """A condition on the start: residual = 0 [m or rad], and its change with the velocities (n,).

    Of a rate: row · v = −residual. name: as a file has it; the components of a point share one.
    """

    name: str
    residual: float
    row: Array
    angular: bool = False


class Coordinate(NamedTuple):
    """One freedom of a joint: its value [m or rad]; its rate is row · v + beside."""

    freedom: Freedom
    value: float
    row: Array
    beside: float


class Rows(NamedTuple):
    """Rows (r, n) of f_a v = g (2.15) and g (r,), in units of the size, with their owners."""

    rows: Array
    g: Array
    names: list[str]

    def selected(self, which: NDArray[np.bool_]) -> "Rows":
        """Returns some of the rows."""
        names = [name for name, is_one in zip(self.names, which, strict=True) if is_one]
        return Rows(self.rows[which], self.g[which], names)

    def about(self, columns: Sequence[int]) -> "Rows":
        """Returns the rows that concern any of these velocities."""
        return self.selected(np.any(self.rows[:, columns] != 0.0, axis=1))

    def plus(self, more: "Rows") -> "Rows":
        """Returns the rows with others behind them."""
        return Rows(
            np.vstack([self.rows, more.rows]), np.append(self.g, more.g), self.names + more.names
        )

    def residuals(self, v: Array) -> Array:
        """Returns the residuals (r,) that v leaves."""
        return self.rows @ v - self.g

    def violated(self, v: Array) -> bool:
        """Whether v leaves more than rounding."""
        scale = max(product_size(self.rows, v), np.max(np.abs(self.g), initial=0.0))
        return bool(np.max(np.abs(self.residuals(v)), initial=0.0) > CLOSED * scale)

    def solved(self, v: Array, free: Sequence[int]) -> Array:
        """v with the smallest change of its free columns; once more of what rounding has left."""
        v = v.copy()
        for _ in range(2):
            v[free] -= least(self.rows[:, free], self.residuals(v))
        return v


def product_size(rows: Array, v: Array) -> float:
    """The largest |row| |v|: the size of which rounding is a part in `rows @ v`.

    v counts in the columns of the rows alone. No product by itself is that size: across a blade at
    90 deg they are -1 × 0 and 6e-17 × 1.
    """
    speed = np.linalg.norm(v[np.any(rows != 0.0, axis=0)])
    return float(np.max(np.linalg.norm(rows, axis=1), initial=0.0) * speed)


class Closure:
    """Residuals f (2.14) of all that holds, and of what is given, of one case at t = 0.

    n: the number of velocities; the unknowns are the `free` ones among them. given: what the case
    gives of q, by its place there.
    """

    where: Any  # coordinates in the plane or in space
    standing: Sequence[str] = ()  # the points that are not to move

    def __init__(self, case: Case, where: Any) -> None:
        self.case, self.scene, self.where = case, case.scene, where
        self.turning, self.n = where.turning, len(where.turning)
        self._tables: dict[tuple[int, ...], Table] = {}
        self._tracked: dict[Any, Constraint] = {}
        self.parts = constraints(case.scene, where)
        places = [part.held or (None,) * part.size for part in self.parts]
        self._places = np.array([at is not None for each in places for at in each], bool)
        self.given, known = self.givens()
        self.reach = self._reach()
        self.size = self._size()
        self.rounding = max(1.0, self.reach / self.size)  # of places, in sizes
        self.units = np.where(self.turning, 1.0, self.size)  # of the velocities: rad, or lengths
        self.free = np.array([i for i in range(self.n) if i not in known], int)

    # What differs between the plane and space.

    attitude_word: str  # the key by which a file gives an attitude

    def givens(self) -> tuple[Mapping[int, float], Collection[int]]:
        """Returns what is given of q, by its place there, and the columns of v that this fixes."""
        return self.body_coordinates(self.case.initial), self.fixed_columns(self.case.initial)

    def attitude_of(self, placement: Placement) -> Sequence[float] | None:
        """Returns what a placement gives of an attitude, as q has it."""
        raise NotImplementedError

    def turned(self, wanted: Sequence[float], q: Array, at: int) -> Sequence[float]:
        """(s,) [rad] how far the attitude that stands in q at a place is turned from another."""
        raise NotImplementedError

    def turns(self, joint: Joint, q: Array) -> Iterator[Coordinate]:
        """Yields the turns of a joint."""
        raise NotImplementedError

    def equations_by_word(
        self, placements: Mapping[str, Placement], q: Array
    ) -> Iterator[Equation]:
        """Yields what placements say besides coordinates and points."""
        yield from ()

    def refuse_rates(self, q: Array, v: Array) -> None:
        """Raises CaseError for rates that are 0 where nobody says whose; v in units of the size."""

    def rates_by_word(self, q: Array) -> Iterator[Equation]:
        """Yields the rates that the case gives besides those of bodies and freedoms."""
        yield from ()

    def resting(self, q: Array) -> Iterator[Equation]:
        """Yields the rates that are to be 0 where nothing tells them, before all others."""
        yield from ()

    def moved(self, q: Array, change: Array) -> Array:
        """q after a small move (n,)."""
        raise NotImplementedError

    def settled(self, q: Array) -> Array:
        """q with its angles on the turns on which a start has them."""
        raise NotImplementedError

    def difference(self, a: Array, b: Array) -> float:
        """The largest difference of two solutions, in sizes and rad."""
        raise NotImplementedError

    # The equations of the positions.

    def equations(self, q: Array) -> tuple[Array, Array]:
        """f = 0 in units of the size: residuals (k,) and rows (k, n)."""
        held = self._places.any()  # else there is nothing that (2.14) would be of
        f = residuals(self._table(self.parts), self.parts, 0.0, q.tolist()) if held else []
        initial = list(self.equations_of(self.case.initial, q))
        angular = np.append(self._angular(self.parts)[self._places], [e.angular for e in initial])
        units = np.where(angular, 1.0, self.size)
        rows = [self._rows(self.parts, q)[0][self._places], *(e.row[None] for e in initial)]
        off = zip([*f, *(e.residual for e in initial)], angular.tolist(), strict=True)
        return (  # a turn more is the same place
            np.array([math.remainder(x, math.tau) if angle else x / self.size for x, angle in off]),
            np.vstack(rows) * self.units / units[:, None],
        )

    def owners(self, q: Array) -> list[tuple[str, bool]]:
        """For each residual the part, or what is given, by its name; and whether it is an angle."""
        names = [(c.part, angle) for c in self.parts for angle in c.angular]
        held = [owner for owner, place in zip(names, self._places, strict=True) if place]
        return [*held, *((e.name, e.angular) for e in self.equations_of(self.case.initial, q))]

    def equations_of(self, placements: Mapping[str, Placement], q: Array) -> Iterator[Equation]:
        """Yields what placements say of points, of joints, and besides."""
        for name, placement in placements.items():
            for point, place in placement.points.items():
                rows, r = self.point(Anchor(name, point), q)
                for at, wanted, row in zip(r.tolist(), place, rows, strict=True):
                    yield Equation(f"{name}.{point}", at - wanted, row)
            for c in self.placed(name, placement, q):
                off = c.value - placement.given[c.freedom.name]
                yield Equation(f"{name}.{c.freedom.name}", off, c.row, c.freedom.kind != "shift")
        yield from self.equations_by_word(placements, q)

    def placed(self, name: str, placement: Placement, q: Array) -> list[Coordinate]:
        """The coordinates of a joint that a placement gives."""
        joint = self.scene.joints.get(name)
        if joint is None or not {freedom.name for freedom in joint.named} & placement.given.keys():
            return []
        return [c for c in self.coordinates(joint, q) if c.freedom.name in placement.given]

    def coordinates(self, joint: Joint, q: Array) -> Iterator[Coordinate]:
        """Yields each freedom of a joint that has a coordinate."""
        axes = np.array([freedom.axis for freedom in joint.shifts])
        duals = np.linalg.pinv(axes.T) if len(axes) else axes  # s_i of Δ = Σ s_i u_i
        for freedom, dual in zip(joint.shifts, duals, strict=True):
            key = joint.name, freedom
            if key not in self._tracked:
                row, ends = (Line(FIRST, SECOND, tuple(dual.tolist())),), (joint.a, joint.b)
                at = Constraint(joint.name, ends, (row,), ((),), (0.0,), self.where)
                self._tracked[key] = at
            rows, g, _ = self._tracked[key].alone.rows(0.0, q, np.zeros(self.n))
            (value,) = self._tracked[key].places(0.0, q.tolist())
            yield Coordinate(freedom, float(value), rows[0], -float(g[0]))
        yield from self.turns(joint, q)

    def point(self, anchor: Anchor, q: Array) -> tuple[Array, Array]:
        """(d, n) the rows of a point's velocity, and its place (d,)."""
        if anchor not in self._tracked:
            self._tracked[anchor] = tracked(anchor, self.where)
        point = self._tracked[anchor]
        rows, _, _ = point.alone.rows(0.0, q, np.zeros(self.n))
        return rows, np.array(point.places(0.0, q.tolist()))

    # What is said of bodies by themselves.

    def body_coordinates(self, placements: Mapping[str, Placement]) -> dict[int, float]:
        """The coordinates that are given of bodies, by their places in q."""
        values: dict[int, float] = {}
        for name, placement in self._bodies(placements):
            at = self.where.slots[name]
            for i, axis in enumerate(self.scene.frame.axes):
                if axis in placement.given:
                    values[at.r + i] = placement.given[axis]
            e = self.attitude_of(placement)
            if e is not None and at.attitude is not None:
                values |= {at.attitude + i: x for i, x in enumerate(e)}
        return values

    def fixed_columns(self, placements: Mapping[str, Placement]) -> set[int]:
        """The columns of v along which placements leave a body no way."""
        columns: set[int] = set()
        for name, placement in self._bodies(placements):
            at = self.where.slots[name]
            axes = enumerate(self.scene.frame.axes)
            columns |= {at.r_dot + i for i, axis in axes if axis in placement.given}
            if self.attitude_of(placement) is not None and at.omega is not None:
                columns |= {at.omega + i for i in range(self.where.frame.turns)}
        return columns

    def _bodies(self, placements: Mapping[str, Placement]) -> Iterator[tuple[str, Placement]]:
        yield from ((name, p) for name, p in placements.items() if name in self.where.slots)

    def with_given(self, q: Array) -> Array:
        """q with what is given in its place."""
        q = q.copy()
        q[list(self.given)] = list(self.given.values())
        return q

    # How far a start is from what is near, and what it has instead.

    def near_errors(self, q: Array, *, turns: bool = False) -> dict[str, float]:
        """How far q is from all that `near` says, by name, in rad or sizes.

        turns: whether whole ones count, which what is given elsewhere may hold.
        """
        distances: dict[str, float] = {}
        for name, off, angular in self._off_near(q):
            size = (off if turns else math.remainder(off, math.tau)) if angular else off / self.size
            distances[name] = math.hypot(distances.get(name, 0.0), size)
        return distances

    def _off_near(self, q: Array) -> Iterator[tuple[str, float, bool]]:
        near = self.case.near
        for name, placement in self._bodies(near):
            at = self.where.slots[name]
            for i, axis in enumerate(self.scene.frame.axes):
                if axis in placement.given:
                    yield f"{name}.{axis}", float(q[at.r + i]) - placement.given[axis], False
            e = self.attitude_of(placement)
            if e is not None and at.attitude is not None:
                for turned in self.turned(e, q, at.attitude):
                    yield f"{name}.{self.attitude_word}", turned, True
        yield from ((e.name, e.residual, e.angular) for e in self.equations_of(near, q))

    def distance(self, q: Array) -> float:
        """How far q is from the worst of what `near` says, in rad or sizes; 0 without any."""
        return max(self.near_errors(q).values(), default=0.0)

    def shown(self, q: Array, name: str) -> str:
        """The value that q has of a coordinate, or of a point, as a file has it."""
        part, _, field = name.partition(".")
        if part in self.scene.joints:
            coordinates = self.coordinates(self.scene.joints[part], q)
            return next(
                value_text(c.value, c.freedom.kind) for c in coordinates if c.freedom.name == field
            )
        if field in self.scene.frame.axes:
            at = self.where.slots[part].r + self.scene.frame.axes.index(field)
            return value_text(float(q[at]), "shift")
        _, place = self.point(Anchor(part, field), q)
        return f"[{', '.join(f'{x:.4g}' for x in place)}]"

    # The rows of the velocities.

    def velocities(self, q: Array) -> Rows:
        """Returns the rows of all that is held and given, but for rates of bodies, no unknowns."""
        names = [c.part for c in self.parts for _ in range(c.size)]
        rates = [*self._rates_of_joints(q), *self.rates_by_word(q)]
        return Rows(*self.linear(self.parts, q), names).plus(self.scaled(rates))

    def scaled(self, rates: Sequence[Equation]) -> Rows:
        """The rows of equations of rates, in units of the size."""
        units = np.where([e.angular for e in rates], 1.0, self.size)
        rows = np.array([e.row for e in rates]).reshape(-1, self.n) * self.units / units[:, None]
        return Rows(rows, -np.array([e.residual for e in rates]) / units, [e.name for e in rates])

    def given_rates(self) -> dict[int, float]:
        """The velocities that are given of bodies, by their columns in v."""
        columns = {name: i for i, name in enumerate(self.where.rate_names)}
        return {
            columns[f"{name}.{word}"]: value
            for name, placement in self._bodies(self.case.initial)
            for word, value in placement.given.items()
            if f"{name}.{word}" in columns
        }

    def _rates_of_joints(self, q: Array) -> Iterator[Equation]:
        for name, placement in self.case.initial.items():
            joint = self.scene.joints.get(name)
            if joint is not None and joint.rates.keys() & placement.given.keys():
                yield from (
                    e._replace(residual=e.residual - placement.given[rate])
                    for rate, e in self.rates(joint, q).items()
                    if rate in placement.given
                )

    def rates(self, joint: Joint, q: Array) -> dict[str, Equation]:
        """The equations that the rates of its freedoms with names are zero, by these."""
        return {
            f.rate: Equation(f"{joint.name}.{f.rate}", beside, row, f.kind != "shift")
            for f, _, row, beside in self.coordinates(joint, q)
            if f.name
        }

    def linear(self, parts: Sequence[Constraint], q: Array) -> tuple[Array, Array]:
        """The rows (r, n) and right sides g (r,) of f_a v = g (2.15), in units of the size.

        What a residual of 1 means: 1 rad for a held angle, else the mechanism's size [m].
        """
        f, g = self._rows(parts, q)
        units = np.where(self._angular(parts), 1.0, self.size)
        return f * self.units / units[:, None], g / units

    def dependent(self, q: Array, below: float) -> str | None:
        """The first part, or drive, whose rows repeat what is held by those before it.

        Singular values `below` of the largest are zero.
        """
        rows, _ = self.linear(self.parts, q)
        owners = [part.source or part.part for part in self.parts for _ in range(part.size)]
        held = np.zeros((0, self.n))
        for part in dict.fromkeys(owners):
            held = np.vstack([held, rows[[owner == part for owner in owners]]])
            if rank(held, below) < len(held):
                return part
        return None

    def columns(self, bodies: Collection[str]) -> list[int]:
        """The columns of v that are of these bodies."""
        return [i for i, name in enumerate(self.where.rate_names) if name.split(".")[0] in bodies]

    def _rows(self, parts: Sequence[Constraint], q: Array) -> tuple[Array, Array]:
        f, g, _ = self._table(parts).rows(0.0, q, np.zeros(self.n))
        return f, g

    def _table(self, parts: Sequence[Constraint]) -> Table:
        key = tuple(map(id, parts))
        if key not in self._tables:  # Newton asks for the same rows again and again
            self._tables[key] = Table(self.where, parts)
        return self._tables[key]

    @staticmethod
    def _angular(parts: Iterable[Constraint]) -> Array:
        return np.array([angle for c in parts for angle in c.angular], bool)

    def _size(self) -> float:
        """The largest length [m] on a body, wherever the scene stands; without one, the reach."""
        bodies = self.scene.bodies.values()
        lengths = [abs(x) for body in bodies for p in body.points.values() for x in p]
        lengths += [body.radius for body in bodies if body.radius]
        lengths += [joint.length for joint in self.scene.joints.values() if joint.length]
        return max(lengths, default=0.0) or self.reach

    def _reach(self) -> float:
        """The largest given distance [m] from the origin: what rounding is relative to."""
        lengths = [x for p in self.scene.points.values() for x in p.at]
        for placement in self.case.initial.values():
            lengths += [x for key, x in placement.given.items() if key in self.scene.frame.axes]
            lengths += [x for place in placement.points.values() for x in place]
        return max(map(abs, lengths), default=1.0) or 1.0


def value_text(value: float, kind: str) -> str:
    """A shift or a turn as a file has it; of a turn nothing that is rounding."""
    return f"{value:.4g} m" if kind == "shift" else f"{round(value * DEGREES, 9) + 0.0:.4g} deg"


def joined(names: Iterable[str], links: Iterable[set[str]]) -> list[set[str]]:
    """The names in groups: two of one link are in one."""
    groups = [{name} for name in names]
    for link in links:
        met = [group for group in groups if group & link]
        groups = [group for group in groups if not group & link] + [set().union(*met)]
    return groups
