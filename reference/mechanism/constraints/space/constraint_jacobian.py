"""The rows of a scene in space at one state, and what their multipliers are."""

from collections.abc import Iterator
from typing import Any

import numpy as np

from ...kinematics.space.kinematics import Bodies, Layout
from .blades import Blades, Pivots
from .constraint_terms import Dots, Kind, Lines, Points
from .joint_constraints import Blade, Dot, Drive, Held, Line, Pivot, Rim, Together
from .rolling import Drives, Rims

KINDS: dict[type[Any], tuple[type[Any], int]] = {
    Together: (Points, 3), Line: (Lines, 1), Dot: (Dots, 1), Rim: (Rims, 3), Pivot: (Pivots, 3),
    Drive: (Drives, 1), Blade: (Blades, 1),
}  # fmt: skip
AXES = "xyz"


class SpatialRows:
    """f_a (r, n), g and γ (r,), ordered by kind; `owners` names the part of each row."""

    def __init__(self, parts: list[Held], layout: Layout) -> None:
        self.layout, self.n = layout, layout.where.size
        self.parts: list[Held] = []
        self._kinds: list[Kind] = []
        self._spans: list[slice] = []
        for kind, (rows, each) in KINDS.items():
            if mine := [part for part in parts if isinstance(part, kind)]:
                first = len(self.owners)
                self.parts += mine
                self._kinds.append(rows(mine, layout, first))
                self._spans.append(slice(first, first + each * len(mine)))
        self.size = len(self.owners)
        self._fixed = np.zeros(self.size * self.n + 1)
        matrix = self._fixed[:-1].reshape(self.size, self.n)
        for kind in self._kinds:
            kind.constants(matrix)
        self._targets = np.concatenate([np.zeros(0, int), *(k.targets for k in self._kinds)])

    @property
    def owners(self) -> list[str]:
        """The part of each row."""
        return [part.part for part in self.parts for _ in range(KINDS[type(part)][1])]

    @property
    def sources(self) -> list[str]:
        """The source of each row: its part, or of a prescribed rate its own name (`q1.omega`)."""
        return [
            part.quantity if isinstance(part, Drive) else part.part
            for part in self.parts
            for _ in range(KINDS[type(part)][1])
        ]

    def at(self, t: Any, bodies: Bodies) -> tuple[Any, Any, Any]:
        """(2.15) f_a (r, n) and g (r,), and γ (r,) of f_a v̇ = γ."""
        kind = np.result_type(bodies.r, bodies.omega, np.asarray(t))
        numbers = self._fixed.astype(kind)
        if not self._kinds:
            empty = np.zeros(0, kind)
            return numbers[:-1].reshape(0, self.n), empty, empty
        found = [k.values(t, bodies) for k in self._kinds]
        numbers[self._targets] = np.concatenate([v for values, _, _ in found for v in values])
        g, gamma = (np.concatenate(parts) for parts in list(zip(*found, strict=True))[1:])
        return numbers[:-1].reshape(self.size, self.n), g, gamma

    def f(self, t: Any, bodies: Bodies) -> Any:
        """(2.14) the residuals of the holonomic rows, in their order."""
        places = np.concatenate([np.zeros(0), *(k.places(t, bodies) for k in self._kinds)])
        return places[self.holonomic]

    @property
    def holonomic(self) -> Any:
        """(r,) which rows have residuals: all but what a rim's point or a pivot does along the
        floor, prescribed rates, and blades."""
        low = [False, False, True]
        known = {Rim: low, Pivot: low, Drive: [False], Blade: [False]}
        kinds = [(type(part), KINDS[type(part)][1]) for part in self.parts]
        flat = [x for kind, size in kinds for x in known.get(kind, [True] * size)]
        return np.array(flat, dtype=bool)

    @property
    def angular(self) -> Any:
        """(r,) which rows are about directions or turns [rad], not lengths [m]."""
        flat = [
            isinstance(part, Dot) or (isinstance(part, Drive) and part.shift is None)
            for part in self.parts
            for _ in range(KINDS[type(part)][1])
        ]
        return np.array(flat, dtype=bool)

    def reactions(self, t: float, bodies: Bodies, multipliers: Any) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ by quantity: forces and moments on second parts, ground axes."""
        found: dict[str, float] = {}
        for kind, span in zip(self._kinds, self._spans, strict=True):
            for name, value in _told(kind, self._of(span), bodies, multipliers[span]):
                found[name] = found.get(name, 0.0) + float(value)
        return found

    def _of(self, span: slice) -> list[Held]:
        at, found = 0, []
        for part in self.parts:
            if span.start <= at < span.stop:
                found.append(part)
            at += KINDS[type(part)][1]
        return found


def _told(kind: Any, parts: list[Any], bodies: Bodies, forces: Any) -> Iterator[tuple[str, Any]]:
    """Each reaction with its component."""
    if isinstance(kind, Points | Rims | Pivots):
        names = ("fx", "fy", "fz") if isinstance(kind, Points) else ("fx", "fy", "normal")
        for part, force in zip(parts, forces.reshape(-1, 3), strict=True):
            yield from ((f"{part.part}.{n}", x) for n, x in zip(names, force, strict=True))
        return
    if isinstance(kind, Blades):
        yield from ((f"{p.part}.{p.name}", x) for p, x in zip(parts, forces, strict=True))
        return
    if isinstance(kind, Lines):
        vectors, letter = kind.direction(bodies), "f"
    elif isinstance(kind, Dots):
        u, w = kind.axes(bodies)
        vectors, letter = np.cross(w, u), "m"
    else:
        yield from _driving(kind, parts, bodies, forces)
        return
    for part, vector, force in zip(parts, vectors, forces, strict=True):
        yield from (
            (f"{part.part}.{letter}{a}", force * x) for a, x in zip(AXES, vector, strict=True)
        )


def _driving(
    kind: Drives, parts: list[Drive], bodies: Bodies, forces: Any
) -> Iterator[tuple[str, Any]]:
    """Yields what a drive exerts: by itself, and as a part of all that the joint does."""
    for part, m, u, force in zip(
        parts, kind.axes(bodies)[0], kind.direction(bodies), forces, strict=True
    ):
        yield f"{part.part}.{part.name}", force
        vector, letter = (u, "f") if part.shift is not None else (m, "m")
        yield from (
            (f"{part.part}.{letter}{a}", force * x) for a, x in zip(AXES, vector, strict=True)
        )
