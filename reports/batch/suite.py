"""The one path: cases → references → trials → rows."""

from collections.abc import Mapping, Sequence
from concurrent.futures import Executor
from contextlib import nullcontext
from dataclasses import dataclass, field, replace
from math import ceil, inf, log10

from ...cases.case import Case
from ...cases.mistake import CaseError, Mistake
from ...engines.engine import Engine
from ...reference.certificate.agreement import Check
from ...reference.solve import Solution
from ..compare.events.states import mistaken
from ..compare.judge.instants import of_reference
from ..compare.judge.metric import round_to_floor
from ..compare.judge.uncertified import failing, uncertified
from ..compare.judge.unintended import unintended
from ..compare.trial.book import producers
from ..data.coverage import countable
from ..data.promised import answered
from ..data.row import (
    DEVIATES,
    DIVERGED,
    FAILS,
    UNSEARCHED,
    Cause,
    Certificate,
    Comparison,
    Instant,
    Rungs,
    StepError,
)
from ..system.pool import Died, local
from .cache.key import Keys
from .cache.store import Store, temporary_store
from .search.cause_rows import NONE, NOTHING
from .search.causes import Known
from .search.causes import causes as found_causes
from .search.solving import solved
from .search.why import Key, key_of
from .selection import sound, told_apart
from .task_results import Progress, Results, mistakes_of
from .tasks import Pair
from .trials import Tried, tried

OF_BOUND = 0.1  # of what a check must keep: below it a difference is its rounding
ROUNDING = 1e-9  # of a size: below it bounds are of rounding, and so are all digits below them
EDGE = 1e-9  # of an exponent: a bound of 1e-9 is one, whatever its logarithm's last digit

RUNS = 30  # about, of an engine on a case: three ways, two ladders, five rungs


@dataclass
class Report:
    """The rows of all reports, and the samples behind them."""

    comparisons: list[Comparison] = field(default_factory=list)
    rungs: list[Rungs] = field(default_factory=list)
    steps: list[StepError] = field(default_factory=list)
    certificates: list[Certificate] = field(default_factory=list)
    instants: list[Instant] = field(default_factory=list)
    equations: dict[str, set[str]] = field(default_factory=dict)  # case → executed equations
    cases: list[Case] = field(default_factory=list)
    solutions: dict[str, Solution] = field(default_factory=dict)
    causes: list[Cause] = field(default_factory=list)
    mistakes: list[Mistake] = field(default_factory=list)  # of files that are left out
    tried: list[Tried] = field(default_factory=list)

    @property
    def fails(self) -> bool:
        """Whether a verdict FAILS, in a row or in a certificate."""
        return any(row.verdict == FAILS for row in (*self.comparisons, *self.certificates))

    def warnings(self) -> list[tuple[str, str]]:
        """(case, sentence) of what a motion shows that is no mistake, and most likely not meant."""
        return [
            (case.name, what)
            for case in self.cases
            if (solution := self.solutions.get(case.name))
            for what in unintended(case, solution.trajectory)
        ]


def measure(
    cases: Sequence[Case],
    engines: Sequence[Engine],
    *,
    jobs: int = 1,
    progress: Progress,
    book: bool = True,
    causes: bool = False,
    known: Known | None = None,
    store: Store | None = None,
    executor: Executor | None = None,
) -> Report:
    """Solves every case once and runs every trial once, on `jobs` processes of this machine.

    book: whether the book's own approximations stand beside the engines. causes: whether what
    cures each row above its tolerance is searched for, which takes more runs; known: what is
    carried over where it stands on the same, instead of a search. store: where results are kept as
    they come, and taken from if nothing that they depend on has changed; None: nowhere. executor:
    any of `concurrent.futures`, a cluster's for instance, in place of the processes.

    A mistake that only solving finds costs its own file: `mistakes` of the report tells them.
    Raises CaseError with the mistakes if no file is left, and where two cases have one name.
    """
    cases = told_apart(cases)
    countable()
    keys, report = Keys.now(store), Report(cases=list(cases))
    beside = [(case, e) for case in cases for e in producers(case, engines, book=book)]
    most = max(len(cases), RUNS * len(beside))
    with (
        nullcontext(store) if store else temporary_store() as used,
        used.alone(keys.run(beside), lambda: progress("another run has these", 0, 1)),
        nullcontext(executor) if executor else local(min(jobs, most)) as working,
    ):
        results = Results(working, progress, used, keys)
        pairs = [Pair(case, engine, used, keys.solution(case)) for case, engine in beside]
        _solve(cases, results, report)
        paired = [pair for pair in pairs if pair.case.name in report.solutions]
        references = {name: solved.trajectory for name, solved in report.solutions.items()}
        for one in tried(paired, references, results):
            _take(one, report)
        _explain(paired, results, report, search=causes, known=known)
        return report


