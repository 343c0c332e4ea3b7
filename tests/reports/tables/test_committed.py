"""The committed reports are what the suite measures now, cover the chapter and got no worse."""

import ast
import re
from collections.abc import Callable, Iterator
from dataclasses import fields, replace
from pathlib import Path
from typing import Any

import pandas as pd
import pytest
from given import scenes
from given.command.lines import row as typed_row
from given.command.tree import ROOT
from given.otherwise import otherwise

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.reference.coverage import equations
from textmech.reports.compare.judge.compare import compare
from textmech.reports.compare.judge.metric import EPSILON
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.front.show import readme
from textmech.reports.runs.cache.store import usable
from textmech.reports.runs.processes import pool
from textmech.reports.runs.request import Request
from textmech.reports.runs.selection import choose_cases, choose_engines
from textmech.reports.runs.suite import Report
from textmech.reports.search.advice.advice_rows import Requirement
from textmech.reports.search.advice.advice_rows import rows as rows_of
from textmech.reports.search.advice.advise import advised
from textmech.reports.search.causes import explained
from textmech.reports.tables import committed, promised, write
from textmech.reports.tables import coverage as covering
from textmech.reports.tables.committed import Key
from textmech.reports.tables.coverage import coverage
from textmech.reports.tables.coverage import otherwise as elsewhere
from textmech.reports.tables.promised import answered, ships, unkept
from textmech.reports.tables.row import (
    AGREES,
    BEYOND,
    DEVIATES,
    DIVERGED,
    FAILS,
    Advice,
    Cause,
    Certificate,
    Comparison,
    Instant,
    Rungs,
)

# The committed reports are what the suite measures now, and the READMEs show them.

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
    """Of one that swings, a loop, a contact and dry friction: the same cures, of nearly the same
    size."""
    names = ["bar_pendulum", "four_bar", "sliding_block.below", "growing_force"]
    cases, engines = choose_cases(names), choose_engines([], [])
    found = explained.measure(
        Request(cases, engines, jobs=pool.workers(), book=False, store=usable()), search=True
    ).causes
    asked = {engine.name for engine in engines}  # and not of the book's approximations
    read = write.read(write.HERE / "causes.csv", Cause)
    committed = [c for c in read if c.case in names and c.engine in asked]
    assert {cure(cause) for cause in found} == {cure(cause) for cause in committed}


def cure(cause: Cause) -> tuple[str, ...]:
    step = "" if cause.step is None else f"{cause.step:.3g}"
    return cause.case, cause.engine, cause.setting, cause.quantity, cause.cure, cause.options, step


@pytest.mark.slow
def test_advice_is_current() -> None:
    names = ["bar_pendulum", "four_bar", "sliding_block.below", "growing_force", "heavy_top.cusp"]
    cases = choose_cases([*names, "planar_bodies"])
    asked, engines = Requirement(None, 2.0), choose_engines([], ["shipped"])
    with advised(Request(cases, engines, store=usable()), asked) as found:
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


# What was committed is not lost: tuned rows have a bar near it, and none gets worse unnoticed.

Make = Callable[..., Trial]
KEY: Key = ("moving", "mujoco", "tuned", "native", "ball.x")
NOTHING = Comparison(**{field.name: None for field in fields(Comparison)})  # type: ignore[arg-type]


