"""The steps that engines would have to take are counted before any of them is made to run."""

from pathlib import Path

import pytest
from given.scenes.pendulum import pendulum

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.engines.engine import Plan
from textmech.reports.compare.trial.ladder import ladders
from textmech.reports.compare.trial.start import assembled
from textmech.reports.compare.trial.trial import planned
from textmech.reports.compare.trial.work import STEPS, _steps, too_long
from textmech.reports.runs.selection import choose_engines
from textmech.reports.tables.user_settings import read_settings

SLOW = pendulum(duration=3e3, length=2, step=1e-2)
LANDS = "events: {turns: {rod.omega: falls to zero}}"


def cases(folder: Path, text: str, *, long: bool = False) -> list[Case]:
    file = folder / "case.yaml"
    file.write_text(text, encoding="utf-8")
    return load(file, long=long)


@pytest.mark.parametrize(
    ("text", "place", "words"),
    [
        (pendulum(step=1e-9), "10:1 step", "tuned's step 1e-09 s"),
        (pendulum(duration=1e3, step=1e-4), "10:1 step", "4e+07 steps"),
        (
            pendulum(duration=3e3, length=2, step=1e-2),
            "8:1 duration",
            "mujoco.shipped's step 0.002 s",
        ),
        (pendulum(duration=1e3, more=LANDS), "8:1 duration", "rows kept for the events"),
    ],
)
def test_endless_ladders_are_said_at_the_step_or_the_duration(
    tmp_path: Path, text: str, place: str, words: str
) -> None:
    engines = choose_engines([], [])
    found = too_long(cases(tmp_path, text), engines)
    assert {f"{m.line}:{m.column} {m.where}" for m in found} >= {place}
    assert any(words in m.what and "--allow-long" in m.what for m in found)
    assert too_long(cases(tmp_path, text, long=True), engines) == []


def test_the_variants_of_a_file_are_counted_together(tmp_path: Path) -> None:
    more = "variants:\n" + "\n".join(f"  v{i}: {{duration: {i + 1}.0}}" for i in range(60))
    engines = choose_engines(["mujoco.tuned"], [])
    alone = too_long(cases(tmp_path, pendulum(duration=60, step=2e-4)), engines)
    (together,) = too_long(cases(tmp_path, pendulum(step=2e-4, more=more)), engines)
    assert alone == []
    assert "60 s" in together.what  # the longest is named


@pytest.mark.parametrize("name", ["mujoco.shipped", "mujoco.tuned", "pymunk.tuned"])
def test_the_count_is_that_of_the_ladders(tmp_path: Path, name: str) -> None:
    (case,) = cases(tmp_path, pendulum())
    (engine,) = choose_engines([name], [])
    for way in planned(engine, case.scene, assembled(case)):
        assert isinstance(way, Plan)
        steps = [h for ladder in ladders(case, engine, way) for h in ladder.steps]
        taken = sum(case.duration / h for h in steps)
        assert taken <= _steps(case, engine) <= 4.1 * taken


@pytest.mark.slow
def test_the_shipped_cases_stay_far_below() -> None:
    from textmech.reports.runs.selection import choose_cases

    most = max(_steps(case, e) for case in choose_cases([]) for e in choose_engines([], []))
    # A question is about 100 s: 50 000 steps of 2 ms, and the ladder takes 31 times as many.
    assert 10 * most < STEPS


@pytest.mark.parametrize("name", ["mujoco", "pymunk"])
def test_endless_iterations_of_ones_own_are_said(tmp_path: Path, name: str) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text(f"{name}: {{step: 1.0e-3, iterations: 1000000000}}\n", encoding="utf-8")
    with pytest.raises(CaseError) as caught:
        read_settings(file, [])
    (mistake,) = caught.value.mistakes
    assert (mistake.line, mistake.where) == (1, f"{name}.iterations")
    assert "1e+09 iterations" in mistake.what
    assert "--allow-long" in mistake.what


def test_an_own_step_that_is_none_is_said(tmp_path: Path) -> None:
    """1 s over it is no double."""
    file = tmp_path / "mine.yaml"
    file.write_text("pymunk: {step: 5.0e-324}\n", encoding="utf-8")
    with pytest.raises(CaseError, match=r"1:10: pymunk\.step: must be at least 1e-30 s"):
        read_settings(file, [], long=True)


def test_an_own_step_without_end_is_said(tmp_path: Path) -> None:
    file = tmp_path / "mine.yaml"
    file.write_text("mujoco: {step: 1.0e-9}\n", encoding="utf-8")
    engines = choose_engines(["mujoco"], [str(file)])
    (mistake,) = too_long(cases(tmp_path, pendulum()), engines)
    assert "step 1e-09 s" in mistake.what
