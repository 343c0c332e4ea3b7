"""A process that dies, or a task that raises, costs its own result only."""

import os
import signal
import sys
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import Executor, ProcessPoolExecutor, ThreadPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass
from pathlib import Path

import pytest
from given.forked import TOLD, runs

from textmech.reports.system import lock, pool
from textmech.reports.system.lock import locked
from textmech.reports.system.pool import Processes


def work(task: int) -> int:
    if task == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    if task == 5:
        raise ZeroDivisionError("five")
    if task == 6:
        sys.exit(0)
    return task * task


def struck(task: int) -> int:
    if task == 1:
        os.kill(os.getpid(), signal.SIGRTMIN + 2)
    return task


def test_a_signal_without_a_name_is_one() -> None:
    """And the process that it ended is replaced: the next task is answered."""
    with pool.local(1) as executor:
        found = dict(pool.spread(struck, [0, 1, 2], executor))
    died = pool.Died(f"the process died (signal {signal.SIGRTMIN + 2})")
    assert found == {0: 0, 1: died, 2: 2}


@pytest.mark.parametrize("jobs", [1, 2])
def test_the_rest_goes_on(jobs: int) -> None:
    with pool.local(jobs) as executor:
        found = dict(pool.spread(work, list(range(7)), executor))
    assert {i: r for i, r in found.items() if i not in (3, 5, 6)} == {0: 0, 1: 1, 2: 4, 4: 16}
    assert found[3] == pool.Died("the process died (SIGKILL)")
    assert found[5] == pool.Died("ZeroDivisionError: five")
    assert found[6] == pool.Died("SystemExit: 0")


def where(_: int) -> str:
    return os.getcwd()


