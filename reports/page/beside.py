"""What other commands add to a folder of reports: advice, causes, versions. Text as it is there."""

from collections.abc import Mapping
from typing import Any

import pandas as pd

from .folder import BESIDE

YES = ("yes", "true", "1", "moved")
WITHIN = "agrees"
AS_ALLOWED = "as the case allows"  # where no tolerance is written

Themes = Mapping[str, tuple[str, ...]]


def absent(name: str) -> str:
    """One sentence for a section whose file is not there."""
    return f"There is no {name} beside these reports; {BESIDE[name]} writes it."


def advice(frame: pd.DataFrame | None, themes: Themes) -> dict[str, Any] | None:
    """The rows of the search for a setting, and what they can be chosen by."""
    if frame is None:
        return None
    columns = (
        "case", "engine", "tolerance", "margin", "recipe", "options", "step", "cost",
        "shipped_cost", "worst", "quantity", "remains",
    )  # fmt: skip
    rows = [
        {
            **row,
            "tolerance": row["tolerance"] or AS_ALLOWED,
            "themes": " ".join(themes.get(row["case"], ())),
            "linked": row["case"] in themes,
        }
        for row in _rows(frame, columns)
    ]
    return {
        "rows": rows,
        "engines": sorted({row["engine"] for row in rows}),
        "tolerances": list(dict.fromkeys(row["tolerance"] for row in rows)),
    }


def causes(frame: pd.DataFrame | None) -> dict[str, Any] | None:
    """The cures, by how many rows each one cures, and all rows."""
    if frame is None:
        return None
    found: dict[tuple[str, str], list[str]] = {}
    for row in _rows(frame, ("case", "engine", "cure")):
        found.setdefault((row["engine"], row["cure"]), []).append(row["case"])
    most = max(map(len, found.values()), default=1)
    by_knob = [
        {
            "engine": engine,
            "cure": cure,
            "count": len(cases),
            "percent": 100 * len(cases) // most,
            "cases": sorted(set(cases)),
        }
        for (engine, cure), cases in sorted(found.items(), key=lambda one: (-len(one[1]), one[0]))
    ]
    return {"by_knob": by_knob, "names": list(frame.columns), "rows": frame.to_numpy().tolist()}


def versions(frame: pd.DataFrame | None) -> dict[str, Any] | None:
    """How many rows of each release are within, and those that moved."""
    if frame is None:
        return None
    found: dict[tuple[str, str, str], list[dict[str, str]]] = {}
    for row in _rows(frame, ("engine", "version", "setting", "verdict", "moved")):
        found.setdefault((row["engine"], row["version"], row["setting"]), []).append(row)
    shares = [
        {
            "engine": engine,
            "version": version,
            "setting": setting,
            "judged": len(rows),
            "within": (within := sum(row["verdict"] == WITHIN for row in rows)),
            "percent": 100 * within // len(rows),
            "moved": sum(_moved(row["moved"]) for row in rows),
        }
        for (engine, version, setting), rows in sorted(found.items(), key=_by_release)
    ]
    moved = [
        row
        for row, text in zip(frame.to_numpy().tolist(), frame["moved"], strict=True)
        if _moved(text)
    ]
    return {"shares": shares, "names": list(frame.columns), "moved": moved}


def _moved(text: str) -> bool:
    return text.strip().lower() in YES


def _by_release(one: tuple[tuple[str, str, str], Any]) -> tuple[str, str, list[tuple[bool, Any]]]:
    """3.10 after 3.9."""
    engine, version, setting = one[0]
    parts = [
        (not part.isdigit(), int(part) if part.isdigit() else part) for part in version.split(".")
    ]
    return engine, setting, parts


def _rows(frame: pd.DataFrame, columns: tuple[str, ...]) -> list[dict[str, str]]:
    """With these columns, empty where the file has none of them."""
    return [
        {name: row.get(name, "") for name in columns}
        for row in frame.astype(str).to_dict("records")  # pyright: ignore[reportReturnType]
    ]