def _solve(cases: Sequence[Case], results: Results, report: Report) -> None:
    keys = {case.name: results.keys.solution(case) for case in cases}
    found = results.of("references", solved, {keys[case.name]: case for case in cases})
    answers = {case.name: found[keys[case.name]] for case in cases}
    report.mistakes += [m for case in cases for m in _wrong(case, answers[case.name])]
    report.cases = sound(cases, report.mistakes)
    if not report.cases:
        raise CaseError(report.mistakes)
    for case in report.cases:
        answer = answers[case.name]
        report.solutions[case.name] = answer
        report.equations[case.name] = set(answer.equations)
        report.certificates += _certificates(case, answer)
        report.instants += of_reference(case, answer.trajectory)


def _wrong(case: Case, answer: Solution | CaseError | Died) -> list[Mistake]:
    """The mistakes of a case that only solving finds."""
    if isinstance(answer, Solution):
        return mistaken(case, answer.trajectory)
    return mistakes_of(case, answer)


def _take(one: Tried, report: Report) -> None:
    solution = report.solutions[one.pair.case.name]
    outcome = one.outcome
    if not solution.holds:
        outcome = failing(outcome, uncertified(solution))
    outcome = replace(outcome, rows=answered(one.pair.case, outcome.rows))
    report.comparisons += outcome.rows
    report.rungs += outcome.rungs
    report.steps += outcome.steps
    report.instants += outcome.instants
    report.tried.append(replace(one, outcome=outcome))


def _explain(
    pairs: Sequence[Pair], results: Results, report: Report, *, search: bool, known: Known | None
) -> None:
    moments = {
        (one.pair.case.name, one.pair.engine.name, one.pair.engine.setting, name): words
        for one in report.tried
        if one.realised == "native"
        for name, words in one.outcome.moments.items()
    }
    found = report.comparisons, report.steps, report.rungs
    report.causes = found_causes(*found, pairs, results, search=search, known=known)
    report.comparisons = with_causes(report.comparisons, report.causes, moments)


def _certificates(case: Case, solution: Solution) -> list[Certificate]:
    return [_certificate(case, solution, check) for check in solution.checks]


def _certificate(case: Case, solution: Solution, check: Check) -> Certificate:
    bound = _bound(check)
    least = bound if bound <= ROUNDING and check.holds else OF_BOUND * bound
    return Certificate(
        case=case.name,
        source=str(case.origin),
        system=solution.system,
        check=check.name,
        difference=round_to_floor(check.difference, least),
        bound=bound,
        certified=check.certified,
        unit=check.unit,
        verdict="holds" if check.holds else FAILS,
    )


def _bound(check: Check) -> float:
    """The bound as it is written: of a measured one that is kept a power of a thousand above it.

    Its own digits are rounding's, and of a run on another processor others.
    """
    if not (check.measured and check.holds and 0.0 < check.bound < inf):
        return check.bound
    return max(ROUNDING, 1000.0 ** ceil(log10(check.bound) / 3 - EDGE))


# Causes in a row's last column: its instant, what is declared of it, and what cures it.


Moments = Mapping[Key, str]
"""In words, of rows whose error is largest at an instant."""
MOST = 3  # cures in a sentence: causes.csv has them all


def with_causes(
    rows: Sequence[Comparison], causes: Sequence[Cause], moments: Moments
) -> list[Comparison]:
    """The rows, of which each that has causes says them."""
    found: dict[Key, list[Cause]] = {}
    for cause in causes:
        found.setdefault(key_of(cause), []).append(cause)
    return [
        _with(row, found[key_of(row)], moments.get(key_of(row), ""))
        if row.realised == "native" and key_of(row) in found
        else row
        for row in rows
    ]


def _with(row: Comparison, causes: Sequence[Cause], moment: str) -> Comparison:
    """The row with its causes in words; what its ladder says stays where nothing is better."""
    first = causes[0].cure
    if first == UNSEARCHED:
        return row
    declared = row.because if row.verdict in (DEVIATES, DIVERGED) else moment
    if first == NONE:
        told = [declared or row.because, "none of its options tried cures it"]
    elif first == NOTHING:
        told = [declared or row.because, NOTHING]
    else:
        told = [declared, f"cured by {_cures(causes)}"]
    return replace(row, because="; ".join(part for part in told if part))


def _cures(causes: Sequence[Cause]) -> str:
    told = [_cure(cause) for cause in causes[:MOST]]
    more = len(causes) - len(told)
    return " or ".join([*told, f"{more} more"] if more else told)


def _cure(cause: Cause) -> str:
    """`RK4 (×4)`: beside it what it costs."""
    cost = "" if cause.cost is None else f" (×{cause.cost:.2g} the cost)"
    at = f" {cause.step:.3g} s" if cause.cure.endswith("step") else ""
    return f"{cause.cure}{at}{cost}"
