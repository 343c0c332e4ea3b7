"""The README's tables and its picture, of all cases and of the committed reports.

`python -m textmech.reports.show.readme` writes them.
"""

from collections.abc import Mapping
from pathlib import Path

from ..row import Comparison, Rungs
from ..write import HERE, read
from . import picture
from .catalogue import catalogue
from .cures import cures
from .questions import questions
from .summary import approximations, summary
from .table import markdown, narrow, page

README = Path(__file__).parents[2] / "README.md"
PICTURE = HERE / picture.NAME
FIRST = "four_bar"  # the case that the README begins with


def current() -> str:
    """The README as it should be."""
    text = README.read_text(encoding="utf-8")
    for name, block in blocks().items():
        text = _filled(text, name, block)
    return text


def blocks() -> Mapping[str, str]:
    """Each by the name that stands in the comments which open and close it."""
    rows = read(HERE / "tolerance.csv", Comparison)
    lines = summary(rows, rungs := read(HERE / "convergence.csv", Rungs), cures(HERE))
    first = narrow([line for line in lines if line.case == FIRST])
    return {
        "first": f"```\n{first}\n```\n",
        "questions": markdown(questions()),
        "summary": markdown(page(lines)),
        "approximations": markdown(page(approximations(rows, rungs))),
        "cases": markdown(catalogue()),
    }


def drawn() -> str:
    """The picture as it should be."""
    return picture.picture(read(HERE / "tolerance.csv", Comparison))


def _filled(text: str, name: str, block: str) -> str:
    opens, closes = f"<!-- {name}: ", f"<!-- /{name} -->"
    before, _, rest = text.partition(opens)
    said, _, old = rest.partition("\n")
    return f"{before}{opens}{said}\n\n{block}\n{closes}{old.partition(closes)[2]}"


if __name__ == "__main__":
    README.write_text(current(), encoding="utf-8")
    PICTURE.write_text(drawn(), encoding="utf-8")
