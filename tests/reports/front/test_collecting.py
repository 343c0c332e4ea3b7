"""What pytest collects of a file: engines are asked once in which ways they run it."""

from pathlib import Path

import pytest
from given.adapters.faulty import Faulty

from textmech.cases.case import Case
from textmech.cases.find import shipped
from textmech.engines.engine import Engine, Plan, Refusal, Start
from textmech.reports.compare.trial import limit
from textmech.reports.front import collecting
from textmech.reports.front.collecting import Earlier, Key, collected
from textmech.reports.runs.cache.key import Keys
from textmech.reports.runs.cache.store import Store

FILE = shipped()["bar_pendulum"]


@pytest.fixture
def asked(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """Whom it asks."""
    names: list[str] = []
    sound = collecting.ways_of

    def ways_of(engine: Engine, case: Case, start: Start) -> tuple[Plan | Refusal, ...]:
        names.append(f"{engine.name}.{engine.setting}")
        return sound(engine, case, start)

    monkeypatch.setattr(collecting, "ways_of", ways_of)
    return names


def keys(earlier: Earlier, *engines: str) -> list[Key]:
    found = collected(FILE, engines, [], [], lambda: earlier, long=False, write=print)
    return [key for _, keys in found for key in keys]


@pytest.mark.slow
def test_an_engine_is_asked_once(tmp_path: Path, asked: list[str]) -> None:
    first = keys(Earlier.of(Store(tmp_path)), "mujoco.tuned")
    assert asked == ["mujoco.tuned"]
    assert keys(Earlier.of(Store(tmp_path)), "mujoco.tuned") == first
    assert asked == ["mujoco.tuned"]
    others = keys(Earlier.of(Store(tmp_path)), "mujoco.shipped", "pymunk.tuned")
    assert {key[1:3] for key in others} == {("mujoco", "shipped"), ("pymunk", "tuned")}
    assert asked == ["mujoco.tuned", "mujoco.shipped", "pymunk.tuned"]


def test_without_a_store_it_is_always_asked(asked: list[str]) -> None:
    assert keys(Earlier.of(None), "mujoco.tuned") == keys(Earlier.of(None), "mujoco.tuned")
    assert asked == ["mujoco.tuned", "mujoco.tuned"]


@pytest.mark.slow
def test_code_that_collects_otherwise_asks_again(
    tmp_path: Path, asked: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    keys(Earlier.of(Store(tmp_path)), "mujoco.tuned")
    monkeypatch.setattr(Keys, "_code", lambda self, places: f"newer {places}")
    keys(Earlier.of(Store(tmp_path)), "mujoco.tuned")
    assert asked == ["mujoco.tuned", "mujoco.tuned"]


@pytest.mark.slow
@pytest.mark.mutant("what pytest collects is kept by its case alone, whatever the engine")
def test_a_key_without_the_engine_is_seen(
    tmp_path: Path, asked: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Keys, "collected", lambda self, case, engine: self.solution(case))
    with pytest.raises(AssertionError):
        test_an_engine_is_asked_once(tmp_path, asked)


@pytest.mark.slow
@pytest.mark.mutant("an engine that hangs while it is collected hangs pytest")
def test_an_engine_that_hangs_is_waited_for_as_long_as_is_said(
    moving: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(limit.VARIABLE, "1.0")
    monkeypatch.setattr(collecting.installed, "foreign", lambda name: True)
    engine = Faulty(verb="plans", act="hangs")
    assert Earlier.of(None).ways(moving, engine, dict) == (("native", False),)
