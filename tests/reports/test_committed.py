"""The committed reports are what the suite measures now, and the READMEs show them."""

import pytest

from textmech.reports.batch import suite
from textmech.reports.batch.advice.advice_rows import Requirement
from textmech.reports.batch.advice.advice_rows import rows as rows_of
from textmech.reports.batch.advice.advise import advised
from textmech.reports.batch.cache.store import usable
from textmech.reports.batch.selection import choose_cases, choose_engines
from textmech.reports.batch.suite import Report
from textmech.reports.compare.judge.metric import EPSILON
from textmech.reports.data.row import Advice, Cause, Certificate, Comparison, Instant, Rungs
from textmech.reports.output import write
from textmech.reports.show import readme
from textmech.reports.system import pool

QUARTER = 0.25  # what another compiler or processor may change of a number above the floor
AFTER_EVENTS = 2 / 3  # a factor of three: which step sees an event first may change
LOST = 10  # times the committed error, which is the next power of ten: another machine may pass it
# Checks whose bound follows how sensitive the motion is, in whole powers of ten: rounding may give
# the next one. Of all others the bound is a number in the code.
FOLLOWING = (
    "generated motion",
    "generated events",
    "closed form",
    "closed events",
    "constraint drift",
    "drives follow their laws",
    "joints hold",
    "nothing slips",
)
# Below this part of a tolerance a number is rounding's, and differs between machines.
FLOOR = 1e-6
DIGITS = 1e-2  # of a step as it is written
ORDER = 0.05  # what the noise of neighbouring rungs may do to it, beside a quarter of itself


@pytest.mark.slow
def test_causes_are_current() -> None:
    """Of one case in the plane and one with a contact: the same cures, of nearly the same size."""
    cases, engines = choose_cases(["four_bar", "sliding_block.below"]), choose_engines([], [])
    found = suite.measure(
        cases,
        engines,
        jobs=pool.workers(),
        progress=lambda *_: None,
        book=False,
        causes=True,
        store=usable(),
    ).causes
    names = {case.name for case in cases}
    committed = [c for c in write.read(write.HERE / "causes.csv", Cause) if c.case in names]
    assert {cure(cause) for cause in found} == {cure(cause) for cause in committed}


def cure(cause: Cause) -> tuple[str, ...]:
    step = "" if cause.step is None else f"{cause.step:.3g}"
    return cause.case, cause.engine, cause.setting, cause.quantity, cause.cure, cause.options, step


@pytest.mark.slow
def test_advice_is_current() -> None:
    cases = choose_cases(["bar_pendulum", "four_bar", "sliding_block.below"])
    asked, engines = Requirement(None, 2.0), choose_engines([], ["shipped"])
    with advised(cases, engines, asked, progress=lambda *_: None, store=usable()) as found:
        rows = {(one.case, one.engine, one.want): one for each in found for one in rows_of(each)}
    read = write.read(write.HERE / write.ADVICE, Advice)
    committed = {(a.case, a.engine, a.want): a for a in read if a.tolerance is None}
    assert {case.name for case in choose_cases([])} == {case for case, *_ in committed}
    for key, now in rows.items():
        before = committed[key]
        assert (now.recipe, now.settings, now.quantity) == (
            before.recipe,
            before.settings,
            before.quantity,
        )
        assert near(now.step, before.step, 0.0, DIGITS)
        assert near(now.ratio, before.ratio, FLOOR, QUARTER)


@pytest.mark.slow
def test_tolerances_are_current(report: Report) -> None:
    committed = {key(row): row for row in write.read(write.HERE / "tolerance.csv", Comparison)}
    assert {key(row) for row in report.comparisons} == set(committed)
    switch = {case.name for case in choose_cases([]) if case.events}
    for row in report.comparisons:
        before = committed[key(row)]
        spread = AFTER_EVENTS if row.case in switch else QUARTER
        assert (row.verdict, row.unit, row.protocol != "") == (
            before.verdict,
            before.unit,
            before.protocol != "",
        )
        floor = FLOOR * (row.allowed or 1.0)
        assert near(row.error, before.error, floor, spread), key(row)
        assert near(row.rms, before.rms, floor, spread), key(row)
        assert near(row.final, before.final, floor, spread), key(row)


