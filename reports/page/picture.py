"""The pictures of one case and quantity on paper: mechanism, tube, error, ladder."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from ...cases.trajectory import Array
from ..data.row import Comparison, Rungs, StepError
from .column import Column, column
from .heat import short
from .motions import Motion
from .pack import unpacked, unpacked_by_size
from .paint import INK, style
from .strobe import strobe

ROOM = 0.9  # of the tube's height, above and below it: further off is out of the picture
LEAST = 1e-9  # of error over allowed: below that nothing is drawn


def picture(
    name: str,
    quantity: str,
    motion: Motion,
    rows: Sequence[Comparison],
    rungs: Sequence[Rungs],
    steps: Sequence[StepError],
) -> Figure:
    """Draws a quantity of one case, from the rows of that case.

    What has no curve, as the time of an event, has a ladder alone beside the mechanism.
    """
    own = [row for row in rows if row.quantity == quantity]
    allowed = next((row.allowed for row in own if row.allowed), 1.0)
    figure = Figure(figsize=(10, 7.2), layout="constrained")
    axes = figure.subplots(2, 2)
    figure.suptitle(f"{name}: {quantity}", fontsize=12, x=0.01, ha="left")
    shown = list(dict.fromkeys(column(row) for row in own if row.error is not None))
    strobe(axes[0, 0], motion, [one for one in shown if one.key in motion["ghosts"]])
    curves = motion["curves"]["quantities"].get(quantity)
    if curves is None:
        for one in (axes[0, 1], axes[1, 0]):
            one.set_axis_off()
    else:
        unit = own[0].unit if own else ""
        times = unpacked(motion["curves"]["times"])
        _tube(axes[0, 1], times, curves, shown, allowed, f"{quantity} [{unit}]")
        _error(axes[1, 0], times, curves, shown, allowed, own)
    climbed = [one for one in steps if one.quantity == quantity]
    _ladder(axes[1, 1], [rung for rung in rungs if rung.quantity == quantity], climbed, allowed)
    lines = {}
    for one in axes.ravel()[1:]:
        lines |= dict(zip(*reversed(one.get_legend_handles_labels()), strict=True))
    place = {"loc": "outside lower left", "ncols": 3, "frameon": False, "fontsize": 9}
    figure.legend(lines.values(), lines, **place)
    return figure


def _tube(
    axes: Any, times: Array, curves: Any, shown: Sequence[Column], allowed: float, label: str
) -> None:
    reference = unpacked(curves["reference"])
    axes.fill_between(times, reference - allowed, reference + allowed, color=INK, alpha=0.12, lw=0)
    axes.plot(times, reference, color=INK, lw=2, label="reference")
    low, high = np.min(reference) - allowed, np.max(reference) + allowed
    bottom, top, away = low - ROOM * (high - low), high + ROOM * (high - low), []
    for one, off in _off(curves, shown):
        if "values" in off:  # at its own samples
            x, y = unpacked(off["times"]), unpacked(off["values"])
        else:
            x, y = times, reference + unpacked_by_size(off["curve"])
        _curve(axes, x, y, one, shown)
        if np.min(y) < bottom or np.max(y) > top:
            most = short(float(np.max(np.abs(unpacked_by_size(off["curve"])))))
            away.append(f"{one.title} leaves the picture: off by up to {most}")
    low, high = axes.get_ylim()
    axes.set_ylim(max(bottom, low), min(top, high))
    axes.text(0.01, 0.99, "\n".join(away), transform=axes.transAxes, va="top", fontsize=8)
    axes.set(xlabel="t [s]", ylabel=label)


def _error(
    axes: Any,
    times: Array,
    curves: Any,
    shown: Sequence[Column],
    allowed: float,
    rows: Sequence[Comparison],
) -> None:
    for one, off in _off(curves, shown):
        own = unpacked(off["times"]) if "times" in off else times
        parts = np.abs(unpacked_by_size(off["curve"])) / allowed
        _curve(axes, own, np.maximum(parts, LEAST), one, shown)
    _bound(axes)
    told = [row for row in rows if row.when is not None and row.ratio]
    if told:
        worst = max(told, key=lambda row: row.ratio or 0.0)
        axes.plot([worst.when], [worst.ratio], "o", ms=10, mfc="none", color=INK)
        axes.annotate(
            f"{short(worst.ratio or 0.0)} × at {worst.when:.3g} s",
            (worst.when, worst.ratio),
            xytext=(-8, 8),
            textcoords="offset points",
            ha="right",
            fontsize=9,
        )
        axes.set_ylim(top=max(axes.get_ylim()[1], 10 * (worst.ratio or 0.0)))
    axes.set(xlabel="t [s]", ylabel="error / allowed")


def _ladder(axes: Any, rungs: Sequence[Rungs], steps: Sequence[StepError], allowed: float) -> None:
    kinds = [column(rung) for rung in rungs]
    for rung in rungs:
        own = [s for s in steps if (column(s), s.ladder) == (column(rung), rung.ladder)]
        milliseconds = [1e3 * one.step for one in own]
        parts = [one.error / allowed for one in own]
        order = "" if rung.order is None else f", order {rung.order:.2g}"
        label = f"{column(rung).title}, {rung.ladder}{order}"
        look = {**style(column(rung), kinds), "lw": 1.0 if rung.ladder == "held" else 1.6, "ms": 4}
        axes.plot(milliseconds, np.maximum(parts, LEAST), label=label, **look)
    axes.set(xscale="log", xlabel="step h [ms]", ylabel="error / allowed")
    axes.xaxis.set_minor_formatter(NullFormatter())
    _bound(axes)


def _off(curves: Any, shown: Sequence[Column]) -> list[tuple[Column, Any]]:
    return [(one, curves["off"][one.key]) for one in shown if one.key in curves["off"]]


def _curve(axes: Any, x: Array, y: Array, of: Column, among: Sequence[Column]) -> None:
    every = max(1, len(x) // 5)
    axes.plot(x, y, lw=1.3, ms=4, markevery=every, **style(of, among))


def _bound(axes: Any) -> None:
    axes.set_yscale("log")
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.axhline(1.0, color=INK, lw=0.8, ls=":")
    axes.axhspan(axes.get_ylim()[0], 1.0, color=INK, alpha=0.05, lw=0)
    axes.grid(color=INK, alpha=0.15, lw=0.5)
