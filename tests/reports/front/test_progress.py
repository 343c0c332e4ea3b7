"""What a run says while it works: on a terminal, and where its output goes to a file."""

import time
from concurrent.futures import ThreadPoolExecutor
from functools import partial
from types import SimpleNamespace

import pytest

from textmech.reference.integrators import now
from textmech.reports.front.show import console as say
from textmech.reports.front.show import progress
from textmech.reports.runs import selection
from textmech.reports.runs.cache.key import Keys
from textmech.reports.runs.cache.store import temporary_store
from textmech.reports.runs.processes import pool
from textmech.reports.runs.processes.pool import Processes
from textmech.reports.runs.task_results import Results


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
    assert progress.time_left(seconds, part) == said


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
    with ThreadPoolExecutor(1) as executor, temporary_store() as store:
        results = Results(executor, lambda *words: heard.append(words), store, Keys.now(None))
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


@pytest.mark.slow
def test_what_takes_long_has_a_line_that_moves(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """Whoever works, in this process: where it is in the motion, and how long that still takes."""
    for name in ("FIRST", "INTERVAL", "BEAT"):
        monkeypatch.setattr(progress, name, 0.05)
    with progress.aloud():
        now.begun("swing")
        now.doing("the motion", 0.0, 10.0)
        now.reached(2.5)
        now.NOW.since -= 30.0
        time.sleep(0.5)
        now.reached(5.0)
        time.sleep(0.5)
    said = capsys.readouterr().err
    assert "swing: the motion, at 2.5 of 10 s, about 1:3" in said
    assert "swing: the motion, at 5 of 10 s" in said


def test_an_engine_whose_import_takes_long_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    heard: list[str] = []

    def settings(name: str) -> tuple[str, ...]:
        heard.append(now.NOW.line())
        return ("shipped",)

    now.begun("")
    monkeypatch.setattr(selection.engines, "settings", settings)
    selection._offers({"pymunk"})
    assert heard == ["importing pymunk"]
    assert now.NOW.line() == ""


@pytest.mark.slow
def test_what_is_soon_done_says_nothing(capsys: pytest.CaptureFixture[str]) -> None:
    with progress.aloud():
        now.doing("the motion", 0.0, 10.0)
        time.sleep(2 * progress.BEAT)
    assert capsys.readouterr().err == ""


def moving(task: SimpleNamespace) -> None:
    now.doing("the motion", 0.0, 10.0)
    now.reached(4.0)
    time.sleep(task.seconds)


def _hear(executor: Processes, heard: list[list[str]]) -> None:
    heard.append(executor.doing())


@pytest.mark.slow
def test_what_another_process_is_at_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    heard: list[list[str]] = []
    monkeypatch.setattr(pool, "BEAT", 0.2)
    with pool.local(1) as executor:
        task = SimpleNamespace(name="a long one", seconds=2.0)
        assert isinstance(executor, Processes)
        told = partial(dict, pool.spread(moving, [task], executor, partial(_hear, executor, heard)))
        assert told() == {0: None}
        assert executor.doing() == []
    assert any(
        said and said[0].startswith("a long one: the motion, at 4 of 10 s") for said in heard
    )


def test_a_line_that_was_drawn_stands_in_nobodys_way(capsys: pytest.CaptureFixture[str]) -> None:
    say.draw("half a line")
    say.tell("a whole one")
    say.tell("another")
    wiped = " " * len("half a line")
    assert capsys.readouterr().err == f"\rhalf a line\r{wiped}\ra whole one\nanother\n"


@pytest.mark.mutant("an error stream that is gone silences the output")
def test_what_is_printed_comes_though_the_error_stream_has_gone(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    def gone() -> None:
        raise BrokenPipeError

    monkeypatch.setattr(say, "_clear", gone)
    say.say("agrees")
    assert capsys.readouterr().out == "agrees\n"
