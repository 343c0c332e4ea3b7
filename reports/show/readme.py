"""The README's tables, of all cases and of the committed reports.

`python -m textmech.reports.show.readme` writes them.
"""

from collections.abc import Mapping, Sequence
from pathlib import Path

from ..row import Comparison, Rungs
from ..write import HERE, read
from .catalogue import catalogue
from .cures import cures
from .questions import questions
from .summary import approximations, summary
from .table import markdown, page

README = Path(__file__).parents[2] / "README.md"
Cells = Sequence[Sequence[str]]


def current() -> str:
    """The README as it should be."""
    text = README.read_text(encoding="utf-8")
    for name, table in tables().items():
        text = _filled(text, name, table)
    return text


def tables() -> Mapping[str, Cells]:
    """Each by the name that stands in the comments which open and close it."""
    rows = read(HERE / "tolerance.csv", Comparison)
    rungs = read(HERE / "convergence.csv", Rungs)
    return {
        "questions": questions(),
        "summary": page(summary(rows, rungs, cures(HERE))),
        "approximations": page(approximations(rows, rungs)),
        "cases": catalogue(),
    }


def _filled(text: str, name: str, table: Cells) -> str:
    opens, closes = f"<!-- {name}: ", f"<!-- /{name} -->"
    before, _, rest = text.partition(opens)
    said, _, old = rest.partition("\n")
    return f"{before}{opens}{said}\n\n{markdown(table)}\n{closes}{old.partition(closes)[2]}"


if __name__ == "__main__":
    README.write_text(current(), encoding="utf-8")
