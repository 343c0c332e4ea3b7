"""The README's picture: how far off the cases are at worst, as shipped and tuned, from the reports.

`python -m textmech.reports.front.show.readme` draws it.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import StringIO
from math import inf
from typing import Any

import numpy as np
from matplotlib import rc_context
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import FixedLocator, FuncFormatter, PercentFormatter

from ...runs.selection import BOOK
from ...tables.row import REFUSED, Comparison

NAME = "shares.svg"
SIZE = (7.2, 3.4)  # inches
SMALL = (4.8, 2.3)  # inches: on a telephone a letter of its text is 9 pixels high
LEAST, MOST = 1e-6, 1e4  # × allowed
COLOURS = ("#0072B2", "#D55E00", "#009E73")  # told apart by the colour-blind, too
OWN = (("#CC79A7", (0, (2, 1))), ("#E69F00", (0, (1, 2))), ("#56B4E9", (0, (8, 2))))
"""Of a person's own settings: colour and dash, as the page has them."""
LINES = {"shipped": (0, (3, 1.5)), "recommended": (0, (6, 1.5, 1, 1.5)), "tuned": "solid"}
TICKS = {1e-6: "1e-6", 1e-4: "1e-4", 1e-2: "0.01", 1.0: "1", 1e2: "100", 1e4: "1e4"}
STYLE: dict[Any, Any] = {
    "svg.hashsalt": "textmech",  # the same bytes from the same rows
    "svg.fonttype": "none",
    "font.family": "sans-serif",
    "font.sans-serif": ["DejaVu Sans"],
    "font.size": 9.0,
}


def picture(rows: Sequence[Comparison]) -> str:
    """The picture as the text of an SVG file."""
    with rc_context(STYLE):
        out = StringIO()
        drawn(rows).savefig(out, format="svg", metadata={"Date": None, "Creator": None})
    return "".join(f"{line.rstrip()}\n" for line in out.getvalue().splitlines())


@dataclass(frozen=True)
class Curve:
    """The curve of an engine's setting: how far off each case is at worst, and how it is drawn."""

    name: str
    ratios: Sequence[float]
    colour: str
    dash: Any

    @property
    def label(self) -> str:
        """The curve's name, and the share of the cases in which all is within."""
        within = sum(ratio <= 1 for ratio in self.ratios) / len(self.ratios)
        return f"{self.name}: {within:.0%} of {len(self.ratios)}"


def curves(rows: Sequence[Comparison]) -> Iterator[Curve]:
    """Yields the curve of each engine's setting; a person's own have colours of their own."""
    shares = worst(rows)
    engines = sorted({engine for engine, _ in shares})
    own = [key for key in shares if key[1] not in LINES]
    for (engine, setting), ratios in shares.items():
        look = (COLOURS[engines.index(engine) % len(COLOURS)], LINES.get(setting))
        if (engine, setting) in own:
            look = OWN[own.index((engine, setting)) % len(OWN)]
        yield Curve(f"{engine} {setting}", ratios, *look)


def drawn(rows: Sequence[Comparison], *, small: bool = False) -> Figure:
    """Draws all curves; small: as a telephone shows them, with the legend left to the page."""
    with rc_context(STYLE):
        figure = Figure(figsize=SMALL if small else SIZE, layout="constrained")
        axes = figure.add_subplot()
        for curve in curves(rows):
            _curve(axes, curve)
        _frame(axes)
        if small:
            axes.set_xlabel("worst error, over what is allowed")
        else:
            axes.legend(loc="upper left", title="within the tolerance", frameon=False)
    return figure


def worst(rows: Sequence[Comparison]) -> Mapping[tuple[str, str], list[float]]:
    """By engine and setting the worst ratio of each case that the engine itself answers."""
    cases: dict[tuple[str, str], dict[str, float]] = {}
    for row in rows:
        native = row.realised == "native" and row.engine != BOOK and row.quantity != "audit"
        if native and row.verdict != REFUSED:
            worst = cases.setdefault((row.engine, row.setting), {})
            ratio = inf if row.ratio is None else row.ratio
            worst[row.case] = max(worst.get(row.case, 0.0), ratio)
    return {key: sorted(ratios.values()) for key, ratios in sorted(cases.items())}


def _curve(axes: Axes, curve: Curve) -> None:
    """Returns the share of the cases that are at worst so far off."""
    ratios = curve.ratios
    x = np.clip([LEAST, *ratios, MOST], LEAST, MOST)
    finite = sum(ratio <= MOST for ratio in ratios)
    counts = [0, *np.minimum(np.arange(1, len(ratios) + 1), finite), finite]
    axes.step(
        x,
        np.array(counts) / len(ratios),
        where="post",
        color=curve.colour,
        linestyle=curve.dash,
        linewidth=1.8,
        label=curve.label,
    )


def _frame(axes: Axes) -> None:
    axes.axvline(1.0, color="0.35", linewidth=0.8)
    axes.set_xscale("log")
    axes.set_xlim(LEAST, MOST)
    axes.set_ylim(0, 1)
    axes.xaxis.set_major_locator(FixedLocator([*TICKS]))
    axes.xaxis.set_major_formatter(FuncFormatter(lambda ratio, _: TICKS[ratio]))
    axes.xaxis.set_minor_locator(FixedLocator([]))
    axes.yaxis.set_major_formatter(PercentFormatter(1.0))
    axes.set_xlabel("the worst quantity's error, over what the textbook's tolerance allows")
    axes.set_ylabel("share of the cases")
    axes.spines[["top", "right"]].set_visible(False)
