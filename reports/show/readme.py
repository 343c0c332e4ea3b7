"""What is generated in the READMEs: tables of cases and of the committed reports, and a picture.

`python -m textmech.reports.show.readme` writes all of it anew.
"""

from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import NamedTuple

from ..row import Comparison, Rungs
from ..write import HERE, read
from . import picture
from .catalogue import catalogue
from .cures import cures
from .nouns import nouns
from .questions import questions
from .releases import listed, releases
from .shares import shares
from .speed import speed
from .summary import Line, approximations, summary
from .table import markdown, narrow, page

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
