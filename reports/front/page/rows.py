"""The rows of a case as its section shows them: short lists, with words that repeat told once."""

from collections.abc import Mapping, Sequence
from typing import Any

import pandas as pd

from ...tables.row import OF_A_LADDER, StepError
from .beside import records
from .column import Column, column
from .folder import Folder

CURES = (
    "case", "engine", "setting", "quantity", "error", "cure", "options", "step",
    "error_after", "cost", "law",
)  # fmt: skip
EMPTY = pd.DataFrame(columns=["case"])
DIGITS = ".3g"  # as the reports are written
TIME = ".6g"


class Words:
    """Texts by their number, in the order in which they were met."""

    def __init__(self) -> None:
        self.told: dict[str, int] = {}

    def number(self, text: str) -> int:
        """Returns the number of a text, the same for equal texts."""
        return self.told.setdefault(text, len(self.told))


def rows(folder: Folder, columns: Sequence[Column]) -> dict[str, Any]:
    """Returns by case comparisons, ladders, instants, checks; words and columns by number."""
    place: Mapping[Column, int] = {col: k for k, col in enumerate(columns)}
    words, cases = Words(), dict[str, dict[str, list[Any]]]()
    kinds = ("rows", "ladders", "instants", "checks", "causes")

    def of(case: str) -> dict[str, list[Any]]:
        return cases.setdefault(case, {kind: [] for kind in kinds})

    for row in folder.comparisons:
        of(row.case)["rows"].append([
            place[column(row)], words.number(row.quantity), words.number(row.unit),
            _few(row.step), _few(row.allowed), _few(row.error), _few(row.when, TIME),
            _few(row.ratio), words.number(row.verdict), words.number(row.because),
        ])  # fmt: skip
    climbed: dict[tuple[str, Column, str, str], list[StepError]] = {}
    for step in folder.steps:
        climbed.setdefault((step.case, column(step), step.quantity, step.ladder), []).append(step)
    for rung in folder.rungs:
        steps = climbed.get((rung.case, column(rung), rung.quantity, rung.ladder), [])
        of(rung.case)["ladders"].append([
            place[column(rung)], words.number(rung.quantity), words.number(rung.ladder),
            [_few(step.step) for step in steps], [_few(step.error) for step in steps],
            _few(rung.order), _few(rung.limit), _few(rung.usable_step),
            words.number(OF_A_LADDER[rung.verdict]),
        ])  # fmt: skip
    for instant in folder.instants:
        at = -1 if instant.engine == "reference" else place.get(column(instant), -2)
        of(instant.case)["instants"].append([
            at, words.number(instant.event), instant.k,
            _few(instant.time, ".9g"), _few(instant.difference),
        ])  # fmt: skip
    for check in folder.certificates:
        of(check.case)["checks"].append([
            words.number(check.check), _few(check.difference), _few(check.bound),
            _few(check.certified), words.number(check.unit), words.number(check.verdict),
        ])  # fmt: skip
    for cause in records(folder.beside.get("causes.csv", EMPTY), CURES):
        of(cause["case"])["causes"].append([words.number(cause[name]) for name in CURES[1:]])
    return {"columns": [col.key for col in columns], "words": list(words.told), "cases": cases}


def _few(number: float | None, digits: str = DIGITS) -> float | str | None:
    """Rounds a number for JSON; one that is not finite becomes a word."""
    if number is None:
        return None
    few = float(format(number, digits))
    if few != few or few in (float("inf"), float("-inf")):
        return str(few)
    return int(few) if few == int(few) and abs(few) < 1e6 else few
