"""The README's tables, of all cases and of the committed reports.

`python -m textmech.reports.show.readme` writes them.
"""

from pathlib import Path

from ..row import Comparison, Rungs
from ..write import HERE, read
from .catalogue import catalogue
from .summary import markdown, summary

README = Path(__file__).parents[2] / "README.md"
SUMMARY = ("from reports/*.csv -->\n", "<!-- /summary -->")
CASES = ("from cases/*.yaml -->\n", "<!-- /cases -->")
"""What opens and closes each table."""


def current() -> str:
    """The README as it should be."""
    lines = summary(read(HERE / "tolerance.csv", Comparison), read(HERE / "convergence.csv", Rungs))
    text = README.read_text(encoding="utf-8")
    return _filled(_filled(text, SUMMARY, lines), CASES, catalogue())


def _filled(text: str, marks: tuple[str, str], lines: list[list[str]]) -> str:
    opens, closes = marks
    before, _, rest = text.partition(opens)
    return f"{before}{opens}\n{markdown(lines)}\n{closes}{rest.partition(closes)[2]}"


if __name__ == "__main__":
    README.write_text(current(), encoding="utf-8")
