"""The one path: cases → references → trials → rows."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field, replace
from functools import partial
from math import ceil, inf, log10

from ...cases.case import Case
from ...cases.mistake import CaseError, Mistake
from ...reference.certificate.agreement import Check
from ...reference.solve import Solution
from ..compare.events.states import mistaken
from ..compare.judge.instants import of_reference
from ..compare.judge.metric import round_to_floor
from ..compare.judge.uncertified import failing, uncertified
from ..compare.judge.unintended import unintended
from ..compare.own_rows import Modelled, line
from ..compare.trial.book import producers
from ..tables.coverage import countable
from ..tables.model_line import ModelLine
from ..tables.promised import answered
from ..tables.row import FAILS, Cause, Certificate, Comparison, Instant, Rungs, StepError
from .models import measured
from .processes.pool import Died
from .request import Request
from .selection import sound, told_apart
from .task_results import Results, mistakes_of
from .tasks import Pair, solved
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
    models: list[Modelled] = field(default_factory=list)
    cures: dict[str, str] = field(default_factory=dict)  # of models, by name, in words

    @property
    def lines(self) -> list[ModelLine]:
        """A row for each model."""
        return [line(model, self.cures.get(model.case.name, "")) for model in self.models]

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


Explain = Callable[[Sequence[Pair], Results, Report], None]
"""Puts the causes of its rows into a report, with more runs of its pairs if need be."""


def measure(request: Request, explain: Explain | None = None) -> Report:
    """Solves every case once and runs every trial once.

    A mistake that only solving finds costs its own file: `mistakes` of the report tells them.
    Raises CaseError with the mistakes if no file is left, and where two cases have one name.
    """
    cases = told_apart(request.cases)
    countable()
    report = Report(cases=list(cases))
    beside = [(c, e) for c in cases for e in producers(c, request.engines, book=request.book)]
    most = max(len(cases), RUNS * len(beside), len(request.models))
    with request.results(most=most) as results:
        if request.models:
            _take_models(request, results, report)
        if not cases:
            return report
        keys, waiting = results.keys, partial(results.progress, "another run has these", 0, 1)
        with results.store.alone(keys.run(beside), waiting):
            pairs = [Pair(case, e, results.store, keys.solution(case)) for case, e in beside]
            _solve(cases, results, report)
            paired = [pair for pair in pairs if pair.case.name in report.solutions]
            references = {name: solved.trajectory for name, solved in report.solutions.items()}
            for run in tried(paired, references, results):
                _take(run, report)
            if explain:
                explain(paired, results, report)
    return report


def _take_models(request: Request, results: Results, report: Report) -> None:
    report.models, report.mistakes = measured(request.models, request.model_settings, results)
    if not (report.models or request.cases):
        raise CaseError(report.mistakes)
    for model in report.models:
        report.comparisons += model.comparisons
        report.rungs += model.rungs
        report.steps += model.step_errors
        report.certificates += model.certificates


def _solve(cases: Sequence[Case], results: Results, report: Report) -> None:
    keys = {case.name: results.keys.solution(case) for case in cases}
    solutions = results.of("references", solved, {keys[case.name]: case for case in cases})
    answers = {case.name: solutions[keys[case.name]] for case in cases}
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


def _take(run: Tried, report: Report) -> None:
    solution = report.solutions[run.pair.case.name]
    outcome = run.outcome
    if not solution.holds:
        outcome = failing(outcome, uncertified(solution))
    outcome = replace(outcome, rows=answered(run.pair.case, outcome.rows))
    report.comparisons += outcome.rows
    report.rungs += outcome.rungs
    report.steps += outcome.steps
    report.instants += outcome.instants
    report.tried.append(replace(run, outcome=outcome))


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
    """Rounds a bound as it is written: a measured one that is kept up to a power of a thousand.

    Its own digits are rounding's, and of a run on another processor others.
    """
    if not (check.measured and check.holds and 0.0 < check.bound < inf):
        return check.bound
    return max(ROUNDING, 1000.0 ** ceil(log10(check.bound) / 3 - EDGE))
