"""Says for the README how long people wait, from the committed speed.csv."""

import csv
from textwrap import fill

from ..data.row import SPEED
from ..output.write import HERE

TOLD = {
    "make reports, in a fresh clone, with its set-up": "`make reports` takes {} in a fresh clone",
    "make reports, nothing changed": "and {} where nothing has changed",
    "make test, nothing known": "`make test` takes {} at first",
    "make test again": "and {} again",
}
"""By the row of the table the words for it."""
WIDTH = 100


def speed() -> str:
    """A sentence, of the last time that `make speed` was run."""
    with (HERE / SPEED).open(encoding="utf-8", newline="") as lines:
        wall = {row["what"]: float(row["wall"]) for row in csv.DictReader(lines)}
    told = ", ".join(words.format(_about(wall[what])) for what, words in TOLD.items())
    return fill(f"On a server with two cores: {told}.", WIDTH) + "\n"


def _about(seconds: float) -> str:
    if seconds < 90:
        return f"about {seconds:.0f} s"
    return f"about {seconds / 60:.2g} min"
