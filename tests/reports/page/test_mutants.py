"""The planted mistakes on the page: counted by room, each with the test that sees it."""

from dataclasses import replace
from types import SimpleNamespace

import pandas as pd
import pytest

from textmech.reports.data.row import MUTANTS
from textmech.reports.page.page import COLUMNS, mutants, page

LAW, ODD = "tests/reference/test_law.py::test_seen", "tests/engines/test_odd.py::test_seen"
FRAME = pd.DataFrame(
    [
        ("reference", "gravity upside down", LAW),
        ("reference", "Steiner term left out", LAW),
        ("engines", "<b>5 % on J</b>", ODD),
    ],
    columns=list(COLUMNS),
)


def shown(made: SimpleNamespace, beside: dict[str, pd.DataFrame]) -> str:
    text = page(replace(made.folder, beside=beside), made.cases, made.motions)
    return text.partition('id="trust"')[2].partition("</section>")[0]


def test_they_are_counted_by_room_and_by_test() -> None:
    found = mutants(FRAME)
    assert found is not None
    assert (found["count"], found["tests"]) == (3, 2)
    assert [(room["room"], room["count"]) for room in found["rooms"]] == [
        ("engines", 1),
        ("reference", 2),
    ]
    ((test,),) = (room["tests"] for room in found["rooms"] if room["room"] == "reference")
    assert test == {"seen_by": LAW, "planted": ["gravity upside down", "Steiner term left out"]}


@pytest.mark.slow
def test_each_is_on_the_page_with_its_test_and_is_no_markup(made: SimpleNamespace) -> None:
    text = shown(made, {MUTANTS: FRAME})
    assert "<summary>All 3 mistakes</summary>" in text
    assert f'gravity upside down<br>Steiner term left out</td><td class="names">{LAW}<' in text
    assert "&lt;b&gt;5 % on J&lt;/b&gt;" in text


@pytest.mark.slow
def test_beside_a_users_own_reports_there_is_none_and_no_word_of_it(made: SimpleNamespace) -> None:
    assert mutants(None) is None
    text = shown(made, {})
    assert "Certificates" in text
    assert "Mutants" not in text
    assert MUTANTS not in text
