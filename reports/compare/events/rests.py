"""When an engine's quantity comes to rest at zero and leaves it, from steps that creep and tremble.

Steps above 2 % of the motion's largest value move; 4 % are asked where rest ends, so that noise
does not count twice. The time itself is where the motion, continued, would be zero: a curve
through the steps next to the rest, of which the nearest is still above 2 %. A straight line
would be 7e-4 s off in Example 2.4 at any step, since 2 % of its speed last 30 ms; a cubic 1e-6 s.
Where the steps between it and the rest are smooth themselves, `continued` asks those: 1e-12 s.

What begins to move by far less than it reaches later needs a smaller share than 2 %. The exact
motion tells which: an engine that trembles or creeps above that does not rest as it would.
"""

from collections.abc import Iterator

import numpy as np

from ....cases.trajectory import Array

LOW, HIGH = 0.02, 0.04  # of the largest value
SHARES = tuple(part * LOW for part in (1.0, 0.3, 0.1, 0.03, 0.01, 1e-3))  # in place of LOW
WINDOW = 0.06  # of the largest value in the phase: the curve is laid through 2 % to 6 % of it
STEPS = 6  # at least, in the curve; and the shortest rest: a shorter one is a passage
DEGREE = 3
PLAUSIBLE = 4  # times the way to half of the last value: where the zero can be
TOUCHES = 0.5  # imaginary over real part: a curve that noise keeps just off zero


Rest = tuple[float | None, float | None]
"""When [s] something stops and starts; None where the record begins or ends in its rest."""


def rests(times: Array, u: Array, low: float = LOW) -> list[Rest]:
    """(stop, start) [s] of every rest of u (N,); None where the record begins or ends in it.

    low: in place of 2 %; what is asked elsewhere is as much smaller.

    Where u passes through zero both curves meet, so a rest has to last longer than six steps; or
    until the end of the record. What starts within six steps rests at no time. What never exceeds
    4 % of the motion's largest value again counts as rest: an engine's creep is no other.
    """
    phases = [_widened(u, *phase, low) for phase in _phases(u, low)]
    if not phases:
        return []
    stops = [None, *(_zero(times, u, first, last, low) for first, last in phases)]
    starts = [*(_zero(times, u, last, first, low) for first, last in phases), None]
    shortest = STEPS * float(times[1] - times[0])
    if phases[0][0] == 0:
        del stops[0], starts[0]
    if phases[-1][1] == len(u) - 1:
        del stops[-1], starts[-1]
    return [
        (stop, start)
        for stop, start in zip(stops, starts, strict=True)
        if start is None or start - (times[0] if stop is None else stop) > shortest
        if stop is None or stop <= times[-1]
    ]


def _phases(u: Array, low: float) -> Iterator[tuple[int, int]]:
    """First and last step of every stretch in which u moves with one sign."""
    largest = float(np.max(np.abs(u)))
    if largest == 0:
        return
    clear = (np.abs(u) > HIGH / LOW * low * largest) | (np.abs(u) <= low * largest)
    clear[0] = True
    as_at = np.maximum.accumulate(np.where(clear, np.arange(len(u)), 0))
    moves = (np.abs(u) > low * largest)[as_at]
    state = np.where(moves, np.sign(u), 0.0)
    for run in np.split(np.arange(len(u)), np.flatnonzero(np.diff(state)) + 1):
        if state[run[0]]:
            yield int(run[0]), int(run[-1])


def _widened(u: Array, first: int, last: int, low: float) -> tuple[int, int]:
    """The stretch with the steps beside it that still exceed 2 % of its own largest value."""
    sign = np.sign(u[first])
    near = sign * u > low * float(np.max(np.abs(u[first : last + 1])))
    outside = np.flatnonzero(~near)
    return (
        int(np.max(outside[outside < first], initial=-1)) + 1,
        int(np.min(outside[outside > last], initial=len(u))) - 1,
    )


