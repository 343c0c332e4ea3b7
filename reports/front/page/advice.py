"""Prepares the advice for the page: of each case, and by theme what most of its cases need."""

from collections import Counter
from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from ....cases.theme import THEMES
from ...tables.short_numbers import factor, milliseconds
from .beside import records

COLUMNS = (
    "case", "engine", "tolerance", "margin", "want", "recipe", "settings", "step", "cost",
    "shipped_cost",
    "ratio", "quantity", "remains",
)  # fmt: skip
AS_ALLOWED = "as the case allows"  # where no tolerance is written
FEWEST = "fewest changes"  # which is not the cheapest
NONE = "none"  # the recipe, where nothing keeps the bar

Themes = Mapping[str, tuple[str, ...]]


def advice(frame: pd.DataFrame | None, themes: Themes) -> dict[str, Any] | None:
    """Returns all rows, what filters them, and the rows by theme; None where there is no file."""
    if frame is None:
        return None
    rows = [
        {
            **row,
            "tolerance": row["tolerance"] or AS_ALLOWED,
            "themes": " ".join(themes.get(row["case"], ())),
            "linked": row["case"] in themes,
            "step": _step(row["step"]),
            "times": _times(row),
        }
        for row in records(frame, COLUMNS)
    ]
    by_theme = list(_by_theme(rows, themes))
    return {
        "rows": rows,
        "about": {row["theme"] for row in by_theme},
        "engines": sorted({row["engine"] for row in rows}),
        "tolerances": list(dict.fromkeys(row["tolerance"] for row in rows)),
        "themes": by_theme,
    }


def _step(seconds: str) -> str:
    return milliseconds(float(seconds)) if seconds else ""


def _times(row: Mapping[str, str]) -> str:
    """Formats the cost over that of the shipped setting."""
    cost, shipped = row["cost"], row["shipped_cost"]
    return factor(float(cost) / float(shipped)) if cost and shipped else ""


def _by_theme(rows: Sequence[Mapping[str, Any]], themes: Themes) -> Any:
    """For each theme, engine and tolerance: the cheapest recipe of most cases, and its dearest."""
    groups: dict[tuple[str, str, str], list[Mapping[str, Any]]] = {}
    for row in rows:
        if (not row["ratio"] and row["recipe"] == NONE) or row["want"] == FEWEST:
            continue  # refused, or a claim about states: no setting plays a part
        for theme in themes.get(row["case"], ()):
            groups.setdefault((theme, row["engine"], row["tolerance"]), []).append(row)
    order = list(THEMES)

    def place(at: tuple[str, str, str]) -> tuple[int, str, bool, str]:
        theme, engine, tolerance = at
        return order.index(theme), engine, tolerance != AS_ALLOWED, tolerance

    for theme, engine, tolerance in sorted(groups, key=place):
        group = groups[theme, engine, tolerance]
        cured = [row for row in group if row["step"] and row["recipe"] != NONE]
        recipes = Counter(row["recipe"] for row in cured).most_common()
        first = recipes[0][0] if recipes else ""
        usual = [row for row in cured if row["recipe"] == first]
        hardest = max(usual, key=lambda row: float(row["cost"]), default=None)
        cases = "case" if len(group) == 1 else "cases"
        yield {
            "says": f"keeps {len(usual)} of {len(group)} {cases} about {theme}" if first else "",
            "most": 2 * len(usual) >= len(group),
            "theme": theme,
            "engine": engine,
            "tolerance": tolerance,
            "cases": len(group),
            "cured": len(cured),
            "recipe": first,
            "usual": len(usual),
            "others": recipes[1:],
            "step": "" if hardest is None else hardest["step"],
            "times": "" if hardest is None else hardest["times"],
            "hardest": "" if hardest is None else hardest["case"],
            "settings": "" if hardest is None else hardest["settings"],
        }
