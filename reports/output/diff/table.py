"""A CSV file of a report as text: its head, and its rows with their lines."""

import csv
import errno
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from io import StringIO
from pathlib import Path

from ....cases.mistake import CaseError, Mistake
from ...data.file_content import LARGEST, content

Row = Mapping[str, str]


@dataclass(frozen=True)
class Table:
    """A whole file. lines: where each row begins to stand in it, for a mistake's place."""

    path: Path
    columns: tuple[str, ...]
    rows: tuple[Row, ...]
    lines: tuple[int, ...]
    text: str

    def mistake(self, what: str, line: int = 0, column: str = "") -> Mistake:
        """A mistake in the file, at a line of it, in one of its columns."""
        return Mistake(str(self.path), line, 1 if line else 0, column, what)


def read(path: Path) -> Table:
    """Raises CaseError if the file is no table."""
    text = _text(path)
    head, *records = _records(path, text)
    columns = tuple(head[1])
    if twice := {name for name in columns if columns.count(name) > 1}:
        raise _wrong(path, f"two columns are called {min(twice)!r}")
    for line, cells in records:
        if len(cells) != len(columns):
            what = f"has {len(cells)} cells, and the head has {len(columns)}"
            raise _wrong(path, what, line)
    rows = tuple(dict(zip(columns, cells, strict=True)) for _, cells in records)
    return Table(path, columns, rows, tuple(line for line, _ in records), text)


def _text(path: Path) -> str:
    try:
        return content(path, LARGEST).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise _wrong(path, f"is no text in UTF-8: byte {error.start} cannot be read") from None
    except OSError as error:
        what = error.strerror or "cannot be read"
        ours = error.errno in (errno.EINVAL, errno.EFBIG)  # what `content` says of it
        raise _wrong(path, what if ours else f"cannot be read: {what}") from None


def _records(path: Path, body: str) -> list[tuple[int, list[str]]]:
    """(line, cells) of the head and of each row."""
    try:
        found = [*_numbered(body)]
    except csv.Error as error:
        raise _wrong(path, f"is no CSV: {error}") from None
    if not found:
        raise _wrong(path, "is empty: its first line should name the columns")
    return found


def _numbered(body: str) -> Iterator[tuple[int, list[str]]]:
    reader = csv.reader(StringIO(body, newline=""), strict=True)
    line = 1
    for cells in reader:
        yield line, cells
        line = reader.line_num + 1


def _wrong(path: Path, what: str, line: int = 0) -> CaseError:
    return CaseError([Mistake(str(path), line, 1 if line else 0, "", what)])
