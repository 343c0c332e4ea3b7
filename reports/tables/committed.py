"""The committed reports: tolerance.csv as a bar, so that what was reached is not lost unnoticed.

It binds shipped cases in pytest, at the engine's version and step of the committed row. `make
reports` writes it anew whatever it was, and a person reads the difference: so every row has a bar
near what is measured, no bar is typed by the suite, and no verdict depends on an older run.
"""

from collections.abc import Mapping
from contextlib import suppress
from functools import cache

from ...cases.case import Case
from ...cases.find import is_shipped
from ...cases.model_case import ModelCase
from .ownership import HERE
from .row import Cause, Comparison, Known, rank
from .write import read

FILE = HERE / "tolerance.csv"
CAUSES = FILE.with_name("causes.csv")
WORSE = 10  # × what was committed; another processor changes a third beside an event, see the tests
USELESS = 1e-6  # of `allow`: where a shipped setting's figure is nothing to anyone
ROUNDING = 1e-8  # of `allow`: where a tuned setting's figure may be rounding's on another processor
SAME_STEP = 1e-2  # steps are written with three digits

Key = tuple[str, str, str, str, str]


@cache
def rows() -> Mapping[Key, Comparison]:
    """By case, engine, setting, realised, quantity; empty where no reports are committed."""
    if not FILE.is_file():
        return {}
    return {key_of(row): row for row in read(FILE, Comparison)}


def key_of(row: Comparison) -> Key:
    """Returns the cells that name a row: case, engine, setting, realised, quantity."""
    return row.case, row.engine, row.setting, row.realised, row.quantity


def committed_causes() -> Known:
    """The causes, and the verdicts that they belong to; nothing where they cannot be read."""
    by_row: dict[tuple[str, str, str, str], list[Cause]] = {}
    with suppress(OSError, ValueError):  # cut, or half of a merge: then all are searched anew
        for cause in read(CAUSES, Cause):
            key = cause.case, cause.engine, cause.setting, cause.quantity
            by_row.setdefault(key, []).append(cause)
        return Known(by_row, {key: row.verdict for key, row in rows().items()})
    return Known()


def before(case: Case | ModelCase, key: Key, version: str, step: float | None) -> Comparison | None:
    """Returns the committed row of the same question; None: another case, version or step."""
    row = rows().get(key)
    if row is None or row.version != version or not is_shipped(case.source.file):
        return None
    if step and row.step and abs(step - row.step) > SAME_STEP * step:
        return None
    return row


def worse(case: Case | ModelCase, row: Comparison) -> str:
    """Returns in words how a row is worse than the committed one, or nothing."""
    old = before(case, key_of(row), row.version, row.step)
    if old is None:
        return ""
    if rank(row.verdict) > rank(old.verdict):
        return f"the committed report says: {old.verdict}"
    if old.error is None or row.error is None:
        return ""
    least = ROUNDING if row.setting == "tuned" else USELESS
    bar = WORSE * max(old.error, least * (row.allowed or 0.0))
    if not row.error <= bar:
        return f"{row.error:.3g} is above {WORSE} × the committed {old.error:.3g}"
    return ""
