"""The reference's own error in each observed quantity, against what the case asks of it."""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...cases.case import Case
from ...cases.fields.kind import WORK
from ...cases.mistake import Mistake
from ...cases.scene.difference import apart
from ...cases.scene.observe import corners, observe, power
from ...cases.scene.passages import lasting
from ...cases.scene.quantity import at_event, event_quantities
from ...cases.trajectory import Array, Trajectory
from .agreement import Check, worst
from .event_time_error import unread

SHARE = 0.01  # of the smallest tolerance: what the reference's own error may take
EPS = float(np.finfo(np.float64).eps)
ERROR = "error of "
FALLS = 2**4  # at twice the distance, where a sum over samples has at least the fourth order
SAFE = 4  # of 15 by that order: random scenes have errors of up to 1.5 fifteenths of what differs
SURELY = 4  # times what every other step adds: the steps themselves leave out a third of that
LEFT = 4 / 3  # a sum over four times as many samples leaves at most a fourth


def errors(
    case: Case,
    motion: Trajectory,
    others: Mapping[str, Trajectory],
    late: float,
    finely: Callable[[], Trajectory] | None = None,
    march: Callable[[], Trajectory] | None = None,
) -> Iterator[Check]:
    """The share of the smallest `allow` or `reach` that each quantity's own error takes.

    The error is the largest difference to any other answer, and at least the rounding of a double.
    late: how well the times are known at which modes change [s]. finely: another answer at more
    samples, from which sums are told better; march: the motion at every step of its integrator.
    None: what is asked for has none.
    """
    known = case.quantities
    sums = [name for name in case.allow if name in known and known[name].field in WORK]
    closer = finely() if sums and finely else None
    steps = march() if sums and march else None
    times = {name: q for name, q in event_quantities(case.events).items() if q.field == "time"}
    for name in case.allow:
        least, at = _least(case, name), at_event(name, case.events)
        if name in known:
            error, unit = _apart(case, motion, others, name), known[name].unit
            if name in sums:
                missed = 0.0 if steps is None else _missed(case, motion, steps, name)
                error = max(error, missed, _summed(case, motion, closer, name))
        elif name in times:
            event = case.events[times[name].part]
            off = late + _unread(case, motion, others, times[name].part)
            off += _piled(motion.endless) if event.rule == "stays zero" else 0.0
            error, unit = max(EPS * float(motion.times[-1]), off), times[name].unit
        elif at is not None:  # known as everywhere in the motion, but the event is late
            own = observe(case.scene, motion, at.quantity)
            fastest = worst(np.abs(np.diff(own))) / case.interval
            off = late + _unread(case, motion, others, at.event)
            error = _apart(case, motion, others, at.quantity) + fastest * off
            unit = known[at.quantity].unit
        else:
            continue  # a count: the changes of mode are compared by name and number
        if least is not None:
            yield Check(f"{ERROR}{name}", error / least, SHARE, error, unit)


def _piled(endless: Sequence[Array]) -> float:
    """How long [s] after the last of a pile that was followed its limit may be."""
    rest = 0.0
    for pile in endless:
        two, one = np.diff(pile[-3:]).tolist()
        rest = max(rest, one * one / (two - one))
    return rest


def _unread(case: Case, motion: Trajectory, others: Mapping[str, Trajectory], name: str) -> float:
    """By how much [s] an event may be off where its quantity passes through zero in a mode."""
    event = case.events[name]
    if motion.record is None or not event.crosses:
        return 0.0
    return unread(case.scene, motion.record, event, _apart(case, motion, others, event.quantity))


def _summed(case: Case, motion: Trajectory, closer: Trajectory | None, name: str) -> float:
    """How far a sum over the samples may be from the integral, by fewer samples and by more.

    By every second one: where they show that it falls with the fourth power of their distance or
    faster, a fourth part. Elsewhere the power may jump between two samples, where no law says so:
    then it falls with their distance alone, and what every fourth gives tells what the other two
    leave out by chance. Others between them tell what all of these leave out, as what jumps twice
    between two samples: at least three parts in four of it.
    """
    jumps = corners(case.scene, name.rpartition(".")[0])
    kept = [_kept(motion.times, jumps, k) for k in (1, 2, 4)]
    every = [observe(case.scene, _thinned(motion, rows), name) for rows in kept]
    near, far = (
        worst(np.abs(one[np.isin(rows, fewer)] - other))
        for (one, rows), (other, fewer) in pairwise(zip(every, kept, strict=True))
    )
    coarse = near / SAFE if FALLS * near <= far else max(near, far / 2)
    if closer is None:
        return coarse
    fine = observe(case.scene, closer, name)[np.searchsorted(closer.times, motion.times)]
    return max(coarse, LEFT * worst(np.abs(every[0] - fine)))


