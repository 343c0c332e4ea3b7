"""`textmech check`."""

import warnings
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING

import click

from ....cases.mistake import CaseError, Mistake
from ..show.console import say
from .looking import tell_spaces
from .options import BAD_INPUT, FAILED, allow_long, as_json, processes

if TYPE_CHECKING:
    from ....cases.case import Case
    from ....cases.model_case import ModelCase
    from ....engines.engine import Engine
    from ....reference.certificate.agreement import Check
    from ...compare.own_equations import Part


@dataclass(frozen=True)
class Checked:
    """A file's cases by name, its mistakes, and (case, check) of each check that does not hold.

    otherwise: sentences, of cases whose hand-written system moves as another scene would. warnings:
    (case, sentence) of what a motion shows that is no mistake, and most likely not meant. model:
    what a user's own model is, with the parts of its equations.
    """

    file: str
    cases: Sequence[str]
    mistakes: Sequence[Mistake]
    broken: Sequence[tuple[str, "Check"]]
    otherwise: Sequence[str] = ()
    warnings: Sequence[tuple[str, str]] = ()
    model: str = ""
    parts: Sequence["Part"] = ()

    @property
    def fails(self) -> bool:
        """Whether a check of a reference, or a part of a model's equations, does not hold."""
        return bool(self.broken) or not all(part.holds for part in self.parts)


@click.command()
@click.argument("files", nargs=-1, required=True, metavar="FILE...")
@processes
@as_json
@allow_long
def check(files: tuple[str, ...], jobs: int | None, wants_json: bool, allow_long: bool) -> None:
    """All mistakes of case files, and checks of their references; no engine is run.

    Of an MJCF or URDF file what MuJoCo compiles: its mass matrix, its bias, its passive and its
    actuator forces are compared with the textbook's at a hundred states, and the forces of
    contacts, limits, dry friction and equalities, where they act, with the optimum of their law.

    \b
      textmech check my_case.yaml
      textmech check robot.xml
    """
    from ...runs.processes.pool import workers
    from ...runs.selection import choose_engines
    from ..show.document import write

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # an engine that is broken is no mistake of a case
        engines = choose_engines([], [])
    results = _checked(files, engines, jobs or workers(), long=allow_long)
    mistakes = [mistake for result in results for mistake in result.mistakes]
    code = BAD_INPUT if mistakes else FAILED if any(result.fails for result in results) else 0
    if wants_json:
        write({"files": [_document(result) for result in results], "exit_code": code})
        raise click.exceptions.Exit(code)
    for result in results:
        for line in _lines(result):
            say(line)
    if mistakes:
        raise CaseError(mistakes)
    raise click.exceptions.Exit(code)


def _checked(
    files: Sequence[str], engines: "Sequence[Engine]", jobs: int, *, long: bool
) -> list[Checked]:
    """Checks each file; cases are solved in processes, each with its share of the memory."""
    from ...runs.processes.pool import Died, local, spread
    from ..show.progress import progress

    units = [unit for file in files for unit in _units(file, engines, long=long)]
    tasks = [unit for unit in units if not isinstance(unit, Checked)]
    by_task: dict[int, Checked] = {}
    if tasks:
        alone = len(units) == 1  # no file is done before it
        with progress(quiet=alone) as listener, local(min(jobs, len(tasks))) as working:
            listener.watch(working)
            for index, answer in spread(_done, tasks, working):
                file = tasks[index].name
                if isinstance(answer, Died):
                    why = Mistake(file, 0, 0, "", f"could not be checked: {answer.because}")
                    answer = Checked(file, [], [why], [])
                by_task[index] = answer
                listener("files", len(by_task), len(tasks), file, len(by_task) / len(tasks))
    answers = (by_task[index] for index in range(len(tasks)))
    return [unit if isinstance(unit, Checked) else next(answers) for unit in units]


