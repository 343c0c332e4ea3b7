"""What a run says while it works: on a terminal, and where its output goes to a file."""

import time
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import pytest

from textmech.reports import pool
from textmech.reports.cache.key import Keys
from textmech.reports.cache.store import passing
from textmech.reports.results import Results
from textmech.reports.show import progress


@pytest.mark.parametrize(
    ("seconds", "part", "said"),
    [
        (10.0, 0.5, "about 10 s left"),
        (30.0, 0.25, "about 1:30 left"),
        (60.0, 0.01, ""),  # nobody knows yet
        (9.0, 0.99, ""),
    ],
)
def test_how_long_the_rest_takes(seconds: float, part: float, said: str) -> None:
    assert progress.left(seconds, part) == said


def test_a_bar_is_as_wide_as_the_terminal(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("COLUMNS", "64")
    line = progress.bar("engines", 5, 20, "about 9 s left", "four_bar in mujoco.tuned")
    assert len(line) == 63
    assert line.startswith("engines    [#####...............] 5/20  about 9 s left  four_ba")
    assert "four_bar" not in progress.bar("engines", 20, 20, "", "four_bar in mujoco.tuned")


def test_a_file_gets_a_line_every_ten_seconds(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    clock = iter([0.0, 0.0, 4.0, 11.0, 12.0, 20.0])
    monkeypatch.setattr(progress.time, "monotonic", lambda: next(clock))
    with progress.progress() as told:
        told("engines", 0, 4)
        told("engines", 1, 4, "four_bar in mujoco.tuned", 0.1)
        told("engines", 2, 4, "rhombus in mujoco.tuned", 0.5)
        told("engines", 3, 4, "rhombus in pymunk.tuned", 0.9)
        told("engines", 4, 4, "swing in pymunk.tuned", 1.0)
    assert capsys.readouterr().err.splitlines() == [
        "engines: 2 of 4 done, about 11 s left, last rhombus in mujoco.tuned",
        "engines: 4 of 4 done",
    ]


def test_tasks_tell_their_names_and_a_long_one_counts_for_more() -> None:
    heard: list[tuple] = []
    tasks = {
        "long": SimpleNamespace(name="a long one", steps=3000.0),
        "short": SimpleNamespace(name="a short one", steps=1000.0),
    }
    with ThreadPoolExecutor(1) as executor, passing() as store:
        results = Results(executor, lambda *words: heard.append(words), store, Keys.now())
        results.anew("engines", str, tasks)
    assert heard == [
        ("engines", 0, 2, "", 0.0),
        ("engines", 1, 2, "a long one", 0.75),
        ("engines", 2, 2, "a short one", 1.0),
    ]


def test_a_task_that_takes_long_is_waited_for_aloud(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pool, "BEAT", 0.01)
    beats: list[float] = []
    with ThreadPoolExecutor(1) as executor:
        found = dict(pool.spread(time.sleep, [0.1], executor, lambda: beats.append(1.0)))
    assert found == {0: None}
    assert len(beats) > 2
