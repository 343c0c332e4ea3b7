"""The one path: cases → references → trials → rows."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from ..cases.case import Case
from ..cases.mistake import CaseError
from ..cases.trajectory import Trajectory
from ..engines.engine import Engine, Plan, Refusal, Start
from ..reference.solve import Solution, solve
from . import pool
from .events.times import never
from .judge.compare import Outcome, compare, crashed
from .judge.instants import of_reference
from .judge.metric import told
from .row import FAILS, Certificate, Comparison, Instant, Rungs
from .trial.book import producers
from .trial.ladder import sampled
from .trial.start import first
from .trial.trial import Trial, ways, with_room

OF_BOUND = 0.1  # of what a check must keep: below it a difference is its rounding

Progress = Callable[[str, int, int], None]
"""What is being done, how much is done, out of how much."""


@dataclass
class Report:
    """The rows of all reports, and the samples behind them."""

    comparisons: list[Comparison] = field(default_factory=list)
    rungs: list[Rungs] = field(default_factory=list)
    certificates: list[Certificate] = field(default_factory=list)
    instants: list[Instant] = field(default_factory=list)
    equations: dict[str, set[str]] = field(default_factory=dict)  # case → executed equations
    trials: list[tuple[Trial, Outcome]] = field(default_factory=list)

    @property
    def fails(self) -> bool:
        """Whether a verdict FAILS, in a row or in a certificate."""
        return any(row.verdict == FAILS for row in (*self.comparisons, *self.certificates))


def measure(
    cases: Sequence[Case],
    engines: Sequence[Engine],
    *,
    jobs: int,
    progress: Progress,
    book: bool = True,
) -> Report:
    """Solves every case once and runs every trial once, on `jobs` processes.

    book: whether the book's own approximations stand beside the engines.

    Raises CaseError with the mistakes of all cases that cannot be started.
    """
    report = Report()
    solutions = _solutions(cases, jobs, progress, report)
    trials, lost = _trials(cases, engines, solutions, jobs, book=book)
    outcomes = dict(_watched(compare, trials, jobs, "engines", progress))
    ended = [*lost, *((trial, outcomes[index]) for index, trial in enumerate(trials))]
    for trial, outcome in ended:
        if isinstance(outcome, pool.Died):
            outcome = crashed(trial, outcome.because)
        outcome = _counted(outcome, solutions[trial.case.name])
        report.comparisons += outcome.rows
        report.rungs += outcome.rungs
        report.instants += outcome.instants
        report.trials.append((trial, outcome))
    return report


def _trials(
    cases: Sequence[Case],
    engines: Sequence[Engine],
    solutions: Mapping[str, Solution],
    jobs: int,
    *,
    book: bool,
) -> tuple[list[Trial], list[tuple[Trial, pool.Died]]]:
    """Every way of every engine, and what died while it planned."""
    trials: list[Trial] = []
    lost: list[tuple[Trial, pool.Died]] = []
    pairs = [(case, engine) for case in cases for engine in producers(case, engines, book=book)]
    starts = {case.name: first(solutions[case.name].trajectory) for case in cases}
    tasks = [(engine, case, starts[case.name]) for case, engine in pairs]
    found = dict(pool.spread(_planned, tasks, jobs=jobs))
    for index, (case, engine) in enumerate(pairs):
        planned, reference = found[index], solutions[case.name].trajectory
        if isinstance(planned, pool.Died):
            gone = Refusal("native", planned.because)
            lost.append((Trial(case, reference, engine, gone), planned))
        else:
            how, own = planned
            if own is not None:
                case, reference = sampled(case, engine), own
            trials += [Trial(case, reference, engine, way, own is not None) for way in how]
    return trials, lost


def _planned(
    task: tuple[Engine, Case, Start],
) -> tuple[tuple[Plan | Refusal, ...], Trajectory | None]:
    """The engine's ways, and the reference's motion where its own step meets other samples."""
    engine, case, start = task
    found = with_room(ways(engine, case.scene, start), case, engine)
    own = sampled(case, engine)
    if own is case or all(isinstance(way, Refusal) for way in found):
        return found, None
    return found, solve(own).trajectory


def _solutions(
    cases: Sequence[Case], jobs: int, progress: Progress, report: Report
) -> Mapping[str, Solution]:
    solutions: dict[str, Solution] = {}
    mistakes = []
    found = dict(_watched(_solved, cases, jobs, "references", progress))
    for index, case in enumerate(cases):
        answer = found[index]
        if isinstance(answer, CaseError):
            mistakes += answer.mistakes
        elif isinstance(answer, pool.Died):
            raise RuntimeError(f"{case.name}: {answer.because}")
        else:
            solutions[case.name] = answer
            report.equations[case.name] = set(answer.equations)
            report.certificates += _certificates(case, answer)
            report.instants += of_reference(case, answer.trajectory)
    if mistakes:
        raise CaseError(mistakes)
    return solutions


def _watched(
    function: Callable, tasks: Sequence, jobs: int, what: str, progress: Progress
) -> Iterator[tuple[int, Any]]:
    progress(what, 0, len(tasks))
    for done, result in enumerate(pool.spread(function, tasks, jobs=jobs), start=1):
        progress(what, done, len(tasks))
        yield result


def _solved(case: Case) -> Solution | CaseError:
    try:
        solution = solve(case)
    except CaseError as error:
        return error
    mistakes = never(case, solution.trajectory)
    if mistakes:
        return CaseError(mistakes)
    return solution


def _certificates(case: Case, solution: Solution) -> list[Certificate]:
    return [
        Certificate(
            case=case.name,
            source=str(case.origin),
            system=solution.system,
            check=check.name,
            difference=told(check.difference, OF_BOUND * check.bound),
            bound=check.bound,
            certified=check.certified,
            unit=check.unit,
            verdict="holds" if check.holds else FAILS,
        )
        for check in solution.checks
    ]


def _counted(outcome: Outcome, solution: Solution) -> Outcome:
    """Against a reference that is not certified nothing can be judged."""
    if solution.holds:
        return outcome
    broken = next(check for check in solution.checks if not check.holds)
    because = (
        f"the reference is not certified: {broken.name} differs by {broken.difference:.2e}, "
        f"its bound is {broken.bound:.2e}"
    )
    return replace(
        outcome, rows=[replace(row, verdict=FAILS, because=because) for row in outcome.rows]
    )