@pytest.mark.slow
def test_orders_and_limits_are_current(report: Report) -> None:
    committed = {
        (*key(row), row.ladder): row for row in write.read(write.HERE / "convergence.csv", Rungs)
    }
    assert {(*key(row), row.ladder) for row in report.rungs} == set(committed)
    allowed = {key(row): row.allowed or 1.0 for row in report.comparisons}
    switch = {case.name for case in choose_cases([]) if case.events}
    for row in report.rungs:
        before = committed[(*key(row), row.ladder)]
        floor = FLOOR * allowed[key(row)]
        spread = AFTER_EVENTS if row.case in switch else QUARTER
        if max(row.uncertainty or 0.0, before.uncertainty or 0.0) > floor:
            assert row.verdict == before.verdict, key(row)
        assert near(row.limit, before.limit, floor, spread), key(row)
        assert near(row.usable_step, before.usable_step, 0.0, DIGITS), key(row)
        if (row.order is None) == (before.order is None):  # near the floor there may be none
            assert near(row.order, before.order, ORDER), key(row)


@pytest.mark.slow
def test_events_are_current(report: Report) -> None:
    committed = {instant(row): row for row in write.read(write.HERE / "events.csv", Instant)}
    assert {instant(row) for row in report.instants} == set(committed)
    for row in report.instants:
        before = committed[instant(row)]
        off = max(abs(row.difference or 0.0), abs(before.difference or 0.0))
        assert abs(row.time - before.time) <= AFTER_EVENTS * off + FLOOR, instant(row)


@pytest.mark.slow
def test_certificates_are_current(report: Report) -> None:
    rows = write.read(write.HERE / "reference.csv", Certificate)
    committed = {(row.case, row.check): row for row in rows}
    assert {(row.case, row.check) for row in report.certificates} == set(committed)
    for row in report.certificates:
        before = committed[(row.case, row.check)]
        assert (row.system, row.verdict) == (before.system, "holds")
        next_to = 11 if row.check in FOLLOWING else 1.01  # the committed one has three digits
        assert before.bound / next_to <= row.bound <= next_to * before.bound, row.check
        if row.certified is not None:
            assert before.certified is not None
            assert row.certified <= LOST * before.certified, row.check


@pytest.mark.slow
def test_coverage_is_current(report: Report) -> None:
    now = write.tables(report, choose_cases([]))["coverage.csv"]
    text = now.to_csv(index=False, lineterminator="\n")
    assert (write.HERE / "coverage.csv").read_text(encoding="utf-8") == text


@pytest.mark.slow
def test_every_equation_that_a_case_names_is_executed_by_it(report: Report) -> None:
    for case in choose_cases([]):
        missing = set(case.origin.equations) - report.equations[case.name]
        assert not missing, f"{case.name} names {sorted(missing)} and never runs them"


@pytest.mark.slow
@pytest.mark.parametrize("file", readme.FILES)
def test_what_is_generated_in_a_readme_is_current(file: str) -> None:
    assert (readme.ROOT / file).read_text(encoding="utf-8") == readme.current(file)


def key(row: Comparison | Rungs) -> tuple[str, ...]:
    return (row.case, row.engine, row.setting, row.realised, row.quantity)


def instant(row: Instant) -> tuple[str, ...]:
    return (row.case, row.engine, row.setting, row.realised, row.event, str(row.k))


def near(now: float | None, before: float | None, floor: float, spread: float = QUARTER) -> bool:
    if now is None or before is None:
        return now is before
    return abs(now - before) <= spread * max(abs(now), abs(before)) + max(floor, EPSILON)
