"""Work against precision, a panel for each theme: how many of its cases a step is enough for."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from ...tables.row import Comparison, StepError
from .column import Column, column

SHOWN = ("pins", "loops", "springs", "rolling", "friction", "impacts", "space")
PRECISIONS = (1.0, 1e-2)  # parts of what is allowed: the reader chooses one
ANY = "any way"  # native, or with a law or a driver of ours: whichever takes the larger step
LEAST, MOST = 10.0, 1e5  # steps per second that are shown

Steps = Mapping[tuple[str, Column], Mapping[float, float]]
"""By case and column: step [s] → the worst error there, over allowed."""


def work(
    rows: Sequence[Comparison], steps: Sequence[StepError], themes: Mapping[str, tuple[str, ...]]
) -> list[dict[str, Any]]:
    """Returns a panel for each theme that has a ladder: by column the curve of each precision."""
    ladders = worst(rows, steps)
    moving = {case: about for case, about in themes.items() if "states" not in about}
    panels = [(theme, [case for case in moving if theme in moving[case]]) for theme in SHOWN]
    return [
        {
            "theme": theme,
            "cases": len(cases),
            "curves": {
                of.key: [profile(of, cases, ladders, part) for part in PRECISIONS]
                for of in _kinds(ladders)
            },
        }
        for theme, cases in panels
        if any(at[0] in cases for at in ladders)
    ]


def worst(rows: Iterable[Comparison], steps: Iterable[StepError]) -> Steps:
    """Returns the worst error over allowed at each step [s] of one ladder a case and column.

    It is the one whose tuned numbers follow the step, or else the one where they are held.
    """
    allowed = {(row.case, column(row), row.quantity): row.allowed for row in rows}
    by_case: dict[tuple[str, Column], dict[str, dict[float, float]]] = {}
    for step in steps:
        allow = allowed.get((step.case, column(step), step.quantity))
        if not allow or step.engine == "book":
            continue
        at = by_case.setdefault((step.case, column(step)), {}).setdefault(step.ladder, {})
        at[step.step] = max(at.get(step.step, 0.0), step.error / allow)
    return {
        at: ladders["following" if "following" in ladders else "held"]
        for at, ladders in by_case.items()
    }


def enough(ladder: Mapping[float, float], precision: float) -> float | None:
    """The largest step from which on, downward, all is within that part of what is allowed."""
    largest = None
    for h in sorted(ladder):
        if not ladder[h] <= precision:
            break
        largest = h
    return largest


def _kinds(ladders: Steps) -> list[Column]:
    """Returns each engine's settings by themselves, and those with our laws where there are any."""
    seen = {of for _, of in ladders}
    native = {of for of in seen if of.realised == "native"}
    helped = {Column(of.engine, of.setting, ANY) for of in seen - native}
    return sorted(native | helped)


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
        allowed = [h for ladder in ways if (h := enough(ladder, precision))]
        if allowed:
            steps.append(1 / max(allowed))
    corners = sorted(set(steps))
    shares = [100 * sum(step <= x for step in steps) / len(cases) for x in corners]
    corners = [min(max(float(f"{x:.4g}"), LEAST), MOST) for x in corners]
    return [LEAST, *corners, MOST], [0.0, *(round(s, 1) for s in [*shares, max(shares, default=0)])]
