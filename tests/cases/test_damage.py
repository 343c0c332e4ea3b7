"""Whatever is written into a case file: cases, or mistakes with a place; never a traceback."""

import math
from collections import Counter
from pathlib import Path
from typing import Any

import pytest
from given.same_examples import examples
from given.scenes.damage import damaged, numbers
from given.scenes.spatial_case import SOUND as SPATIAL
from hypothesis import given
from hypothesis import strategies as st

from textmech.cases.fields.number import LARGEST, SMALLEST, NumberMistake, amount
from textmech.cases.load import load
from textmech.cases.mistake import CaseError, plain
from textmech.reports.runs.selection import HANDWRITTEN

N = 150
often = examples(N)
WHOLE = ("missing key", "is empty")  # what is said of a file, and of no line in it


def outcome(file: Path, content: bytes) -> str:
    """`loaded` or `refused`; fails on any other error, and on a mistake without a place."""
    file.write_bytes(content)
    try:
        assert load(file, systems=HANDWRITTEN)
    except CaseError as error:
        found = error
    else:
        return "loaded"
    assert found.mistakes
    for mistake in found.mistakes:
        assert mistake.line > 0 or mistake.what.startswith(WHOLE), mistake
    assert all(plain(line) == line for line in str(found).splitlines())
    return "refused"


@pytest.mark.slow
@pytest.mark.parametrize("drawn", [damaged(), damaged([SPATIAL])], ids=["plane", "space"])
def test_a_damaged_file_is_loaded_or_refused_with_places(drawn: Any, tmp_path: Path) -> None:
    seen: Counter[str] = Counter()

    @often
    @given(drawn)
    def each(content: bytes) -> None:
        seen[outcome(tmp_path / "case.yaml", content)] += 1

    each()
    assert min(seen["loaded"], seen["refused"]) > N / 20  # or the damage is too small or too large


@pytest.mark.slow
def test_any_bytes_are_refused_with_places(tmp_path: Path) -> None:
    text = st.text(max_size=60).map(lambda text: text.encode("utf-8", "replace"))

    @often
    @given(st.binary(max_size=60) | text)
    def each(content: bytes) -> None:
        assert outcome(tmp_path / "case.yaml", content) == "refused"

    each()


@pytest.mark.slow
@often
@given(numbers() | st.text(max_size=20) | st.floats() | st.integers() | st.booleans())
def test_a_number_is_finite_and_of_a_size_to_compute_with_or_refused(value: object) -> None:
    try:
        found = amount(value)
    except NumberMistake:
        return
    assert math.isfinite(found.value)
    assert found.value == 0 or SMALLEST <= abs(found.value) <= LARGEST


@pytest.mark.slow
@often
@given(st.text())
def test_nothing_that_is_shown_steers_a_terminal(text: str) -> None:
    shown = plain(text)
    assert not any(ord(c) < 32 or 127 <= ord(c) < 160 for c in shown)
    shown.encode("utf-8")
