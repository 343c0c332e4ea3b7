"""Equations as MathML: every letter is kept, at its place, and nothing is markup."""

import unicodedata
from xml.etree.ElementTree import fromstring

import pytest

from textmech.cases.case import Case
from textmech.reports.batch.selection import choose_cases
from textmech.reports.page.listed import _equation, equations, mathml


def told(line: str) -> str:
    return "".join(fromstring(mathml(line)).itertext()).replace("\u2061", "").replace("\xa0", " ")


def test_letters_have_their_dots_indices_and_exponents() -> None:
    found = mathml("J_O φ̈ = −m g ω₁² e_β′ sin² φ")
    assert "<msub><mi>J</mi><mrow><mi>O</mi></mrow></msub>" in found
    assert '<mi class="dotted">φ̈</mi>' in unicodedata.normalize("NFD", found)
    assert "<msubsup><mi>ω</mi><mrow><mn>1</mn></mrow><mrow><mn>2</mn></mrow></msubsup>" in found
    assert "<mi>β</mi></mrow><mrow><mo>′</mo></mrow></msubsup>" in found
    assert '<msup><mi mathvariant="normal">sin</mi>' in found


def test_indices_and_exponents_of_more_letters_go_together() -> None:
    assert "<mi>k</mi><mo>,</mo>" in mathml("ω_{k,k−1}")
    assert "<mrow><mn>1</mn><mo>−</mo><mi>α</mi></mrow></msup>" in mathml("v^{1−α}")
    assert mathml("ṙ_c²").count("<msubsup>") == 1
    assert '<mi mathvariant="normal">max</mi><mrow><mi>i</mi>' in mathml("max_i x")
    assert "<mrow><mn>10</mn></mrow></msup>" in mathml("v^10")
    assert "<mrow><mo>−</mo><mn>1</mn></mrow></msup>" in mathml("v^−1")


@pytest.mark.parametrize("unit", ["m²/s²", "1/s", "rad/s²", "N m"])
def test_a_unit_behind_an_equation_is_no_part_of_it(unit: str) -> None:
    found = _equation("(2.5)", f"a = b c [{unit}]")
    assert found is not None
    assert found.unit == unit
    assert "[" not in found.html


def test_what_would_be_markup_is_a_sign() -> None:
    assert told('a <b> & "c') == 'a<b>&"c'
    assert "<b>" not in mathml('a <b> & "c')


@pytest.mark.slow
def test_every_hand_written_motion_shows_its_equations(shipped: list[Case]) -> None:
    cases = [case for case in shipped if case.system and case.states is None]
    for case in cases:
        found = equations(case)
        assert found, case.name
        assert any("(2." in one.numbers for one in found), case.name
        for one in found:
            assert "`" not in one.html + one.words
            fromstring(one.html)


def test_the_pendulum_shows_its_own_equation() -> None:
    (case,) = choose_cases(["bar_pendulum"])
    first = equations(case)[0]
    assert first.numbers == "(2.34)"
    assert first.unit == "rad/s²"
    assert told_of(first.html) == "JOφ̈=−mg(l/2)cosφ"


def told_of(html: str) -> str:
    text = "".join(fromstring(html).itertext()).replace("\u2061", "")
    return unicodedata.normalize("NFD", text)


def test_what_is_generated_has_none() -> None:
    (case,) = choose_cases(["free_pair"])
    assert case.system is None
    assert equations(case) == []