def _missed(case: Case, motion: Trajectory, march: Trajectory, name: str) -> float:
    """How far a sum over the samples is from one over the steps of the march, if that is surely
    more than what the latter leaves out: samples may miss what is short, or in step with them.
    """
    times, owner = march.times, name.rpartition(".")[0]
    told = power(case.scene, march, owner)
    whole = _trapezoids(times, told)
    left = 0.0
    for rows in lasting(march):
        fewer = _every_other(rows)
        coarse, fine = _trapezoids(times[fewer], told[fewer]), whole[fewer] - whole[rows[0]]
        left += worst(np.abs(coarse - fine))  # anywhere: at the end they may agree by chance
    on = np.isin(times, list(corners(case.scene, owner)))  # a row there tells one side alone
    left += float(np.sum(np.abs(np.diff(times) * np.diff(told))[on[1:] | on[:-1]]))
    at = np.searchsorted(times, motion.times, side="right") - 1
    off = worst(np.abs(whole[at] - observe(case.scene, motion, name)))
    return off if off > SURELY * left else 0.0


def _trapezoids(times: Array, values: Array) -> Array:
    """(N,) the area under the line through the values, up to each."""
    areas = np.diff(times) * (values[1:] + values[:-1]) / 2
    return np.concatenate([[0.0], np.cumsum(areas)])


def _every_other(rows: NDArray[np.int64]) -> NDArray[np.int64]:
    """Every second row, and the last."""
    return np.unique(np.append(rows[::2], rows[-1]))


def _kept(times: Array, jumps: Iterable[float], k: int) -> NDArray[np.int64]:
    """Every k-th sample, and those on corners, where a side begins."""
    on = np.flatnonzero(np.isin(times, list(jumps)))
    return np.union1d(np.arange(0, len(times), k), on)


def _thinned(motion: Trajectory, rows: NDArray[np.int64]) -> Trajectory:
    """Some of the samples."""
    return Trajectory(
        motion.times[rows],
        {name: each[rows] for name, each in motion.states.items()},
        {name: each[rows] for name, each in motion.reactions.items()},
        near={name: each[rows] for name, each in motion.near.items()},
    )


def _apart(case: Case, motion: Trajectory, others: Mapping[str, Trajectory], name: str) -> float:
    """How far a quantity's samples are from those of any other answer."""
    own = observe(case.scene, motion, name)
    found = [apart(own, observe(case.scene, other, name)) for other in others.values()]
    return worst([EPS * worst(np.abs(own).ravel()), *map(worst, found)])


def _least(case: Case, name: str) -> float | None:
    """The smallest `allow` or `reach` of a quantity, or None if nothing bounds it."""
    return min((bar for _, bar in _bars(case, name)), default=None)


def beyond(case: Case, checks: Sequence[Check]) -> list[Mistake]:
    """Each `allow` or `reach` that asks more than can be certified, if nothing else is wrong.

    Where a motion is so sensitive that its states are not known, two answers to it may also differ
    in when something happens, and in how often: that is no second mistake.
    """
    broken = [check for check in checks if not check.holds]
    own = [check for check in broken if check.name.startswith(ERROR)]
    sensitive = any(math.isfinite(check.certified or math.inf) for check in own)
    if not sensitive or any(
        not check.name.endswith("events") for check in broken if check not in own
    ):
        return []
    found = []
    for check in own:
        assert check.certified is not None
        name = check.name.removeprefix(ERROR)
        summed = name in case.quantities and case.quantities[name].field in WORK
        cure = "take more samples" if summed else "a shorter duration"
        found += [
            case.mistake(path, _asks(bar, check.certified, check.unit, cure))
            for path, bar in _bars(case, name)
            if not check.certified <= SHARE * bar
        ]
    return found


def _bars(case: Case, name: str) -> Iterator[tuple[tuple[str, ...], float]]:
    """Where the case bounds a quantity, and by what."""
    allowed = case.allow[name]
    if allowed is not None:
        yield ("allow", name), allowed
    for engine, bars in case.reach.items():
        if name in bars:
            yield ("reach", engine, name), bars[name]


def _asks(bar: float, certified: float, unit: str, cure: str) -> str:
    if not math.isfinite(certified):
        return (
            f"{bar:.3g} asks more than can be certified: two answers to this motion differ in how "
            "often it happens; give a shorter duration"
        )
    digit = 10.0 ** math.floor(math.log10(certified / SHARE))
    least = math.ceil(certified / SHARE / digit) * digit
    return (
        f"{bar:.3g} asks more than can be certified: the reference knows this to "
        f"{certified:.1e} {unit}, and that may be {SHARE:.0%} of it; give at least {least:.0e}, "
        f"or {cure}"
    )
