"""Finds what cures a row, in the report of causes, where there is one."""

from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import pandas as pd

from ....cases.case import Case
from ....cases.find import is_shipped
from ...search.causes.why import Key, key_of
from ...tables.row import UNSEARCHED, Cause
from ...tables.short_numbers import milliseconds
from ...tables.write import HERE
from .summary import Cures

NAME = "causes.csv"
KEY = ("case", "engine", "setting", "quantity")
MOST = 2  # cures that a table has room for
OURS = ("our force law", "our driver")  # which go on in the report


def committed(cases: Sequence[Case]) -> Cures:
    """Returns the cures of those cases that are shipped ones, from the committed report."""
    ours = {case.name for case in cases if is_shipped(case.source.file)}
    return {key: cure for key, cure in cures(HERE).items() if key[0] in ours}


def known(cases: Sequence[Case], causes: Iterable[Cause]) -> Cures:
    """Returns the cures of a run: those of shipped cases, and those that it has searched for."""
    return {**committed(cases), **found_cures(causes)}


def cures(folder: Path) -> Cures:
    """Returns the two cheapest cures in words, by case, engine, setting and quantity.

    The report has a row for each cure, the cheapest first; what was not searched is not told.
    """
    file = folder / NAME
    if not file.is_file():
        return {}
    rows = pd.read_csv(file, dtype=str, keep_default_na=False)
    return _joined(rows[[*KEY, "cure", "step"]].itertuples(index=False))


def found_cures(causes: Iterable[Cause]) -> Cures:
    """Returns the cures, as `cures` does, of causes that a run has just searched for."""
    rows = ((c.case, c.engine, c.setting, c.quantity, c.cure, c.step) for c in causes)
    return _joined(rows)


def carried(causes: Iterable[Cause], known: Mapping[Key, Sequence[Cause]]) -> str:
    """Says of how many rows the causes are those that were known; nothing where of none."""
    searched: dict[Key, list[Cause]] = {}
    for cause in causes:
        if cause.searched_with:
            searched.setdefault(key_of(cause), []).append(cause)
    count = sum(known.get(key) == rows for key, rows in searched.items())
    anew = len(searched) - count
    words = f"causes: {count} rows keep the committed ones, as nothing they depend on has changed"
    return f"{words}; {anew} were searched anew" if count else ""


def _joined(rows: Iterable[tuple[Any, ...]]) -> Cures:
    cures: dict[tuple[str, str, str, str], list[str]] = {}
    for case, engine, setting, quantity, cure, step in rows:
        if cure != UNSEARCHED:
            cures.setdefault((case, engine, setting, quantity), []).append(_cure_text(cure, step))
    return {key: " or ".join(words[:MOST]) for key, words in cures.items()}


def _cure_text(cure: str, step: str | float | None) -> str:
    """Returns a cure with its step, where that is changed; a law or driver by its short name."""
    if cure.startswith(OURS):
        return next(word for word in OURS if cure.startswith(word))
    changed = cure.split(" + ")[-1] == "step"
    return f"{cure} {milliseconds(float(step))}" if step and changed else cure
