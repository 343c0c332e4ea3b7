"""Generates parts of the READMEs: tables of cases and of the committed reports, and a picture.

`python -m textmech.reports.front.show.readme` writes all of it anew.
"""

import csv
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path
from statistics import mean, median
from textwrap import fill
from typing import Any, NamedTuple

from ruamel.yaml import YAML

from ....cases.find import of_the_book
from ....cases.load import load
from ....cases.scene.frame import PLANE
from ....engines import place
from ....engines.knobs import as_text
from ...compare.own_rows import THEME as OWN_MODEL
from ...tables.row import SPEED, Comparison, Rungs
from ...tables.short_numbers import factor
from ...tables.write import HERE, read
from . import picture
from .cures import cures
from .nouns import nouns
from .picture import worst
from .summary import Line, approximations, summary
from .table import markdown, narrow, page

# Says for the README how long people wait, from the committed speed.csv.


TOLD = {
    "make reports, in a fresh clone, with its set-up": "`make reports` takes {} in a fresh clone",
    "make reports, nothing changed": "and {} where nothing has changed",
    "make test, nothing known": "`make test` takes {} at first",
    "make test again": "and {} again",
}
"""By the row of the table the words for it."""


def speed() -> str:
    """Returns a sentence on the times of the last `make speed`."""
    with (HERE / SPEED).open(encoding="utf-8", newline="") as lines:
        wall = {row["what"]: float(row["wall"]) for row in csv.DictReader(lines)}
    times = ", ".join(words.format(_about(wall[what])) for what, words in TOLD.items())
    return fill(f"On a server with two cores: {times}.", WIDTH) + "\n"


def _about(seconds: float) -> str:
    if seconds < 90:
        return f"about {seconds:.0f} s"
    return f"about {seconds / 60:.2g} min"


# Which release of an engine moved numbers, in words, from the committed versions.csv.


Row = Mapping[str, str]
WIDTH = 100
PLACE = ("case", "engine", "setting", "realised", "quantity")


def listed() -> list[Row]:
    """The rows of the committed table."""
    with (HERE / "versions.csv").open(encoding="utf-8", newline="") as lines:
        return [*csv.DictReader(lines)]


def releases(rows: Sequence[Row]) -> str:
    """Returns which cases the table sweeps, and which release of each engine moved what."""
    files = sorted({row["case"].partition(".")[0] for row in rows})
    frames = {load(of_the_book()[name])[0].scene.frame for name in files}
    where = "all of the plane" if frames == {PLANE} else "of the plane and of space"
    lines = [fill(f"The table sweeps these cases, {where}: {_joined_files(files)}.", WIDTH), ""]
    for engine in sorted({row["engine"] for row in rows}):
        its = [row for row in rows if row["engine"] == engine]
        swept = [*dict.fromkeys(row["version"] for row in its)]
        text = "; ".join(_release_changes(its, swept)) or "no release moved a number"
        lines.append(fill(f"- {engine} {', '.join(swept)}: {text}.", WIDTH, subsequent_indent="  "))
    return "\n".join(lines) + "\n"


def _release_changes(rows: Sequence[Row], swept: Sequence[str]) -> Iterator[str]:
    """Yields for each release how many numbers it moved that the one before had, and where."""
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
            yield f"{now} moved {count}, in {_joined_files(files)}"


def _place(row: Row) -> tuple[str, ...]:
    return tuple(row[name] for name in PLACE)


def _joined_files(files: Sequence[str]) -> str:
    return ", ".join(f"`{name}`" for name in files)


# The list of the textbook cases: what each claims, and where in the book it comes from.


def catalogue() -> list[list[str]]:
    """Lines of cells, the head first: a file, its title, and its places in the book."""
    lines = [["case", "what it claims", "in the book"]]
    for name, path in sorted(of_the_book().items()):
        first = load(path)[0]
        lines.append([f"[`{name}`]({path.name})", first.title, str(first.origin)])
    return lines


ROOT = Path(__file__).parents[3]
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
    return summary(_committed_rows(), _rungs(), cures(HERE))


