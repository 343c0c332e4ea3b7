"""Two report folders row by row."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from ....cases.mistake import CaseError, Mistake
from .change import KINDS, WORSE, Change
from .errors import ERRORS
from .file import File, number
from .files import FILES
from .folder import Folder
from .other import unknown
from .rule import Rule
from .scope import Scope
from .table import Row, Table

Key = tuple[str, ...]
Bars = Mapping[Key, float]
"""What is allowed, by case, engine, setting, realised, quantity."""


@dataclass(frozen=True)
class Counts:
    """Rows of one file: compared with one another, and those of each folder that were not.

    searched: those of each that were not since not both runs looked for what they tell.
    """

    compared: int
    old: int
    new: int
    searched: tuple[int, int] = (0, 0)


@dataclass(frozen=True)
class Difference:
    """Every difference between two report folders.

    scope: what both look at; counts: by file; alone: files of one folder.
    """

    old: Folder
    new: Folder
    rule: Rule
    scope: Scope
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
    """whole: both are of all that there is, so that a case of one folder is lost or new.

    Raises CaseError where there is nothing that both look at.
    """
    shared = old.scope & new.scope
    if not (shared.cases and shared.columns):
        what = "no case" if not shared.cases else "no engine with the same setting"
        text = f"{what} is in both folders: nothing can be compared"
        raise CaseError([Mistake(f"{old.name} and {new.name}", 0, 0, "", text)])
    scope = old.scope | new.scope if whole else shared
    bars = {**_bars(old.errors), **_bars(new.errors)}
    changes: list[Change] = []
    counts: dict[str, Counts] = {}
    for name in sorted(old.tables.keys() & new.tables.keys(), key=_place):
        tables = old.tables[name], new.tables[name]
        file = FILES.get(name) or unknown(*tables)
        told = [_within(file, table, scope) for table in tables]
        both = file.both(*told)
        before, after = ({_key(file, row): row for row in rows} for rows in both)
        changes += _changes(file, before, after, rule, bars)
        left = [len(t.rows) - len(rows) for t, rows in zip(tables, told, strict=True)]
        unsearched = len(told[0]) - len(both[0]), len(told[1]) - len(both[1])
        counts[name] = Counts(len(before.keys() & after.keys()), left[0], left[1], unsearched)
    changes.sort(key=lambda change: KINDS.index(change.kind))
    alone = tuple(sorted(old.tables.keys() ^ new.tables.keys()))
    return Difference(old, new, rule, scope, tuple(changes), counts, alone)


def _place(name: str) -> tuple[int, str]:
    """The known files in their order, then the others."""
    return ([*FILES].index(name) if name in FILES else len(FILES)), name


def _within(file: File, table: Table, scope: Scope) -> list[Row]:
    told = (file.within(row, scope) for row in table.rows)
    return [row for row in told if row is not None]


def _key(file: File, row: Row) -> Key:
    return tuple(row[name] for name in file.keys)


def _changes(
    file: File, old: Mapping[Key, Row], new: Mapping[Key, Row],
    rule: Rule, bars: Bars,
) -> Iterator[Change]:  # fmt: skip
    for key in sorted(old.keys() | new.keys()):
        before, after = old.get(key), new.get(key)
        if before is not None and after is not None:
            change = file.compare(before, after, rule, _allowed(after, bars))
            if change is not None:
                yield change
        elif before is not None:
            where, was = file.place(before), file.seen(before)
            yield Change(file.lost(before), file.name, where, was, None)
        elif after is not None:
            where, now = file.place(after), file.seen(after)
            yield Change(file.new(after), file.name, where, None, now)


def _bars(errors: Table) -> Bars:
    told = ((_key(ERRORS, row), number(row, "allowed")) for row in errors.rows)
    return {key: allowed for key, allowed in told if allowed is not None}


def _allowed(row: Row, bars: Bars) -> float | None:
    return bars.get(tuple(row.get(key, "") for key in ERRORS.keys))
