"""Power at the samples, and the work that it does from the first of them on.

Between two samples stands the polynomial through the six around them, on one side of all corners of
laws in time: there a power may jump or bend. So the error falls as the sixth power of the samples'
distance, where nothing else jumps, as friction and blows do. How large it is the reference says of
itself: it integrates the power inside its own steps.
"""

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from ..trajectory import Array, Trajectory


def work_done(
    motion: Trajectory, corners: Iterable[float], power: Callable[[Trajectory], Array]
) -> Array:
    """(N,) work [J] since the first sample, from a function for the power [W]."""
    work, before = [np.zeros(0)], 0.0
    for piece in pieces(motion, corners):
        own = motion.times[piece.own]
        marks = np.unique([piece.begin, *own.clip(piece.begin, piece.end), piece.end])
        sums = before + np.cumsum([0.0, *areas(piece.motion.times, power(piece.motion), marks)])
        work.append(sums[np.searchsorted(marks, own.clip(piece.begin, piece.end))])
        before = float(sums[-1])
    return np.concatenate(work)


def areas(times: Array, values: Array, marks: Array) -> list[float]:
    """The areas between each mark and the next, under the polynomials through the values around."""
    around = [_rows_around(times, (a + b) / 2) for a, b in pairwise(marks.tolist())]
    between = zip(around, pairwise(marks.tolist()), strict=True)
    return [_area(times[rows], values[rows], *ends) for rows, ends in between]


def _rows_around(times: Array, middle: float) -> slice:
    """The rows around a time."""
    first = int(np.searchsorted(times, middle)) - AROUND // 2
    first = min(max(0, first), max(0, len(times) - AROUND))
    return slice(first, first + AROUND)


def _area(times: Array, values: Array, begin: float, end: float) -> float:
    """The area from `begin` to `end` under the polynomial through all rows."""
    middle, half = (begin + end) / 2, (end - begin) / 2
    size = max(half, float(np.ptp(times)))  # scaled: high powers of a small time would underflow
    degrees = np.arange(len(times))
    powers = ((times - middle) / size)[:, None] ** degrees
    each = (1 - (-1.0) ** (degrees + 1)) / (degrees + 1) * (half / size) ** (degrees + 1)
    return size * float(each @ np.linalg.solve(powers, values))


# A motion in smooth pieces: what acts by a law in time may jump or bend at the law's corners.
#
# Places, attitudes and speeds go on through a corner, and only bend there: between two samples they
# are read on it from the samples of one side alone. What producers give, as reactions, may jump: it
# has one value before the corner and one after it.


AROUND = 6  # samples in a polynomial: of fifth degree
NEAR = 0.1  # of two samples' distance, or a piece's: a corner nearer to a sample gets no row
ROUNDED = 1e-14  # of the motion: two times nearer than this are one instant
GENTLE = 10.0  # distances of two samples in which what moves may change much: it is well sampled


@dataclass(frozen=True)
class Piece:
    """The part of a motion between two corners, or one of them and the first or last sample.

    motion: the samples in it, and a row at each end that no sample is near; that at its later end
    is of just before. own: which of all samples are in it; one on its later end is the next
    piece's.
    """

    begin: float
    end: float
    motion: Trajectory
    own: slice


def pieces(motion: Trajectory, corners: Iterable[float]) -> Iterator[Piece]:
    """Split a motion at the corners of its laws; without corners it is one piece.

    The last begins and ends with the last sample, where that is on a corner.
    """
    times = motion.times
    if not len(times):
        return
    inside = _instants(times, corners)
    firsts = [0, *(int(np.searchsorted(times, before)) for before, _ in inside), len(times)]
    parts = [slice(*two) for two in pairwise(firsts)]
    begins = [float(times[0]), *(after for _, after in inside)]
    ends = [*(before for before, _ in inside), float(times[-1])]
    for k, (part, begin, end) in enumerate(zip(parts, begins, ends, strict=True)):
        rows = [_rows(motion, part, begin)]
        if k and _adds_information(times, begin, part, end - begin):
            rows.insert(0, _row_at(motion, begin, (parts[k - 1], part), part))
        if part is not parts[-1] and _adds_information(times, end, part, end - begin):
            rows.append(_row_before(_row_at(motion, end, (part, parts[k + 1]), part)))
        yield Piece(begin, end, _concatenate(rows), part)


