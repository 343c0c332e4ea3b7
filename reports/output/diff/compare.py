"""Two report folders merged row by row, and every difference between them."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace

from ....cases.mistake import CaseError, Mistake
from ...data.row import UNSEARCHED
from .columns import (
    CHANGED,
    ENGINE,
    ERRORS,
    KINDS,
    KNOWN,
    WORSE,
    Columns,
    Row,
    Rule,
    factor,
    number,
)  # fmt: skip
from .folder import Folder, Scope, Table

NAMING = (
    *(*ENGINE, "ladder", "quantity", "event", "k"),
    *("system", "check", "kind", "number", "tolerance", "margin"),
)
"""Columns that name the rows of a file that is not known."""
FURTHER = ("version", "cure", "options", "recipe")
"""Columns that may name them too, where those above do not tell them apart."""

Key = tuple[str, ...]


@dataclass(frozen=True)
class Place:
    """Case, column and subject of a change; empty where it has none.

    So `four_bar`, `mujoco.tuned (law)`, `crank.angle`.
    """

    case: str
    column: str
    what: str


@dataclass(frozen=True)
class Seen:
    """The content of a row in one of the folders: a verdict or other words, and a number."""

    words: str
    number: float | None = None


@dataclass(frozen=True)
class Change:
    """A row that differs, or that only one of the folders has (then the other is None)."""

    kind: str
    file: str
    place: Place
    was: Seen | None
    now: Seen | None
    unit: str = ""
    allowed: float | None = None
    times: float | None = None  # the new error over the old one
    label: str = ""  # what its number is, where it is no error
    note: str = ""


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
    """Compares two folders, as far as both look at the same cases and engines.

    whole: both are of all that there is, so that a case of one folder is lost or new. Raises
    CaseError where there is nothing that both look at.
    """
    shared = old.scope & new.scope
    if not (shared.cases and shared.engines):
        what = "no case" if not shared.cases else "no engine with the same setting"
        text = f"{what} is in both folders: nothing can be compared"
        raise CaseError([Mistake(f"{old.name} and {new.name}", 0, 0, "", text)])
    scope = old.scope | new.scope if whole else shared
    allowed = {  # where both say it, the new one counts
        ERRORS.key(row): float(row["allowed"])
        for row in (*old.errors, *new.errors)
        if row["allowed"]
    }
    changes: list[Change] = []
    counts: dict[str, Counts] = {}
    names = old.tables.keys() & new.tables.keys()
    for name in [*(n for n in KNOWN if n in names), *sorted(names - KNOWN.keys())]:
        tables = old.tables[name], new.tables[name]
        columns = KNOWN.get(name) or _guessed(name, *tables)
        asked = [_within(columns, table.rows, scope) for table in tables]
        told = _searched(columns, *asked)
        before, after = ({columns.key(row): row for row in rows} for rows in told)
        changes += _merged(columns, before, after, rule, allowed)
        left = [len(table.rows) - len(rows) for table, rows in zip(tables, asked, strict=True)]
        unsearched = len(asked[0]) - len(told[0]), len(asked[1]) - len(told[1])
        counts[name] = Counts(len(before.keys() & after.keys()), left[0], left[1], unsearched)
    changes.sort(key=lambda change: KINDS.index(change.kind))
    alone = tuple(sorted(old.tables.keys() ^ new.tables.keys()))
    return Difference(old, new, rule, scope, tuple(changes), counts, alone)


def place(columns: Columns, row: Row) -> Place:
    """Returns the place of a row, with a realisation that is not native in brackets."""
    engine = ".".join(row[name] for name in ("engine", "setting") if row.get(name))
    realised = row.get("realised", "")
    further = (row[name] for name in columns.keys if name not in ENGINE)
    return Place(
        row.get("case", ""),
        columns.column.format_map(row)
        or (engine if realised in ("", "native") else f"{engine} ({realised})"),
        columns.what.format_map(row) or ", ".join(filter(None, further)),
    )


def _guessed(name: str, old: Table, new: Table) -> Columns:
    """Returns the columns of a file that is not known, by the fewest that name its rows.

    Where nothing less tells the rows apart, all shared columns name them: then none changes, and
    rows are lost and new.
    """
    shared = [column for column in old.columns if column in new.columns]
    keys = [column for column in shared if column in NAMING]
    for further in ("", *FURTHER):
        keys += [further] if further in shared else []
        found = Columns(name, tuple(keys), words=tuple(c for c in shared if c not in keys))
        if keys and all(len({*map(found.key, t.rows)}) == len(t.rows) for t in (old, new)):
            return found
    return Columns(name, tuple(shared))


def _within(columns: Columns, rows: Sequence[Row], scope: Scope) -> list[Row]:
    """Returns the rows about cases and engines of the scope; a list of cases has only those."""
    found = [row for row in rows if scope.holds(row)]
    if not (name := columns.listed):
        return found
    return [
        {**row, name: " ".join(case for case in row[name].split() if case in scope.cases)}
        for row in found
    ]


def _searched(columns: Columns, old: list[Row], new: list[Row]) -> tuple[list[Row], list[Row]]:
    """Returns the rows of each folder but those about what one of the runs has not searched."""
    if not columns.question:
        return old, new

    def question(row: Row) -> Key:
        return tuple(row[name] for name in columns.question)

    left = {question(row) for row in (*old, *new) if row["cure"] == UNSEARCHED}
    return (
        [row for row in old if question(row) not in left],
        [row for row in new if question(row) not in left],
    )


def _merged(
    columns: Columns, old: Mapping[Key, Row], new: Mapping[Key, Row],
    rule: Rule, allowed: Mapping[Key, float],
) -> Iterator[Change]:  # fmt: skip
    for key in sorted(old.keys() | new.keys()):
        was, now = old.get(key), new.get(key)
        if was is not None and now is not None:
            bar = allowed.get(tuple(now.get(name, "") for name in ERRORS.keys))
            change = _compared(columns, was, now, rule, bar)
            if change is not None:
                yield change
        elif was is not None:
            kind, where = columns.lost(was), place(columns, was)
            yield Change(kind, columns.name, where, _seen(columns, was), None)
        elif now is not None:
            kind, where = columns.new(now), place(columns, now)
            yield Change(kind, columns.name, where, None, _seen(columns, now))


def _compared(
    columns: Columns, old: Row, new: Row, rule: Rule, allowed: float | None
) -> Change | None:
    """Returns how a row has changed; of cells that nobody knows never more than that they did."""
    where = place(columns, new)
    if columns.judge is None:
        differ = tuple(name for name in columns.words if _another(old[name], new[name], rule))
        was, now = (_seen(replace(columns, words=differ), row) for row in (old, new))
        return Change(CHANGED, columns.name, where, was, now) if differ else None
    kind = columns.judge(old, new, rule, allowed)
    if kind is None:
        return None
    was, now = _seen(columns, old), _seen(columns, new)
    error = columns is ERRORS
    moved = old.get("unit") == new.get("unit") and rule.differ(was.number, now.number, allowed)
    return Change(
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


def _another(was: str, now: str, rule: Rule) -> bool:
    """Compares numbers by the rule, and all else as it is written."""
    try:
        return rule.differ(float(was), float(now), None)
    except ValueError:
        return was != now


def _seen(columns: Columns, row: Row) -> Seen:
    if columns.judge is None:
        return Seen(", ".join(f"{name} {row[name]}" for name in columns.words if row[name]))
    words = next((row[name] for name in columns.words if row[name]), columns.nothing)
    return Seen(words, number(row, columns.numbers[0]) if columns.numbers else None)


def _note(old: Row, new: Row) -> str:
    """Returns what else is another: `allowed 0.1 → 0.2, step 0.01 → 0.002`, or ""."""
    differ = [name for name in ("unit", "allowed", "step") if old.get(name) != new.get(name)]
    return ", ".join(
        f"{name} {old[name] or 'none'} → {new[name] or 'none'}"
        for name in differ
        if name != "step" or (old[name] and new[name])  # a verdict says why it has none
    )
