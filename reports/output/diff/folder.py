"""A report folder: all its tables, whole, of one run, and with the columns that are compared."""

import csv
import errno
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from io import StringIO
from pathlib import Path

from ....cases.mistake import CaseError, Mistake
from ...data import file_content, runs
from ...data.ownership import HERE, is_checkout
from ...data.row import OF_NO_RUN
from ...data.runs import Written
from .columns import ERRORS, KNOWN, STEPS, Row

NOT_PACKED = (STEPS.name,)  # no wheel has it: a third of all tables, and it judges nothing
REFERENCE = ("reference", "")  # an engine's column in events.csv, of every run


@dataclass(frozen=True)
class Table:
    """A CSV file. lines: where each row begins to stand in it, for a mistake's place."""

    path: Path
    columns: tuple[str, ...]
    rows: tuple[Row, ...]
    lines: tuple[int, ...]
    text: str


@dataclass(frozen=True)
class Scope:
    """Cases, and engines with their settings, that both folders look at."""

    cases: frozenset[str]
    engines: frozenset[tuple[str, str]]

    def __and__(self, other: "Scope") -> "Scope":
        return Scope(self.cases & other.cases, self.engines & other.engines)

    def __or__(self, other: "Scope") -> "Scope":
        return Scope(self.cases | other.cases, self.engines | other.engines)

    def holds(self, row: Row) -> bool:
        """Whether a row is about one of the cases and one of the engines, as far as it says."""
        if "case" in row and row["case"] not in self.cases:
            return False
        engine = row.get("engine"), row.get("setting")
        return None in engine or engine == REFERENCE or engine in self.engines


@dataclass(frozen=True)
class Folder:
    """Tables by their files' names. name: what a person calls it; run: what its content does."""

    name: str
    tables: Mapping[str, Table]
    run: str

    @property
    def errors(self) -> Sequence[Row]:
        """The rows of the file that every report has; each engine has one on each case."""
        return self.tables[ERRORS.name].rows

    @cached_property
    def scope(self) -> Scope:
        """The cases and engines that the folder has errors of."""
        return Scope(
            frozenset(row["case"] for row in self.errors),
            frozenset((row["engine"], row["setting"]) for row in self.errors),
        )

    @property
    def versions(self) -> dict[str, str]:
        """The version of every engine by its name; where a folder has two, both."""
        found = {(row["engine"], row["version"]) for row in self.errors if row["version"]}
        names = sorted({engine for engine, _ in found})
        return {name: " and ".join(sorted(v for e, v in found if e == name)) for name in names}


def opened(named: Mapping[str, Path]) -> list[Folder]:
    """Reads folders, each with its name. Raises CaseError with the mistakes of all."""
    folders: list[Folder] = []
    mistakes: list[Mistake] = []
    for name, path in named.items():
        try:
            folders.append(_opened(name, path))
        except CaseError as error:
            mistakes += error.mistakes
    if mistakes:
        raise CaseError(mistakes)
    return folders


def _opened(name: str, path: Path) -> Folder:
    if not path.is_dir():
        what = "is no folder" if path.exists() else "no such folder"
        raise CaseError([_mistake(path, f"{what}; a report is one, with its *.csv")])
    if not (path / ERRORS.name).exists():
        what = f"is no report: it has no {ERRORS.name}; `textmech run --out FOLDER` writes one"
        raise CaseError([_mistake(path, what)])
    tables: dict[str, Table] = {}
    mistakes: list[Mistake] = []
    written = _written(path)
    ours = {*KNOWN, *written} - {*OF_NO_RUN, runs.NAME}  # others are not for us to read
    for file in sorted(path.glob("*.csv")):
        if file.name in ours:
            try:
                tables[file.name] = read(file)
            except CaseError as error:
                mistakes += error.mistakes
    for table in tables.values():
        mistakes += [*_unreadable(table)] or [*_doubted(table, written)]
    mistakes += [*_mixed(tables, written), *_cut(path, written)]
    if mistakes:
        raise CaseError(mistakes)
    return Folder(name, tables, written[ERRORS.name].run)


