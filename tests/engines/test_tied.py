"""Numbers that follow the step, by a closed grammar."""

import pytest

from textmech.engines.step_scaled import at, tied

H = 0.5  # s: every power of it is exact, and another number

FOLLOWS = {
    "2h": 1.0,
    "-2h": -1.0,
    "8.0h": 4.0,
    "2 h": 1.0,
    " .5h": 0.25,
    "1e1h": 5.0,
    "-1/h": -2.0,
    "-1 / h": -2.0,
    "0.25/h2": 1.0,
    "-0.25/h²": -1.0,
    "+3/h2": 12.0,
}


@pytest.mark.parametrize("text", FOLLOWS)
def test_what_follows(text: str) -> None:
    assert tied(text)
    assert at(text, H) == FOLLOWS[text]


@pytest.mark.parametrize(
    "text",
    [
        "h",
        "2",
        "RK4",
        "2hh",
        "2h2",
        "1/h3",
        "1/(h)",
        "2*h",
        "h/2",
        "nanh",
        "infh",
        "1e101h",
        "-1e309/h",
        "",
        "1e5",
    ],
)
def test_what_does_not(text: str) -> None:
    assert not tied(text)
    assert at(text, H) == text


def test_entries_of_lists() -> None:
    assert at(["2h", 1.0, ("-1/h", "word")], H) == [1.0, 1.0, [-2.0, "word"]]
    assert at({"a": "2h"}, H) == {"a": "2h"}