def _instants(times: Array, corners: Iterable[float]) -> list[tuple[float, float]]:
    """The corners after the first sample, up to the last: each the first and last of an instant.

    Two laws may write one instant in two ways, as 0.3 and 0.1 + 0.2.
    """
    instants = list[tuple[float, float]]()
    for t in sorted({*corners}):
        if not times[0] < t <= times[-1]:
            continue
        if instants and t - instants[-1][1] <= ROUNDED * (times[-1] - times[0]):
            instants[-1] = instants[-1][0], t
        else:
            instants.append((t, t))
    return instants


def _adds_information(times: Array, corner: float, part: slice, length: float) -> bool:
    """Whether a corner is far enough from the samples of its part to add information."""
    before, after = times[_neighbours(times, corner)]
    return bool(np.all(np.abs(times[part] - corner) >= NEAR * min(after - before, length)))


def _row_at(motion: Trajectory, t: float, beside: tuple[slice, slice], part: slice) -> Trajectory:
    """One row, at a corner: states from the better sampled side, what jumps as in `part`."""
    rows = _side(motion.times, t, beside)
    given = _nearest(motion.times, t, part)
    if not len(given):
        given = _neighbours(motion.times, t)
    return Trajectory(
        np.array([t]),
        {name: _lagrange(motion.times, each, rows, t) for name, each in motion.states.items()},
        {name: _lagrange(motion.times, each, given, t) for name, each in motion.reactions.items()},
        near={name: _lagrange(motion.times, e, rows, t) for name, e in motion.near.items()},
    )


def _side(times: Array, t: float, beside: tuple[slice, slice]) -> Any:
    """The samples of one side whose polynomial is the closest at a corner, or those around it."""
    i = int(np.searchsorted(times, t))
    if times[i] == t:
        return np.array([i])
    distance = GENTLE * (times[i] - times[i - 1])
    sides = [rows for part in beside if len(rows := _nearest(times, t, part)) > 1]
    return min(
        sides,
        key=lambda rows: float(np.prod(np.abs(times[rows] - t) / distance)),
        default=_neighbours(times, t),
    )


def _nearest(times: Array, t: float, part: slice) -> Any:
    """The samples of a part that are nearest to a time, as many as a polynomial has."""
    rows = np.arange(len(times))[part]
    return rows[np.argsort(np.abs(times[rows] - t), kind="stable")[:AROUND]]


def _neighbours(times: Array, t: float) -> Any:
    """The samples before and after a time."""
    i = min(max(int(np.searchsorted(times, t)), 1), len(times) - 1)
    return np.array([i - 1, i])


def _lagrange(times: Array, values: Array, rows: Any, t: float) -> Array:
    """(1, …) the value at t of the polynomial through these rows, by Lagrange."""
    nodes, value = times[rows], 0.0 * values[:1]
    for i, row in enumerate(rows):
        others = np.delete(nodes, i)
        value = value + values[row] * np.prod((t - others) / (nodes[i] - others))
    return value


def _rows(motion: Trajectory, part: slice, begin: float) -> Trajectory:
    return Trajectory(
        np.maximum(motion.times[part], begin),
        {name: rows[part] for name, rows in motion.states.items()},
        {name: rows[part] for name, rows in motion.reactions.items()},
        near={name: rows[part] for name, rows in motion.near.items()},
    )


def _row_before(row: Trajectory) -> Trajectory:
    """The same row one ulp of time earlier, before a law jumps."""
    return Trajectory(np.nextafter(row.times, -np.inf), row.states, row.reactions, near=row.near)


def _concatenate(parts: list[Trajectory]) -> Trajectory:
    """Concatenate trajectories."""
    first = parts[0]
    if len(parts) == 1:
        return first
    return Trajectory(
        np.concatenate([part.times for part in parts]),
        {name: np.concatenate([part.states[name] for part in parts]) for name in first.states},
        {n: np.concatenate([part.reactions[n] for part in parts]) for n in first.reactions},
        near={name: np.concatenate([part.near[name] for part in parts]) for name in first.near},
    )
