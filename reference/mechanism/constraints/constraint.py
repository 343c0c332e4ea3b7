"""A constraint as data: the points it is about, its rows as sums of terms, and what they make.

With the rows as written, the multipliers are the force (and moment) of the first part on the
second.
"""

from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from ....cases.scene import Anchor
from ..kinematics.coordinates import Attached, Coordinates, moved
from .banded_solver import MANY
from .constraint_jacobian import Places, Rows
from .constraint_terms import Term

Numbers = Sequence[Any]
COMPONENTS = {"fx": 0, "fy": 1}  # of a force λ u, u the direction of its row


@dataclass(frozen=True)
class Constraint:
    """In each row the sum of the terms is zero, and what it is the rate of stays what it is."""

    part: str  # the joint or contact it belongs to
    ends: tuple[Anchor, ...]  # the points that the terms name by their place here
    rows: tuple[tuple[Term, ...], ...]  # the first term of each is about the second part
    names: tuple[tuple[str, ...], ...]  # of the reactions that each row's multiplier makes
    held: tuple[float, ...] | None  # the places of the rows [m or rad]; None: only rates are known
    where: Coordinates

    @property
    def size(self) -> int:
        """The number r of rows."""
        return len(self.rows)

    @property
    def holonomic(self) -> bool:
        """Whether it has a residual (2.14), not only a rate (2.15)."""
        return self.held is not None

    @cached_property
    def angular(self) -> tuple[bool, ...]:
        """Which of its residuals are angles [rad], not lengths [m], (r,)."""
        return tuple(all(term.angular for term in terms) for terms in self.rows)

    def places(self, t: Any, q: Numbers) -> list[Any]:
        """The place [m or rad] that each row is the rate of, (r,)."""
        ends = [moved(end, t, q, q) for end in self.attached]
        return [sum(term.place(ends) for term in terms) for terms in self.rows]

    def f(self, t: Any, q: Numbers) -> list[Any]:
        """(2.14) f = places − where they are held [m or rad], (r,); () if only rates are known."""
        if self.held is None:
            return []
        return [place - at for place, at in zip(self.places(t, q), self.held, strict=True)]

    def reactions(self, t: float, q: Numbers, multipliers: Numbers) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: a force λ u along the direction of its row, or a moment λ."""
        ends = [moved(end, t, q, q) for end in self.attached]
        found: dict[str, float] = {}
        for terms, names, force in zip(self.rows, self.names, multipliers, strict=True):
            u = terms[0].direction(ends)
            for name in names:
                component = u[COMPONENTS[name]] if name in COMPONENTS else 1.0
                found[f"{self.part}.{name}"] = force * component
        return found

    @cached_property
    def alone(self) -> Rows:
        """Its rows without those of others."""
        return assembled([self], self.where)

    @cached_property
    def attached(self) -> list[Attached]:
        """The points of `ends` on their bodies."""
        return [self.where.attached[end.body, end.point] for end in self.ends]


def residuals(parts: Sequence[Constraint], where: Coordinates) -> Callable[[Any, Any], Any]:
    """f (r,) of t and q, of all parts in their order.

    All at once, where they are many and of the kind; few cost less one by one.
    """
    rows = [(c.attached, terms) for c in parts if c.holonomic for terms in c.rows]
    if len(rows) >= MANY:
        with suppress(TypeError):
            places = Places(rows, len(where.masses))
            held = np.array([at for c in parts for at in c.held or ()])
            return lambda t, q: places(t, q) - held
    return lambda t, q: np.array([entry for c in parts for entry in c.f(t, q.tolist())])


def assembled(parts: Sequence[Constraint], where: Coordinates) -> Rows:
    """The rows of all parts, in their order."""
    return Rows([(c.attached, terms) for c in parts for terms in c.rows], len(where.masses))
