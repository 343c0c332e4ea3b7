"""A report folder: all its tables, as a run wrote them, with the columns that are compared."""

from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

from ....cases.mistake import CaseError, Mistake
from .. import run_list
from ..ownership import HERE, is_checkout
from ..run_list import Written
from .columns import ERRORS, KNOWN, OF_A_RUN, STEPS, Columns, Row

NOT_PACKED = (STEPS.name,)  # no wheel has it: a third of all tables, and it judges nothing


@dataclass(frozen=True)
class Folder:
    """The rows of tables by file name. name: what a person calls it; run: what its content does."""

    name: str
    tables: Mapping[str, Sequence[Row]]
    run: str

    @property
    def errors(self) -> Sequence[Row]:
        """The rows of the file that every report has; each engine has one on each case."""
        return self.tables[ERRORS.name]

    @cached_property
    def cases(self) -> frozenset[str]:
        """The cases that the folder has errors of."""
        return frozenset(row["case"] for row in self.errors)

    @cached_property
    def engines(self) -> frozenset[tuple[str, str]]:
        """The engines with their settings that the folder has errors of."""
        return frozenset((row["engine"], row["setting"]) for row in self.errors)

    @property
    def versions(self) -> dict[str, str]:
        """The version of every engine by its name; where a folder has two, both."""
        pairs = {(row["engine"], row["version"]) for row in self.errors if row["version"]}
        names = sorted({engine for engine, _ in pairs})
        return {name: " and ".join(sorted(v for e, v in pairs if e == name)) for name in names}


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
    tables: dict[str, Sequence[Row]] = {}
    written: Mapping[str, Written] = {}
    mistakes: list[Mistake] = []
    with _noted(path / run_list.NAME, mistakes):
        written = run_list.read(path)
        if not written:
            what = "is not there, or names no table: it is what tells whether the others are whole"
            raise ValueError(what)
    for file in (path / columns for columns in KNOWN if written):
        if file.exists():
            with _noted(file, mistakes):
                tables[file.name] = run_list.table(file)
                _check_cells(KNOWN[file.name], tables[file.name])
    mistakes += _mixed(path, written)
    if mistakes:
        raise CaseError(mistakes)
    return Folder(name, tables, written[ERRORS.name].run)


@contextmanager
def _noted(path: Path, mistakes: list[Mistake]) -> Iterator[None]:
    """Adds what is wrong with the file to the mistakes."""
    try:
        yield
    except OSError as error:
        mistakes.append(_mistake(path, f"cannot be read: {error.strerror}"))
    except ValueError as error:
        mistakes.append(_mistake(path, str(error).removeprefix(f"{path}: ")))


def _mistake(path: Path, what: str) -> Mistake:
    return Mistake(str(path), 0, 0, "", what)


def _mixed(path: Path, written: Mapping[str, Written]) -> Iterator[Mistake]:
    """Files of another run than tolerance.csv, and files of its run that are not there any more."""
    run = written[ERRORS.name].run if ERRORS.name in written else None
    packed = path.resolve() == HERE and not is_checkout()
    for name in sorted(OF_A_RUN & written.keys() if run else ()):
        if written[name].run != run:
            other = f"of run {written[name].run}, and {ERRORS.name} beside it of run {run}"
            yield _mistake(path / name, f"{other}: run both again")
        elif not (path / name).exists() and not (packed and name in NOT_PACKED):
            what = f"is not there, and {run_list.NAME} names it: the folder was cut; run it again"
            yield _mistake(path / name, what)


def _check_cells(columns: Columns, rows: Sequence[Row]) -> None:
    """Raises ValueError where a table has other columns or words than this version writes."""
    if rows and (missing := [name for name in columns.needed if name not in rows[0]]):
        what = f"has no column {missing[0]!r}: of another version of textmech?"
        raise ValueError(f"{what} Its columns are {', '.join(rows[0])}")
    for row in rows:
        for name in columns.numbers:
            try:
                float(row[name] or 0)
            except ValueError:
                what = f"should be a number or nothing, is {row[name]!r}"
                raise ValueError(f"{name}: {what}") from None
        if columns.verdicts and row["verdict"] not in columns.verdicts:
            raise ValueError(f"{row['verdict']!r} is no verdict: of another version of textmech?")
