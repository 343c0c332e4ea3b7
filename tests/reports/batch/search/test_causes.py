"""Causes of real rows: those that are known by hand, and what is said where there are none."""

from pathlib import Path
from typing import Any

import pytest
from given import scenes
from given.lines import ladder, row

from textmech.reports.batch import suite
from textmech.reports.batch.search.cause_rows import NOTHING
from textmech.reports.batch.search.why import OURS, Rows
from textmech.reports.batch.selection import choose_engines
from textmech.reports.batch.suite import Report
from textmech.reports.data.row import ANOTHER, BEYOND, FALLS, UNSEARCHED, UNSETTLED, Cause

CASES = ("bar_pendulum", "four_bar", "sliding_block.below", "growing_force", "planar_bodies")


def measured(*, causes: bool, names: tuple[str, ...] = CASES) -> Report:
    cases = [scenes.EVERY[name] for name in names]
    engines = choose_engines([], [])
    return suite.measure(
        cases, engines, jobs=2, progress=lambda *_: None, book=False, causes=causes
    )


@pytest.fixture(scope="module")
def report() -> Report:
    return measured(causes=True)


def of(
    report: Report, case: str, engine: str, quantity: str, setting: str = "shipped"
) -> list[Cause]:
    key = (case, engine, setting, quantity)
    return [c for c in report.causes if (c.case, c.engine, c.setting, c.quantity) == key]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "engine", "quantity", "cures"),
    [
        ("bar_pendulum", "mujoco", "energy.total", ["RK4", "step"]),
        ("bar_pendulum", "pymunk", "bar.angle", ["error_bias 0 + step"]),
        ("bar_pendulum", "pymunk", "hinge.gap", ["step"]),
        ("four_bar", "mujoco", "crank.angle", ["RK4 + softness of loops"]),
        ("four_bar", "mujoco", "D.gap", ["RK4 + softness of loops", "softness of loops + step"]),
        ("sliding_block.below", "mujoco", "block.x", ["impratio 1e6"]),
        ("growing_force", "pymunk", "block.x", [OURS["law"]]),
        ("growing_force", "mujoco", "block.x", [OURS["law"]]),
        ("planar_bodies", "pymunk", "energy.kinetic", [NOTHING]),
    ],
)
def test_causes_that_are_known(
    report: Report, case: str, engine: str, quantity: str, cures: list[str]
) -> None:
    assert [cause.cure for cause in of(report, case, engine, quantity)] == cures


@pytest.mark.slow
def test_a_cure_brings_the_error_within_and_says_at_what_cost(report: Report) -> None:
    cured = [cause for cause in report.causes if cause.error_after is not None]
    assert len(cured) > 20
    assert all(c.error_after <= (c.allowed or 0.0) for c in cured if c.error_after is not None)
    assert all((c.error or 0.0) > (c.allowed or 0.0) for c in cured)
    (rk4, finer) = of(report, "bar_pendulum", "mujoco", "energy.total")
    assert (rk4.options, rk4.step, rk4.cost) == ("{integrator: RK4}", 2e-3, 4.0)
    assert (finer.options, finer.step, finer.cost, finer.law) == ("{}", 5e-4, 4.0, "h^1")


@pytest.mark.slow
def test_the_last_column_of_every_row_beyond_says_them(report: Report) -> None:
    rows = {(r.case, r.engine, r.quantity): r for r in report.comparisons if r.verdict == BEYOND}
    pendulum = rows["bar_pendulum", "mujoco", "energy.total"]
    assert pendulum.because == "cured by RK4 (×4 the cost) or step 0.0005 s (×4 the cost)"
    told = [row for row in rows.values() if "cured by" in row.because]
    assert len(told) == len(rows)


@pytest.mark.slow
def test_a_declared_deviation_keeps_its_words(report: Report) -> None:
    row = next(
        r
        for r in report.comparisons
        if (r.case, r.engine, r.setting, r.realised, r.quantity)
        == ("growing_force", "pymunk", "tuned", "native", "block.x")
    )
    words = "one number for friction: it breaks loose at the kinetic 3 N; cured by "
    assert row.because == words + OURS["law"]


@pytest.mark.slow
def test_without_a_search_what_the_ladder_tells_stays() -> None:
    report = measured(causes=False, names=("bar_pendulum",))
    assert {cause.cure for cause in report.causes} == {UNSEARCHED}
    row = next(r for r in report.comparisons if r.verdict == BEYOND)
    assert row.because.startswith("the step: it falls with order 1.0")


@pytest.mark.mutant("our law for a cure, where the engine's own smaller step is one: {setting}")
@pytest.mark.parametrize("setting", ["shipped", "tuned"])
@pytest.mark.parametrize("told", [{"usable": 1e-3}, {"usable": None, "verdict": FALLS}])
def test_our_law_is_no_cause_where_a_smaller_step_agrees(
    setting: str, told: dict[str, Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    off, law = row(ratio=3.0, allowed=1e-2), row("tuned", realised="law")
    given = [off, row("tuned", ratio=2.0), law]
    assert Rows(given, [ladder(**told, setting=setting)]).ours(off) == []
    assert Rows(given, [ladder(None, setting, verdict=ANOTHER)]).ours(off) == [law]
    short = Rows(given, [ladder(None, setting, verdict=UNSETTLED)])
    assert short.ours(off) == ([] if setting == "tuned" else [law])
    assert Rows(given, [ladder(**told, setting=setting, realised="law")]).ours(off) == [law]
    monkeypatch.setattr(Rows, "_by_steps", set())
    assert Rows(given, [ladder(**told, setting=setting)]).ours(off) == [law]


DAMPED = """\
scene:
  points: {O: [0, 0], W: [1.0, 0.5]}
  bodies: {rod: {bar: {mass: 1.0, length: 1.0}}}
  joints: {hinge: {pin: [ground.O, rod.start]}}
  forces: {oil: {damper: [rod.end, ground.W], damping: 2.0}}
initial: {rod: {angle: 0, omega: 0}}
allow: {rod.angle: 4.0e-3}
"""
DAMPED_FOR = "duration: 1.0\nsamples: 11\nstep: {pymunk: 2.5e-3}\n"


@pytest.mark.slow
def test_a_damper_of_the_engines_own_that_a_smaller_step_cures(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, DAMPED, tail=DAMPED_FOR)
    found = suite.measure(
        [case], choose_engines(["pymunk"], []), jobs=2, progress=lambda *_: None, causes=True
    )
    cures = {(c.setting, c.cure) for c in found.causes}
    assert cures == {("shipped", "step"), ("tuned", "step")}
