"""The rates at the start in space: what is given, and what the constraints make of it."""

from collections.abc import Iterator, Sequence

import numpy as np

from ...system import Array
from .. import messages
from ..rates import mechanisms
from ..search import CLOSED, least, null, rank
from . import refusal
from .closure import SpatialClosure
from .initial_conditions import Equation


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
    left = _left(closure, q, rows)
    held, more = (rows, right), np.array([e.row for e in left]).reshape(-1, closure.where.size)
    rows = np.vstack([rows, more])
    right = np.concatenate([right, [-e.residual for e in left]])
    still = _still(closure, found)
    if not _violated(rows, right, still):
        return still
    v = _least(closure, *held)
    if _violated(*held, v):
        residual = np.abs(held[0] @ v - held[1])
        raise messages.rates_violate(closure.case, names[int(np.argmax(residual))])
    for columns in _unsaid(closure, rows, right):
        rows = np.vstack([rows, np.eye(closure.where.size)[columns]])
        right = np.append(right, np.zeros(len(columns)))
    v = _least(closure, rows, right)
    if _violated(rows, right, v):
        count = rank(np.vstack([held[0], more]) * closure.units) - rank(held[0] * closure.units)
        raise messages.missing(closure.case, count, [e.name for e in left])
    loose = null(rows * closure.units, closure.where.size)
    return _resting(closure, rows, right, loose) if len(loose) else v


def _least(closure: SpatialClosure, rows: Array, right: Array) -> Array:
    """v (n,) that satisfies the rows, or nearly; once more of what rounding has left."""
    units = closure.units
    v = units * least(rows * units, right)
    return v + units * least(rows * units, right - rows @ v)


def _left(closure: SpatialClosure, q: Array, rows: Array) -> list[Equation]:
    """The joints' rates that nobody gives and nothing determines: all of them are to be 0."""
    units, known = closure.units, rank(rows * closure.units)
    return [
        equation
        for equation in _joints(closure, q)
        if rank(np.vstack([rows, equation.row]) * units) > known
    ]


def _resting(closure: SpatialClosure, rows: Array, right: Array, loose: Array) -> Array:
    """With 0 for every rate that is still open, if all else allows that."""
    still = np.eye(closure.where.size)[refusal.open_columns(loose)]
    rows, right = np.vstack([rows, still]), np.append(right, np.zeros(len(still)))
    v = _least(closure, rows, right)
    if _violated(rows, right, v):
        raise refusal.rates_open(closure, loose)
    return v


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
