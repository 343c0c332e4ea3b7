"""The committed tolerance.csv as a bar: what was reached is not lost unnoticed.

It binds shipped cases in pytest, at the engine's version and step of the committed row. `make
reports` writes it anew whatever it was, and a person reads the difference: so every row has a bar
near what is measured, no bar is typed by the suite, and no verdict depends on an older run.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cache
from pathlib import Path

import pandas as pd

from ..cases.case import Case
from ..cases.find import shipped
from .row import AGREES, BEYOND, CHANGED, CRASHED, DEVIATES, DIVERGED, FAILS, Comparison

FILE = Path(__file__).parent / "tolerance.csv"
WORSE = 10  # × what was committed; another processor changes a third beside an event, see the tests
USELESS = 1e-6  # of `allow`: where a shipped setting's figure is nothing to anyone
ROUNDING = 1e-8  # of `allow`: where a tuned setting's figure may be rounding's on another processor
SAME_STEP = 1e-2  # steps are written with three digits
LADDER = (AGREES, DEVIATES, BEYOND, CHANGED, "refused", DIVERGED, CRASHED, FAILS)
"""Verdicts from good to bad, by their first words."""

Key = tuple[str, str, str, str, str]


@dataclass(frozen=True)
class Committed:
    """What a row said: the engine's version, its step [s], the largest error, the verdict."""

    version: str
    step: float | None
    largest: float | None
    verdict: str


@cache
def rows() -> Mapping[Key, Committed]:
    """By case, engine, setting, realised, quantity; empty where no reports are committed."""
    if not FILE.is_file():
        return {}
    frame = pd.read_csv(FILE, dtype=str, comment="#", keep_default_na=False)
    found: dict[Key, Committed] = {}
    for record in frame.to_dict("records"):
        text = {str(name): str(value) for name, value in record.items()}
        key = (text["case"], text["engine"], text["setting"], text["realised"], text["quantity"])
        step, largest = _number(text["step"]), _number(text["largest"])
        found[key] = Committed(text["version"], step, largest, text["verdict"])
    return found


def _number(text: str) -> float | None:
    return float(text) if text else None


def before(case: Case, key: Key, version: str, step: float | None) -> Committed | None:
    """What was committed of the same question, or None: another case, version or step."""
    found = rows().get(key)
    file = shipped().get(case.name.partition(".")[0])
    if found is None or file is None or found.version != version:
        return None
    if file.resolve() != Path(case.source.file).resolve():
        return None
    if step and found.step and abs(step - found.step) > SAME_STEP * step:
        return None
    return found


def worse(case: Case, row: Comparison) -> str:
    """How a row is worse than the committed one, in words; or nothing."""
    key = (row.case, row.engine, row.setting, row.realised, row.quantity)
    found = before(case, key, row.version, row.step)
    if found is None:
        return ""
    if _rank(row.verdict) > _rank(found.verdict):
        return f"the committed report says: {found.verdict}"
    if found.largest is None or row.largest is None:
        return ""
    least = ROUNDING if row.setting == "tuned" else USELESS
    bar = WORSE * max(found.largest, least * (row.allowed or 0.0))
    if not row.largest <= bar:
        return f"{row.largest:.3g} is above {WORSE} × the committed {found.largest:.3g}"
    return ""


def _rank(verdict: str) -> int:
    return next((i for i, word in enumerate(LADDER) if verdict.startswith(word)), len(LADDER))
