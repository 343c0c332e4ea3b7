"""The pictures of one case and quantity on paper: mechanism, tube, error, ladder."""

from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter

from ....cases.scene.rotation import turned
from ....cases.trajectory import Array
from ...tables.row import Comparison, Rungs, StepError
from ...tables.short_numbers import factor
from ...tables.spoken import spoken
from .column import Column, column, ordered
from .drawing import LIMIT, Motion
from .heat import short
from .paint import INK, style
from .poses import read

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
    strobe(axes[0, 0], motion, [column for column in shown if column.key in motion["ghosts"]])
    if motion["against"] == LIMIT:
        axes[0, 0].set_title("\n".join(_worst(rows)), fontsize=9, loc="left")
    curves = motion["curves"]["quantities"].get(quantity)
    if curves is None:
        for panel in (axes[0, 1], axes[1, 0]):
            panel.set_axis_off()
    else:
        unit = own[0].unit if own else ""
        times = np.array(motion["curves"]["times"])
        label = f"{quantity} [{unit}]"
        _tube(axes[0, 1], times, curves, shown, allowed, label, motion["against"])
        _error(axes[1, 0], times, curves, shown, allowed, own)
        if until := motion["curves"].get("until"):
            for panel in (axes[0, 1], axes[1, 0]):
                panel.axvspan(until, times[-1], hatch="//", fc="none", ec=INK, alpha=0.25, lw=0)
            late = f"later than {until:.3g} s nothing is judged"
            axes[1, 0].set_title(late, loc="right", fontsize=9)
    climbed = [step for step in steps if step.quantity == quantity]
    _ladder(axes[1, 1], [rung for rung in rungs if rung.quantity == quantity], climbed, allowed)
    lines = {}
    for panel in axes.ravel()[1:]:
        lines |= dict(zip(*reversed(panel.get_legend_handles_labels()), strict=True))
    place = {"loc": "outside lower left", "ncols": 3, "frameon": False, "fontsize": 9}
    figure.legend(lines.values(), lines, **place)
    return figure


def _worst(rows: Sequence[Comparison]) -> Iterator[str]:
    """Yields a line of text for each setting: its largest ratio, or its verdict if it has none."""
    worst = {column(row): row for row in sorted(rows, key=lambda row: row.ratio or 0.0)}
    for shown in ordered(worst):
        row = worst[shown]
        far = (
            spoken(row.verdict)
            if row.ratio is None
            else (f"{row.quantity} {factor(row.ratio)} of what is allowed")
        )
        yield f"{shown.setting}: {far}"


def _tube(
    axes: Any,
    times: Array,
    curves: Any,
    shown: Sequence[Column],
    allowed: float,
    label: str,
    against: str = "reference",
) -> None:
    reference = np.array(curves["reference"])
    axes.fill_between(times, reference - allowed, reference + allowed, color=INK, alpha=0.12, lw=0)
    axes.plot(times, reference, color=INK, lw=2, label=against)
    low, high = np.min(reference) - allowed, np.max(reference) + allowed
    bottom, top, away = low - ROOM * (high - low), high + ROOM * (high - low), []
    for shown_column, off in _errors_of(curves, shown):
        if "values" in off:  # at its own samples
            x, y = np.array(off["times"]), np.array(off["values"])
        else:
            x, y = times, reference + off["curve"]
        _curve(axes, x, y, shown_column, shown)
        if np.min(y) < bottom or np.max(y) > top:
            most = short(float(np.max(np.abs(off["curve"]))))
            away.append(f"{shown_column.title} leaves the picture: off by up to {most}")
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
    for shown_column, off in _errors_of(curves, shown):
        own = np.array(off.get("times", times))
        parts = np.abs(off["curve"]) / allowed
        _curve(axes, own, np.maximum(parts, LEAST), shown_column, shown)
    _bound(axes)
    rated = [row for row in rows if row.when is not None and row.ratio]
    if rated:
        worst = max(rated, key=lambda row: row.ratio or 0.0)
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
    both = len({rung.ladder for rung in rungs}) > 1
    for rung in rungs:
        own = [s for s in steps if (column(s), s.ladder) == (column(rung), rung.ladder)]
        milliseconds = [1e3 * step.step for step in own]
        parts = [step.error / allowed for step in own]
        order = "" if rung.order is None else f", order {rung.order:.2g}"
        label = f"{column(rung).title}{f', {rung.ladder}' if both else ''}{order}"
        look = {**style(column(rung), kinds), "lw": 1.0 if rung.ladder == "held" else 1.6, "ms": 4}
        axes.plot(milliseconds, np.maximum(parts, LEAST), label=label, **look)
    axes.set(xscale="log", xlabel="step h [ms]", ylabel="error / allowed")
    axes.xaxis.set_minor_formatter(NullFormatter())
    _bound(axes)


