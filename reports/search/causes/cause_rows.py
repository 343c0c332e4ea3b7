"""Rows of causes.csv: each cure in words, with its options, its step and its price."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace

from ....engines.knobs import as_text
from ...tables.row import Cause, Comparison, Rungs, StepError, as_written
from .candidate import Candidate
from .change import STEP
from .cures import LARGEST, Cure, Cured
from .errors import Errors
from .why import OURS, key_of

NONE = "none found"
NOTHING = "nothing can be changed: it is asked of states, without a run"
Cost = Callable[[Candidate], float]


def by_search(row: Comparison, cured: Cured, cost: Cost) -> list[Cause]:
    """A row for each cure, the cheapest first; cost: over that of the row's own setting."""
    cures = sorted(cured.cures, key=lambda cure: cost(cure.candidate))
    return [_cause(row, cure, cost, cured.elsewhere) for cure in cures] or [without(row, NONE)]


def _cause(row: Comparison, cure: Cure, cost: Cost, elsewhere: bool) -> Cause:
    words = " + ".join(change.words for change in cure.changes)
    if len(cure.changes) > LARGEST:
        words = f"all of {words}"  # fewer may do: not all sets of them were tried
    return replace(
        without(row, f"{words}, but for the instant" if elsewhere else words),
        options=as_text(cure.candidate.options),
        step=cure.candidate.step,
        # As the report says them: a sentence about a row that is carried over must be the same.
        error_after=as_written(cure.error * (row.allowed or 0.0)),
        cost=as_written(cost(cure.candidate)),
        law=cure.law,
    )


def by_ours(row: Comparison, agreeing: Sequence[Comparison]) -> list[Cause]:
    """Where only a law or driver of ours agrees."""
    return [
        replace(without(row, OURS[one.realised]), step=one.step, error_after=one.error)
        for one in agreeing
    ]


def by_ladder(
    rows: Sequence[Comparison], steps: Sequence[StepError], ladders: Sequence[Rungs]
) -> Iterator[Cause]:
    """The step, where a row's own held ladder knows one from which on it keeps what is allowed."""
    usable = {_at(one): one.usable_step for one in ladders if one.ladder == "held"}
    errors = {(*_at(one), one.step): one.error for one in steps if one.ladder == "held"}
    for row in rows:
        step = usable.get(_at(row))
        error = errors.get((*_at(row), step or 0.0))
        if error is not None:
            yield replace(without(row, STEP.words), step=step, error_after=as_written(error))


def without(row: Comparison, words: str) -> Cause:
    """Nothing is known but that it is off."""
    return Cause(*key_of(row), row.error, row.allowed, words, *("", None, None, None, ""))


def _at(row: Comparison | Rungs | StepError) -> tuple[str, ...]:
    return row.case, row.engine, row.setting, row.realised, row.quantity


def climbed(
    base: Candidate, rows: Sequence[Comparison], steps: Sequence[StepError]
) -> dict[Candidate, Errors]:
    """The errors of the rows at the ladder's steps, if it tells all of them.

    steps: of the case in the engine with that setting. An error of all samples stands for that
    away from instants too, which is no larger. Nothing is known where numbers follow the step, for
    then a ladder holds them; nor of a count, which has no ladder.
    """
    native = [one for one in steps if one.realised == "native"]
    if any(one.ladder != "held" for one in native):
        return {}
    allowed = {row.quantity: row.allowed for row in rows if row.allowed}
    ladder: dict[float, dict[str, tuple[float, float]]] = {}
    for one in native:
        if allow := allowed.get(one.quantity):
            ladder.setdefault(one.step, {})[one.quantity] = (one.error / allow, one.error / allow)
    whole = {step: errors for step, errors in ladder.items() if errors.keys() == allowed.keys()}
    if base.step not in whole:
        return {}
    return {base.at(step): errors for step, errors in whole.items() if step != base.step}
