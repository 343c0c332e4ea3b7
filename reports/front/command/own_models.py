"""`textmech run` of models of the user's own: each at its steps, against its limit."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ....cases.mistake import CaseError, Mistake, plain
from ..show.console import say
from .options import BAD_INPUT

if TYPE_CHECKING:
    from ....engines.own_model.model import OwnModel
    from ...compare.own_steps import Step, Steps


@dataclass(frozen=True)
class Model:
    """A model, by the name that was typed, and where it is."""

    name: str
    path: str

    @property
    def limit(self) -> float:
        """How long it may take [s]: of a thousand joints one second may take an hour."""
        from ....cases.language.check.work import LIMIT

        return LIMIT

    def compiled(self) -> "OwnModel":
        """Returns the compiled model. Raises CaseError, of the name that was typed."""
        from ....engines.own_model.model import compiled

        try:
            return compiled(self.path)
        except CaseError as error:
            raise CaseError([replace(each, file=self.name) for each in error.mistakes]) from None


@dataclass(frozen=True)
class Stepped:
    """A model: what it is, from where it is started, and its steps, or why there are none."""

    file: str
    model: str = ""
    started: str = ""
    steps: "Steps | None" = None
    because: str = ""
    mistakes: Sequence[Mistake] = ()


def run_models(files: Sequence[str], jobs: int | None, *, wants_json: bool) -> None:
    """Runs each in a process of its own, and prints a table for each. Ends the command."""
    from ...runs.processes.pool import Died, local, spread, workers
    from ..show import document
    from ..show.progress import progress

    tasks = [Model(file, str(Path(file).resolve())) for file in files]
    by_place: dict[int, Stepped] = {}
    jobs = min(jobs or workers(), len(tasks))
    with progress(quiet=len(tasks) == 1) as told, local(jobs) as working:
        told.watch(working)
        for index, one in spread(_stepped, tasks, working):
            name = tasks[index].name
            if isinstance(one, Died):
                why = Mistake(name, 0, 0, "", f"could not be run: {one.because}")
                one = Stepped(name, mistakes=[why])
            by_place[index] = one
            told("models", len(by_place), len(tasks), name, len(by_place) / len(tasks))
    answers = [by_place[index] for index in range(len(tasks))]
    mistakes = [mistake for one in answers for mistake in one.mistakes]
    code = BAD_INPUT if mistakes else 0
    if wants_json:
        document.write({"models": [_document(one) for one in answers], "exit_code": code})
    else:
        for one in answers:
            for line in _lines(one):
                say(plain(line))
    if mistakes and not wants_json:
        raise CaseError(mistakes)
    raise click.exceptions.Exit(code)


def _stepped(task: Model) -> Stepped:
    from ....engines.own_model.limit import NoLimit
    from ...compare.own_steps import steps

    try:
        own = task.compiled()
    except CaseError as error:
        return Stepped(task.name, mistakes=error.mistakes)
    if not own.model.nv:
        return Stepped(task.name, str(own), because="nothing moves")
    try:
        return Stepped(task.name, str(own), own.started, steps(own))
    except NoLimit as error:
        return Stepped(task.name, str(own), own.started, because=f"no limit: {error}")


def _lines(one: Stepped) -> Iterator[str]:
    if one.model:
        yield f"{one.file}: {one.model}"
    if one.because:
        yield f"  {one.because}" if one.model else f"{one.file}: {one.because}"
    if (steps := one.steps) is None:
        return
    end, limit = float(steps.limit.times[-1]), steps.limit
    yield f"  {one.started}, over {end:.3g} s"
    yield f"  its limit for h → 0 by {limit.method}, known to {limit.error:.0e} rad or m"
    if steps.until < end:
        yield (
            f"  judged until {steps.until:.3g} s: later a disturbance of 1e-9 exceeds "
            f"{steps.tolerance:g}"
        )
    if not steps.judges:
        yield f"  which is too rough to say which step keeps {steps.tolerance:g}"
    if steps.note:
        yield f"  no finer steps: {steps.note}"
    yield ""
    head = f"  {'integrator':13} {'step':>8}  {'off by':>8}  {'in':20} {'order':>5}  "
    yield head + f"keeps {steps.tolerance:g} from"
    for row in steps.rows:
        yield f"  {_line(row, judges=steps.judges)}"


def _line(row: "Step", *, judges: bool) -> str:
    step = f"{row.step * 1e3:.3g} ms"
    if row.off is None:
        off, where = "diverges", ""
    else:
        off, where = f"{row.off:.1e}", row.joint
    order = "" if row.order is None else f"{row.order:.1f}"
    finer = "none tried" if judges else ""
    keeps = finer if row.keeps is None else f"{row.keeps * 1e3:.3g} ms"
    return f"{row.setting:13} {step:>8}  {off:>8}  {where:20} {order:>5}  {keeps}".rstrip()


def _document(one: Stepped) -> dict[str, object]:
    from ..show.document import mistakes

    told: dict[str, object] = {
        "file": one.file,
        "model": one.model,
        "started": one.started,
        "because": one.because,
        "mistakes": mistakes(one.mistakes),
    }
    if one.steps is not None:
        told |= {
            "limit": {"method": one.steps.limit.method, "error": one.steps.limit.error},
            "tolerance": one.steps.tolerance,
            "judged_until": one.steps.until,
            "note": one.steps.note,
            "steps": [asdict(row) for row in one.steps.rows],
        }
    return told
