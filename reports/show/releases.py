"""Which release of an engine moved numbers, in words, from the committed versions.csv."""

import csv
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise
from textwrap import fill

from ...cases.find import of_the_book
from ...cases.load import load
from ...cases.scene.frame import PLANE
from ..write import HERE

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
    """Of each release that moved numbers which the one before it had: how many, and where."""
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
