"""`textmech show`."""

from collections.abc import Sequence
from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ....cases.mistake import CaseError, Mistake, nearest
from ..show.console import say
from .options import allow_long

if TYPE_CHECKING:
    from ....cases.case import Case
    from ....cases.model_case import ModelCase
    from ....engines.engine import Engine
    from ...compare.own_steps import Setting


@click.command(short_help="A scene as the engine's own file or script; what a model is.")
@click.argument("case")
@click.option(
    "--engine",
    "name",
    metavar="E",
    help="An engine's setting, as mujoco.shipped; of an engine alone its tuned one, and of a model "
    "its own.",
)
@click.option(
    "--settings",
    metavar="FILE",
    help="Your own options in place of that, as `textmech advise` prints them.",
)
@allow_long
def show(case: str, name: str | None, settings: str | None, allow_long: bool) -> None:
    """The scene as the engine's own file or script, with the settings and their reasons.

    Of a model of your own (MJCF, URDF, or a case with a `model`) what it is: options, joints,
    actuators, how it is run, and what is compared of it; with --engine a Python script that runs
    it, in its own setting, or as mujoco.shipped, mujoco.recommended, mujoco.rk4.

    \b
      textmech show four_bar --engine pymunk > four_bar.py
      textmech show four_bar --engine mujoco --settings mine.yaml > four_bar.xml
      textmech show robot.xml
      textmech show robot.xml --engine mujoco > robot.py
    """
    from ...runs.chosen_models import choose_models

    models = choose_models([case], long=allow_long)
    if models.mistakes:
        raise CaseError(models.mistakes)
    if models.cases:
        _show_models(models.cases, case, name, settings)
    else:
        _show_case(case, name, settings, allow_long)


def _show_models(
    cases: "Sequence[ModelCase]", word: str, name: str | None, settings: str | None
) -> None:
    """Prints what models are, or a script that runs one.

    They are compiled in a process of their own, which a damaged file may end.
    """
    from ....engines.probe import apart
    from ...compare.trial.limit import limit
    from ..show.own_model import described, script_lines

    calls = [partial(described, case) for case in cases]
    if name is not None or settings is not None:
        _refuse_several([case.name for case in cases], word)
        calls = [partial(script_lines, cases[0], _setting(name or "mujoco", settings))]
    mistakes: list[Mistake] = []
    for call in calls:
        lines, lost = apart(call, most=limit())
        if lost:
            raise click.ClickException(f"{word} cannot be shown: {lost}")
        if isinstance(lines, CaseError):
            mistakes += lines.mistakes
            continue
        for line in lines:
            say(line)
    if mistakes:
        raise CaseError(mistakes)


def _setting(name: str, settings: str | None) -> "Setting":
    """Returns the setting in which a model is stepped, by an engine's name and a file of options.

    Raises click.UsageError or CaseError.
    """
    from ...compare.own_steps import OTHERS, OWN, Setting
    from ...runs.models import ENGINE, own_engines, settings_of

    engine, _, wanted = name.partition(".")
    if engine != ENGINE:
        raise click.UsageError(f"{name}: a model is stepped by {ENGINE} alone")
    if settings:
        asked = settings_of(own_engines([settings]))
        if asked is None or not asked.own:
            raise click.UsageError(f"{settings} holds no options of {ENGINE}")
        return asked.own[0]
    options = {OWN: {}, **OTHERS}
    if wanted and wanted not in options:
        raise click.UsageError(f"a model has no setting {wanted!r}{nearest(wanted, options)}")
    return Setting(wanted or OWN, options[wanted or OWN])


def _refuse_several(names: Sequence[str], word: str) -> None:
    """Raises click.UsageError of more than one case."""
    if len(names) > 1:
        raise click.UsageError(f"{word} has variants; show one of: {', '.join(names)}")


def _show_case(word: str, name: str | None, settings: str | None, allow_long: bool) -> None:
    """Prints a scene as the file or script of an engine."""
    from ....engines import Known, foreign
    from ....engines.probe import apart, guarded
    from ...compare.trial.limit import limit
    from ...compare.trial.table_text import why
    from ...runs.selection import choose_cases, choose_engines
    from ..show.script import script

    known = Known([(name or "").partition(".")[0]])  # no other is imported
    case, *others = choose_cases([word], known=known, long=allow_long)
    _refuse_several([each.name for each in (case, *others)], word)
    if name is None:
        raise click.UsageError("say --engine: a scene is shown as an engine's own file or script")
    engines = choose_engines([name], [settings] if settings else [])
    if not engines:
        raise click.UsageError(f"{name} is no engine, and has no file of its own")
    # Of a bare name the tuned setting, or what else the engine offers.
    wanted = Path(settings).stem if settings else "tuned"
    engine = next((e for e in engines if e.setting == wanted), None if settings else engines[0])
    if engine is None:
        raise click.UsageError(f"{settings} holds no options of {name}")
    if foreign(engine.name):  # which may end its process, or never answer
        _, lost = apart(_shows, case, engine, most=limit())
        if lost:
            raise click.ClickException(f"{name} has no file to show: {lost}")
    text, error = guarded(partial(script, case, engine))
    if isinstance(error, CaseError | click.ClickException):
        raise error
    if error is not None:
        raise click.ClickException(f"{name} has no file to show: {why(error)}")
    if not isinstance(text, str):
        raise click.ClickException(f"{name} gives no text to show: a {type(text).__name__}")
    say(text, nl=False)


def _shows(case: "Case", engine: "Engine") -> None:
    """Asks for the file, in a process of its own; what it raises is asked for once more."""
    from ..show.script import script

    with suppress(Exception):
        script(case, engine)
