"""Generates parts of the READMEs: tables of cases and of the committed reports, and a picture.

`python -m textmech.reports.show.readme` writes all of it anew.
"""

import csv
from collections.abc import Callable, Iterator, Mapping, Sequence
from functools import cache
from itertools import pairwise
from pathlib import Path
from textwrap import fill
from typing import NamedTuple

from ...cases.find import of_the_book
from ...cases.load import load
from ...cases.scene.frame import PLANE
from ..data.row import Comparison, Rungs
from ..output.write import HERE, read
from . import picture
from .cures import cures
from .nouns import nouns
from .questions import questions
from .shares import shares
from .speed import speed
from .summary import Line, approximations, summary
from .table import markdown, narrow, page

# Which release of an engine moved numbers, in words, from the committed versions.csv.


Row = Mapping[str, str]
WIDTH = 100
PLACE = ("case", "engine", "setting", "realised", "quantity")


def listed() -> list[Row]:
    """The rows of the committed table."""
    with (HERE / "versions.csv").open(encoding="utf-8", newline="") as lines:
        return [*csv.DictReader(lines)]


def releases(rows: Sequence[Row]) -> str:
    """Which cases the table sweeps, and of each engine which release moved what in them."""
    files = sorted({row["case"].partition(".")[0] for row in rows})
    frames = {load(of_the_book()[name])[0].scene.frame for name in files}
    where = "all of the plane" if frames == {PLANE} else "of the plane and of space"
    lines = [fill(f"The table sweeps these cases, {where}: {_named(files)}.", WIDTH), ""]
    for engine in sorted({row["engine"] for row in rows}):
        its = [row for row in rows if row["engine"] == engine]
        swept = [*dict.fromkeys(row["version"] for row in its)]
        told = "; ".join(_told(its, swept)) or "no release moved a number"
        lines.append(fill(f"- {engine} {', '.join(swept)}: {told}.", WIDTH, subsequent_indent="  "))
    return "\n".join(lines) + "\n"


def _told(rows: Sequence[Row], swept: Sequence[str]) -> Iterator[str]:
    """For each release that moved numbers which the one before had: how many moved, and where."""
    for before, now in pairwise(swept):
        had = {_place(row) for row in rows if row["version"] == before and row["error"]}
        moved = [
            row
            for row in rows
            if row["version"] == now and row["moved"] and row["error"] and _place(row) in had
        ]
        if moved:
            files = sorted({row["case"].partition(".")[0] for row in moved})
            count = f"{len(moved)} number{'s' if len(moved) > 1 else ''}"
            yield f"{now} moved {count}, in {_named(files)}"


def _place(row: Row) -> tuple[str, ...]:
    return tuple(row[name] for name in PLACE)


def _named(files: Sequence[str]) -> str:
    return ", ".join(f"`{name}`" for name in files)


# The list of the textbook cases: what each claims, and where in the book it comes from.


def catalogue() -> list[list[str]]:
    """Lines of cells, the head first: a file, its title, and its places in the book."""
    lines = [["case", "what it claims", "in the book"]]
    for name, path in sorted(of_the_book().items()):
        first = load(path)[0]
        lines.append([f"[`{name}`]({path.name})", first.title, str(first.origin)])
    return lines


ROOT = Path(__file__).parents[2]
PICTURE = HERE / picture.NAME
FIRST = "four_bar"  # the case that the README begins with


class Part(NamedTuple):
    """A text of a file: it stands between `<!-- name: … -->` and `<!-- /name -->`."""

    file: str
    name: str
    text: Callable[[], str]


def _first() -> str:
    return f"```\n{narrow([line for line in _lines() if line.case == FIRST])}\n```\n"


@cache
def _lines() -> Sequence[Line]:
    return summary(_rows(), _rungs(), cures(HERE))


@cache
def _rows() -> Sequence[Comparison]:
    return read(HERE / "tolerance.csv", Comparison)


@cache
def _rungs() -> Sequence[Rungs]:
    return read(HERE / "convergence.csv", Rungs)


PARTS = (
    Part("README.md", "shares", lambda: markdown(shares(_rows()))),
    Part("README.md", "first", _first),
    Part("README.md", "speed", speed),
    Part("reports/README.md", "summary", lambda: markdown(page(_lines()))),
    Part(
        "reports/README.md",
        "approximations",
        lambda: markdown(page(approximations(_rows(), _rungs()))),
    ),
    Part("reports/README.md", "releases", lambda: releases(listed())),
    Part("engines/SCENE.md", "scene", nouns),
    Part("cases/CATALOGUE.md", "cases", lambda: markdown(catalogue())),
    Part("cases/questions/README.md", "questions", lambda: markdown(questions())),
)
FILES = (*dict.fromkeys(part.file for part in PARTS),)


def current(file: str) -> str:
    """One of FILES as it should be. Raises ValueError where a part has no place in it."""
    text = (ROOT / file).read_text(encoding="utf-8")
    for part in PARTS:
        if part.file == file:
            text = filled(text, part)
    return text


def filled(text: str, part: Part) -> str:
    """The text with the part in its place."""
    opens, closes = f"<!-- {part.name}: ", f"<!-- /{part.name} -->"
    if (text.count(opens), text.count(closes)) != (1, 1):
        raise ValueError(f"{part.file} should have one {opens}… --> and one {closes}")
    before, _, rest = text.partition(opens)
    said, _, old = rest.partition("\n")
    if closes not in old:
        raise ValueError(f"{part.file}: {closes} should stand below {opens}… -->")
    return f"{before}{opens}{said}\n\n{part.text()}\n{closes}{old.partition(closes)[2]}"


def drawn() -> str:
    """The picture as it should be."""
    return picture.picture(_rows())


if __name__ == "__main__":
    written = {file: current(file) for file in FILES}
    for file, text in written.items():
        (ROOT / file).write_text(text, encoding="utf-8")
    PICTURE.write_text(drawn(), encoding="utf-8")
