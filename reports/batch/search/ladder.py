"""Reads the ladder that a row's own setting has already: its errors at smaller steps."""

from collections.abc import Iterator, Sequence
from itertools import takewhile

from ...data.row import Comparison, StepError
from .candidate import Candidate
from .parallel_search import Known


def usable(
    rows: Sequence[Comparison], steps: Sequence[StepError]
) -> Iterator[tuple[Comparison, float, float]]:
    """Rows with the largest step [s] from which on their held ladder keeps what is allowed, and
    the error there; those that have one."""
    held: dict[tuple[str, ...], list[StepError]] = {}
    for one in steps:
        if one.ladder == "held":
            key = one.case, one.engine, one.setting, one.realised, one.quantity
            held.setdefault(key, []).append(one)
    for row in rows:
        key = row.case, row.engine, row.setting, row.realised, row.quantity
        if kept := _kept(held.get(key, ()), row.allowed or 0.0):
            yield row, kept[-1].step, kept[-1].error


def _kept(ladder: Sequence[StepError], allowed: float) -> list[StepError]:
    """The steps up to the last before the first that does not keep it."""
    climbed = sorted(ladder, key=lambda one: one.step)
    return [*takewhile(lambda one: one.error <= allowed, climbed)]


def climbed(base: Candidate, rows: Sequence[Comparison], steps: Sequence[StepError]) -> Known:
    """The errors of the rows at the ladder's steps, if it tells all of them.

    steps: of the case in the engine with that setting. An error of all samples stands for that
    away from instants too, which is no larger. Nothing is known where numbers follow the step, for
    then a ladder holds them; nor of a count, which has no ladder.
    """
    native = [one for one in steps if one.realised == "native"]
    if any(one.ladder != "held" for one in native):
        return {}
    of: dict[str, dict[float, float]] = {}
    for one in native:
        of.setdefault(one.quantity, {})[one.step] = one.error
    allowed = {row.quantity: row.allowed for row in rows}
    ladders = {tuple(sorted(errors)) for errors in of.values()}
    if not (set(allowed) <= set(of) and len(ladders) == 1):
        return {}
    (ladder,) = ladders
    if ladder[-1] != base.step:
        return {}
    return {
        base.at(step): {
            name: (of[name][step] / allow, of[name][step] / allow)
            for name, allow in allowed.items()
            if allow
        }
        for step in ladder[:-1]  # the last is the row's own
    }
