"""`textmech versions`."""

import shutil
import warnings
from pathlib import Path

import click

from ....cases.mistake import CaseError
from ..show.console import say, tell
from .done import DONE
from .options import Folder, allow_long, jobs, overwrite, own_settings

CASES = (
    *("bar_pendulum", "double_pendulum", "four_bar", "slider_crank"),
    *("sliding_block", "rolling_wheel", "bouncing_disk"),
)
"""Pins, loops, sliding, rolling and impacts, in a few seconds a release."""


@click.command()
@click.argument("words", nargs=-1, metavar="ENGINE==VERSION... [CASES]...")
@own_settings("is a further one")
@jobs
@click.option(
    "--out", type=Folder(), help="A folder for versions.csv: all numbers, and what moved."
)
@overwrite
@allow_long
def versions(
    words: tuple[str, ...],
    settings: tuple[str, ...],
    jobs: int | None,
    out: Path | None,
    overwrite: bool,
    allow_long: bool,
) -> None:
    """Which release of an engine moved which textbook number.

    Each release is installed by pip, or by uv where there is no pip, into a folder of its own in
    the cache, and nothing of your environment changes. All run the same cases against the same
    references with today's adapters, in the order in which you name them; each is compared with
    the one before, by the rule of `textmech diff`, and what moved is shown as a table. What an old
    release lacks is refused in words. A verdict FAILS is a finding here, not an exit code.

    Of a model of your own (MJCF, URDF, or a case with a `model`) it is said which joint a release
    moved, by how much, and which of the two is nearer to the limit of the model's own equations.

    Without CASES some of the shipped ones are taken: pins, loops, friction, rolling, impacts.

    \b
      textmech versions mujoco==3.3.7 mujoco==3.7.0 mujoco==4.0.0
      textmech versions pymunk==6.8.1 pymunk==7.3.1 my_case.yaml --settings mine.yaml
      textmech versions mujoco==3.4.0 mujoco==3.5.0 robot.xml

    \b
    Exit codes: 0 done, 2 a mistake: no engine, no such release, no network
    """
    from ....engines.own_model.opened import opened
    from ...runs.chosen_models import choose_models
    from ...runs.selection import choose_cases, choose_engines
    from ...tables import write
    from ...tables.ownership import unasked
    from ..versions.measure import measure
    from ..versions.motions import motion_lines
    from ..versions.release import parted
    from ..versions.table import NAME, table, text

    releases, named = parted(words)
    if out is not None:
        unasked(out, [NAME], overwrite=overwrite)
    chosen = named or [*CASES]
    models = choose_models(chosen, long=allow_long)
    if models.mistakes:
        raise CaseError(models.mistakes)
    cases = [model.name for model in models.cases]
    if models.others:
        cases += [case.name for case in choose_cases(models.others, known=None, long=allow_long)]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # an engine that is broken here may not be asked for
        names = sorted({release.engine for release in releases})
        choose_engines(names, settings, long=allow_long)  # a mistake in own options is found now
    for model in models.cases:
        opened(model)  # what is wrong with it here is said before any release is installed
    files = [model.file for model in models.cases]
    measured = [*measure(releases, chosen, settings, jobs, allow_long, tell, files)]
    rows = table(measured, cases)
    if out is not None:
        write.write({NAME: rows}, out, overwrite=overwrite)
        DONE.append(f"{NAME} is in {out}")
    say(text(rows, shutil.get_terminal_size().columns))
    for line in motion_lines(models.cases, measured):
        say(line)
    if out is not None:
        say(f"written to {out / NAME}")
