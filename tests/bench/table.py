"""Writes the benchmark's results as tables of 80 columns, and the adapters' rows as CSV.

The tables: adapters against plain loops (`head`, `line`, `summary`), our integrators against
scipy's (`reference`), large scenes (`growth`), and the start of commands (`start`).
"""

import csv
import io
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import astuple, fields
from inspect import cleandoc
from itertools import chain, groupby
from textwrap import fill, shorten, wrap

import numpy as np

from textmech.engines.engine import Engine

from .adapters import LOOPS, Amount, Row
from .growth import Grown
from .integrators import Compared
from .start import UNIT, Begun
from .turns import Ratio

AIMS = {"native": 1.05, "law": 1.05, "driver": 1.05, "recorded": 1.3, "building": 1.3}
"""The ratios of CPU time to the plain loop's that are aimed at, by what is measured.

native, law, driver: a run that reads at samples, by how its plan is realised; recorded: one that
reads every step; building: scenes for a ladder of steps.
"""
REFERENCE_AIM = 0.5  # of our integrator's CPU time over that of the best of scipy's methods

HEAD = (
    "CPU time over the plainest loop a user would write for the same motion: in turns, the median "
    "of {rounds} rounds, ± half of what the middle half of them spans. Both sides build their "
    "scene and take {count} steps over the case's duration. The loop keeps nothing; a run reads "
    "states and forces, at samples, or at every step too. Building: without a step, for a ladder "
    "of {rungs} steps. Apart: the ends of the two motions."
)


def head(amount: Amount, rungs: int, engines: Iterable[Engine]) -> str:
    """Returns the table's head: what is compared, each plain loop in its words, the columns."""
    count = amount.steps * amount.samples
    docs = {e.name: LOOPS[e.name].__doc__ or "" for e in engines if e.name in LOOPS}
    loops = {name: cleandoc(doc).partition("\n")[0] for name, doc in docs.items()}
    told = [fill(f"  {name}: {text}", 80, subsequent_indent="    ") for name, text in loops.items()]
    columns = f"{'a step':>8}{f'{amount.steps} a sample':>13}{'every step':>13}{'building':>12}"
    said = fill(HEAD.format(rounds=amount.rounds, count=count, rungs=rungs), 80)
    return "\n".join([said, *told, "", f"{'':27}{columns}{'apart':>7}"])


def line(row: Row) -> str:
    """Returns the line of one plan: its ratios, or why there are none."""
    name = f"  {row.engine}.{row.setting}"
    name += "" if row.realised == "native" else f" ({row.realised})"
    if row.because:
        told = f", {row.apart:.0e} apart" if row.differs else ""
        return f"{name:27} {shorten(row.because + told, 52, placeholder=' …')}"
    ratios = f"{row.samples!s:>13}{row.recorded!s:>13}{row.building!s:>12}"
    apart = f"{row.apart:.0e}" if row.apart else "0"
    return f"{name:27}{row.step * 1e6:5.1f} µs{ratios}{apart:>7}"


def summary(rows: Sequence[Row]) -> Iterator[str]:
    """Yields the lines of the summary: by engine, the median and the largest of each of AIMS."""
    yield f"{'median (most)':15}" + "".join(f"{kind:>13}" for kind in AIMS)
    yield f"{'aim':15}" + "".join(f"{f'{aim:.2f}':>13}" for aim in AIMS.values())
    measured = [row for row in rows if not row.because]
    for engine, found in groupby(sorted(measured, key=_engine), key=_engine):
        ratios = list(found)
        cells = (_cell([ratio.median for ratio in _kind(ratios, kind)]) for kind in AIMS)
        yield f"{engine:15}" + "".join(f"{cell:>13}" for cell in cells)


def _engine(row: Row) -> str:
    return row.engine


def _kind(rows: Iterable[Row], kind: str) -> Iterator[Ratio]:
    """Yields the ratios of one kind of AIMS.

    native, law and driver are no fields of a row: there it is the samples' ratio of such a plan.
    """
    for row in rows:
        if kind == "recorded" and row.realised != "native":
            continue  # else the cost of the law or the driver would be counted here again
        found = getattr(row, kind, row.samples if row.realised == kind else None)
        if found is not None:
            yield found


def _cell(ratios: list[float]) -> str:
    """Returns `1.03 (1.10)`, the median and the largest, or a dash if there is none."""
    return f"{np.median(ratios):.2f} ({max(ratios):.2f})" if ratios else "–"


def reference(rows: Iterable[Compared]) -> Iterator[str]:
    """Yields the lines of the table of our integrators' CPU time against scipy's, to one error."""
    yield f"{'the reference':24}{'error':>8}{'ours':>12}{'over the best of scipy':>32}"
    yield f"{'aim':24}{'':20}{REFERENCE_AIM:>25.2f}"
    for row in rows:
        against = f"{row.best} {row.ratio}" if row.ratio else row.best
        yield f"  {row.case:22}{row.error:8.0e}{row.ours * 1e3:9.1f} ms{against:>32}"


def start(rows: Iterable[Begun]) -> Iterator[str]:
    """Yields the lines of the table of what commands cost before their work begins."""
    yield f"{'the start of':24}{'CPU time':>10}{'bound':>10}{f'over {UNIT}':>20}"
    for row in rows:
        above = "  above" if row.seconds > row.bound else ""
        yield f"  {row.name:22}{row.seconds:8.2f} s{row.bound:8.2f} s{row.over:>20.1f}{above}"


def growth(rows: Iterable[Grown]) -> Iterator[str]:
    """Yields the lines of the table of large scenes, as they are measured, with the refusals."""
    yield f"{'reading and certifying':32}{'CPU s':>8}{'bound':>8}"
    for row in rows:
        yield f"  {row.scene:30}{row.seconds:8.1f}{row.bound:8.0f}"
        yield from (f"    {words}" for words in wrap(row.refusal, 76))


_RATIOS = ("samples", "recorded", "building")


def as_csv(rows: Iterable[Row]) -> str:
    """Returns the adapters' rows as CSV, each ratio in two columns: its median and its spread."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    names = [field.name for field in fields(Row)]
    pairs = ((name, f"{name}_spread") if name in _RATIOS else (name,) for name in names)
    writer.writerow(chain.from_iterable(pairs))
    for row in rows:
        writer.writerow(chain.from_iterable(_cells(getattr(row, name), name) for name in names))
    return text.getvalue()


def _cells(value: object, name: str) -> Sequence[object]:
    """Returns the cells of a field: two of a ratio, empty if it was not measured, else one."""
    if name in _RATIOS:
        return [f"{x:.3g}" for x in astuple(value)] if isinstance(value, Ratio) else ["", ""]
    return [f"{value:.3g}" if isinstance(value, float) else value]
