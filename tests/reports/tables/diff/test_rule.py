"""When a number has moved: never by rounding, always by what a person would call another number."""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from textmech.reports.tables.diff.columns import Rule
from textmech.reports.tables.diff.compare import factor

RULE = Rule()
NUMBERS = st.none() | st.floats(min_value=0.0) | st.just(math.nan)
ALLOWED = st.none() | st.floats(min_value=1e-12, max_value=1e3)


@pytest.mark.parametrize(
    ("was", "now", "allowed", "moved"),
    [
        (1.00e-3, 1.01e-3, 1e-3, False),  # one in the third written digit
        (9.99e-3, 1.00e-2, 1e-3, False),
        (1.00e-3, 1.02e-3, 1e-3, True),
        (1.00e-3, 0.98e-3, 1e-3, True),
        (1e-12, 9e-10, 1e-3, False),  # both far below what matters
        (1e-12, 1.1e-9, 1e-3, True),
        (0.0, 0.9e-9, 1e-3, False),
        (0.0, 1.1e-9, 1e-3, True),
        (None, None, 1e-3, False),
        (None, 0.0, 1e-3, True),
        (0.0, None, 1e-3, True),
        (math.inf, math.inf, 1e-3, False),
        (math.inf, 1.0, 1e-3, True),
        (math.nan, math.nan, 1e-3, False),
        (math.nan, 1.0, 1e-3, True),
        (1.0, 2.0, None, True),
    ],
)
def test_what_has_moved(
    was: float | None, now: float | None, allowed: float | None, moved: bool
) -> None:
    assert RULE.differ(was, now, allowed) is moved


@pytest.mark.parametrize(
    ("was", "now", "grown"),
    [
        (1e-3, 1.4e-3, False),
        (1e-3, 1.6e-3, True),
        (1.6e-3, 1e-3, False),
        (1e-9, 0.9e-6, False),  # grown, and still a thousandth of what is allowed
        (1e-9, 1.1e-6, True),
        (0.0, 1.1e-6, True),
        (1e-3, math.inf, True),
        (1e-3, math.nan, True),
        (None, 1.0, False),
    ],
)
def test_what_has_grown(was: float | None, now: float | None, grown: bool) -> None:
    assert RULE.grown(was, now, 1e-3) is grown


@given(NUMBERS, NUMBERS, ALLOWED)
def test_the_rule_is_the_same_both_ways_and_never_sees_a_number_move_from_itself(
    was: float | None, now: float | None, allowed: float | None
) -> None:
    assert RULE.differ(was, now, allowed) == RULE.differ(now, was, allowed)
    assert not RULE.differ(was, was, allowed)
    assert not (RULE.grown(was, now, allowed) and RULE.grown(now, was, allowed)) or math.isnan(
        (was or 0.0) + (now or 0.0)
    )


@pytest.mark.parametrize(
    ("was", "now", "times"),
    [
        (2.0, 1.0, 0.5),
        (0.0, 1.0, math.inf),
        (0.0, 0.0, None),
        (None, 1.0, None),
        (math.inf, 1, None),
    ],
)
def test_times(was: float | None, now: float | None, times: float | None) -> None:
    assert factor(was, now) == times
