"""All rows of constraints and all forces of a scene at one state, from one function.

A row has the n factors of the velocities, and behind them g and γ: f_a q̇ᵃ = g (2.15) and
f_a q̈ᵃ = γ; a force has the n numbers that it is along the coordinates (2.50). What does not change
with the state stands in the table from the beginning, and is no part of the function.
"""

from collections.abc import Mapping, Sequence
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from ...coverage import Numbered
from ..kinematics.frame import Vec
from ..kinematics.kinematics import Kinematics, Layout, Part, Row
from ..kinematics.tape import Compiled, is_number

G, GAMMA = -2, -1  # where g and γ stand in a row of n + 2 numbers


class Held(Protocol):
    """A constraint as the table needs it: its rows."""

    @property
    def size(self) -> int: ...
    def written(self, k: Kinematics) -> list[Row]: ...
    def located(self, k: Kinematics) -> list[Any]: ...
    def exerted(self, k: Kinematics) -> list[dict[str, Any]]: ...


class Acting(Protocol):
    """A force element as the table needs it: its loads."""

    name: str

    def loads(self, k: Kinematics) -> list[tuple[Part, Vec | None, Vec | None]]: ...


class Table(Numbered):
    """The rows of some constraints in their order, and behind them some forces in theirs."""

    def __init__(
        self, where: Layout, constraints: Sequence[Held], forces: Sequence[Acting] = ()
    ) -> None:
        self.where, self.constraints, self.forces = where, constraints, forces
        self.n, self.size = len(where.masses), sum(c.size for c in constraints)
        firsts = np.cumsum([0, *(c.size for c in constraints)]).tolist()
        self._spans = {
            id(c): range(first, first + c.size)
            for c, first in zip(constraints, firsts, strict=False)
        }
        self._fixed = np.zeros((self.size + len(forces), self.n + 2))
        self._at: tuple[Any, ...] | None = None

    def has(self, constraints: Sequence[Held]) -> bool:
        """Whether it has all their rows."""
        return all(id(c) in self._spans for c in constraints)

    def places_of(self, constraints: Sequence[Held]) -> Any:
        """The numbers of the rows (r,) of these constraints."""
        return np.array([i for c in constraints for i in self._spans[id(c)]], np.intp)

    @cached_property
    def function(self) -> Compiled:
        """The function of all that changes with the state."""
        return self._written[0]

    @cached_property
    def _written(self) -> tuple[Compiled, Any, Compiled, Any]:
        """The function and the places of its results; the same of the rows without the forces.

        Laws of forces may need real numbers; the derivatives of rows are taken by a complex step.
        """
        k, rows = Kinematics(self.where), list[Row]()
        for constraint in self.constraints:
            rows += constraint.written(k)
        for force in self.forces:
            rows.append(Row(force.loads(k)))
        targets, results = [], []
        for i, row in enumerate(rows):
            entries: dict[int, Any] = {self.n: row.g, self.n + 1: row.gamma}
            for part, F, M in row.loads:
                for column, value in part.columns(F, M):
                    entries[column] = entries.get(column, 0.0) + value
            for column, value in entries.items():
                if is_number(value):
                    self._fixed[i, column] = value + 0.0
                else:
                    targets.append(i * (self.n + 2) + column)
                    results.append(value)
        places = np.array(targets, np.intp)
        held = int(np.searchsorted(places // (self.n + 2), self.size))
        alone = k.tape.compiled(results[:held])
        return k.tape.compiled(results), places, alone, places[:held]

    @cached_property
    def pattern(self) -> Any:
        """(size, n) whether an entry of the rows is ever anything but zero."""
        nonzero = np.zeros(self._fixed.shape, bool)
        nonzero.reshape(-1)[self._written[1]] = True
        return (nonzero | (self._fixed != 0.0))[: self.size, : self.n]

    def constant(self, places: Any) -> bool:
        """Whether these rows are the same at every state."""
        return not np.isin(self._written[1] // (self.n + 2), places).any()

    def numbers(self, t: Any, q: Any, v: Any) -> Any:
        """(rows + forces, n + 2) at a state."""
        at = t, q.tobytes(), v.tobytes()
        if self._at is None or self._at[0] != at:
            run, targets, _, _ = self._written  # which fills what is fixed, too
            numbers = self._fixed.copy()
            numbers.reshape(-1)[targets] = run.real(t, q.tolist(), v.tolist())
            numbers.setflags(write=False)  # all who ask at this state are given the same
            self._at = at, numbers
        return self._at[1]

    def entries(self, t: Any, q: Any, v: Any) -> Any:
        """(rows, n + 2) at a state, real or complex."""
        if q.dtype.kind != "c" and v.dtype.kind != "c" and not isinstance(t, complex):
            return self.numbers(t, q, v)
        _, _, run, targets = self._written
        numbers = self._fixed[: self.size] + 0j
        numbers.reshape(-1)[targets] = run.complex(t, q.tolist(), v.tolist())
        return numbers

    def rows(self, t: Any, q: Any, v: Any) -> tuple[Any, Any, Any]:
        """(2.15) f_a (r, n) and g (r,), and γ (r,) of f_a q̈ᵃ = γ."""
        numbers = self.entries(t, q, v)[: self.size].copy()
        return numbers[:, :G], numbers[:, G], numbers[:, GAMMA]

    @cached_property
    def _located(self) -> tuple[Compiled, list[float | None]]:
        """The places of the rows, and which rows have one."""
        k = Kinematics(self.where)
        return _split(k, [place for c in self.constraints for place in c.located(k)])

    def places(self, t: Any, q: Sequence[Any]) -> list[Any]:
        """The place [m or rad] that each row is the rate of; nan of what is the rate of none."""
        function, numbers = self._located
        changing = iter(function(t, q))
        return [next(changing) if x is None else x for x in numbers]

    @cached_property
    def _exerted(self) -> tuple[Compiled, list[float | None], list[tuple[int, str]]]:
        k = Kinematics(self.where)
        each = [reactions for c in self.constraints for reactions in c.exerted(k)]
        names = [(i, name) for i, reactions in enumerate(each) for name in reactions]
        return *_split(k, [x for reactions in each for x in reactions.values()]), names

    def reactions(
        self, t: float, q: Sequence[Any], multipliers: Mapping[int, Any]
    ) -> dict[str, Any]:
        """(2.60) R_a = λ_b f_aᵇ: by quantity what the multipliers of these rows exert."""
        function, numbers, names = self._exerted
        changing = iter(function(t, q))
        reactions: dict[str, Any] = {}
        for (i, name), x in zip(names, numbers, strict=True):
            factor = next(changing) if x is None else x
            if i in multipliers:
                reactions[name] = reactions.get(name, 0.0) + multipliers[i] * factor
        return reactions


def _split(k: Kinematics, numbers: Sequence[Any]) -> tuple[Compiled, list[float | None]]:
    """A function of the numbers that change, and the constant ones, None where one changes."""
    changing = [x for x in numbers if x is not None and not is_number(x)]
    fixed = [None if not is_number(x) else np.nan if x is None else float(x) for x in numbers]
    return k.tape.compiled(changing), fixed


class Rows(Numbered):
    """The rows of some constraints in a table: those of one mode."""

    def __init__(self, table: Table, constraints: Sequence[Held]) -> None:
        self.table, self.places = table, table.places_of(constraints)
        self._taken = span(self.places)

    @property
    def size(self) -> int:
        """The number r of rows."""
        return len(self.places)

    @cached_property
    def constant(self) -> bool:
        """Whether they are the same at every state."""
        return self.table.constant(self.places)

    @cached_property
    def pattern(self) -> tuple[Any, Any]:
        """Row and column of each entry of the f_a that is not always zero."""
        row, column = np.nonzero(self.table.pattern[self.places])
        return row, column

    def __call__(self, t: Any, q: Any, v: Any) -> tuple[Any, Any, Any]:
        """(2.15) f_a (r, n) and g (r,), and γ (r,) of f_a q̈ᵃ = γ."""
        numbers = self.table.entries(t, q, v)[self._taken]
        return numbers[:, :G], numbers[:, G], numbers[:, GAMMA]

    def entries(self, t: float, q: Any, v: Any) -> tuple[Any, Any]:
        """(2.15) Those of the f_a that `pattern` names, and γ (r,)."""
        numbers, (row, column) = self.table.numbers(t, q, v), self.pattern
        return numbers[self.places[row], column], numbers[self.places, GAMMA]


def span(places: Any) -> Any:
    """Places that follow each other as a slice, which costs less to take; others as they are."""
    first = int(places[0]) if len(places) else 0
    follow = np.array_equal(places, np.arange(first, first + len(places)))
    return slice(first, first + len(places)) if follow else places
