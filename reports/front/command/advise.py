"""`textmech advise`."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, replace
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ....cases.mistake import CaseError, Mistake
from ..show.console import say, tell
from .done import DONE, finished
from .looking import left_out, tell_spaces
from .options import (
    BAD_INPUT,
    Finite,
    Folder,
    allow_long,
    as_json,
    jobs,
    named_engines,
    no_cache,
    overwrite,
)
from .own_advice import MARGIN, advised_models, lines

if TYPE_CHECKING:
    from ...search.advice.advice_rows import Advised

PART = 1e-3  # of a quantity's own size: asked for of all cases, beside what each allows


@click.command()
@click.argument("cases", nargs=-1, metavar="CASE...")
@named_engines()
@click.option(
    "--tolerance",
    type=Finite(min=0, min_open=True),
    metavar="X",
    help="What each quantity may be off, as a part of its own size (1e-3: 0.1 %), and an event's "
    "time of the duration; without it, what the case allows.",
)
@click.option(
    "--margin",
    type=Finite(min=1),
    default=MARGIN,
    show_default=True,
    help="How often the worst error has to fit into what is allowed.",
)
@click.option(
    "--all",
    "every",
    is_flag=True,
    help="All shipped cases, as they allow and at a thousandth of each quantity's size, and no "
    "fronts: what advice.csv holds.",
)
@click.option(
    "--out",
    type=Folder(),
    help="Write advice.csv there; with --all by default to the committed reports of a checkout, "
    "and outside of one to ./textmech-reports.",
)
@overwrite
@jobs
@no_cache
@as_json
@allow_long
def advise(
    cases: tuple[str, ...],
    names: tuple[str, ...],
    tolerance: float | None,
    margin: float,
    every: bool,
    out: Path | None,
    overwrite: bool,
    jobs: int | None,
    no_cache: bool,
    wants_json: bool,
    allow_long: bool,
) -> None:
    """Which setting does a CASE need?

    At once what a person sees as shipped: energy lost, gaps, creep. Then for each engine two
    recipes, which may be one: the fewest changed options, and the cheapest. Both keep every
    quantity within its tolerance with a margin, at their step and at the next finer one, and
    wherever a loop is cut; a body on planes is a box or a ball of your own model there, started as
    you start it, and not our points and margins.
    With each what it costs beside the shipped setting, and what to paste: into a model or script of
    your own, and as a file of --settings. Then how cost falls with error over all that was tried.
    Where nothing does it, what remains, and the nearest; Ctrl-C ends with the nearest so far.

    Of MJCF or URDF files: what a person sees at the model's own step and not of its own equations,
    the smallest changes that cure it, and the coarsest step of each integrator, with what to write
    into which element. --tolerance is in rad and m of all joints there.

    \b
      textmech advise robot.xml                         a model of your own
      textmech advise my_case.yaml                      your own mechanism, every engine
      textmech advise four_bar --engine mujoco --tolerance 1e-3
      textmech advise --all                             the committed reports/advice.csv
    """
    from ...runs.cache import store
    from ...runs.chosen_models import Chosen, choose_models
    from ...runs.request import requested
    from ...runs.selection import choose_cases
    from ...search.advice.advice_rows import Requirement, rows
    from ...search.advice.advise import Listener, advised
    from ...tables import write
    from ...tables.ownership import unasked
    from ...tables.row import Advice
    from ..show import document, progress
    from ..show.advice import advice_lines, shipped_lines, stopped_lines

    if bool(cases) == every:
        raise click.UsageError("name a CASE, or say --all")
    if every and out is None and not wants_json:
        out = Folder().convert(str(write.by_default()), None, None)
    if out is not None:
        unasked(out, [write.ADVICE], overwrite=overwrite)
    models = choose_models(cases, long=allow_long) if cases else Chosen((), (), ())
    if models.cases and out is not None:
        raise click.UsageError("--out holds what is advised of cases, and these are models")
    chosen = choose_cases(models.others, long=allow_long) if every or models.others else []
    tell_spaces(chosen)
    request = requested(
        chosen, _without_setting(names), ["shipped"], named=False, models=models.cases,
        mistakes=models.mistakes,
    )  # fmt: skip
    if request.mistakes:
        raise CaseError(request.mistakes)
    used = None if no_cache else store.usable()
    front, table = not (every or wants_json), list[Advice]()
    listener = Listener(partial(_say, shipped_lines), partial(_say, stopped_lines))
    with progress.progress() as shown, finished(used is not None):
        means = replace(request, jobs=jobs, progress=shown, store=used)
        own, mistakes = advised_models(means, tolerance, margin) if models.cases else ([], [])
        for line in (line for tried in own for line in lines(tried) if not wants_json):
            say(line)
        tolerances = [None, PART] if every and tolerance is None else [tolerance]
        for each in tolerances if chosen else ():
            asked = Requirement(each, margin, front=front)
            with advised(means, asked, listener if front else None) as advice:
                for pair_advice in advice:
                    table += rows(pair_advice)
                    for line in advice_lines(pair_advice) if front else ():
                        say(line)
        if wants_json:
            code = BAD_INPUT if mistakes else 0
            data = {"advice": [asdict(row) for row in table], "exit_code": code}
            data |= {"models": [asdict(tried) for tried in own]} if models.cases else {}
            data |= {"mistakes": document.mistakes(mistakes)} if mistakes else {}
            document.write(data)
    if out is not None:
        write.advice(table, out, overwrite=overwrite)
        DONE.append(f"the advice is in {out}")
        tell(f"{len(table)} rows written to {out / write.ADVICE}")
    if mistakes:
        tell(left_out(mistakes))
        raise click.exceptions.Exit(BAD_INPUT)


def _say(lines: "Callable[[Advised], Iterator[str]]", advice: "Sequence[Advised]") -> None:
    for advised in advice:
        for line in lines(advised):
            say(line)


def _without_setting(names: tuple[str, ...]) -> list[str]:
    """The engines' names. Raises CaseError where one has a setting, which is what is looked for."""
    what = "advise looks for the setting: name the engine alone"
    if mistakes := [Mistake("--engine", 0, 0, name, what) for name in names if "." in name]:
        raise CaseError(mistakes)
    return list(names)
