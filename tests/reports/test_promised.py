"""Whose rows may fail: what somebody has promised, and not what is only asked."""

from dataclasses import replace
from pathlib import Path

import pytest
from given import scenes
from given.lines import row
from given.otherwise import otherwise

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.reports.data import promised
from textmech.reports.data.promised import answered, ships, unkept
from textmech.reports.data.row import AGREES, BEYOND, DIVERGED, FAILS, Comparison

BROKEN = replace(
    row("tuned", 1.35), verdict=FAILS, because="0.0135 is above allow 0.01; the step: order 2.0"
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
        replace(row("tuned", 1.35, verdict=BEYOND), case=asked.name, step=1e-4),
        replace(row("shipped", 220.0, verdict=BEYOND), case=asked.name),
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
    rows = [replace(row("tuned", 0.5, verdict=AGREES), case=asked.name)]
    engine, bound = rows[0].engine, {rows[0].quantity: 1e-6}
    promised = replace(asked, reach={f"{engine}.law": bound, engine: bound, "another": bound})
    (line,) = unkept(promised, rows)
    what = f"reach.{engine}.law is held by no row: {engine} does not run the scene so"
    assert line == f"{asked.name}: {what}"
    lawful = replace(rows[0], realised="law")
    assert not [*unkept(promised, [*rows, lawful])]
    assert [*unkept(promised, [lawful])] == [line.replace(f"{engine}.law", engine)]
