"""Prepares what other commands add to reports: causes, versions. Text stays as it is there."""

from typing import Any

import pandas as pd

from .folder import BESIDE

YES = ("yes", "true", "1", "moved")
WITHIN = "agrees"
SAME = ("case", "engine", "setting", "realised", "quantity")  # of releases that are compared


def absent(name: str) -> str:
    """One sentence for a section whose file is not there."""
    return f"There is no {name} beside these reports; {BESIDE[name]} writes it."


def causes(frame: pd.DataFrame | None) -> dict[str, Any] | None:
    """The cures, by how many rows each one cures, and all rows."""
    if frame is None:
        return None
    cures: dict[tuple[str, str], list[str]] = {}
    for row in records(frame, ("case", "engine", "cure")):
        cures.setdefault((row["engine"], row["cure"]), []).append(row["case"])
    most = max(map(len, cures.values()), default=1)
    by_knob = [
        {
            "engine": engine,
            "cure": cure,
            "count": len(cases),
            "percent": 100 * len(cases) // most,
            "cases": sorted(set(cases)),
        }
        for (engine, cure), cases in sorted(cures.items(), key=lambda kv: (-len(kv[1]), kv[0]))
    ]
    return {"by_knob": by_knob, "count": len(frame)}


def versions(frame: pd.DataFrame | None) -> dict[str, Any] | None:
    """How many rows of each release are within, and those that moved."""
    if frame is None:
        return None
    by_release: dict[tuple[str, str, str], list[dict[str, str]]] = {}
    for row in records(frame, ("engine", "version", "setting", "quantity", "verdict", "moved")):
        if row["quantity"] == "audit":
            continue
        by_release.setdefault((row["engine"], row["version"], row["setting"]), []).append(row)
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
        for (engine, version, setting), rows in sorted(by_release.items(), key=_by_release)
    ]
    before = _before(frame)
    moved = [
        [*row, before[k]]
        for k, (row, text) in enumerate(zip(frame.to_numpy().tolist(), frame["moved"], strict=True))
        if _moved(text)
    ]
    return {"shares": shares, "names": [*frame.columns, "error before"], "moved": moved}


def _before(frame: pd.DataFrame) -> list[str]:
    """Returns for each row the error of its quantity in the release before, or nothing."""
    rows = records(frame, (*SAME, "version", "error"))
    order = sorted(range(len(rows)), key=lambda k: _release(rows[k]["version"]))
    last: dict[tuple[str, ...], str] = {}
    before = [""] * len(rows)
    for k in order:
        of = tuple(rows[k][name] for name in SAME)
        before[k] = last.get(of, "")
        last[of] = rows[k]["error"]
    return before


def _moved(text: str) -> bool:
    return text.strip().lower() in YES


def _by_release(item: tuple[tuple[str, str, str], Any]) -> tuple[str, str, list[tuple[bool, Any]]]:
    engine, version, setting = item[0]
    return engine, setting, _release(version)


def _release(version: str) -> list[tuple[bool, Any]]:
    """Returns its numbers, by which releases are sorted: 3.10 after 3.9."""
    return [
        (not part.isdigit(), int(part) if part.isdigit() else part) for part in version.split(".")
    ]


def records(frame: pd.DataFrame, columns: tuple[str, ...]) -> list[dict[str, str]]:
    """Returns a frame's rows with these columns, empty where it lacks them."""
    return [
        {name: row.get(name, "") for name in columns}
        for row in frame.astype(str).to_dict("records")  # pyright: ignore[reportReturnType]
    ]
