"""Measures what adapters and integrators cost, and prints tables: `make bench`."""

import sys
import warnings
from itertools import chain

import click

from textmech.reports import cli
from textmech.reports.batch.selection import choose_cases, choose_engines
from textmech.reports.command.options import FAILED, allow_long, named_cases, named_engines
from textmech.reports.show.console import say

from . import adapters, table
from .adapters import RUNGS, Amount, one_of_each_file
from .growth import grown
from .integrators import compared
from .start import begun


@click.command(short_help="What our adapters cost over the bare engines.")
@named_cases
@named_engines()
@click.option(
    "--rounds",
    type=click.IntRange(min=1),
    default=5,
    show_default=True,
    help="How often all are measured in turn. More rounds make the ratios steadier.",
)
@click.option(
    "--steps",
    type=click.IntRange(min=1),
    default=100,
    show_default=True,
    help="Steps a sample; there are 100 samples.",
)
@click.option("--start", "starts", is_flag=True, help="Only what commands cost to start.")
@click.option("--csv", "as_csv", is_flag=True, help="Print the adapters' rows as CSV instead.")
@allow_long
def bench(
    cases: tuple[str, ...],
    names: tuple[str, ...],
    rounds: int,
    steps: int,
    starts: bool,
    as_csv: bool,
    allow_long: bool,
) -> None:
    """What our adapters cost over the bare engines, and our integrators over scipy's.

    Each figure is a ratio of CPU times measured in turn in one run: 1.05 is 5 % more than the
    plainest loop that a user would write for the same motion in the same engine. Both sides build
    their scene within the time; the plain loop keeps nothing, a run reads states and forces. Where
    a plain loop ends elsewhere than the run, nothing is compared, and the exit code is 1.

    Without CASES, one variant of each shipped file, four systems of the reference beside DOP853,
    LSODA and Radau of scipy, scenes of up to 200 bodies, and what commands cost to start, in a few
    minutes.

    \b
      make bench                                      all of it
      make bench WHAT="four_bar --engine mujoco"      one scene in one engine
      make bench WHAT=--start                         what a command costs to start
      make bench WHAT="my_case.yaml --csv"            your own scene, for a spreadsheet
    """
    if starts:
        if cases or names or as_csv:
            raise click.UsageError("--start stands alone")
        for part in table.start(begun(rounds)):
            say(part)
        return
    chosen = choose_cases(cases, long=allow_long) if cases else one_of_each_file()
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # of an engine that cannot be imported: it is only left out
        engines = choose_engines(names, [])
    if not engines:
        raise click.UsageError("the book's approximations have no engine below them")
    amount = Amount(steps=steps, rounds=rounds)
    found = []
    if not as_csv:
        say(table.head(amount, RUNGS, engines))
    for case in chosen:
        if not as_csv:
            say(case.name)
        for row in adapters.rows(case, engines, amount):
            found.append(row)
            if not as_csv:
                say(table.line(row))
    if as_csv:
        say(table.as_csv(found), nl=False)
    else:
        say("\n".join(["", *table.summary(found)]))
        if not (cases or names):
            for part in chain(
                table.reference(compared(rounds)),
                ("",),
                table.growth(grown()),
                ("",),
                table.start(begun(rounds)),
            ):
                say(part)
    if any(row.differs for row in found):
        raise click.exceptions.Exit(FAILED)


if __name__ == "__main__":  # with what every command says of its mistakes
    cli.command.add_command(bench)
    sys.argv.insert(1, bench.name or "")
    cli.main()
