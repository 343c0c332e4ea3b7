"""Every unit of the language with every prefix, against the table of pint's own."""

import math
import re
from functools import cache
from itertools import product
from typing import Any

import pint
import pytest
from given.otherwise import otherwise

from textmech.cases.fields import number
from textmech.cases.fields.number import Amount, Names, NumberMistake, amount

ROUNDING = 1e-15  # a few products in a double each
LINES = [line.partition("=") for line in number._UNITS.strip().splitlines()]


def words(*, prefixes: bool) -> list[str]:
    """All names and short forms of the table: what stands between its signs of equality."""
    found = []
    for name, _, rest in LINES:
        if name.strip().endswith("-") is prefixes:
            found += [name, *rest.split("=")[1:]]
    return [word.strip().removesuffix("-") for word in found]


PREFIXES, UNITS = words(prefixes=True), words(prefixes=False)
ALONE = {"kilogram", "kg"}  # has its prefix already, and no other is one to pint
ALL = UNITS + [p + u for p, u in product(PREFIXES, UNITS) if u not in ALONE]
OURS = [word for word in ALL if (len(word) <= 12 and word.isascii()) or word in "°µmμm"]


@cache
def known() -> Any:
    """pint with the table that it comes with."""
    return pint.UnitRegistry()


def off(word: str) -> float:
    """How far a unit's size is from pint's, relative."""
    found = amount(f"1 {word}").value
    return float(abs(found / theirs(word).to_base_units().magnitude - 1.0))


def theirs(word: str) -> Any:
    """1 of it to pint, which knows a revolution by no short name, and a gramme by one alone."""
    return known().Quantity(1.0, re.sub("rev$", "turn", re.sub("gramme$", "gram", word)))


def test_the_table_is_read_whole() -> None:
    assert {"n", "µ", "μ", "m", "c", "k", "M", "G", "giga"} <= {*PREFIXES}
    assert {"m", "kg", "g", "s", "min", "h", "rad", "deg", "°", "rev", "rpm", "Hz"} <= {*UNITS}
    assert {"N", "J", "W", "A", "C", "T"} <= {*UNITS}
    assert len(OURS) > 300


@pytest.mark.slow
def test_every_unit_is_that_of_pint() -> None:
    """Long words are no units of ours: a term has at most twelve letters.

    With a gram that is 1e-3 kilogram, a kgram made every force after it a RecursionError.
    """
    far = {word: off(word) for word in OURS}
    assert {word: by for word, by in far.items() if not by < ROUNDING} == {}


OWN = ("[angle]", "[frequency]")


def alike(word: str) -> bool:
    """Whether its dimension is pint's, but for the angle and what Hz counts, which are our own."""
    ours = number._quantity(1.0, word).dimensionality
    expected = theirs(word).dimensionality if word not in ("Hz", "hertz") else {}
    return {k: v for k, v in ours.items() if k not in OWN} == dict(expected.items())


@pytest.mark.slow
def test_each_dimension_is_that_of_pint() -> None:
    assert [word for word in OURS[: len(UNITS)] if not alike(word)] == []


@pytest.mark.slow
@pytest.mark.mutant("unit: {old} for {new}")
@pytest.mark.parametrize(
    ("new", "old"),
    [
        ("1e9 = G", "1e6 = G"),
        ("joule / second = W", "joule * second = W"),
        ("/ 180 radian", "/ 200 radian"),
        ("revolution / minute", "revolution / second"),
        ("1e-9 = n", "1e-6 = n"),
        ("kilogram / ampere / second**2 = T", "kilogram / ampere / second = T"),
    ],
)
def test_another_size_is_seen(new: str, old: str, monkeypatch: pytest.MonkeyPatch) -> None:
    assert number._UNITS.count(new) == 1
    monkeypatch.setattr(number, "_UNITS", number._UNITS.replace(new, old))
    number._registry.cache_clear()
    try:
        seen = [word for word in OURS if not off(word) < ROUNDING]
        seen += [w for w in UNITS if not alike(w)]
    finally:
        number._registry.cache_clear()
    assert seen


KNOWN = Names({"m": Amount(1.5), "l1": Amount(0.2), "zero": Amount(0.0), "wrong": None})
HERTZ = "; Hz may count turns or radians: write rpm or rad/s"


@pytest.mark.parametrize(
    ("text", "unit", "said"),
    [
        ("45", "rad", "is 45 rad, which is 7.2 turns: write 45 deg, or 45 rad"),
        ("-90", "rad", "is -90 rad, which is -14 turns: write -90 deg, or -90 rad"),
        ("8 Nm", "N m", "unknown unit 'Nm'; did you mean 'N m'?"),
        ("8 Nms", "N m s/rad", "unknown unit 'Nms'; did you mean 'N m s'?"),
        ("1 nan", "N", "unknown unit 'nan'"),
        ("1 m/nan", "m", "unknown unit 'm/nan'"),
        ("pi/6", "rad", "'pi/6' is not computed: write 0.5235987756, or 30 deg"),
        ("2*0.5", "m", "'2*0.5' is not computed: write 1"),
        ("1/0", "m", "'1/0' is not computed: write the number"),
        ("2*m", "kg", "'2*m' is not computed: write 3"),
        ("-m / 2", "kg", "'-m / 2' is not computed: write -0.75"),
        ("m+1e-3", "kg", "'m+1e-3' is not computed: write 1.501"),
        ("2*l1", "m", "'2*l1' is not computed: write 0.4"),
        ("1e300*1e300", "kg", "'1e300*1e300' is not computed: write the number"),
        ("m/zero", "kg", "'m/zero' is not computed: write the number"),
        ("2*wrong", "kg", "'2*wrong' is not computed: write the number"),
        ("m*m/2", "kg", "'m*m/2' is not computed: write the number"),
        ("2*(m + 1)", "kg", "'2*(m + 1)' is not computed: write the number"),
        ("2*other", "kg", "should be a number, is text '2*other'"),
        ("m.x", "kg", "should be a number, is text 'm.x'"),
        ("2 Hz", "rad/s", f"is '2 Hz', but rad/s was expected{HERTZ}"),
        ("3 N m/Hz", "N m s/rad", f"is '3 N m/Hz', but N m s/rad was expected{HERTZ}"),
        ("2 Hz", "kg", "is '2 Hz', but kg was expected"),
        ("2 kHz", "1", f"is '2 kHz', but a plain number was expected{HERTZ}"),
    ],
)
def test_what_to_write_is_said(text: str, unit: str, said: str) -> None:
    value: object = float(text) if text.lstrip("-").isdigit() else text
    with pytest.raises(NumberMistake) as caught:
        number.number(value, unit, KNOWN)
    assert str(caught.value) == said


@pytest.mark.parametrize(
    ("value", "unit", "size"),
    [
        ("45 rad", "rad", 45.0),
        (6.28, "rad", 6.28),
        ("0.5 N m s", "N m s/rad", 0.5),
        ("0.5 N m", "N m/rad", 0.5),
        ("2 N m/deg", "N m/rad", 2 * 180 / math.pi),
    ],
)
def test_a_radian_is_one_beside_a_mass(value: object, unit: str, size: float) -> None:
    found = number.number(value, unit, Names())
    assert found is not None
    assert found.value == pytest.approx(size)


@pytest.mark.mutant("an angle of many turns is taken for what it says")
def test_degrees_that_are_meant_are_asked_for() -> None:
    blind = otherwise(number, "abs(given.value) > TURN", "abs(given.value) > 1e9")
    assert blind.number(45.0, "rad", Names()).value == 45.0
