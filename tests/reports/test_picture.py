"""The README's picture: the same bytes from the same rows, and what it says is counted."""

import re
from math import inf

import pytest
from given.lines import refused, row

from textmech.reports.show import readme
from textmech.reports.show.picture import picture


def labels(svg: str) -> list[str]:
    return re.findall(r">(\w+ \w+: \d+% of \d+)<", svg)


@pytest.mark.slow
def test_the_committed_one_is_drawn_from_the_committed_reports() -> None:
    assert readme.PICTURE.read_text(encoding="utf-8") == readme.drawn()


def test_a_case_counts_by_its_worst_quantity() -> None:
    rows = [
        row(case="one"),
        row(case="one", ratio=3.0, quantity="b.x"),
        row(case="two"),
        row(case="two", ratio=1e9, quantity="audit"),
        row(case="three", ratio=None),  # diverged
        refused(case="four"),
        row(case="four", realised="law"),
        row("karnopp", case="one", engine="book"),
        row("tuned", ratio=inf, case="one"),
        row("tuned", ratio=1.0, case="two", engine="pymunk"),
    ]
    assert labels(picture(rows)) == [
        "mujoco shipped: 33% of 3",
        "mujoco tuned: 0% of 1",
        "pymunk tuned: 100% of 1",
    ]


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [0.4, 2.0])
def test_another_row_is_another_picture(ratio: float) -> None:
    assert picture([row(ratio=ratio)]) == picture([row(ratio=ratio)])
    assert picture([row(ratio=ratio)]) != picture([row(ratio=0.1)])
