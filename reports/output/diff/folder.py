"""A report folder: all its tables, whole, of one run, and with the columns that are compared."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path

from ....cases.mistake import CaseError, Mistake
from ...data import runs
from ...data.row import OF_NO_RUN
from ...data.runs import Written
from .errors import ERRORS
from .file import File
from .files import FILES
from .scope import Scope
from .table import Table, read


@dataclass(frozen=True)
class Folder:
    """Tables by their files' names. name: what a person calls it; run: what its content does."""

    name: str
    tables: Mapping[str, Table]
    run: str

    @property
    def errors(self) -> Table:
        """The one that every report has."""
        return self.tables[ERRORS.name]

    @property
    def scope(self) -> Scope:
        """The cases, and the engines with their settings, that tolerance.csv has rows of."""
        return Scope.of(self.errors.rows)

    @property
    def versions(self) -> dict[str, str]:
        """The version of every engine by its name; where a folder has two, both."""
        found = {(row["engine"], row["version"]) for row in self.errors.rows if row["version"]}
        names = sorted({engine for engine, _ in found})
        return {name: " and ".join(sorted(v for e, v in found if e == name)) for name in names}


def opened(named: Mapping[str, Path]) -> list[Folder]:
    """By their names. Raises CaseError with the mistakes of all folders."""
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
        raise CaseError([Mistake(str(path), 0, 0, "", f"{what}; a report is one, with its *.csv")])
    others = (*OF_NO_RUN, runs.NAME)
    files = sorted(file for file in path.glob("*.csv") if file.name not in others)
    if not (path / ERRORS.name).exists():
        what = f"is no report: it has no {ERRORS.name}; `textmech run --out FOLDER` writes one"
        raise CaseError([Mistake(str(path), 0, 0, "", what)])
    tables: dict[str, Table] = {}
    mistakes: list[Mistake] = []
    for file in files:
        try:
            tables[file.name] = read(file)
        except CaseError as error:
            mistakes += error.mistakes
    written = _written(path)
    for name_of, table in tables.items():
        wrong = [*_mistaken(FILES[name_of], table)] if name_of in FILES else []
        mistakes += wrong or [*_doubted(table, written)]
    mistakes += _mixed(tables, written)
    if mistakes:
        raise CaseError(mistakes)
    return Folder(name, tables, written[ERRORS.name].run)


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
    raise CaseError([Mistake(str(path / runs.NAME), 0, 0, "", what)])


def _doubted(table: Table, written: Mapping[str, Written]) -> Iterator[Mistake]:
    if doubt := runs.doubt(table.path.name, len(table.rows), table.text, written):
        yield table.mistake(doubt)


def _mixed(tables: Mapping[str, Table], written: Mapping[str, Written]) -> Iterator[Mistake]:
    """The known files are written together; others may be another command's."""
    known = [name for name in tables if name in FILES and name in written]
    if ERRORS.name in known:
        ours = written[ERRORS.name].run
        for name in known:
            if (other := written[name].run) != ours:
                what = f"of run {other}, and {ERRORS.name} beside it of run {ours}"
                yield tables[name].mistake(f"{what}: run both again")


def _mistaken(file: File, table: Table) -> Iterator[Mistake]:
    """Columns that are not there, two rows for one thing, and cells that cannot be read.

    A word that is no verdict is told where it stands first: an old table has it in many rows.
    """
    missing = [name for name in file.needed if name not in table.columns]
    if missing:
        what = f"has no column {missing[0]!r}: of another version of textmech?"
        yield table.mistake(f"{what} Its columns are {', '.join(table.columns)}")
        return
    seen: dict[tuple[str, ...], int] = {}
    words = {row["verdict"] for row in table.rows} if "verdict" in file.words else set[str]()
    strange = {word for word in words if not file.verdicts(word)}
    for row, line in zip(table.rows, table.lines, strict=True):
        key = tuple(row[name] for name in file.keys)
        if (first := seen.setdefault(key, line)) != line:
            what = f"the same {', '.join(file.keys)} as line {first}: {', '.join(key)}"
            yield table.mistake(what, line)
        for name in file.numbers:
            if not _is_number(row[name]):
                what = f"should be a number or nothing, is {row[name]!r}"
                yield table.mistake(what, line, name)
        if strange and (word := row["verdict"]) in strange:
            strange.remove(word)
            what = f"{word!r} is no verdict: of another version of textmech?"
            yield table.mistake(what, line, "verdict")


def _is_number(text: str) -> bool:
    try:
        return not text or float(text) == float(text)  # of a number that is none nothing is said
    except ValueError:
        return False
