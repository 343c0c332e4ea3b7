"""Work against precision, a panel for each theme: the median of its cases, step by step."""

from collections.abc import Mapping, Sequence
from io import StringIO
from math import log10
from typing import Any

import matplotlib
import numpy as np
from matplotlib.figure import Figure

from ..row import Comparison, Rungs
from .column import Column, column
from .paint import INK, ink, style

SHOWN = ("pins", "loops", "springs", "rolling", "friction", "impacts", "space")
PER_DECADE = 4  # groups of steps: the cases have steps of their own
LEAST, MOST = 1e-6, 1e4  # of error over allowed: what is smaller or larger changes no choice
ACROSS = 3

Points = list[tuple[float, float]]


def work(
    rows: Sequence[Comparison], rungs: Sequence[Rungs], themes: Mapping[str, tuple[str, ...]]
) -> str:
    """The figure as SVG, or nothing where there is no ladder of any theme."""
    curves = _curves(rows, rungs)
    panels = [
        (theme, found)
        for theme in SHOWN
        if (found := {at: points for at, points in curves.items() if theme in themes.get(at[0], ())})
    ]
    if not panels:
        return ""
    down = -(-len(panels) // ACROSS)
    figure = Figure(figsize=(3.5 * ACROSS, 2.9 * down), layout="constrained")
    axes = figure.subplots(down, ACROSS, sharex=True, sharey=True, squeeze=False).ravel()
    for one, (theme, found) in zip(axes, panels, strict=False):
        _panel(one, theme, found)
    for one in axes[len(panels) :]:
        one.set_axis_off()
    labelled = {label: line for one in axes for line, label in zip(*one.get_legend_handles_labels(), strict=True)}
    figure.legend(labelled.values(), labelled.keys(), loc="outside lower center", ncols=4, frameon=False)
    figure.supxlabel("steps per simulated second", fontsize=9)
    figure.supylabel("worst error / allowed", fontsize=9)
    return svg(figure, "work")


def svg(figure: Figure, salt: str) -> str:
    """Without a date and with the same bytes every time; ink takes the colour of the page."""
    with matplotlib.rc_context({"svg.fonttype": "none", "svg.hashsalt": salt}):
        out = StringIO()
        figure.savefig(out, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
    return ink(out.getvalue())


def _curves(
    rows: Sequence[Comparison], rungs: Sequence[Rungs]
) -> dict[tuple[str, Column], Points]:
    """By case and column, of its first ladder: steps per second and the worst error there."""
    allowed = {(row.case, column(row), row.quantity): row.allowed for row in rows}
    worst: dict[tuple[str, Column], dict[str, dict[float, float]]] = {}
    for rung in rungs:
        allow = allowed.get((rung.case, column(rung), rung.quantity))
        if not allow or rung.engine == "book":
            continue
        at = worst.setdefault((rung.case, column(rung)), {}).setdefault(rung.ladder, {})
        for h, error in zip(rung.steps.split(), rung.errors.split(), strict=False):
            at[float(h)] = max(at.get(float(h), 0.0), float(error) / allow)
    return {
        at: sorted((1 / h, ratio) for h, ratio in ladders[_first(ladders)].items())
        for at, ladders in worst.items()
    }


def _first(ladders: Mapping[str, Any]) -> str:
    return "following" if "following" in ladders else "held"


def _panel(axes: Any, theme: str, curves: Mapping[tuple[str, Column], Points]) -> None:
    by: dict[Column, list[Points]] = {}
    for (_, of), points in curves.items():
        by.setdefault(of, []).append(points)
    axes.set(xscale="log", yscale="log", ylim=(LEAST / 2, MOST * 2))
    axes.set_title(f"{theme} ({len({case for case, _ in curves})} cases)", fontsize=9, loc="left")
    axes.axhspan(LEAST / 2, 1.0, color=INK, alpha=0.05, lw=0)
    axes.axhline(1.0, color=INK, lw=0.8)
    for of in sorted(by):
        x, low, middle, high = _middle(by[of])
        look = style(of)
        axes.plot(x, middle, label=of.title, markersize=4, lw=1.3, **look)
        axes.fill_between(x, low, high, color=look["color"], alpha=0.1, lw=0)
    axes.grid(color=INK, alpha=0.15, lw=0.5)
    axes.tick_params(labelsize=8)


def _middle(curves: Sequence[Points]) -> tuple[list[float], ...]:
    """Steps per second in groups; of each the quartiles of all errors there."""
    groups: dict[int, list[float]] = {}
    for points in curves:
        for x, ratio in points:
            groups.setdefault(round(PER_DECADE * log10(x)), []).append(min(max(ratio, LEAST), MOST))
    told = sorted(groups.items())
    quartiles = [np.percentile(ratios, (25, 50, 75)) for _, ratios in told]
    x = [10 ** (group / PER_DECADE) for group, _ in told]
    return (x, *(list(map(float, one)) for one in np.transpose(quartiles)))
