"""A constraint as data: the points it is about, its rows as sums of terms, and what they make.

With the rows as written, the multipliers are the force (and moment) of the first part on the
second.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from ....cases.scene import Anchor
from ...coverage import Numbered, equation
from ..kinematics.kinematics import Kinematics, Layout, Point, Row
from .constraint_terms import Along, Term
from .equation_table import Table

Numbers = Sequence[Any]
COMPONENTS = {"fx": 0, "fy": 1, "fz": 2, "mx": 0, "my": 1, "mz": 2}
"""The component of a force λ u, or a moment, that each name is; u is the row's direction."""


@dataclass(frozen=True)
class Constraint(Numbered):
    """Rows f_a v − g = 0 as sums of terms; what a row is the rate of stays constant."""

    part: str  # the joint or contact it belongs to
    ends: tuple[Anchor, ...]  # the points that the terms name by their place here
    rows: tuple[tuple[Term, ...], ...]  # the first term of each is about the second part
    names: tuple[tuple[str, ...], ...]  # of the reactions that each row's multiplier makes
    held: tuple[float | None, ...] | None
    """The places of the rows [m or rad]; None where only the rate is known, or all are rates."""
    where: Layout
    source: str = ""  # what asks for it, where that is not the part: `q1.omega` of a drive

    @property
    def size(self) -> int:
        """The number r of rows."""
        return len(self.rows)

    @property
    def holonomic(self) -> bool:
        """Whether it has residuals (2.14), not only rates (2.15)."""
        return self.held is not None

    @cached_property
    def angular(self) -> tuple[bool, ...]:
        """Which of its residuals are angles [rad], not lengths [m], (r,)."""
        return tuple(all(term.angular for term in terms) for terms in self.rows)

    def places(self, t: Any, q: Numbers) -> list[Any]:
        """The place [m or rad] that each row is the rate of, (r,); nan where it is of none."""
        return self.alone.places(t, q)

    def f(self, t: Any, q: Numbers) -> list[Any]:
        """(2.14) f = places − where they are held [m or rad], (≤ r,); () if all are rates."""
        if self.held is None:
            return []
        pairs = zip(self.places(t, q), self.held, strict=True)
        return [place - at for place, at in pairs if at is not None]

    def reactions(self, t: float, q: Numbers, multipliers: Numbers) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: a force λ u along the direction of its row, or a moment λ."""
        return self.alone.reactions(t, q, dict(enumerate(multipliers)))

    @cached_property
    def alone(self) -> Table:
        """A table of its rows alone."""
        return Table(self.where, [self])

    # What a table asks, to write its rows down.

    def written(self, k: Kinematics) -> list[Row]:
        """(2.15) Its rows."""
        ends = self._ends(k)
        return [sum((term.row(k, ends) for term in terms), Row()) for terms in self.rows]

    def located(self, k: Kinematics) -> list[Any]:
        """The place of each row; None where a term has none."""
        ends = self._ends(k)
        each = [[term.place(k, ends) for term in terms] for terms in self.rows]
        return [None if None in places else sum(places) for places in each]

    def exerted(self, k: Kinematics) -> list[dict[str, Any]]:
        """For each row its reactions, of a multiplier 1."""
        ends, reactions = self._ends(k), []
        for terms, names in zip(self.rows, self.names, strict=True):
            u = terms[0].direction(k, ends)
            reactions.append(
                {
                    f"{self.part}.{name}": u[COMPONENTS[name]] if name in COMPONENTS else 1.0
                    for name in names
                }
            )
        return reactions

    def _ends(self, k: Kinematics) -> list[Point]:
        return [k.point(end) for end in self.ends]


def tracked(point: Anchor, where: Layout) -> Constraint:
    """A point along each axis of the ground: its place, and by f_a v − g its velocity.

    Nothing holds it there.
    """
    rows = tuple((Along(0, tuple(e)),) for e in where.frame.axes)
    return Constraint(str(point), (point,), rows, ((),) * len(rows), (0.0,) * len(rows), where)


def row(part: Constraint, t: float, q: Any, v: Any) -> tuple[Any, float, float]:
    """f_a (n,), g and γ of a constraint of one row."""
    f, g, gamma = part.alone.rows(t, q, v)
    return f[0], g[0], gamma[0]


@equation
def residuals(table: Table, parts: Sequence[Constraint], t: Any, q: Numbers) -> list[Any]:
    """(2.14) f of those of the parts that are holonomic, (≤ r,), from a table that has them."""
    places, errors = table.places(t, q), []
    for part in parts:
        if part.held is not None:
            at = zip(table.places_of([part]).tolist(), part.held, strict=True)
            errors += [places[i] - where for i, where in at if where is not None]
    return errors