@pytest.fixture
def as_shipped(moving: Case, monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """The free body's case as a shipped one, with a committed row of the tuned ball."""
    monkeypatch.setattr(committed, "is_shipped", lambda file: file == moving.source.file)

    def with_row(**said: Any) -> None:
        usual = {"version": "4.0.0", "step": 1e-3, "error": 1e-3, "verdict": AGREES}
        row = replace(NOTHING, **{**usual, **said})
        monkeypatch.setattr(committed, "rows", lambda: {KEY: row})

    return with_row


def tuned(made: Trial) -> Any:
    return next(row for row in compare(made).rows if row.quantity == "ball.x")


@pytest.mark.parametrize(("before", "lost"), [(1e-3, False), (1.1e-4, False), (0.9e-4, True)])
def test_a_tuned_row_keeps_ten_times_what_was_committed(
    trial: Make, moving: Case, as_shipped: Callable[..., None], before: float, lost: bool
) -> None:
    as_shipped(error=before)
    found = tuned(trial(rate=1.0))  # 1e-3 off, of 1e-2 allowed
    assert found.verdict == AGREES  # no verdict depends on an older run
    words = "0.001 is above 10 × the committed 9e-05" if lost else ""
    assert committed.worse(moving, found) == words


def test_what_was_nothing_may_be_rounding_and_no_more(
    trial: Make, moving: Case, as_shipped: Callable[..., None]
) -> None:
    as_shipped(error=0.0)
    assert not committed.worse(moving, tuned(trial(rate=0.0, model=1e-12)))
    assert committed.worse(moving, tuned(trial(rate=0.0, model=1e-8)))


@pytest.mark.parametrize("other", [{"version": "3.3.7"}, {"step": 2e-3}])
def test_another_question_has_another_bar(
    trial: Make, moving: Case, as_shipped: Callable[..., None], other: dict[str, Any]
) -> None:
    as_shipped(error=1e-6, **other)
    assert not committed.worse(moving, tuned(trial()))


def test_a_case_of_the_same_name_elsewhere_is_another(
    trial: Make, moving: Case, as_shipped: Callable[..., None]
) -> None:
    as_shipped(error=1e-6)
    other = replace(moving, source=replace(moving.source, file="/elsewhere/moving.yaml"))
    assert committed.worse(moving, tuned(trial()))
    assert not committed.worse(other, tuned(trial(case=other)))


@pytest.mark.parametrize(
    ("before", "now", "lost"),
    [
        (AGREES, "refused", True),
        (AGREES, BEYOND, True),
        (DEVIATES, BEYOND, True),
        (BEYOND, DIVERGED, True),
        (BEYOND, AGREES, False),
        ("refused", AGREES, False),
        (BEYOND, BEYOND, False),
    ],
)
def test_a_worse_verdict_is_a_row_that_got_worse(
    trial: Make, moving: Case, as_shipped: Callable[..., None], before: str, now: str, lost: bool
) -> None:
    as_shipped(verdict=before)
    row = replace(tuned(trial()), verdict=now)
    assert bool(committed.worse(moving, row)) == lost


def test_a_finding_that_grew_tenfold_got_worse(
    trial: Make, moving: Case, as_shipped: Callable[..., None]
) -> None:
    as_shipped(verdict=BEYOND, error=0.1)
    row: Comparison = replace(tuned(trial()), verdict=BEYOND, error=0.9)
    assert committed.worse(moving, row) == ""
    worse = committed.worse(moving, replace(row, error=1.1))
    assert worse == "1.1 is above 10 × the committed 0.1"
    assert committed.worse(moving, replace(row, error=float("nan"))) != ""


# Every item of the chapter has a case that covers it, a test that states it, or a reason.

# Items that nobody covers yet. One that is covered must be struck off here.
PICTURES = ("a photograph of ", "a sketch of ")
FILE = re.compile(r"tests/[\w/]+\.py")


def open_items(table: pd.DataFrame) -> set[tuple[str, str]]:
    """By kind and number, what neither a case nor a declared word covers."""
    left = table[(table.cases == "") & (table.otherwise == "")]
    return set(zip(left.kind, left.number.str.strip("()"), strict=True))


@pytest.fixture(scope="module")
def table() -> pd.DataFrame:
    """Of the shipped cases, solved now."""
    executed = {name: set(scenes.solved(name).equations) for name in scenes.EVERY}
    return coverage(list(scenes.EVERY.values()), executed)


@pytest.mark.slow
def test_nothing_else_is_open(table: pd.DataFrame) -> None:
    assert open_items(table) == set()


@pytest.mark.slow
def test_what_a_case_covers_needs_no_other_word(table: pd.DataFrame) -> None:
    both = table[(table.cases != "") & (table.otherwise != "")]
    assert list(zip(both.kind, both.number, strict=True)) == []


@pytest.mark.slow
def test_an_item_that_loses_its_case_is_seen() -> None:
    lost = {n: c for n, c in scenes.EVERY.items() if n != "four_bar"}
    executed = {name: set(scenes.solved(name).equations) for name in lost}
    assert open_items(coverage(list(lost.values()), executed)) == {("figure", "2.3")}


def test_an_item_that_loses_its_word_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    said = elsewhere()
    del said["equation", "2.42"]
    monkeypatch.setattr(covering, "otherwise", lambda: said)
    found = open_items(coverage([], {}))
    assert ("equation", "2.42") in found
    assert ("equation", "2.43") not in found


def stated(file: str) -> Iterator[str]:
    """The equations that open the docstrings of a file's tests."""
    for node in ast.walk(ast.parse((ROOT / file).read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test_"):
            yield from equations(ast.get_docstring(node))


@pytest.mark.parametrize(("kind", "number"), elsewhere())
def test_a_declared_test_states_the_equation(kind: str, number: str) -> None:
    what = elsewhere()[kind, number]
    if kind == "equation":
        assert FILE.fullmatch(what)
        assert number in set(stated(what))
    else:
        assert what.startswith(PICTURES)


def test_every_item_of_the_chapter_has_a_row() -> None:
    table = coverage([], {})
    assert list(table.columns) == ["kind", "number", "cases", "otherwise"]
    counts = {kind: int(n) for kind, n in table.kind.value_counts().items()}
    assert counts == {"equation": 98, "example": 4, "exercise": 6, "figure": 32}
    known = set(zip(table.kind, table.number.str.strip("()"), strict=True))
    assert set(elsewhere()) <= known


# Whose rows may fail: what somebody has promised, and not what is only asked.

BROKEN = replace(
    typed_row("tuned", 1.35),
    verdict=FAILS,
    because="0.0135 is above allow 0.01; the step: order 2.0",
)


@pytest.fixture
def asked(tmp_path: Path) -> Case:
    """A user's own copy of a case, without what ours promises."""
    text = Path(scenes.EVERY["bar_pendulum"].source.file).read_text(encoding="utf-8")
    file = tmp_path / "bar_pendulum.yaml"
    file.write_text(text, encoding="utf-8")
    (case,) = load(file)
    return replace(case, reach={}, deviates={})


def test_a_copy_of_a_case_is_the_users_own(asked: Case) -> None:
    assert ships(scenes.EVERY["bar_pendulum"])
    assert not ships(asked)


@pytest.mark.mutant("a users question fails")
def test_a_recipe_of_ours_that_misses_is_no_failure_of_the_users(asked: Case) -> None:
    ours = scenes.EVERY["bar_pendulum"]
    assert answered(ours, [BROKEN]) == [BROKEN]
    (told,) = answered(asked, [BROKEN])
    assert (told.verdict, told.because) == (BEYOND, "the step: order 2.0")
    was = "return [*rows] if ships(case) else"
    always = otherwise(promised, was, "return [*rows] if True else")
    assert always.answered(asked, [BROKEN]) == [BROKEN]


def test_what_diverges_is_told_as_it_is(asked: Case) -> None:
    gone = replace(BROKEN, error=None, ratio=None, because=f"{DIVERGED}: Nan in QACC")
    (told,) = answered(asked, [gone])
    assert (told.verdict, told.because) == (DIVERGED, "Nan in QACC")


@pytest.mark.parametrize(
    "one",
    [
        replace(BROKEN, setting="shipped"),
        replace(BROKEN, because="2e-3 is above reach 1e-6; the step"),
        replace(BROKEN, because="the reference is not certified"),
        replace(BROKEN, quantity="audit", because="mass: 2 in place of 1"),
        replace(BROKEN, error=None, because="crashed: it ended by signal 11"),
    ],
    ids=lambda one: one.because[:20] or one.setting,
)
def test_what_is_no_question_fails(asked: Case, one: Comparison) -> None:
    assert answered(asked, [one]) == [one]


def test_what_its_author_promises_fails(asked: Case) -> None:
    name = BROKEN.quantity
    assert answered(replace(asked, reach={BROKEN.engine: {name: 1e-6}}), [BROKEN]) == [BROKEN]
    limit = replace(asked, reach={f"{BROKEN.engine}.limit": {name: 1e-6}})
    assert answered(limit, [BROKEN]) == [BROKEN]
    other = replace(asked, reach={"another": {name: 1e-6}})
    assert answered(other, [BROKEN])[0].verdict == BEYOND


def test_the_nearest_is_named(asked: Case) -> None:
    rows = [
        replace(typed_row("tuned", 1.35, verdict=BEYOND), case=asked.name, step=1e-4),
        replace(typed_row("shipped", 220.0, verdict=BEYOND), case=asked.name),
    ]
    (line,) = unkept(asked, rows)
    engine, name = rows[0].engine, rows[0].quantity
    nearest = f"{engine}.tuned, {name} ×1.4 at 0.0001 s"
    told = f"no setting keeps it at the judged step; nearest: {nearest}"
    assert line == f"{asked.name} in {engine}: {told}"
    assert not [*unkept(asked, rows[1:])]  # nobody has tried
    kept = [rows[0], replace(rows[1], verdict=AGREES)]
    assert not [*unkept(asked, kept)]
    assert not [*unkept(scenes.EVERY["bar_pendulum"], rows)]
    gone = replace(rows[1], verdict=FAILS, ratio=0.5, because="the declared deviation is gone")
    assert not [*unkept(asked, [rows[0], gone])]  # the tolerance is kept


@pytest.mark.mutant("a promise of a row that is not there")
def test_a_reach_of_no_row_is_told(asked: Case) -> None:
    rows = [replace(typed_row("tuned", 0.5, verdict=AGREES), case=asked.name)]
    engine, bound = rows[0].engine, {rows[0].quantity: 1e-6}
    promised = replace(asked, reach={f"{engine}.law": bound, engine: bound, "another": bound})
    (line,) = unkept(promised, rows)
    what = f"reach.{engine}.law is held by no row: {engine} does not run the scene so"
    assert line == f"{asked.name}: {what}"
    lawful = replace(rows[0], realised="law")
    assert not [*unkept(promised, [*rows, lawful])]
    assert [*unkept(promised, [lawful])] == [line.replace(f"{engine}.law", engine)]
