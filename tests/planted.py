"""The planted mistakes: what the tests break on purpose, and which test sees it.

A test that plants one says so, in words: `@pytest.mark.mutant("Steiner term left out")`; in them
stands `{name}` for the test's parameter of that name. `python tests/planted.py` writes the list,
reports/mutants.csv; with `--print` it only says the list. No run writes it: no test is installed.
"""

import sys
from collections.abc import Iterable, Iterator, Mapping
from contextlib import redirect_stdout
from io import StringIO
from pathlib import Path
from typing import Any

import pandas as pd
import pytest

from textmech.reports.tables import write
from textmech.reports.tables.row import MUTANTS

ROOT = Path(__file__).parents[1]
MARK = "mutant"
SLOW = "slow"
COLUMNS = ["room", "planted", "seen_by", "loop"]


class Word(str):
    """A parameter in words. name: of a function or class, as it is written."""

    name: str


class Items:
    """A plug-in that keeps what was collected."""

    def __init__(self) -> None:
        self.found: list[pytest.Item] = []

    def pytest_collection_finish(self, session: pytest.Session) -> None:
        """Nothing is left out by then that was asked for."""
        self.found = list(session.items)


def files() -> list[Path]:
    """Those that use the mark: to collect all others too takes longer."""
    found = sorted((ROOT / "tests").rglob("test_*.py"))
    return [file for file in found if f"mark.{MARK}" in file.read_text(encoding="utf-8")]


def collected() -> list[pytest.Item]:
    """By pytest itself, in this process: not to be asked of a test."""
    items, said = Items(), StringIO()
    words = ["--collect-only", "-q", "-p", "no:cacheprovider", f"--rootdir={ROOT}"]
    words += ["-W", "ignore::pytest.PytestAssertRewriteWarning"]  # textmech is imported already
    with redirect_stdout(said):
        ended = pytest.main([*words, *map(str, files())], plugins=[items])
    if ended != pytest.ExitCode.OK:
        raise SystemExit(said.getvalue())
    return items.found


def listed(items: Iterable[pytest.Item]) -> pd.DataFrame:
    """A row for each mistake of each test; tests of one function that plant the same are one.

    loop: `quick` where `make test` sees it, `slow` where `make test-all` alone does.
    """
    found: dict[tuple[str, str, str], str] = {}
    for item in items:
        loop = SLOW if item.get_closest_marker(SLOW) else "quick"
        for row in planted(item):
            found[row] = min(loop, found.get(row, loop))
    rows = [(*row, loop) for row, loop in sorted(found.items())]
    return pd.DataFrame(rows, columns=["room", "seen_by", "planted", "loop"])[COLUMNS]


def planted(item: pytest.Item) -> Iterator[tuple[str, str, str]]:
    """The room that is broken, the test without its parameters, and what is broken."""
    seen_by = item.nodeid.partition("[")[0]
    room = Path(seen_by.partition("::")[0]).parent.relative_to("tests").as_posix()
    given = item.callspec.params if hasattr(item, "callspec") else {}  # type: ignore[attr-defined]
    told = {name: worded(value) for name, value in given.items()}
    for mark in item.iter_markers(MARK):
        if not mark.args:
            raise ValueError(f"{item.nodeid} does not say what it plants")
        for words in mark.args:
            yield room, seen_by, words.format(**told).strip()


def worded(value: Any) -> Word:
    """A parameter as a person would say it: of functions and classes what they say themselves."""
    found = Word(_worded(value))
    found.name = getattr(value, "__name__", str(value))
    return found


def _worded(value: Any) -> str:
    if isinstance(value, Mapping):
        return ", ".join(_of_key(key, one) for key, one in value.items())
    if isinstance(value, tuple):
        return " ".join(map(_worded, value))
    if callable(value):
        said = value.__doc__
        name = getattr(value, "__name__", "")
        return _opening(said) if said else name.strip("_").replace("_", " ")
    return str(value)


def _of_key(key: str, value: Any) -> str:
    """Of a method that is replaced what replaces it; of a number also whose it is."""
    return _worded(value) if callable(value) else f"{key} {_worded(value)}"


def _opening(text: str) -> str:
    """The first sentence, to stand within another."""
    first = " ".join(text.partition("\n\n")[0].split()).partition(". ")[0].rstrip(".")
    small = first[1:2].islower() or first.startswith("A ")  # no letter of the book's, as E or T
    return first[0].lower() + first[1:] if small else first


def main(*words: str) -> None:
    """Writes the list beside the reports."""
    found = listed(collected())
    texts = write.texts({MUTANTS: found})
    if "--print" in words:
        sys.stdout.buffer.write(texts[MUTANTS].encode())  # the same bytes in any terminal
        return
    write.write({MUTANTS: found}, write.HERE)
    print(f"{len(found)} planted mistakes in {len(set(found['seen_by']))} tests")


if __name__ == "__main__":
    main(*sys.argv[1:])
