"""Rows of causes.csv: each cure in words, with its options, its step and its price."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import takewhile

from ....engines.engine import Cost, Tunable
from ....engines.knobs import Options, as_text
from ...compare.trial.start import first
from ...runs.tasks import Pair
from ...tables.row import Cause, Comparison, Rungs, StepError, as_written
from .candidate import Candidate
from .change import STEP, Field
from .cures import LARGEST, Cure, Cured
from .parallel_search import Known
from .why import OURS

NONE = "none found"
NOTHING = "nothing can be changed: it is asked of states, without a run"


@dataclass(frozen=True)
class Unexplained:
    """The rows of a pair that have to be searched."""

    pair: Pair
    field: Field
    rows: Sequence[Comparison]

    def cost(self, candidate: Candidate) -> float:
        """Over that of the rows' own setting."""
        base = self._cost(self.field.base.options, self.field.base.step)
        return self._cost(candidate.options, candidate.step) / base

    @cached_property
    def _cost(self) -> Cost:
        engine = self.pair.engine
        assert isinstance(engine, Tunable)
        return engine.cost(self.pair.case.scene, first(self.pair.reference()))


def searched(asked: Unexplained, row: Comparison, cured: Cured) -> list[Cause]:
    """A row for each cure, the cheapest first."""
    found = sorted(cured.cures, key=lambda cure: asked.cost(cure.candidate))
    return [_cause(asked, row, cure, cured.elsewhere) for cure in found] or [without(row, NONE)]


def _cause(asked: Unexplained, row: Comparison, cure: Cure, elsewhere: bool) -> Cause:
    words = " + ".join(lever.words for lever in cure.turned)
    if len(cure.turned) > LARGEST:
        words = f"all of {words}"  # fewer may do: not all sets of them were tried
    return replace(
        without(row, f"{words}, but for the instant" if elsewhere else words),
        options=as_text(cure.candidate.options),
        step=cure.candidate.step,
        # As the report says them: a sentence about a row that is carried over must be the same.
        error_after=as_written(cure.error * (row.allowed or 0.0)),
        cost=as_written(asked.cost(cure.candidate)),
        law=cure.law,
    )


def by_ours(row: Comparison, agreeing: Sequence[Comparison]) -> list[Cause]:
    """Where only a law or driver of ours agrees."""
    return [
        replace(without(row, OURS[one.realised]), step=one.step, error_after=one.error)
        for one in agreeing
    ]


def by_ladder(
    rows: Sequence[Comparison],
    steps: Sequence[StepError],
    ladders: Sequence[Rungs],
    own: Callable[[Comparison], Options],
) -> Iterator[Cause]:
    """The step, where a row's own ladder knows one that is small enough.

    own: the options of the row's setting.
    """
    for row, step, error in usable(rows, steps, ladders):
        yield replace(
            without(row, STEP.words),
            options=as_text(own(row)),
            step=step,
            error_after=as_written(error),
        )


def without(row: Comparison, words: str) -> Cause:
    """Nothing is known but that it is off."""
    return Cause(
        row.case,
        row.engine,
        row.setting,
        row.quantity,
        row.error,
        row.allowed,
        words,
        *("", None, None, None, ""),
    )


# Reads the ladder that a row's own setting has already: its errors at smaller steps.


def usable(
    rows: Sequence[Comparison], steps: Sequence[StepError], ladders: Sequence[Rungs]
) -> Iterator[tuple[Comparison, float, float]]:
    """Rows with the largest step [s] from which on their held ladder keeps what is allowed, and
    the error there; those that have one.

    Of what strikes that is smaller than the errors say, which are those of one start.
    """
    largest = {_at(rung): rung.usable_step or 0.0 for rung in ladders if rung.ladder == "held"}
    held: dict[tuple[str, ...], list[StepError]] = {}
    for one in steps:
        if one.ladder == "held" and one.step <= largest.get(_at(one), 0.0):
            held.setdefault(_at(one), []).append(one)
    for row in rows:
        if kept := _kept(held.get(_at(row), ()), row.allowed or 0.0):
            yield row, kept[-1].step, kept[-1].error


def _at(row: Comparison | Rungs | StepError) -> tuple[str, ...]:
    return row.case, row.engine, row.setting, row.realised, row.quantity


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
