"""`textmech causes`."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import groupby
from typing import TYPE_CHECKING

import click

from ....cases.mistake import CaseError
from ..show.console import say, tell
from .done import finished
from .options import BAD_INPUT, allow_long, as_json, jobs, named_engines, no_cache

if TYPE_CHECKING:
    from ...tables.row import Cause


@click.command()
@click.argument("cases", nargs=-1, required=True, metavar="CASE...")
@named_engines()
@jobs
@no_cache
@as_json
@allow_long
def causes(
    cases: tuple[str, ...],
    names: tuple[str, ...],
    jobs: int | None,
    no_cache: bool,
    wants_json: bool,
    allow_long: bool,
) -> None:
    """Why is a CASE off? For each quantity above its tolerance, what brings it within.

    A cause is found by experiment: of all that the tuned setting has otherwise than the shipped
    one, the smallest sets that cure, with the step that they need and what they cost. Where a law
    or driver of ours is needed, the engine's own model is another one.
    """
    from ...runs.cache import store
    from ...runs.request import requested
    from ...runs.selection import choose_cases, choose_engines
    from ...search.causes import explained
    from ...search.causes.why import OFF
    from ...tables import committed
    from ..show import cures, document, progress

    chosen = choose_cases(cases, long=allow_long)
    if names:
        choose_engines(names, [])  # a mistake in a setting is found, and all are needed
    engines = [name.partition(".")[0] for name in names]
    request = requested(chosen, engines, [], named=False)
    if request.mistakes:
        raise CaseError(request.mistakes)
    used, known = (None, None) if no_cache else (store.usable(), committed.committed_causes())
    with progress.progress() as listener, finished(used is not None):
        request = replace(request, book=False, jobs=jobs, progress=listener, store=used)
        report = explained.measure(request, search=True, known=known)
    if names:
        mine = [c for c in report.causes if {c.engine, f"{c.engine}.{c.setting}"} & {*names}]
        report = replace(report, causes=mine)
    if known and (summary := cures.carried(report.causes, known.causes)):
        tell(summary)
    if wants_json:
        code = BAD_INPUT if report.mistakes else 0
        document.write(document.of_causes(report.causes, report.mistakes, exit_code=code))
        raise click.exceptions.Exit(code)
    _print(report.causes, sum(row.verdict in OFF for row in report.comparisons))
    if report.mistakes:
        raise CaseError(report.mistakes)


def _print(causes: "Sequence[Cause]", off: int) -> None:
    """Prints the causes; off: how many rows are above their tolerances, whoever made them."""
    if not causes and off:
        say(
            "nothing to search: no engine's own run is above a tolerance, "
            f"but {off} rows by laws or drivers of ours are"
        )
    elif not causes:
        say("no quantity is above its tolerance, in any setting")
    for (case, engine, setting), group in groupby(
        causes, key=lambda cause: (cause.case, cause.engine, cause.setting)
    ):
        say(f"\n{case} in {engine}.{setting}")
        for quantity, cures in groupby(group, key=lambda cause: cause.quantity):
            first, *others = cures
            before = "diverged" if first.error is None else f"{first.error:.2g}"
            allowed = f"(allowed {first.allowed or 0:.1g})"
            say(f"  {quantity:20} {before:>8} {allowed}  {_line(first)}")
            for other in others:
                say(f"  {'':20} {'':8} {'or':>{len(allowed)}}  {_line(other)}")


def _line(cause: "Cause") -> str:
    if cause.error_after is None:
        return cause.cure
    parts = [f"{cause.error_after:.2g} with {cause.cure}"]
    parts += [] if cause.step is None else [f"h = {cause.step:.3g} s"]
    parts += [] if cause.cost is None else [f"×{cause.cost:.2g} the cost"]
    return ", ".join([*parts, *([f"error ~ {cause.law}"] if cause.law else [])])
