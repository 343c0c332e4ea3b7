"""Two report folders merged row by row, and every difference between them."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf, isinf, isnan
from typing import NamedTuple

from ....cases.mistake import CaseError, Mistake
from ..row import AGREES, BEYOND, DEVIATES, FAILS, UNSEARCHED
from ..row import CHANGED as ANOTHER_EVENT
from .columns import (  # fmt: skip
    CAUSES,
    CHANGED,
    COVERED,
    ENGINE,
    ERRORS,
    KINDS,
    KNOWN,
    LOST,
    NEW,
    WORSE,
    Columns,
    Row,
    Rule,
    number,
)
from .folder import Folder

JUDGED = (AGREES, DEVIATES, BEYOND, ANOTHER_EVENT)
"""Verdicts on a number: who loses such a row knows less than before."""
REFERENCE = ("reference", "")  # an engine's column in events.csv, of every run

Key = tuple[str, ...]


Place = tuple[str, str, str]
"""Case, column and subject of a row, as `four_bar`, `mujoco.tuned (law)`, `crank.angle`."""


class Content(NamedTuple):
    """The content of a row in one of the folders: a verdict or other words, and a number."""

    words: str
    number: float | None = None


@dataclass(frozen=True)
class Change:
    """A row that differs, or that only one of the folders has (then the other is None).

    times: the new error over the old one; label: what its number is, where it is no error.
    """

    kind: str
    file: str
    place: Place
    old: Content | None
    new: Content | None
    unit: str = ""
    allowed: float | None = None
    times: float | None = None
    label: str = ""
    note: str = ""


class Counts(NamedTuple):
    """Rows of one file: compared with one another, and those of each folder that were not.

    searched: those of each that were not since not both runs looked for what they tell.
    """

    compared: int
    left: tuple[int, int]
    searched: tuple[int, int] = (0, 0)


@dataclass(frozen=True)
class Difference:
    """Every difference between two report folders.

    cases, engines: what both look at; counts: by file; alone: files of one folder.
    """

    old: Folder
    new: Folder
    rule: Rule
    cases: frozenset[str]
    engines: frozenset[tuple[str, str]]
    changes: tuple[Change, ...]
    counts: Mapping[str, Counts]
    alone: tuple[str, ...]

    def of(self, kind: str) -> tuple[Change, ...]:
        """Returns the changes of one kind."""
        return tuple(change for change in self.changes if change.kind == kind)

    @property
    def regressed(self) -> bool:
        """Whether anything got worse."""
        return bool(self.of(WORSE))


def difference(old: Folder, new: Folder, rule: Rule, *, whole: bool = False) -> Difference:
    """Compares two folders, as far as both look at the same cases and engines.

    whole: both are of all that there is, so that a case of one folder is lost or new. Raises
    CaseError where there is nothing that both look at.
    """
    cases, engines = old.cases & new.cases, old.engines & new.engines
    if not (cases and engines):
        what = "no case" if not cases else "no engine with the same setting"
        text = f"{what} is in both folders: nothing can be compared"
        raise CaseError([Mistake(f"{old.name} and {new.name}", 0, 0, "", text)])
    if whole:
        cases, engines = old.cases | new.cases, old.engines | new.engines
    allowed = {  # where both say it, the new one counts
        ERRORS.key(row): float(row["allowed"])
        for row in (*old.errors, *new.errors)
        if row["allowed"]
    }

    def looked_at(row: Row) -> bool:
        engine = row.get("engine"), row.get("setting")
        of_both = None in engine or engine == REFERENCE or engine in engines
        return of_both and row.get("case") in {None, *cases}

    changes: list[Change] = []
    counts: dict[str, Counts] = {}
    for columns in (KNOWN[name] for name in KNOWN if name in old.tables and name in new.tables):
        tables = old.tables[columns.name], new.tables[columns.name]
        rows = [[row for row in table if looked_at(row)] for table in tables]
        unpaired = len(tables[0]) - len(rows[0]), len(tables[1]) - len(rows[1])
        searched = _searched(rows) if columns is CAUSES else rows
        unsearched = len(rows[0]) - len(searched[0]), len(rows[1]) - len(searched[1])
        if columns is COVERED:
            searched = [[_by_cases(row, cases) for row in some] for some in rows]
        before, after = ({columns.key(row): row for row in some} for some in searched)
        changes += _merged(columns, before, after, rule, allowed)
        counts[columns.name] = Counts(len(before.keys() & after.keys()), unpaired, unsearched)
    changes.sort(key=lambda change: KINDS.index(change.kind))
    alone = tuple(sorted(old.tables.keys() ^ new.tables.keys()))
    return Difference(old, new, rule, cases, engines, tuple(changes), counts, alone)


def place(columns: Columns, row: Row) -> Place:
    """Returns the place of a row, with a realisation that is not native in brackets."""
    engine = ".".join(row[name] for name in ("engine", "setting") if row.get(name))
    realised = row.get("realised", "")
    further = (row[name] for name in columns.keys if name not in ENGINE)
    column = engine if realised in ("", "native") else f"{engine} ({realised})"
    what = columns.what.format_map(row) or ", ".join(filter(None, further))
    return row.get("case", ""), columns.column.format_map(row) or column, what


def _by_cases(row: Row, cases: frozenset[str]) -> Row:
    """Returns an item of the chapter with those of its cases alone that both folders look at."""
    return {**row, "cases": " ".join(case for case in row["cases"].split() if case in cases)}


def _searched(rows: Sequence[Sequence[Row]]) -> list[list[Row]]:
    """Returns the causes of each folder but those that one of the runs has not searched."""

    def question(row: Row) -> Key:
        return tuple(row[name] for name in ("case", "engine", "setting", "quantity"))

    unsearched = {question(row) for some in rows for row in some if row["cure"] == UNSEARCHED}
    return [[row for row in some if question(row) not in unsearched] for some in rows]


def _merged(
    columns: Columns, old: Mapping[Key, Row], new: Mapping[Key, Row],
    rule: Rule, allowed: Mapping[Key, float],
) -> Iterator[Change]:  # fmt: skip
    for key in sorted(old.keys() | new.keys()):
        was, now = old.get(key), new.get(key)
        if was is not None and now is not None:
            bar = allowed.get(tuple(now.get(name, "") for name in ERRORS.keys))
            yield from _compared(columns, was, now, rule, bar)
        elif was is not None:
            kind = WORSE if columns is ERRORS and was["verdict"] in JUDGED else LOST
            yield Change(kind, columns.name, place(columns, was), _content(columns, was), None)
        elif now is not None:
            kind = WORSE if now.get("verdict") == FAILS else NEW
            yield Change(kind, columns.name, place(columns, now), None, _content(columns, now))


def _compared(
    columns: Columns, old: Row, new: Row, rule: Rule, allowed: float | None
) -> Iterator[Change]:
    """Yields how a row has changed, or nothing; of cells without a judge that they have."""
    where = place(columns, new)
    if columns.judge is None:
        differ = tuple(name for name in columns.words if _another(old[name], new[name], rule))
        was, now = (_content(replace(columns, words=differ), row) for row in (old, new))
        if differ:
            yield Change(CHANGED, columns.name, where, was, now)
    elif kind := columns.judge(old, new, rule, allowed):
        was, now = _content(columns, old), _content(columns, new)
        error = columns is ERRORS
        moved = old.get("unit") == new.get("unit") and rule.differ(was.number, now.number, allowed)
        yield Change(
            kind,
            columns.name,
            where,
            was,
            now,
            unit=columns.unit.format_map(new),
            allowed=allowed if error else None,
            times=factor(was.number, now.number) if error and moved else None,
            label=columns.label,
            note=_note(old, new),
        )


def factor(was: float | None, now: float | None) -> float | None:
    """Returns how many times as large the new number is; None where that is no number."""
    if was is None or now is None or isnan(was) or isnan(now) or was == now:
        return None
    if was == 0.0:
        return inf
    return None if isinf(was) else now / was


def _another(was: str, now: str, rule: Rule) -> bool:
    """Compares numbers by the rule, and all else as it is written."""
    try:
        return rule.differ(float(was), float(now), None)
    except ValueError:
        return was != now


def _content(columns: Columns, row: Row) -> Content:
    if columns.judge is None:
        return Content(", ".join(f"{name} {row[name]}" for name in columns.words if row[name]))
    words = next((row[name] for name in columns.words if row[name]), "")
    if columns is COVERED:
        words = words or "not covered"
    return Content(words, number(row, columns.numbers[0]) if columns.numbers else None)


def _note(old: Row, new: Row) -> str:
    """Returns what else is another: `allowed 0.1 → 0.2, step 0.01 → 0.002`, or ""."""
    differ = [name for name in ("unit", "allowed", "step") if old.get(name) != new.get(name)]
    return ", ".join(
        f"{name} {old[name] or 'none'} → {new[name] or 'none'}"
        for name in differ
        if name != "step" or (old[name] and new[name])  # a verdict says why it has none
    )