def _zero(times: Array, u: Array, inner: int, edge: int, low: float) -> float:
    """Where u, continued from the steps between `inner` and `edge` beyond `edge`, is zero [s]."""
    away = 1 if edge >= inner else -1
    if not 0 <= edge + away < len(u):  # the record ends here: nobody asks for this time
        return float(times[edge])
    rows = np.arange(edge, inner - away, -away)
    high = np.flatnonzero(np.abs(u[rows]) > WINDOW / LOW * low * np.max(np.abs(u[rows])))
    rows = rows[: max(STEPS, int(high[0]))]
    h = float(times[edge + away] - times[edge])  # negative where u starts
    steps, values = (times[rows] - times[edge]) / h, u[rows] / u[edge]
    half = _half(u[edge + away :: away] / u[edge])
    for degree in (DEGREE, 1):
        zero = _first_zero(steps, values, degree)
        if half is None or half <= zero <= PLAUSIBLE * half:
            return continued(times, u, float(times[edge]) + h * zero, away)
    return float(times[edge]) + h * 2 * half  # a corner, or steps too uneven for any curve


def _half(beyond: Array) -> float | None:
    """After how many steps the values, from 1 on, are half of that; None if they never are."""
    below = np.flatnonzero(beyond <= 0.5)
    if not len(below):
        return None
    i = int(below[0])
    before = float(beyond[i - 1]) if i else 1.0
    return i + (before - 0.5) / (before - float(beyond[i]))


def _first_zero(steps: Array, u: Array, degree: int) -> float:
    """The first zero beyond step 0 of the curve through u; inf if there is none."""
    if len(steps) == 1:
        return np.inf
    span = float(np.max(np.abs(steps)))
    roots = np.roots(np.polyfit(steps / span, u, min(degree, len(steps) - 1)))
    touches = np.abs(np.imag(roots)) <= np.real(roots) * TOUCHES
    return float(np.min(np.real(roots[touches]), initial=np.inf)) * span


# A zero that is nearly known, again from the steps right beside it, where those can be trusted.
#
# What slides smoothly until it rests, or from when it breaks loose, is known there as well as the
# engine knows its motion: t as a curve of u through eight steps, at u = 0. Whether the steps
# beside a rest are smooth, or an engine's creep and a soft contact have bent them already, two
# such curves tell: of eight steps and of six they agree better with each other than with the zero
# as it was, or it stays that: it is the mean of many steps, which noise moves less.


THROUGH, FEWER = 8, 6  # of seventh and fifth degree: both above what the engines' own order leaves
SKIPPED = 4  # at most: an engine's law may bend the last steps
AGREE = 1e-3  # of a step: curves that are further apart are not those of a smooth motion


def continued(times: Array, u: Array, zero: float, away: int) -> float:
    """The zero [s] of u (N,) again; away: 1 where u stops there, −1 where it starts."""
    h = float(times[1] - times[0])
    moving = np.flatnonzero(away * (zero - times) > 0.0)[::-away]  # the nearest first
    nearest, apart = zero, AGREE * h
    for skipped in range(SKIPPED):
        rows = moving[skipped : skipped + THROUGH]
        steps = np.diff(u[rows])
        if len(rows) < THROUGH:
            break
        if not np.all(steps * u[rows[0]] > 0.0):
            continue  # it does not grow from the rest on: no curve of u
        by_fewer, by_all = _at_zero(times[rows], u[rows])
        if abs(by_all - by_fewer) < min(apart, abs(by_all - zero)) and abs(by_all - zero) < h:
            nearest, apart = by_all, abs(by_all - by_fewer)
    return nearest


def _at_zero(times: Array, u: Array) -> tuple[float, float]:
    """t where u is 0, of the curves through the first `FEWER` points and through all of them.

    By Neville's scheme; from the first time on, or what is left of each digit would be rounding.
    """
    x, t = u.tolist(), (times - times[0]).tolist()
    firsts = []
    for k in range(1, len(x)):
        t = [(x[i] * t[i + 1] - x[i + k] * t[i]) / (x[i] - x[i + k]) for i in range(len(x) - k)]
        firsts.append(float(times[0]) + t[0])
    return firsts[FEWER - 2], firsts[-1]
