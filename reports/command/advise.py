"""`textmech advise`."""

import warnings
from dataclasses import asdict
from pathlib import Path

import click

from ...cases.mistake import CaseError
from ..show.say import say, tell
from .answer import as_json
from .done import finished
from .folder import Folder
from .options import allow_long, jobs, named_engines, no_cache, overwrite


@click.command()
@click.argument("cases", nargs=-1, metavar="CASE...")
@named_engines()
@click.option(
    "--tolerance",
    type=click.FloatRange(min=0, min_open=True),
    metavar="X",
    help="What each quantity may be off, as a part of its own size (1e-3: 0.1 %), and an event's "
    "time of the duration; without it, what the case allows.",
)
@click.option(
    "--margin",
    type=click.FloatRange(min=1),
    default=2.0,
    show_default=True,
    help="How often the worst error has to fit into what is allowed.",
)
@click.option(
    "--robust",
    is_flag=True,
    help="Try the recipe with six draws of the case's parameters, each up to 10 % off; "
    "those with a unit of their own, such as angles in degrees, stay as they are.",
)
@click.option(
    "--all", "every", is_flag=True, help="All shipped cases, and no fronts: what advice.csv holds."
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
    robust: bool,
    every: bool,
    out: Path | None,
    overwrite: bool,
    jobs: int | None,
    no_cache: bool,
    wants_json: bool,
    allow_long: bool,
) -> None:
    """Which setting does a CASE need?

    For each engine the minimal recipe: the fewest changed options, and with them the largest step,
    that keep every quantity within its tolerance with a margin, at that step and at the next finer
    one. With it what it costs beside the shipped setting, what to paste, and how cost falls with
    error over all that was tried. Where nothing does it, what remains.

    \b
      textmech advise my_case.yaml                      your own mechanism, every engine
      textmech advise four_bar --engine mujoco --tolerance 1e-3
      textmech advise --all                             the committed reports/advice.csv
    """
    from .. import write
    from ..cache import store
    from ..ours import unasked
    from ..search.advised import Asked, row
    from ..search.session import advised
    from ..selection import choose_cases, choose_engines
    from ..show import document, progress
    from ..show.advice import told
    from ..trial.work import too_long

    if bool(cases) == every:
        raise click.UsageError("name a CASE, or say --all")
    if every and out is None and not wants_json:
        out = Folder().convert(str(write.by_default()), None, None)
    if out is not None:
        unasked(out, [write.ADVICE], overwrite=overwrite)
    chosen = choose_cases(cases, long=allow_long)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # an engine that is broken and that nobody named
        engines = choose_engines([name.partition(".")[0] for name in names], ["shipped"])
    if long := too_long(chosen, engines):
        raise CaseError(long)
    used = None if no_cache else store.usable()
    asked = Asked(tolerance, margin, front=not (every or wants_json), robust=robust)
    with (
        progress.progress() as shown,
        finished(used is not None),
        advised(chosen, engines, asked, jobs=jobs, progress=shown, store=used) as found,
    ):
        rows = [row(one) for one in found]
        if wants_json:
            draws = [{} if one.draws is None else asdict(one.draws) for one in found]
            told_rows = [asdict(one) | more for one, more in zip(rows, draws, strict=True)]
            document.write({"advice": told_rows, "exit_code": 0})
        elif not every:
            for one in found:
                for line in told(one):
                    say(line)
    if out is not None:
        write.advice(rows, out, overwrite=overwrite)
        tell(f"{len(rows)} rows written to {out / write.ADVICE}")
