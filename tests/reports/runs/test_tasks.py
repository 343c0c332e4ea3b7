"""The events of a reference are read once for all rungs of all engines on a case."""

from pathlib import Path
from typing import Any

import pytest
from given import scenes

from textmech import engines
from textmech.reports.compare.events import timing
from textmech.reports.runs import tasks
from textmech.reports.runs.cache.key import Keys
from textmech.reports.runs.cache.store import Store
from textmech.reports.runs.tasks import Pair, Unit, planned

pytestmark = pytest.mark.slow

CASES = ("bouncing_ball", "sliding_block.braking")
SETTINGS = ("shipped", "recommended")


def readings(store: Path, monkeypatch: pytest.MonkeyPatch) -> tuple[list[Any], set[Any]]:
    """What is read of references by all rungs of two settings, and what they know by it."""
    asked: list[Any] = []
    known: set[Any] = set()
    reading = timing.reading

    def counted(scene: Any, record: Any, event: Any, happened: Any, step: float) -> Any:
        asked.append((event.quantity, event.rule, step))
        return reading(scene, record, event, happened, step)

    monkeypatch.setattr(timing, "reading", counted)
    kept, keys = Store(store), Keys.now(None)
    for name in CASES:
        case, solved = scenes.SHIPPED[name], scenes.solved(name)
        key = keys.solution(case)
        kept.put(key, solved)
        for setting in SETTINGS:
            pair = Pair(case, engines.make("mujoco", setting), kept, key)
            for way in planned(pair):
                for (_, step), rung in Unit(pair, way).rungs(solved.trajectory).items():
                    assert rung.events.keys() == case.events.keys()
                    known |= {
                        (event.quantity, event.rule, step, rung.events[one].happened)
                        for one, event in case.events.items()
                    }
    return asked, known


def test_each_event_is_read_once_at_each_step(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked, known = readings(tmp_path, monkeypatch)
    assert len(asked) == len(set(asked)) == len(known) > 0


@pytest.mark.mutant("events of a reference are read again for each setting")
def test_reading_anew_would_be_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tasks, "_timings", lambda store, key: [])
    asked, _ = readings(tmp_path, monkeypatch)
    assert len(asked) == len(SETTINGS) * len(set(asked))


@pytest.mark.mutant("all references are read as the first one is")
def test_what_is_read_of_another_reference_would_be_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    one: list[Any] = []
    monkeypatch.setattr(tasks, "_timings", lambda store, key: one)
    with pytest.raises(AssertionError):
        readings(tmp_path, monkeypatch)