def test_engines_do_not_write_into_the_users_folder(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pool.local(1) as executor:
        assert dict(pool.spread(where, [0], executor))[0] != str(tmp_path)


@dataclass(frozen=True)
class Guest:
    """A task of somebody else's engine, which leaves something behind; of ours it is empty."""

    guest: str


def leftovers(task: Guest) -> tuple[int, str]:
    found = os.environ.get("LEFT_BEHIND", "")
    if task.guest:
        os.environ["LEFT_BEHIND"] = task.guest
    return os.getpid(), found


@pytest.mark.slow
@pytest.mark.mutant("a process that ran somebody else's engine answers for all")
def test_what_an_engine_leaves_behind_reaches_nobody_else(monkeypatch: pytest.MonkeyPatch) -> None:
    tasks = [Guest(name) for name in ("", "one", "one", "", "", "two", "one", "")]
    with pool.local(1) as executor:
        found = [each for _, each in sorted(pool.spread(leftovers, tasks, executor))]
    assert [left for _, left in found] == ["", "", "one", "", "", "", "", ""]
    assert found[0][0] == found[1][0] == found[2][0]  # no more processes than it needs
    assert found[3][0] == found[4][0] == found[5][0]
    monkeypatch.setattr(pool._Process, "guest", property(lambda self: "", lambda self, name: None))
    with pool.local(1) as executor:
        found = [each for _, each in sorted(pool.spread(leftovers, tasks, executor))]
    assert found[3][1] == "one"


def end(how: str) -> str:
    if how == "dies":
        os.kill(os.getpid(), signal.SIGKILL)
    if how == "leaves":
        os._exit(0)
    if how == "raises":
        raise Strange("one", "two")
    return how


class Strange(Exception):
    """One that is pickled and cannot be read back."""

    def __init__(self, one: str, two: str) -> None:
        super().__init__(one)


@pytest.mark.slow
def test_whatever_a_task_does_it_is_told_and_costs_no_other() -> None:
    tasks = [*["dies", "leaves", "raises"] * 5, *map(str, range(20))]
    with pool.local(2) as executor:
        found = dict(pool.spread(end, tasks, executor))
    told = {"dies": "SIGKILL", "leaves": "exit code 0", "raises": "one"}
    for index, task in enumerate(tasks):
        if task in told:
            assert told[task] in found[index].because
        else:
            assert found[index] == task


class Unreadable:
    """An answer that is pickled and cannot be read back."""

    def __reduce__(self) -> tuple[type, tuple[str]]:
        return int, ("no number",)


def answer(task: int) -> object:
    return Unreadable() if task == 1 else task


def test_an_answer_that_cannot_be_read_costs_no_other() -> None:
    """Where all processes answer through one pipe, as pebble's do, it ends the pool."""
    with pool.local(2) as executor:
        found = dict(pool.spread(answer, list(range(6)), executor))
    assert "ValueError: invalid literal" in found.pop(1).because
    assert found == {task: task for task in (0, 2, 3, 4, 5)}


def test_processes_that_are_killed_while_they_wait_cost_a_task_each() -> None:
    """As by a system that runs out of memory; those that replace them do the rest."""
    with pool.local(2) as executor:
        assert dict(pool.spread(answer, [0, 2], executor)) == {0: 0, 1: 2}
        assert isinstance(executor, Processes)
        for process in executor._all:
            os.kill(process._process.pid or 0, signal.SIGKILL)
            process._process.join()
        found = dict(pool.spread(answer, [0, 2, 3, 4, 5, 6], executor))
    died = [result for result in found.values() if isinstance(result, pool.Died)]
    assert died == [pool.Died("the process died (SIGKILL)")] * 2
    assert len(found) == 6


@pytest.mark.slow
def test_of_many_that_die_at_once_each_end_is_told_once() -> None:
    """A process that is replaced while its neighbour dies: some of these were wrong."""
    tasks = ["dies", "dies", "lives"] * 80
    with pool.local(8) as executor:
        found = dict(pool.spread(end, tasks, executor))
    died = pool.Died("the process died (SIGKILL)")
    assert [found[i] for i in range(240)] == [died, died, "lives"] * 80


def meet(folder: Path) -> bool:
    """Whether another task is at work at the same time."""
    (folder / str(os.getpid())).touch()
    until = time.monotonic() + 20
    while len(list(folder.iterdir())) < 2 and time.monotonic() < until:
        time.sleep(0.01)
    return time.monotonic() < until


def test_after_deaths_there_are_as_many_at_once(tmp_path: Path) -> None:
    with pool.local(2) as executor:
        list(pool.spread(end, ["dies"] * 3, executor))
        assert dict(pool.spread(meet, [tmp_path] * 2, executor)) == {0: True, 1: True}


@pytest.mark.parametrize("kind", [ThreadPoolExecutor, ProcessPoolExecutor])
def test_any_executor_serves(kind: Callable[[int], Executor]) -> None:
    with kind(3) as executor:
        found = dict(pool.spread(work, [0, 1, 2, 4, 5, 6], executor))
    assert [found[i] for i in range(4)] == [0, 1, 4, 16]
    assert [found[4], found[5]] == [
        pool.Died("ZeroDivisionError: five"),
        pool.Died("SystemExit: 0"),
    ]


def test_in_threads_one_task_runs_at_a_time() -> None:
    """Engines have one set of callbacks a process."""
    shared: list[int] = []
    with ThreadPoolExecutor(4) as executor:
        found = dict(pool.spread(grown, [shared] * 8, executor))
    assert set(found.values()) == {1}


def grown(shared: list[int]) -> int:
    """By how much the list grows while the task looks."""
    before = len(shared)
    shared.append(0)
    time.sleep(0.01)
    return len(shared) - before


# Engines that fork.


def double(task: int) -> int:
    """Comes back in two processes, as from a library that forks by itself, one after the other."""
    if os.fork() == 0:
        time.sleep(0.05)
    return task * task


@pytest.mark.slow
def test_a_task_that_comes_back_twice_is_answered_once() -> None:
    """Else its second answer would be that of the next task."""
    with pool.local(1) as executor:
        for task in range(4):
            assert dict(pool.spread(double, [task], executor)) == {0: task * task}
            time.sleep(0.1)


def helped(task: int) -> int:
    """Leaves a process behind that holds all it has been given, and dies."""
    if task == 1 and os.fork() == 0:
        time.sleep(20)
        os._exit(0)
    if task == 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return task


@pytest.mark.slow
def test_what_a_task_leaves_running_hides_no_death() -> None:
    begun = time.monotonic()
    with pool.local(1) as executor:
        found = dict(pool.spread(helped, [0, 1, 2], executor))
    assert found == {0: 0, 1: pool.Died("the process died (SIGKILL)"), 2: 2}
    assert time.monotonic() - begun < 15  # s: of the 20 that it would be waited for


def leaves(task: tuple[Path, bool]) -> None:
    """Starts a process that outlives it, and tells which; then it may die itself."""
    told, dies = task
    left = os.fork()
    if left == 0:
        time.sleep(60)
        os._exit(0)
    told.write_text(str(left), encoding="utf-8")
    if dies:
        os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.slow
@pytest.mark.mutant("what an engine starts outlives the run")
@pytest.mark.skipif(not TOLD, reason="nothing tells what runs")
@pytest.mark.parametrize("dies", [False, True])
def test_what_a_task_starts_ends_with_the_pool(dies: bool, tmp_path: Path) -> None:
    told = tmp_path / "left"
    with pool.local(1) as executor:
        list(pool.spread(leaves, [(told, dies)], executor))
        left = int(told.read_text(encoding="utf-8"))
        assert dies or runs(left)
    until = time.monotonic() + 10
    while runs(left) and time.monotonic() < until:
        time.sleep(0.01)
    assert not runs(left)


@pytest.mark.parametrize("windows", [False, True])
def test_a_folder_is_locked_as_a_file_is(
    windows: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On Windows, which opens none, by a temporary file; nothing is left in the folder."""
    (temporary := tmp_path / "temporary").mkdir()
    (folder := tmp_path / "folder").mkdir()
    monkeypatch.setattr(lock, "WINDOWS", windows)
    monkeypatch.setattr(tempfile, "tempdir", str(temporary))
    first, waited = ExitStack(), list[int]()
    first.enter_context(locked(folder))
    with locked(folder, lambda: waited.append(1) or first.close()):
        assert waited
    assert not [*folder.iterdir()]
    assert len([*temporary.iterdir()]) == windows


@pytest.mark.mutant("a lock that a forked process holds as long as it lives")
def test_a_lock_ends_with_who_holds_it_and_not_with_what_it_forked(tmp_path: Path) -> None:
    waited, (ready, begun) = list[int](), os.pipe()
    with locked(tmp_path / "lock"):
        left = os.fork()
        if left == 0:
            os.write(begun, b"1")
            time.sleep(20)
            os._exit(0)
        os.read(ready, 1)
    with locked(tmp_path / "lock", lambda: os.kill(left, signal.SIGKILL) or waited.append(1)):
        assert not waited
    os.kill(left, signal.SIGKILL)
    os.waitpid(left, 0)
    os.close(ready)
    os.close(begun)
