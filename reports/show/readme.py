"""The README's summary table from the committed reports.

`python -m textmech.reports.show.readme` writes it.
"""

from pathlib import Path

from ..row import Comparison, Rungs
from ..write import HERE, read
from .summary import markdown, summary

README = Path(__file__).parents[2] / "README.md"
OPENS, CLOSES = "from reports/*.csv -->\n", "<!-- /summary -->"


def current() -> str:
    """The README as it should be."""
    lines = summary(read(HERE / "tolerance.csv", Comparison), read(HERE / "convergence.csv", Rungs))
    before, _, rest = README.read_text(encoding="utf-8").partition(OPENS)
    return f"{before}{OPENS}\n{markdown(lines)}\n{CLOSES}{rest.partition(CLOSES)[2]}"


if __name__ == "__main__":
    README.write_text(current(), encoding="utf-8")
