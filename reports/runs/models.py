"""Models of the user's own, from their cases to their rows."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from hashlib import sha256
from typing import Any

from ...cases.language.check.work import LIMIT
from ...cases.mistake import CaseError, Mistake
from ...cases.model_case import ModelCase
from ...engines.engine import Engine
from ...engines.mujoco.callbacks.signal import listening
from ...engines.own_model.model import VERSION, image
from ...engines.own_model.opened import opened
from ...engines.own_model.step_law import with_step
from ..compare.own_rows import Modelled, lost, modelled
from ..compare.own_steps import OTHERS, OWN, Setting
from ..compare.own_steps import settings_of as settings_for
from ..tables.row import CRASHED, REFUSED
from .processes.pool import Died
from .selection import choose_engines
from .task_results import Results

ENGINE = "mujoco"
OPTIONS_OF = "options"
"""What the setting `own` of a call in Python is called: a model has one of that name."""
OPTIONS = (
    "step", "integrator", "solver", "cone", "iterations", "ls_iterations", "noslip_iterations",
    "tolerance", "ls_tolerance", "noslip_tolerance", "impratio",
)  # fmt: skip
"""Options of a file of settings that say nothing of a scene's elements."""


@dataclass(frozen=True)
class Settings:
    """The settings in which a model is stepped beside its own: some of OTHERS, a user's files."""

    others: Sequence[str] = (*OTHERS,)
    own: Sequence[Setting] = ()


def settings_of(engines: Sequence[Engine]) -> Settings | None:
    """Returns the settings that engines ask for; None if MuJoCo is not among them.

    Raises CaseError of options that are a scene's.
    """
    mine = [engine for engine in engines if engine.name == ENGINE]
    if not mine:
        return None
    names = {engine.setting for engine in mine}
    built_in = {"shipped", "recommended", "tuned"}
    own = [_setting(engine) for engine in mine if engine.setting not in built_in]
    every = built_in <= names
    others = [name for name in OTHERS if every or name in names]
    return Settings(others, own)


def own_engines(files: Sequence[str]) -> list[Engine]:
    """Returns MuJoCo with a user's options, of each file of settings."""
    engines = choose_engines([], [*files], spare=True) if files else []
    return [engine for engine in engines if engine.name == ENGINE]


def _setting(engine: Engine) -> Setting:
    options: Mapping[str, Any] = getattr(engine, "options", {})
    strange = [name for name in options if name not in OPTIONS]
    if strange:
        what = f"is an option of a scene; a model's own file says it. Known: {', '.join(OPTIONS)}"
        where = f"{engine.setting}.{ENGINE}"
        raise CaseError([Mistake("--settings", 0, 0, f"{where}.{n}", what) for n in strange])
    setting = OPTIONS_OF if engine.setting == OWN else engine.setting
    rest = {name: value for name, value in options.items() if name != "step"}
    return Setting(setting, rest, options.get("step", 0.0))


@dataclass(frozen=True)
class Task:
    """A question about a model, answered in a process of its own."""

    case: ModelCase

    @property
    def name(self) -> str:
        """The name that progress shows."""
        return self.case.name

    @property
    def limit(self) -> float:
        """How long it may take [s]: of a thousand joints one second may take an hour."""
        return LIMIT

    def answer(self) -> Any:
        """Returns what is asked. Raises CaseError."""
        raise NotImplementedError

    def lost(self, because: str, verdict: str) -> Any:
        """Returns what stands for the answer of a model that has none."""
        raise NotImplementedError


@dataclass(frozen=True)
class RowsTask(Task):
    """Asks for a model's rows in these settings."""

    settings: Settings

    def answer(self) -> Modelled:
        """Returns the rows. Raises CaseError if the model does not compile."""
        return modelled(self.case, self.settings.others, self.settings.own)

    def lost(self, because: str, verdict: str) -> Modelled:
        """Returns a row that says why there is none."""
        return lost(self.case, because, verdict)


def row_names(case: ModelCase, beside: Settings) -> list[tuple[str, str]] | CaseError:
    """Returns the setting and the quantity of each row of a model; or its mistakes."""
    try:
        ready = opened(case)
    except CaseError as error:
        return error
    settings = settings_for(ready.own, beside.others, beside.own)
    if not ready.own.model.nv or with_step(ready.own):
        settings = settings[:1]
    return [(setting.name, quantity.name) for setting in settings for quantity in ready.bars]


def digest(task: Task) -> str | CaseError:
    """Returns a word of MuJoCo's release and the compiled model; or why not.

    That is of all its numbers, and of the lines that its rows name.
    """
    try:
        own = opened(task.case).own
        head = f"{VERSION} {own.places}".encode()
        return sha256(head + image(own.model)).hexdigest()
    except CaseError as error:
        return error


def _done(task: Task) -> Any | CaseError:
    try:
        with listening():  # what diverges is said in words
            return task.answer()
    except CaseError as error:
        return error


def answers(
    what: str, tasks: Sequence[Task], results: Results
) -> tuple[list[tuple[ModelCase, Any]], list[Mistake]]:
    """Returns each model with what is asked of it, and the mistakes of those that have no answer.

    A model that ends its process, or takes too long, or is one of a folder, is answered by `lost`.
    What was answered of the same numbers is not asked again.
    """
    words = results.anew("models compiled", digest, dict(enumerate(tasks)))
    keys = {
        index: results.keys.model(tasks[index], word)
        for index, word in words.items()
        if not isinstance(word, CaseError | Died)
    }
    by_key = results.of(what, _done, {key: tasks[index] for index, key in keys.items()})
    pairs, mistakes = list[tuple[ModelCase, Any]](), list[Mistake]()
    for k, task in enumerate(tasks):
        answer = by_key[keys[k]] if k in keys else words[k]
        if isinstance(answer, CaseError) and not task.case.in_folder:
            mistakes += answer.mistakes
            continue
        if isinstance(answer, CaseError):
            answer = task.lost("; ".join(m.what for m in answer.mistakes), REFUSED)
        elif isinstance(answer, Died):
            answer = task.lost(answer.because, CRASHED)
        pairs.append((task.case, answer))
    return pairs, mistakes


def measured(
    cases: Sequence[ModelCase], settings: Settings, results: Results
) -> tuple[list[Modelled], list[Mistake]]:
    """Returns the rows of all models, and the mistakes of the rest."""
    pairs, mistakes = answers("models", [RowsTask(case, settings) for case in cases], results)
    return [replace(row, case=case) for case, row in pairs], mistakes
