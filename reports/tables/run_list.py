"""runs.csv: which tables a folder's runs wrote, how many rows each has, and what it held.

The tables themselves hold rows and nothing else, so that any program reads them as they are. What
tells that one was cut, was changed by hand, or is of another run than the table beside it stands
here, in a row for each.
"""

import csv
import re
from collections.abc import Mapping
from dataclasses import dataclass
from hashlib import sha256
from io import StringIO
from pathlib import Path

from . import file_content as content

NAME = "runs.csv"
HEAD = ("file", "rows", "run", "content")
LETTERS = 12  # of a digest: two runs, or two tables, never share them
_CELLS = (r"[^\r\n]{1,255}", r"\d{1,12}", r"[0-9a-f]{1,100}", r"[0-9a-f]{1,100}")


@dataclass(frozen=True)
class Written:
    """A table when it was written: rows, run, digest. run: the same of all tables of one run."""

    rows: int
    run: str
    content: str


def digest(text: str) -> str:
    """Names a text by what it says, whatever ends its lines and marks its bytes' order."""
    plain = text.removeprefix("\ufeff").replace("\r\n", "\n")
    return sha256(plain.encode()).hexdigest()[:LETTERS]


def listed(tables: Mapping[str, tuple[int, str]], folder: Path | None) -> str:
    """Returns the text of runs.csv for the (rows, text) of one run's tables, by file name.

    Tables of other runs that the folder's own list names stay in it, unless it cannot be read.
    """
    run = digest("\0".join([*tables, *(text for _, text in tables.values())]))
    try:
        rows = read(folder) if folder else {}
    except (OSError, ValueError):
        rows = {}
    rows |= {name: Written(count, run, digest(text)) for name, (count, text) in tables.items()}
    out = StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(HEAD)
    writer.writerows((name, row.rows, row.run, row.content) for name, row in sorted(rows.items()))
    return out.getvalue()


def read(folder: Path) -> dict[str, Written]:
    """The folder's list by file name; empty where there is none. Raises OSError, ValueError."""
    path = folder / NAME
    if not path.exists() and not path.is_symlink():
        return {}
    try:
        lines = [*csv.reader(StringIO(content.text(path), newline=""), strict=True)]
    except csv.Error as error:
        raise ValueError(f"{path}: is no CSV: {error}") from None
    if not lines or tuple(lines[0]) != HEAD:
        raise ValueError(f"{path}: its first line should be {','.join(HEAD)}")
    by_name: dict[str, Written] = {}
    for line, cells in enumerate(lines[1:], start=2):
        if len(cells) != len(HEAD) or not all(map(_fits, _CELLS, cells)):
            raise ValueError(f"{path}: line {line}: should be a file, a count and two digests")
        name, count, run, held = cells
        by_name[name] = Written(int(count), run, held)
    return by_name


def table(path: Path) -> list[dict[str, str]]:
    """Returns the rows of a table by column. Raises OSError; ValueError if no run left it so."""
    text, written = content.text(path), read(path.parent)
    try:
        rows = [*csv.DictReader(StringIO(text, newline=""), strict=True)]
    except csv.Error as error:
        raise ValueError(f"{path}: is no CSV: {error}") from None
    if what := doubt(path.name, len(rows), text, written):
        raise ValueError(f"{path}: {what}")
    return rows


def _fits(pattern: str, cell: str) -> bool:
    return re.fullmatch(pattern, cell, re.ASCII) is not None


def doubt(name: str, rows: int, text: str, written: Mapping[str, Written]) -> str:
    """Says why a table is not as a run left it, or nothing."""
    known = written.get(name)
    if known is None:
        return f"no run has written it: {NAME} beside it does not name it"
    if rows != known.rows:
        return f"cut, or changed by hand: {rows} rows, and {NAME} says {known.rows}"
    if digest(text) != known.content:
        return f"changed by hand, or of another run: {NAME} beside it says so"
    return ""