def read(path: Path) -> Table:
    """Reads a CSV file as text, cell by cell. Raises CaseError if it is no table."""
    try:
        text = file_content.text(path)
    except OSError as error:
        what = error.strerror or "cannot be read"
        ours = error.errno in (errno.EINVAL, errno.EFBIG)  # what `file_content` says of it
        raise CaseError([_mistake(path, what if ours else f"cannot be read: {what}")]) from None
    except ValueError as error:
        raise CaseError([_mistake(path, str(error).removeprefix(f"{path}: "))]) from None
    reader = csv.reader(StringIO(text, newline=""), strict=True)
    records: list[tuple[int, list[str]]] = []
    line = 1
    try:
        for cells in reader:
            records.append((line, cells))
            line = reader.line_num + 1
    except csv.Error as error:
        raise CaseError([_mistake(path, f"is no CSV: {error}", line)]) from None
    if not records:
        what = "is empty: its first line should name the columns"
        raise CaseError([_mistake(path, what)])
    (_, columns), *rows = records
    if twice := {name for name in columns if columns.count(name) > 1}:
        raise CaseError([_mistake(path, f"two columns are called {min(twice)!r}")])
    for line, cells in rows:
        if len(cells) != len(columns):
            what = f"has {len(cells)} cells, and the head has {len(columns)}"
            raise CaseError([_mistake(path, what, line)])
    return Table(
        path,
        tuple(columns),
        tuple(dict(zip(columns, cells, strict=True)) for _, cells in rows),
        tuple(line for line, _ in rows),
        text,
    )


def _mistake(path: Path, what: str, line: int = 0, column: str = "") -> Mistake:
    return Mistake(str(path), line, 1 if line else 0, column, what)


def _written(path: Path) -> Mapping[str, Written]:
    """Reads the folder's own list of its tables. Raises CaseError where it cannot be read."""
    try:
        if found := runs.read(path):
            return found
        what = "is not there, or names no table: it is what tells whether the others are whole"
    except ValueError as error:
        what = str(error).removeprefix(f"{path / runs.NAME}: ")
    except OSError as error:
        what = error.strerror or "cannot be read"
    raise CaseError([_mistake(path / runs.NAME, what)])


def _doubted(table: Table, written: Mapping[str, Written]) -> Iterator[Mistake]:
    if doubt := runs.doubt(table.path.name, len(table.rows), table.text, written):
        yield _mistake(table.path, doubt)


def _mixed(tables: Mapping[str, Table], written: Mapping[str, Written]) -> Iterator[Mistake]:
    """The known files are written together; others may be another command's."""
    known = [name for name in tables if name in KNOWN and name in written]
    if ERRORS.name in known:
        ours = written[ERRORS.name].run
        for name in known:
            if (other := written[name].run) != ours:
                what = f"of run {other}, and {ERRORS.name} beside it of run {ours}"
                yield _mistake(tables[name].path, f"{what}: run both again")


def _cut(path: Path, written: Mapping[str, Written]) -> Iterator[Mistake]:
    """The known files of the run that are not there any more."""
    run = written[ERRORS.name].run if ERRORS.name in written else None
    packed = path.resolve() == HERE and not is_checkout()
    for name in sorted({*KNOWN} & {*written} - ({*NOT_PACKED} if packed else set())):
        if written[name].run == run and not (path / name).exists():
            what = f"is not there, and {runs.NAME} names it: the folder was cut; run it again"
            yield _mistake(path / name, what)


def _unreadable(table: Table) -> Iterator[Mistake]:
    """Columns that are not there, two rows for one thing, and cells that cannot be read.

    A word that is no verdict is told where it stands first: an old table has it in many rows.
    """
    columns = KNOWN.get(table.path.name)
    if columns is None:
        return
    missing = [name for name in columns.needed if name not in table.columns]
    if missing:
        what = f"has no column {missing[0]!r}: of another version of textmech?"
        yield _mistake(table.path, f"{what} Its columns are {', '.join(table.columns)}")
        return
    seen: dict[tuple[str, ...], int] = {}
    strange: set[str] = set()
    for row, line in zip(table.rows, table.lines, strict=True):
        key = columns.key(row)
        if (first := seen.setdefault(key, line)) != line:
            what = f"the same {', '.join(columns.keys)} as line {first}: {', '.join(key)}"
            yield _mistake(table.path, what, line)
        for name in columns.numbers:
            if not _is_number(row[name]):
                what = f"should be a number or nothing, is {row[name]!r}"
                yield _mistake(table.path, what, line, name)
        verdict = row["verdict"] if columns.verdicts else None
        if verdict is not None and verdict not in (*columns.verdicts, *strange):
            strange.add(verdict)
            what = f"{verdict!r} is no verdict: of another version of textmech?"
            yield _mistake(table.path, what, line, "verdict")


def _is_number(text: str) -> bool:
    try:
        return not text or float(text) == float(text)  # of a number that is none nothing is said
    except ValueError:
        return False
