"""The first screen: the result in a sentence and a picture, three motions, and all settings."""

from collections.abc import Mapping, Sequence
from itertools import groupby
from typing import Any

from ....engines import place
from ...compare.own_rows import NATIVE
from ...compare.own_steps import OWN
from ...runs.selection import BOOK
from ...tables.row import AGREES, REFUSED, Comparison
from ...tables.short_numbers import factor
from ...tables.spoken import SETTINGS, spoken
from ..show.picture import Curve, curves, drawn, worst
from .column import Column
from .drawing import LIMIT, Motion
from .folder import Folder
from .heat import Cell
from .paint import THEIRS, svg

Cells = Mapping[tuple[str, Column], Cell]
SHIPPED = {"shipped": "as shipped", "recommended": "as its documentation recommends"}
PICTURE = "share of the cases that are at worst so far off, by engine and setting"
FIRST = (
    (("loops",), "four_bar"),
    (("impacts", "friction"), "bouncing_disk.elastic"),
    (("space",), "top_on_floor"),
)
"""The motions of the first screen: a theme, and the case that stands for it where it is there."""


def overview(folder: Folder, cells: Cells, columns: Sequence[Column]) -> dict[str, Any]:
    """The numbers of the head. Rows that are refused are counted by themselves."""
    shares = list(curves(folder.comparisons))
    many = bool(shares) and len({row.case for row in folder.comparisons}) > 1
    return {
        "cases": len({row.case for row in folder.comparisons}),
        "shares": [_share(column, cells) for column in columns],
        "result": result(folder.comparisons) if many else result_of_one(cells),
        "picture": svg(drawn(folder.comparisons, small=True), PICTURE) if many else "",
        "legend": [_key(curve) for curve in shares] if many else [],
    }


def _key(curve: Curve) -> dict[str, str]:
    """Returns a column's label, and the colour and dashes of its line, as SVG has them."""
    _, setting = curve.name.split(" ", 1)
    dash = " ".join(str(2 * x) for x in curve.dash[1]) if isinstance(curve.dash, tuple) else "none"
    meaning = SETTINGS.get(setting)
    label = curve.label.replace(":", f" ({meaning}):", 1) if meaning else curve.label
    colour = dict(THEIRS).get(curve.colour.lower(), curve.colour)
    return {"label": label, "colour": colour, "dash": dash}


def result(rows: Sequence[Comparison]) -> str:
    """Says in one sentence in how many cases each engine keeps every quantity, by setting."""
    worst_ratios = worst(rows)
    order = sorted(worst_ratios, key=lambda key: (key[0], place(key[1])))
    engines = []
    for k, (engine, keys) in enumerate(groupby(order, key=lambda key: key[0])):
        parts = []
        for _, setting in keys:
            ratios = worst_ratios[engine, setting]
            within = f"{sum(ratio <= 1 for ratio in ratios)} of {len(ratios)}"
            noun = "" if k or parts else " case" if len(ratios) == 1 else " cases"
            parts.append(f"{within}{noun} {_setting_text(setting)}")
        keeps = "" if k else " keeps every quantity within the textbook’s tolerance"
        engines.append(f"{engine}{keeps} in {_joined(parts)}")
    return f"{'; '.join(engines)}." if engines else "No case ran in any engine."


def result_of_one(cells: Cells) -> str:
    """Says in one sentence with which settings each engine keeps every quantity of the one case."""
    said = []
    own = sorted((at for at in cells if at[1].engine != BOOK), key=lambda at: _order(at[1]))
    for engine, of in groupby(own, key=lambda at: at[1].engine):
        ran = [(at, cells[at]) for at in of if cells[at].kind != REFUSED]
        within = [_as(column) for (_, column), cell in ran if cell.within == cell.judged]
        off = [
            f"{_as(column)} ({_worst_text(cell)})"
            for (_, column), cell in ran
            if cell.within != cell.judged
        ]
        what = "them" if said else f"all quantities of {own[0][0]} within their tolerances"
        if within:
            said.append(f"{engine} keeps {what} {_joined(within)}")
            said[-1] += f", but not {_joined(off, 'or')}" if off else ""
        elif off:
            said.append(f"{engine} does not keep {what} {_joined(off, 'or')}")
        else:
            said.append(f"{engine} does not support this scene")
    return f"{'; '.join(said)}." if said else "The case ran in no engine."


def _order(column: Column) -> tuple[str, float, str]:
    return column.engine, place(column.setting), column.key


def _as(column: Column) -> str:
    way = spoken(column.realised)
    return _setting_text(column.setting) + (f" with {way}" if way else "")


def _worst_text(cell: Cell) -> str:
    return f"{cell.worst} {factor(cell.ratio)}" if cell.worst and cell.ratio else cell.text


def _setting_text(setting: str) -> str:
    return SHIPPED.get(setting, setting if setting == "tuned" else f"with {setting}")


def _joined(words: Sequence[str], last: str = "and") -> str:
    return f" {last} ".join(filter(None, [", ".join(words[:-1]), words[-1]]))


def moving(
    motions: Mapping[str, Motion], about: Mapping[str, Sequence[str]], cells: Cells
) -> list[dict[str, Any]]:
    """Chooses three cases to begin with, of different themes, and says how far off engines are.

    Where a theme has none that an engine moves otherwise than the textbook, another case stands in.
    """
    seen = [name for name in motions if name in about and _first(motions[name])]
    chosen: list[str] = []
    for themes, name in FIRST:
        of = [n for n in seen if set(themes) & set(about[n]) and n not in chosen]
        chosen += [name] if name in of else of[:1]
    others = sorted(motions, key=lambda name: not _first(motions[name]))
    chosen += [name for name in others if name not in chosen]
    return [
        {
            "case": name,
            "against": SAID[motions[name]["against"]],
            "ghosts": [_ghost(key, name, cells) for key in _first(motions[name])],
        }
        for name in chosen[: len(FIRST)]
    ]


SAID = {"reference": "the textbook", LIMIT: "its limit for h → 0"}


def _first(motion: Motion) -> list[str]:
    """Returns the ghosts of engines as shipped and native; of a model that of its own setting."""
    setting = OWN if motion["against"] == LIMIT else "shipped"
    return [key for key in motion["ghosts"] if key.split(".")[1:] == [setting, NATIVE]]


def _ghost(key: str, case: str, cells: Cells) -> dict[str, str]:
    column = Column(*key.split("."))
    cell = cells.get((case, column))
    far = f"×{cell.text} the tolerance in {cell.worst}" if cell and cell.worst else ""
    return {"key": key, "title": column.title, "far": far}


def _share(column: Column, cells: Cells) -> dict[str, Any]:
    own = [cell for (_, other), cell in cells.items() if other == column]
    ran = [cell for cell in own if cell.kind != REFUSED]
    judged = sum(cell.judged for cell in ran)
    within = sum(cell.within for cell in ran)
    return {
        "title": column.title,
        "judged": judged,
        "within": within,
        "percent": 100 * within // judged if judged else 0,  # 100 is only what is all
        "cases": len(ran),
        "cases_within": sum(cell.kind == AGREES for cell in ran),
        "declared": sum(cell.kind == "declared" for cell in ran),
        "refused": len(own) - len(ran),
    }
