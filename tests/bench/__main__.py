"""Measures what adapters, the reference and commands cost, and prints one table: `make bench`."""

import sys
from collections.abc import Iterator
from itertools import chain

import click
import pandas as pd

from textmech.cases.case import Case
from textmech.engines.engine import Engine
from textmech.reports.front import cli
from textmech.reports.front.command.options import FAILED, named_cases, named_engines
from textmech.reports.front.show.console import say, tell
from textmech.reports.runs.selection import choose_cases, choose_engines

from . import adapters
from .reference import integrators, scenes
from .row import Row
from .start import starts


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
@click.option("--csv", "as_csv", is_flag=True, help="Print the rows as CSV instead.")
def bench(
    cases: tuple[str, ...], names: tuple[str, ...], rounds: int, steps: int, as_csv: bool
) -> None:
    """What our adapters cost over the bare engines, and our integrators over scipy's.

    Each ratio is of CPU times measured in turn in one run: 1.05 is 5 % more than the plainest loop
    that a user would write for the same motion in the same engine. Where a plain loop ends
    elsewhere than the run, nothing is compared, and the exit code is 1.

    Without CASES, one variant of each shipped file, four systems of the reference beside DOP853,
    LSODA and Radau of scipy, chains of many bodies, and what commands cost to start, in a few
    minutes. Progress goes to standard error.

    \b
      make bench                                      all of it
      make bench WHAT="four_bar --engine mujoco"      one scene in one engine
      make bench WHAT="my_case.yaml --csv"            your own scene, for a spreadsheet
    """
    chosen = choose_cases(cases) if cases else adapters.one_of_each_file()
    engines = [engine for engine in choose_engines(names, []) if engine.name in adapters.LOOPS]
    if not engines:
        raise click.UsageError("no engine of these has a plain loop to be measured against")
    everything = not (cases or names)
    rows = []
    for row in _rows(chosen, engines, rounds, steps, everything=everything):
        tell(f"{row.part} {row.name} {row.over}")
        rows.append(row)
    table = pd.DataFrame(rows)
    say(table.to_csv(index=False) if as_csv else text(table), nl=not as_csv)
    if table["wrong"].any():
        raise click.exceptions.Exit(FAILED)


def _rows(
    cases: list[Case], engines: list[Engine], rounds: int, steps: int, *, everything: bool
) -> Iterator[Row]:
    for case in cases:
        yield from adapters.rows(case, engines, steps, rounds)
    if everything:
        yield from chain(integrators(rounds), scenes(), starts(rounds))


def text(table: pd.DataFrame) -> str:
    """Returns the table, below it the median and the largest ratio to each kind of work."""
    shown = table.drop(columns="wrong").round(3).to_string(index=False, na_rep="", justify="left")
    measured = table.dropna(subset="ratio").groupby("over")[["ratio", "aim"]]
    if not len(measured):
        return shown
    summary = measured.agg({"ratio": ["median", "max"], "aim": "first"}).round(3)
    return f"{shown}\n\n{summary.to_string()}"


if __name__ == "__main__":  # with what every command says of its mistakes
    cli.command.add_command(bench)
    sys.argv.insert(1, bench.name or "")
    cli.main()
