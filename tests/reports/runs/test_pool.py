"""A process that dies, or a task that raises, costs its own result only."""

import operator
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
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given.forked import TOLD, runs

from textmech.cases.mistake import CaseError
from textmech.reports.front.command.run import _executor as cluster
from textmech.reports.runs.processes import pool
from textmech.reports.tables import lock
from textmech.reports.tables.lock import locked


def work(task: int) -> int:
    if task == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    if task == 5:
        raise ZeroDivisionError("five")
    if task == 6:
        sys.exit(0)
    if task == 7:
        os._exit(0)
    if task == 8:
        os.kill(os.getpid(), signal.SIGRTMIN + 2)
    if task == 9:
        raise Strange("one", "two")
    return task * task


class Strange(Exception):
    """One that is pickled and cannot be read back."""

    def __init__(self, one: str, two: str) -> None:
        super().__init__(one)


TOLD_OF = {
    3: "its process ended (SIGKILL)",
    5: "ZeroDivisionError: five",
    6: "SystemExit: 0",
    7: "its process ended (exit code 0)",
    8: f"its process ended (signal {signal.SIGRTMIN + 2})",
    9: "Strange: one",
}


@dataclass(frozen=True)
class Task:
    """A task of ours, or of somebody else's engine."""

    what: Any
    foreign: bool = False
    limit: float = 60.0
    name: str = ""

    @property
    def engine(self) -> SimpleNamespace:
        return SimpleNamespace(name="strange" if self.foreign else "mujoco")


