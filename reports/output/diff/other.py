"""A file that this command does not know: rows by what seems to name them, cells as they are."""

from collections.abc import Sequence
from functools import partial

from .change import CHANGED, Change, Place, Seen
from .file import File
from .rule import Rule
from .table import Row, Table

NAMING = (
    *("case", "engine", "setting", "realised", "ladder", "quantity", "event", "k"),
    *("system", "check", "kind", "number", "tolerance", "margin"),
)
FURTHER = ("version", "cure", "options", "recipe")
"""Columns that may name rows too, where those above do not tell them apart."""


def unknown(old: Table, new: Table) -> File:
    """How two tables of one unknown file are compared: by the fewest columns that name rows."""
    shared = [name for name in old.columns if name in new.columns]
    keys = _naming(shared, [old, new])
    named = [name for name in ("case", "engine", "setting") if name in shared]
    rest = [name for name in shared if name not in keys]
    return File(
        name=new.path.name,
        keys=keys,
        numbers=(),
        words=(),
        compare=partial(compared, new.path.name, keys, rest),
        place=partial(place, named, keys),
        seen=partial(seen, rest),
    )


def _naming(shared: Sequence[str], tables: Sequence[Table]) -> tuple[str, ...]:
    """Returns the shared columns that name a row, as few as tell the rows apart.

    Where nothing less does, these are all shared columns: then no row changes.
    """
    keys = [name for name in shared if name in NAMING]
    for further in ("", *FURTHER):
        keys += [further] if further in shared else []
        if keys and all(_apart(table, keys) for table in tables):
            return tuple(keys)
    return tuple(shared)


def _apart(table: Table, keys: Sequence[str]) -> bool:
    return len({tuple(row[key] for key in keys) for row in table.rows}) == len(table.rows)


def place(named: Sequence[str], keys: Sequence[str], row: Row) -> Place:
    """Returns a row's place: the columns of every report by themselves, all others in one."""
    column = ".".join(row[name] for name in named if name != "case" and row[name])
    what = ", ".join(row[key] for key in keys if key not in named and row[key])
    return Place(row["case"] if "case" in named else "", column, what)


def seen(rest: Sequence[str], row: Row) -> Seen:
    """Every cell that is not empty, with its column."""
    return Seen(", ".join(f"{name} {row[name]}" for name in rest if row[name]))


def compared(
    file: str,
    keys: Sequence[str],
    rest: Sequence[str],
    old: Row,
    new: Row,
    rule: Rule,
    allowed: float | None,
) -> Change | None:
    """A change, never a regression: nothing is known of what a cell means."""
    differ = [name for name in rest if _another(old[name], new[name], rule)]
    if not differ:
        return None
    named = [name for name in ("case", "engine", "setting") if name in keys]
    where = place(named, keys, new)
    return Change(CHANGED, file, where, seen(differ, old), seen(differ, new))


def _another(was: str, now: str, rule: Rule) -> bool:
    """Numbers by the rule, all else as it is written."""
    try:
        return rule.differ(float(was), float(now), None)
    except ValueError:
        return was != now
