"""The rates at the start in space: what is given, and what the constraints make of it."""

from collections.abc import Iterator, Sequence

import numpy as np

from ...system import Array
from .. import messages
from ..rates import mechanisms
from . import refusal
from .closure import SpatialClosure, least, null, rank
from .initial_conditions import Equation
from .positions import CLOSED


def rates(closure: SpatialClosure, q: Array) -> Array:
    """v (n,) with f_a v = g (2.15); what nobody gives and nothing determines is 0.

    First the rates of joints, of the second part against the first, and all of a mechanism of which
    no rate is given; then those of bodies.

    Raises CaseError if the given rates violate a constraint, or leave others open that cannot all
    be zero.
    """
    rows, g = closure.rows(q)
    found = list(closure.given.rates(closure.case.initial, q))
    rows = np.vstack([rows, *(e.row for e in found)])
    right = np.concatenate([g, [-e.residual for e in found]])
    names = [*closure.owners, *(e.name for e in found)]
    still = _still(closure, found)
    carried = any(equation.residual for equation in _joints(closure, q))  # by a point that moves
    if not carried and not _violated(rows, right, still):
        return still
    rows, right, names = _at_rest(closure, q, rows, right, names)
    units = closure.units
    v = units * least(rows * units, right)
    v = v + units * least(rows * units, right - rows @ v)
    if _violated(rows, right, v):
        worst = names[int(np.argmax(np.abs(rows @ v - right)))]
        raise messages.rates_violate(closure.case, worst)
    loose = null(rows * units, closure.where.size)
    return _resting(closure, rows, right, loose) if len(loose) else v


def _resting(closure: SpatialClosure, rows: Array, right: Array, loose: Array) -> Array:
    """With 0 for every rate that is still open, if all else allows that."""
    still = np.eye(closure.where.size)[refusal.open_columns(loose)]
    rows, right = np.vstack([rows, still]), np.append(right, np.zeros(len(still)))
    units = closure.units
    v = units * least(rows * units, right)
    v = v + units * least(rows * units, right - rows @ v)
    if _violated(rows, right, v):
        raise refusal.rates_open(closure, loose)
    return v


def _at_rest(
    closure: SpatialClosure, q: Array, rows: Array, right: Array, names: list[str]
) -> tuple[Array, Array, list[str]]:
    """With them, one by one, the joints' rates that are still open: they are 0."""
    units = closure.units
    for equation in _joints(closure, q):
        more = np.vstack([rows, equation.row])
        if rank(more * units) > rank(rows * units):
            rows, right = more, np.append(right, -equation.residual)
            names = [*names, equation.name]
    for columns in _unsaid(closure, rows, right):
        still = np.eye(closure.where.size)[columns]
        rows, right = np.vstack([rows, still]), np.append(right, np.zeros(len(columns)))
        names = [*names, *([""] * len(columns))]
    return rows, right, names


def _unsaid(closure: SpatialClosure, rows: Array, right: Array) -> Iterator[list[int]]:
    """The columns of each mechanism that may rest: nothing that concerns it asks for a rate."""
    where = closure.where
    for bodies in mechanisms(closure.scene):
        mine = [i for i, name in enumerate(where.rate_names) if name.rpartition(".")[0] in bodies]
        concerns = np.any(rows[:, mine] != 0.0, axis=1)
        if not np.any(right[concerns]):
            yield mine


def _joints(closure: SpatialClosure, q: Array) -> Iterator[Equation]:
    for joint in closure.scene.joints.values():
        yield from closure.given.named(joint, q)


def _still(closure: SpatialClosure, found: Sequence[Equation]) -> Array:
    """The velocities (n,) that are given of bodies, and 0 elsewhere."""
    v = np.zeros(closure.where.size)
    for equation in found:
        at = np.flatnonzero(equation.row)
        if len(at) == 1:
            v[at[0]] = -equation.residual / equation.row[at[0]]
    return v


def _violated(rows: Array, right: Array, v: Array) -> bool:
    """Whether what is left of (2.15) is more than rounding."""
    residual = rows @ v - right
    scale = max(np.max(np.abs(rows * v), initial=0.0), np.max(np.abs(right), initial=0.0))
    return bool(np.max(np.abs(residual), initial=0.0) > CLOSED * scale)