@pytest.fixture(autouse=True)
def strange(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(pool.engines, "foreign", lambda name: name == "strange")


def worked(task: Task) -> int:
    return work(task.what)


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize("foreign", [False, True])
def test_whatever_a_task_does_it_is_told_and_costs_no_other(foreign: bool, jobs: int) -> None:
    tasks = [Task(what, foreign) for what in (*range(12), 3, 8, 3, *range(12))]
    with pool.local(jobs) as executor:
        found = dict(pool.spread(worked, tasks, executor))
    for index, task in enumerate(tasks):
        told = TOLD_OF.get(task.what)
        assert found[index] == (pool.Died(told) if told else task.what**2)


def where(_: int) -> str:
    return os.getcwd()


def test_engines_do_not_write_into_the_users_folder(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pool.local(1) as executor:
        assert dict(pool.spread(where, [0], executor))[0] != str(tmp_path)


def leftovers(task: Task) -> tuple[int, tuple[object, ...]]:
    """The process that works, and what a foreign engine changes of it."""
    found = (
        os.environ.get("LEFT_BEHIND"), os.getcwd(), signal.getsignal(signal.SIGTERM),
        sys.getrecursionlimit(), np.geterr()["over"], hasattr(os, "added"),
    )  # fmt: skip
    if task.foreign:
        os.environ["LEFT_BEHIND"] = "something"
        os.chdir("/")
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        sys.setrecursionlimit(999)
        np.seterr(over="raise")
        os.added = True  # type: ignore[attr-defined]
        print("a banner")
    return os.getpid(), found


@pytest.mark.mutant("a process that ran somebody else's engine answers for all")
def test_what_an_engine_leaves_behind_reaches_nobody_else(
    monkeypatch: pytest.MonkeyPatch, capfd: pytest.CaptureFixture[str]
) -> None:
    tasks = [Task(0, foreign) for foreign in (False, True, True, False, True, True, False)]
    with pool.local(1) as executor:
        found = [each for _, each in sorted(pool.spread(leftovers, tasks, executor))]
    assert len({left for _, left in found}) == 1
    assert capfd.readouterr().out == ""
    assert len({found[i][0] for i in (0, 3, 6)}) == 1  # ours has a process that stays
    monkeypatch.setattr(pool, "_is_foreign", lambda task: False)
    with pool.local(1) as executor:
        found = [each for _, each in sorted(pool.spread(leftovers, tasks, executor))]
    assert all(map(operator.ne, found[0][1], found[3][1]))


def slept(task: Task) -> str:
    time.sleep(task.what)
    return "woke"


@pytest.mark.slow
@pytest.mark.parametrize("foreign", [False, True])
def test_a_task_that_hangs_is_ended(foreign: bool) -> None:
    tasks = [Task(0.0), Task(3600.0, foreign, 1.0), *[Task(0.1)] * 4]
    with pool.local(2) as executor:
        found = dict(pool.spread(slept, tasks, executor))
    assert found.pop(1) == pool.Died("it takes longer than 1 s")
    assert set(found.values()) == {"woke"}


class Unreadable:
    """An answer that is pickled and cannot be read back."""

    def __reduce__(self) -> tuple[type, tuple[str]]:
        return int, ("no number",)


def answer(task: int) -> object:
    return Unreadable() if task == 1 else task


def test_an_answer_that_cannot_be_read_costs_no_other() -> None:
    with pool.local(2) as executor:
        found = dict(pool.spread(answer, list(range(6)), executor))
    assert "ValueError: invalid literal" in found.pop(1).because
    assert found == {task: task for task in (0, 2, 3, 4, 5)}


def test_processes_that_are_killed_while_they_wait_cost_no_task() -> None:
    """As by a system that runs out of memory."""
    with pool.local(2) as executor:
        assert dict(pool.spread(answer, [0, 2], executor)) == {0: 0, 1: 2}
        executor._kill_pool()
        found = dict(pool.spread(answer, [0, 2, 3, 4, 5, 6], executor))
    assert found == dict(enumerate([0, 2, 3, 4, 5, 6]))


@pytest.mark.parametrize("kind", [ThreadPoolExecutor, ProcessPoolExecutor])
def test_any_executor_serves(kind: Callable[[int], Executor]) -> None:
    with kind(3) as executor:
        found = dict(pool.spread(work, [0, 1, 2, 4, 5, 6], executor))
    assert [found[i] for i in range(4)] == [0, 1, 4, 16]
    assert [found[4], found[5]] == [pool.Died(TOLD_OF[5]), pool.Died(TOLD_OF[6])]


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


def double(task: Task) -> int:
    """Comes back in two processes, as from a library that forks by itself, one after the other."""
    if os.fork() == 0:
        time.sleep(0.05)
    return task.what**2


@pytest.mark.slow
def test_a_task_that_comes_back_twice_is_answered_once() -> None:
    with pool.local(1) as executor:
        tasks = [Task(what, foreign=True) for what in range(4)]
        assert dict(pool.spread(double, tasks, executor)) == {n: n * n for n in range(4)}


def leaves(task: Task) -> None:
    """Starts a process that outlives it and holds all it has been given, and may die itself."""
    told, dies = task.what
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
@pytest.mark.parametrize(("foreign", "dies"), [(False, False), (True, False), (True, True)])
def test_what_a_task_starts_ends_with_the_pool_and_hides_no_death(
    foreign: bool, dies: bool, tmp_path: Path
) -> None:
    told, begun = tmp_path / "left", time.monotonic()
    with pool.local(1) as executor:
        found = dict(pool.spread(leaves, [Task((told, dies), foreign)], executor))
        left = int(told.read_text(encoding="utf-8"))
    assert found == {0: pool.Died("its process ended (SIGKILL)") if dies else None}
    assert time.monotonic() - begun < 15  # s: of the 60 that it would be waited for
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


# A cluster's executor does the work where an address is given, and only there.


class Client:
    """As Dask's, with threads for its workers."""

    def __init__(self, address: str, **_: Any) -> None:
        if "nobody" in address:
            raise OSError("Timed out trying to connect")

    def __enter__(self) -> "Client":
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def get_executor(self) -> Executor:
        return ThreadPoolExecutor(1)


def test_without_an_address_there_is_none() -> None:
    with cluster(None) as found:
        assert found is None


def test_it_is_the_clients(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "distributed", SimpleNamespace(Client=Client))
    with cluster("tcp://here:8786") as found:
        assert isinstance(found, Executor)


@pytest.mark.parametrize(
    ("module", "words"),
    [(None, r"textmech\[dask\]"), (SimpleNamespace(Client=Client), "Timed out")],
)
def test_what_cannot_be_reached_is_bad_input(
    module: object, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "distributed", module)
    with pytest.raises(CaseError, match=words), cluster("tcp://nobody:8786"):
        pass