@cache
def _committed_rows() -> Sequence[Comparison]:
    """The rows of scenes: a model's are against its own limit, and have a table of their own."""
    return [row for row in read(HERE / "tolerance.csv", Comparison) if row.theme != OWN_MODEL]


@cache
def _rungs() -> Sequence[Rungs]:
    return read(HERE / "convergence.csv", Rungs)


PARTS = (
    Part("README.md", "shares", lambda: markdown(shares(_committed_rows()))),
    Part("README.md", "first", _first),
    Part("README.md", "speed", speed),
    Part("reports/README.md", "summary", lambda: markdown(page(_lines()))),
    Part(
        "reports/README.md",
        "approximations",
        lambda: markdown(page(approximations(_committed_rows(), _rungs()))),
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
    """Returns the text with the part in its place."""
    opens, closes = f"<!-- {part.name}: ", f"<!-- /{part.name} -->"
    if (text.count(opens), text.count(closes)) != (1, 1):
        raise ValueError(f"{part.file} should have one {opens}… --> and one {closes}")
    before, _, rest = text.partition(opens)
    said, _, old = rest.partition("\n")
    if closes not in old:
        raise ValueError(f"{part.file}: {closes} should stand below {opens}… -->")
    return f"{before}{opens}{said}\n\n{part.text()}\n{closes}{old.partition(closes)[2]}"


def drawn() -> str:
    """Returns the README's picture as it should be."""
    return picture.picture(_committed_rows())


# Lists what people ask in public: the case that answers, in a line, and the setting it takes.


LISTED = Path(__file__).parents[2] / "questions.yaml"
WORDS = {
    "shipped": "as shipped",
    "law": "none: only our law beside it",
}
"""What may stand in place of own options, and what is said of it."""


@dataclass(frozen=True)
class Question:
    """A question, its answer, and with what each engine agrees: own options, or one of WORDS."""

    asks: str
    answer: str
    settings: Mapping[str, Mapping[str, Any] | str]


def listed_questions() -> Mapping[str, Question]:
    """Returns the questions by the case that answers, in the order of reading."""
    questions = YAML(typ="safe").load(LISTED.read_text(encoding="utf-8"))
    return {name: Question(q["asks"], q["answer"], q["with"]) for name, q in questions.items()}


def questions() -> list[list[str]]:
    """Lines of cells, the head first."""
    lines = [["question", "case", "answer", "setting"]]
    for name, question in listed_questions().items():
        settings = (_setting(e, s) for e, s in question.settings.items())
        case = f"[`{name}`]({name}.yaml)"
        lines.append([question.asks, case, question.answer, "<br>".join(settings)])
    return lines


def _setting(engine: str, setting: Mapping[str, Any] | str) -> str:
    """Returns a setting as a whole file, or in words."""
    if isinstance(setting, str):
        return f"{engine}: {WORDS[setting]}"
    return f"`{engine}: {as_text(setting)}`"


# The first table of the README: how many cases each engine gets right, and how far off it is.


FAR = 100.0


def shares(rows: Sequence[Comparison]) -> list[list[str]]:
    """Lines of cells, the head first: a line for each engine's setting."""
    lines = [["setting", "every quantity within", "one off ×100 or more", "the worst, in median"]]
    for (engine, setting), ratios in sorted(worst(rows).items(), key=_at_angle):
        within = f"{_share(ratio <= 1 for ratio in ratios)} of {len(ratios)} cases"
        far = _share(ratio >= FAR for ratio in ratios)
        lines.append([f"{engine} {setting}", within, far, _times(median(ratios))])
    return lines


def _share(those: Iterable[bool]) -> str:
    return f"{mean(those):.0%}".replace("%", " %")


def _at_angle(item: tuple[tuple[str, str], list[float]]) -> tuple[str, float]:
    (engine, setting), _ = item
    return engine, place(setting)


def _times(ratio: float) -> str:
    """Formats a ratio; below 1 only its order of magnitude matters."""
    return f"{factor(ratio) if ratio > 1 else f'×{ratio:.1g}'} its tolerance"


if __name__ == "__main__":
    written = {file: current(file) for file in FILES}
    for file, text in written.items():
        (ROOT / file).write_text(text, encoding="utf-8")
    PICTURE.write_text(drawn(), encoding="utf-8")