def _errors_of(curves: Any, shown: Sequence[Column]) -> list[tuple[Column, Any]]:
    return [(column, curves["off"][column.key]) for column in shown if column.key in curves["off"]]


def _curve(axes: Any, x: Array, y: Array, of: Column, among: Sequence[Column]) -> None:
    every = max(1, len(x) // 5)
    first = every * among.index(of) // len(among)  # or one marker would hide another
    axes.plot(x, y, lw=1.3, ms=4, markevery=(first, every), **style(of, among))


def _bound(axes: Any) -> None:
    axes.set_yscale("log")
    axes.yaxis.set_minor_formatter(NullFormatter())
    axes.axhline(1.0, color=INK, lw=0.8, ls=":")
    axes.axhspan(axes.get_ylim()[0], 1.0, color=INK, alpha=0.05, lw=0)
    axes.grid(color=INK, alpha=0.15, lw=0.5)


# A mechanism on paper: the reference at several instants, the engines where they end.


INSTANTS = 7
AZIMUTH, ELEVATION = np.radians(35.0), np.radians(20.0)  # as the page looks at space

Pose = Mapping[str, Array]


def strobe(axes: Any, motion: Motion, ghosts: Sequence[Column]) -> None:
    """Draws a mechanism in motion; ghosts: ways whose last instant is drawn beside it.

    The scale is the mechanism's: a ghost that fell away leaves the picture.
    """
    drawn = read(motion)
    shares = np.linspace(0.0, 1.0, INSTANTS)
    frames = drawn.at(drawn.times[0] + shares * np.ptp(drawn.times))
    for k, share in enumerate(shares.tolist()):
        now = {part: rows[k] for part, rows in frames.items()}
        _bodies(axes, motion, now, color=INK, alpha=0.2 + 0.8 * share, lw=1.6)
    _links(axes, motion, {part: rows[-1] for part, rows in frames.items()})
    if motion["trail"]:
        trail = _seen(np.transpose(motion["trail"]))
        axes.plot(*trail.T, color=INK, lw=0.8, alpha=0.5)
    axes.set_aspect("equal", adjustable="datalim")
    limits = axes.dataLim.frozen()
    for way in ghosts:
        ends = {part: pose[-1] for part, (pose, _) in read(motion["ghosts"][way.key]).moves.items()}
        code = style(way, ghosts)["color"]
        _bodies(axes, motion, ends, color=code, ls="--", lw=1.3, label=way.title)
    axes.dataLim.set(limits)  # what drifts far away is cut off
    axes.autoscale_view()
    for place in motion["sketch"]["ground"]:
        axes.plot(*_seen(np.array([place])).T, marker=6, color=INK, ms=8, alpha=0.6)
    axes.set_axis_off()
    axes.set_title(f"{INSTANTS} instants, the last in full ink", fontsize=9, loc="left")


def _bodies(axes: Any, motion: Motion, now: Pose, **look: Any) -> None:
    label = look.pop("label", None)
    for name, body in motion["sketch"]["bodies"].items():
        if name not in now:
            continue
        for line in body["lines"]:
            axes.plot(*_seen(_placed(now[name], np.array(line))).T, label=label, **look)
            label = None
        if body["dot"]:
            centre = _seen(now[name][None, : motion["axes"]]).T
            axes.plot(*centre, marker="o", ms=6, label=label, **look)
            label = None


def _links(axes: Any, motion: Motion, now: Pose) -> None:
    for link in motion["sketch"]["links"]:
        ends = [_placed(now[p], np.array([place]))[0] if p else place for p, place in link["ends"]]
        axes.plot(*_seen(np.array(ends)).T, color=INK, lw=0.8, ls=":")


def _placed(pose: Array, places: Array) -> Array:
    """(K, 2 or 3) in ground axes of places (K, 2 or 3) on a part."""
    n = places.shape[1]
    if len(pose) == n:  # a driven point of the ground, and a particle
        return pose + places
    if n == 3:
        return pose[:3] + turned(pose[3:], places)
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    return pose[:2] + places @ np.array([[cos, sin], [-sin, cos]])


def _seen(places: Array) -> Array:
    """(K, 2): the plane as it is, space from the side and above."""
    if places.shape[1] == 2:
        return places
    x, y, z = places.T
    across = -np.sin(AZIMUTH) * x + np.cos(AZIMUTH) * y
    towards = np.cos(AZIMUTH) * x + np.sin(AZIMUTH) * y
    return np.stack([across, z * np.cos(ELEVATION) - towards * np.sin(ELEVATION)], axis=1)
