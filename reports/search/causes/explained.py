"""A run with the causes of its rows: what cures each, in a table and in the row's last column."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from functools import partial

from ...runs import suite
from ...runs.request import Request
from ...runs.suite import Report
from ...runs.task_results import Results
from ...runs.tasks import Pair
from ...tables.row import DEVIATES, DIVERGED, UNSEARCHED, Cause, Comparison, Known
from .cause_rows import NONE, NOTHING
from .causes import causes as found_causes
from .why import Key, key_of


def measure(request: Request, *, search: bool = False, known: Known | None = None) -> Report:
    """Returns the rows of a run with their causes, as far as they are known or searched for.

    search: whether what cures each row above its tolerance is searched for, which takes more runs;
    known: what is carried over where it stands on the same, instead of a search. Raises CaseError
    as `suite.measure` does.
    """
    return suite.measure(request, partial(explain, search=search, known=known))


def explain(
    pairs: Sequence[Pair],
    results: Results,
    report: Report,
    *,
    search: bool = False,
    known: Known | None = None,
) -> None:
    """Puts the causes of its rows into the report."""
    moments = {
        (run.pair.case.name, run.pair.engine.name, run.pair.engine.setting, name): words
        for run in report.tried
        if run.realised == "native"
        for name, words in run.outcome.moments.items()
    }
    tables = report.comparisons, report.steps, report.rungs
    report.causes = found_causes(*tables, pairs, results, search=search, known=known)
    report.comparisons = with_causes(report.comparisons, report.causes, moments)


# Causes in a row's last column: its instant, what is declared of it, and what cures it.


Moments = Mapping[Key, str]
"""In words, of rows whose error is largest at an instant."""
MOST = 3  # cures in a sentence: causes.csv has them all


def with_causes(
    rows: Sequence[Comparison], causes: Sequence[Cause], moments: Moments
) -> list[Comparison]:
    """Returns the rows with their causes in words."""
    by_row: dict[Key, list[Cause]] = {}
    for cause in causes:
        by_row.setdefault(key_of(cause), []).append(cause)
    return [
        _with(row, by_row[key_of(row)], moments.get(key_of(row), ""))
        if row.realised == "native" and key_of(row) in by_row
        else row
        for row in rows
    ]


def _with(row: Comparison, causes: Sequence[Cause], moment: str) -> Comparison:
    """Returns the row with its causes in words; its ladder's words stay where none is better."""
    first = causes[0].cure
    if first == UNSEARCHED:
        return row
    declared = row.because if row.verdict in (DEVIATES, DIVERGED) else moment
    if first == NONE:
        parts = [declared or row.because, "none of its options tried cures it"]
    elif first == NOTHING:
        parts = [declared or row.because, NOTHING]
    else:
        parts = [declared, f"cured by {_cures(causes)}"]
    return replace(row, because="; ".join(part for part in parts if part))


def _cures(causes: Sequence[Cause]) -> str:
    words = [_cure(cause) for cause in causes[:MOST]]
    more = len(causes) - len(words)
    return " or ".join([*words, f"{more} more"] if more else words)


def _cure(cause: Cause) -> str:
    """`RK4 (×4)`: beside it what it costs."""
    cost = "" if cause.cost is None else f" (×{cause.cost:.2g} the cost)"
    at = f" {cause.step:.3g} s" if cause.cure.endswith("step") else ""
    return f"{cause.cure}{at}{cost}"
