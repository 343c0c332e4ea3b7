"""Work against precision, a panel for each theme: how many of its cases a step is enough for."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from matplotlib.figure import Figure

from ..row import Comparison, Rungs
from .column import Column, column
from .paint import INK, style, svg

SHOWN = ("pins", "loops", "springs", "rolling", "friction", "impacts", "space")
PRECISIONS = ((1.0, 1.5), (1e-2, 0.7))  # parts of what is allowed, each with the width of its line
ACROSS = 4
ANY = "any way"  # native, or with a law or a driver of ours: whichever takes the larger step
LEAST, MOST = 10.0, 1e5  # steps per second that are shown

Steps = Mapping[tuple[str, Column], Mapping[float, float]]
"""By case and column: step [s] → the worst error there, over allowed."""


def work(
    rows: Sequence[Comparison], rungs: Sequence[Rungs], themes: Mapping[str, tuple[str, ...]]
) -> str:
    """The figure as SVG, or nothing where there is no ladder of any theme."""
    ladders = worst(rows, rungs)
    moving = {case: about for case, about in themes.items() if "states" not in about}
    panels = [(theme, [case for case in moving if theme in moving[case]]) for theme in SHOWN]
    told = [(theme, cases) for theme, cases in panels if any(at[0] in cases for at in ladders)]
    if not told:
        return ""
    down = -(-(len(told) + 1) // ACROSS)
    figure = Figure(figsize=(2.9 * ACROSS, 2.7 * down), layout="constrained")
    axes = figure.subplots(down, ACROSS, sharex=True, sharey=True, squeeze=False).ravel()
    lines: dict[str, Any] = {}
    for one, (theme, cases) in zip(axes, told, strict=False):
        lines |= _panel(one, theme, cases, ladders)
    for one in axes[len(told) :]:
        one.set_axis_off()
    axes[len(told)].legend(lines.values(), lines, loc="center left", frameon=False, fontsize=9)
    figure.supxlabel("steps per simulated second", fontsize=10)
    figure.supylabel("cases within tolerance [%]", fontsize=10)
    return svg(figure, "work")


def worst(rows: Iterable[Comparison], rungs: Iterable[Rungs]) -> Steps:
    """Of each case's first ladder: tuned numbers follow the step, where any are tied to it."""
    allowed = {(row.case, column(row), row.quantity): row.allowed for row in rows}
    found: dict[tuple[str, Column], dict[str, dict[float, float]]] = {}
    for rung in rungs:
        allow = allowed.get((rung.case, column(rung), rung.quantity))
        if not allow or rung.engine == "book":
            continue
        at = found.setdefault((rung.case, column(rung)), {}).setdefault(rung.ladder, {})
        for h, error in zip(rung.steps.split(), rung.errors.split(), strict=False):
            at[float(h)] = max(at.get(float(h), 0.0), float(error) / allow)
    return {
        at: ladders["following" if "following" in ladders else "held"]
        for at, ladders in found.items()
    }


def enough(ladder: Mapping[float, float], precision: float) -> float | None:
    """The largest step from which on, downward, all is within that part of what is allowed."""
    largest = None
    for h in sorted(ladder):
        if not ladder[h] <= precision:
            break
        largest = h
    return largest


def _panel(axes: Any, theme: str, cases: Sequence[str], ladders: Steps) -> dict[str, Any]:
    """Its lines, drawn, and one of each kind by its label."""
    axes.set(xscale="log", xlim=(LEAST, MOST), ylim=(-3, 103))
    count = f"{len(cases)} case" if len(cases) == 1 else f"{len(cases)} cases"
    axes.set_title(f"{theme}: {count}", fontsize=10, loc="left")
    axes.grid(color=INK, alpha=0.15, lw=0.5)
    axes.tick_params(labelsize=9)
    lines: dict[str, Any] = {}
    for of in _kinds(ladders):
        for precision, width in PRECISIONS:
            x, y = profile(of, cases, ladders, precision)
            look = style(of) if precision == 1.0 else {**style(of), "marker": ""}
            ends = {"drawstyle": "steps-post", "markevery": slice(1, -1), "markersize": 3.5}
            (line,) = axes.plot(x, y, lw=width, **look, **ends)
            lines.setdefault(_label(of), line)
    return lines


def _kinds(ladders: Steps) -> list[Column]:
    """Of every engine the settings by themselves, and those with our laws where there are any."""
    seen = {of for _, of in ladders}
    native = {of for of in seen if of.realised == "native"}
    helped = {Column(of.engine, of.setting, ANY) for of in seen - native}
    return sorted(native | helped)


def _label(of: Column) -> str:
    return f"{of.engine} {of.setting}" + (" + law or driver" if of.realised == ANY else "")


def profile(
    of: Column, cases: Sequence[str], ladders: Steps, precision: float
) -> tuple[list[float], list[float]]:
    """Steps per second, and the share [%] of all the theme's cases that so many are enough for."""
    steps: list[float] = []
    for case in cases:
        ways = [
            ladder
            for (name, other), ladder in ladders.items()
            if name == case
            and (other.engine, other.setting) == (of.engine, of.setting)
            and of.realised in (ANY, other.realised)
        ]
        found = [h for ladder in ways if (h := enough(ladder, precision))]
        if found:
            steps.append(1 / max(found))
    corners = sorted(set(steps))
    shares = [100 * sum(step <= x for step in steps) / len(cases) for x in corners]
    return [LEAST, *corners, MOST], [0.0, *shares, max(shares, default=0.0)]
