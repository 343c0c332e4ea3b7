"""What a row is in pytest: passed, failed, or a failure that was expected."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import pytest
from given.lines import row
from given.otherwise import otherwise
from given.report_folders import CERTIFICATE

from textmech.cases.mistake import Mistake
from textmech.reports import pytest_plugin
from textmech.reports.data.row import (
    AGREES,
    BEYOND,
    CRASHED,
    DEVIATES,
    DIVERGED,
    FAILS,
    REFUSED,
    Comparison,
)
from textmech.reports.output import committed

PASSED, FAILED, EXPECTED = "passed", "failed", "xfailed"


def ended(module: Any, kind: str, item: Any) -> str:
    """What pytest calls a test that ends so."""
    try:
        getattr(module, kind).runtest(item)
    except pytest.xfail.Exception:
        return EXPECTED
    except module.RowError:
        return FAILED
    return PASSED


def of_row(found: Comparison, module: Any = pytest_plugin, *, promised: bool = False) -> str:
    """A row's own test."""
    item = SimpleNamespace(
        row=lambda: found,
        case=SimpleNamespace(),
        path=Path("swing.yaml"),
        place=lambda *_: 1,
        user_properties=[],
        promised=promised,
    )
    return ended(module, "ComparisonItem", item)


@pytest.mark.mutant("a failed row's path comes before its size")
@pytest.mark.parametrize(
    ("found", "line"),
    [
        ({"verdict": FAILS}, "×7.92 of 0.01 rad at 2.9 s"),
        ({"verdict": BEYOND, "when": None}, "×7.92 of 0.01 rad"),
        ({"verdict": DIVERGED, "ratio": None, "because": "it fell"}, "diverged: it fell"),
    ],
)
def test_a_failure_says_first_how_large_it_is(found: dict[str, Any], line: str) -> None:
    """For pytest's short summary shows the beginning of the first line alone."""
    numbers = {"ratio": 7.919, "allowed": 0.01, "unit": "rad", "when": 2.9, "because": ""}
    told = replace(row(), **{**numbers, **found})

    def said(module: Any = pytest_plugin) -> str:
        item = SimpleNamespace(
            row=lambda: told, case=SimpleNamespace(), path=Path("a.yaml"), place=lambda *_: 1,
            user_properties=[], promised=True,
        )  # fmt: skip
        with pytest.raises(module.RowError) as error:
            module.ComparisonItem.runtest(item)
        return str(error.value).splitlines()[0]

    assert said() == line
    if told.verdict == FAILS:
        was = "{_size_text(row)}\\n{place}: {row.quantity}\\n"
        path = otherwise(pytest_plugin, was, "{place}: {row.quantity}\\n")
        assert said(path).startswith("a.yaml:1")


def of_certificate(verdict: str, module: Any = pytest_plugin) -> str:
    """The test of a reference of which one of two checks has that verdict."""
    rows = [replace(CERTIFICATE, check="power"), replace(CERTIFICATE, verdict=verdict)]
    report = SimpleNamespace(certificates=rows)
    item = SimpleNamespace(report=lambda: report, case=SimpleNamespace(name=CERTIFICATE.case))
    return ended(module, "CertificateItem", item)


@pytest.fixture(autouse=True)
def no_worse(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nothing was committed of a row, unless a test says so."""
    monkeypatch.setattr(committed, "worse", lambda case, row: "")


@pytest.mark.parametrize(
    ("verdict", "word"),
    [
        (AGREES, PASSED),
        (DEVIATES, PASSED),
        (BEYOND, EXPECTED),
        (DIVERGED, EXPECTED),
        (CRASHED, EXPECTED),
        (REFUSED, EXPECTED),
        ("changed", EXPECTED),
        (FAILS, FAILED),
    ],
)
def test_only_what_agrees_passes(verdict: str, word: str) -> None:
    assert of_row(replace(row(), verdict=verdict)) == word


@pytest.mark.mutant("beyond is a pass in pytest")
def test_a_finding_is_no_pass() -> None:
    found = replace(row(), verdict=BEYOND)
    passes = otherwise(
        pytest_plugin, "not in (AGREES, DEVIATES)", "not in (AGREES, DEVIATES, 'beyond')"
    )
    assert (of_row(found), of_row(found, passes)) == (EXPECTED, PASSED)


@pytest.mark.mutant("what a user's own settings have to keep is an expected failure")
def test_ones_own_settings_have_to_agree() -> None:
    """But what an engine cannot do, no setting can."""
    found = replace(row(), verdict=BEYOND)
    was = "if self.promised and row.verdict != REFUSED:"
    blind = otherwise(pytest_plugin, was, "if False:")
    assert of_row(found, promised=True) == FAILED
    assert of_row(found, blind, promised=True) == EXPECTED
    assert of_row(replace(found, verdict=DIVERGED), promised=True) == FAILED
    assert of_row(replace(found, verdict=REFUSED), promised=True) == EXPECTED
    assert of_row(row(), promised=True) == PASSED


@pytest.mark.mutant("a failed audit is an expected failure in pytest")
def test_an_audit_that_fails_is_no_finding() -> None:
    found = replace(row(), quantity="audit", verdict=FAILS)
    was = "if row.verdict == FAILS:"
    lenient = otherwise(pytest_plugin, was, f'{was[:-1]} and row.quantity != "audit":')
    assert (of_row(found), of_row(found, lenient)) == (FAILED, EXPECTED)


@pytest.mark.mutant("a row that got worse than committed passes in pytest")
@pytest.mark.parametrize(("verdict", "otherwise_"), [(AGREES, PASSED), (BEYOND, EXPECTED)])
def test_a_row_that_got_worse_than_committed_fails(
    monkeypatch: pytest.MonkeyPatch, verdict: str, otherwise_: str
) -> None:
    monkeypatch.setattr(committed, "worse", lambda case, row: "above 10 × the committed 1e-9")
    found = replace(row(), verdict=verdict)
    blind = otherwise(pytest_plugin, "if lost:", "if lost and False:")
    assert (of_row(found), of_row(found, blind)) == (FAILED, otherwise_)


@pytest.mark.mutant("an uncertified reference passes in pytest")
def test_a_reference_of_which_one_check_fails_fails() -> None:
    blind = otherwise(pytest_plugin, "if broken:", "if broken and False:")
    assert of_certificate("holds") == PASSED
    assert (of_certificate(FAILS), of_certificate(FAILS, blind)) == (FAILED, PASSED)


def asked(file: str, module: Any = pytest_plugin) -> str:
    """What becomes of a row of that file, where only bad.yaml has a mistake."""
    report = SimpleNamespace(mistakes=[Mistake("bad.yaml", 1, 1, "title", "missing")])
    source = SimpleNamespace(source=SimpleNamespace(file=file))
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "_found", lambda session: report)
        try:
            module.CaseItem.report(SimpleNamespace(session=None, case=source))
        except module.RowError as error:
            return f"fails: {error}"
    return "is run"


@pytest.mark.mutant("the mistakes of a file are told of all others")
def test_mistakes_cost_their_own_file() -> None:
    assert asked("bad.yaml") == "fails: bad.yaml:1:1: title: missing"
    assert asked("good.yaml") == "is run"
    blamed = otherwise(pytest_plugin, "        if mine:", "        if not mine:")
    assert asked("good.yaml", blamed).startswith("fails")
