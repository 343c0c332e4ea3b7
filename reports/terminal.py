"""What a run shows on the terminal: progress while it works, a table at the end."""

import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import click
import pandas as pd

from reports.row import AGREES, FAILS
from reports.suite import Progress
from reports.summary import summary


@contextmanager
def progress() -> Iterator[Progress]:
    """A bar for each phase on the error stream; plain lines where that is no terminal."""
    terminal = sys.stderr.isatty()

    def show(what: str, done: int, total: int) -> None:
        if terminal:
            filled = 30 * done // max(total, 1)
            bar = "#" * filled + "." * (30 - filled)
            click.echo(f"\r{what:12}[{bar}] {done}/{total}", nl=done == total, err=True)
        elif done == total:
            click.echo(f"{what}: {total}", err=True)

    try:
        yield show
    except BaseException:
        if terminal:
            click.echo(err=True)
        raise


def show(frames: dict[str, pd.DataFrame], *, detailed: bool, written: Path | None) -> None:
    """The rows of named cases, or the summary of all; then what fails, and where it was written."""
    tolerance, convergence = frames["tolerance.csv"], frames["convergence.csv"]
    if detailed:
        _rows(tolerance)
    click.echo()
    click.echo(_aligned(summary(tolerance, convergence)))
    click.echo()
    broken = frames["reference.csv"]
    for row in broken[broken["verdict"] == FAILS].itertuples():
        click.echo(f"FAILS: {row.case}: reference: {row.check}: {row.difference:.2e} > {row.bound:.1e}")
    fails = tolerance[tolerance["verdict"] == FAILS]
    for (case, because), rows in fails.groupby(["case", "because"], sort=False):
        first = rows.iloc[0]
        what = f"{first['engine']}.{first['setting']} {first['quantity']}"
        more = f" and {len(rows) - 1} more rows" if len(rows) > 1 else ""
        click.echo(f"FAILS: {case}: {what}{more}: {because}")
    counts = tolerance["verdict"].str.split(":").str[0].value_counts()
    click.echo(", ".join(f"{count} {word}" for word, count in counts.items()))
    if written is not None:
        click.echo(f"written to {written}")


def _rows(tolerance: pd.DataFrame) -> None:
    for (case, engine, setting, realised), rows in tolerance.groupby(
        ["case", "engine", "setting", "realised"], sort=False
    ):
        first = rows.iloc[0]
        how = "" if realised == "native" else f" ({realised})"
        click.echo(f"\n{case} in {engine} {first['version']} {setting}{how}")
        if first["protocol"]:
            click.echo(f"  {first['protocol']}")
        for row in rows.itertuples():
            click.echo("  " + _line(row))


def _line(row) -> str:
    if pd.isna(row.largest):
        return f"{row.quantity:20} {row.verdict} {row.because}"
    step = "" if pd.isna(row.step) else f"at h = {row.step:g} s"
    number = f"{row.largest:9.2e} {row.unit:6} {step:18}"
    allowed = "" if pd.isna(row.allowed) else f"allowed {row.allowed:.1e}"
    reason = f" ({row.because})" if row.because and row.verdict != AGREES else ""
    return f"{row.quantity:20} {number} {allowed:16} {row.verdict}{reason}"


def _aligned(table: pd.DataFrame) -> str:
    rows = [list(table.columns), *[[str(x) for x in row] for row in table.itertuples(index=False)]]
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    return "\n".join(
        "  ".join(f"{cell:{width}}" for cell, width in zip(row, widths, strict=True)).rstrip()
        for row in rows
    )
