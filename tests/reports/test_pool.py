"""A process that dies, or a task that raises, costs its own result only."""

import os
import signal
import sys

import pytest

from textmech.reports import pool


def work(task: int) -> int:
    if task == 3:
        os.kill(os.getpid(), signal.SIGKILL)
    if task == 5:
        raise ZeroDivisionError("five")
    if task == 6:
        sys.exit(0)
    return task * task


@pytest.mark.parametrize("jobs", [1, 2])
def test_the_rest_goes_on(jobs: int) -> None:
    found = dict(pool.spread(work, list(range(7)), jobs=jobs))
    assert {i: r for i, r in found.items() if i not in (3, 5, 6)} == {0: 0, 1: 1, 2: 4, 4: 16}
    assert found[3] == pool.Died("the process died")
    assert found[5] == pool.Died("ZeroDivisionError: five")
    assert found[6] == pool.Died("SystemExit: 0")


def where(_: int) -> str:
    return os.getcwd()


def test_engines_do_not_write_into_the_users_folder(tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert dict(pool.spread(where, [0], jobs=1))[0] != str(tmp_path)
