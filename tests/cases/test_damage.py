"""Whatever is written into a case file: cases, or mistakes with a place; never a traceback."""

import math
import random
import re
from collections import Counter
from pathlib import Path

import pytest
from given.damage import damaged, numbers
from given.same_examples import examples
from given.spatial_case import SOUND as SPATIAL
from hypothesis import given
from hypothesis import strategies as st

from textmech.cases.fields.number import LARGEST, SMALLEST, NumberMistake, amount
from textmech.cases.find import shipped
from textmech.cases.load import load
from textmech.cases.mistake import CaseError, plain
from textmech.reports.batch.selection import HANDWRITTEN

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
def test_a_damaged_file_is_loaded_or_refused_with_places(tmp_path: Path) -> None:
    seen: Counter[str] = Counter()

    @often
    @given(damaged())
    def each(content: bytes) -> None:
        seen[outcome(tmp_path / "case.yaml", content)] += 1

    each()
    assert min(seen["loaded"], seen["refused"]) > N / 20  # or the damage is too small or too large


@pytest.mark.slow
def test_a_damaged_file_in_space_is_loaded_or_refused_with_places(tmp_path: Path) -> None:
    seen: Counter[str] = Counter()

    @often
    @given(damaged([SPATIAL]))
    def each(content: bytes) -> None:
        seen[outcome(tmp_path / "case.yaml", content)] += 1

    each()
    assert min(seen["loaded"], seen["refused"]) > N / 20


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


# However a shipped case file is mangled, `load` gives cases or a CaseError.


_JUNK = ["", "null", "[]", "{}", "-1", ".nan", "1e999", "x y", "&a 1", "*a", "!!set", "'", "0 m"]


def mangled(text: str, chance: random.Random) -> str:
    """The text with one to three of its tokens deleted, renamed, doubled or replaced."""
    tokens = re.findall(r"\w+|\s+|[^\w\s]", text)
    for _ in range(chance.randint(1, 3)):
        i = chance.randrange(len(tokens))
        other = chance.choice(tokens)
        tokens[i] = chance.choice(["", tokens[i] + "x", tokens[i] * 2, other, chance.choice(_JUNK)])
    return "".join(tokens)


@pytest.mark.slow
def test_mangled(tmp_path: Path) -> None:
    chance = random.Random(1)
    texts = [path.read_text(encoding="utf-8") for path in shipped().values()]
    path = tmp_path / "case.yaml"
    refused = 0
    for _ in range(300):
        path.write_text(mangled(chance.choice(texts), chance), encoding="utf-8")
        try:
            load(path, systems={"four_bar": ("m", "a", "b", "c", "d", "crank0")})
        except CaseError as error:
            refused += len(error.mistakes) > 0
    assert 150 < refused < 300