def _units(
    file: str, engines: "Sequence[Engine]", *, long: bool
) -> "Iterator[Checked | _Task | _Model]":
    """Yields what there is to do for a file, or its mistakes; for a folder each of its models."""
    from ...compare.trial.work import too_long
    from ...runs.chosen_models import choose_models
    from ...runs.selection import choose_cases

    models = choose_models([file], long=long)
    if models.mistakes:
        yield Checked(file, [], models.mistakes, [])
    for model in models.cases:
        yield _Model(model.file if len(models.cases) == 1 else model.name, model)
    if not models.others:
        return
    try:
        cases = choose_cases([file], long=long)
        tell_spaces(cases)
        if wrong := too_long(cases, engines):
            raise CaseError(wrong)
        yield _Task(file, cases)
    except CaseError as error:
        yield Checked(file, [], error.mistakes, [])


@dataclass(frozen=True)
class _Model:
    """A model, by its name."""

    name: str
    case: "ModelCase"

    @property
    def limit(self) -> float:
        """How long it may take [s]."""
        from ....cases.language.check.work import LIMIT

        return LIMIT


@dataclass(frozen=True)
class _Task:
    """A file, by its name, and its cases."""

    name: str
    cases: "Sequence[Case]"


def _done(task: "_Task | _Model") -> Checked:
    return _compared(task) if isinstance(task, _Model) else _solved(task)


def _compared(task: _Model) -> Checked:
    """Compiles a model and compares its equations; what does not compile is a mistake."""
    from ....engines.own_model.opened import opened
    from ...compare.own_equations import equations

    try:
        own = opened(task.case).own
    except CaseError as error:
        return Checked(task.name, [], error.mistakes, [])
    return Checked(task.name, [], [], [], model=str(own), parts=equations(own))


def _solved(task: _Task) -> Checked:
    """Solves a file's cases: finds the mistakes and failed checks that only references show."""
    from ....reference.solve import solve
    from ...compare.events.states import mistaken
    from ...compare.judge.uncertified import otherwise
    from ...compare.judge.unintended import unintended

    file, cases = task.name, task.cases
    try:
        solved = [(case, solve(case)) for case in cases]
    except CaseError as error:
        return Checked(file, [], error.mistakes, [])
    return Checked(
        file,
        [case.name for case in cases],
        [mistake for case, solution in solved for mistake in mistaken(case, solution.trajectory)],
        [(case.name, c) for case, solution in solved for c in solution.checks if not c.holds],
        [what for _, solution in solved if (what := otherwise(solution).rstrip("; "))],
        [
            (case.name, what)
            for case, solution in solved
            for what in unintended(case, solution.trajectory)
        ],
    )


def _lines(checked: Checked) -> Iterator[str]:
    if checked.model:
        from ...compare.own_equations import lines

        yield f"{checked.file}: {checked.model}"
        yield from lines(checked.parts)
        return
    for what in dict.fromkeys(checked.otherwise):
        yield f"{checked.file}: FAILS: {what}"
    for _, broken in checked.broken:
        numbers = f"{broken.difference:.2e} is above {broken.bound:.1e}"
        yield f"{checked.file}: FAILS: the reference's {broken.name}: {numbers}"
    for case, what in checked.warnings:
        variant = f" {case}:" if len(checked.cases) > 1 else ""
        yield f"{checked.file}: warning:{variant} {what}"
    if not (checked.mistakes or checked.broken):
        many = "s" if len(checked.cases) > 1 else ""
        yield f"{checked.file}: {len(checked.cases)} case{many}, no mistakes"


def _document(checked: Checked) -> dict[str, object]:
    from ..show.document import mistakes

    if checked.model:
        parts = [asdict(part) | {"holds": part.holds} for part in checked.parts]
        return {"file": checked.file, "model": checked.model, "mistakes": [], "equations": parts}
    return {
        "file": checked.file,
        "cases": list(checked.cases),
        "mistakes": mistakes(checked.mistakes),
        "fails": [
            {"case": case, "check": c.name, "difference": c.difference, "bound": c.bound}
            for case, c in checked.broken
        ],
        "because": [*dict.fromkeys(checked.otherwise)],
        "warnings": [{"case": case, "what": what} for case, what in checked.warnings],
    }
