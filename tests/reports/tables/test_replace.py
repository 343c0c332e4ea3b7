"""A set of files is the old one, the new one, or a mixture that its list does not fit."""

import multiprocessing
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest
from given.otherwise import otherwise

from textmech.reports.tables import replace as replacing
from textmech.reports.tables import run_list
from textmech.reports.tables.replace import replace

NAMES = ("a.csv", run_list.NAME, "s.csv")
OLD = {name: f"old {name}\n" for name in NAMES}
NEW = {name: f"new {name}\n" for name in (*NAMES, "d.csv")}
FORK = multiprocessing.get_context("fork")
STRIKES = ("mkdir", "open", "replace")  # what a replacement does to the disk


def struck(at: int, name: str, strike: Callable[[], None], patch: pytest.MonkeyPatch) -> None:
    """Lets the `at`-th call of the Path method do something else before it does its work."""
    calls, whole = [0], getattr(Path, name)

    def method(self: Path, *words: object, **more: object) -> object:
        calls[0] += 1
        if calls[0] == at:
            strike()
        return whole(self, *words, **more)

    patch.setattr(Path, name, method)


def found(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in folder.iterdir()}


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    folder = tmp_path / "reports"
    replace(folder, OLD)
    assert found(folder) == OLD
    return folder


def kill() -> None:
    os.kill(os.getpid(), signal.SIGKILL)


def interrupt() -> None:
    raise KeyboardInterrupt


def refuse() -> None:
    raise OSError(28, "No space left on device")


@pytest.mark.parametrize("name", STRIKES)
@pytest.mark.parametrize("at", range(1, 6))
def test_killed_anywhere_each_file_is_whole_and_the_list_is_the_last(
    name: str, at: int, folder: Path
) -> None:
    """Between two files it is a mixture, which the list does not fit; the next run ends it."""

    def doomed() -> None:
        with pytest.MonkeyPatch.context() as patch:
            struck(at, name, kill, patch)
            replace(folder, NEW)

    process = FORK.Process(target=doomed)
    process.start()
    process.join()
    files = {path.name: path.read_text() for path in folder.iterdir() if path.is_file()}
    assert all(text in (OLD.get(name), NEW[name]) for name, text in files.items())
    if files[run_list.NAME] == NEW[run_list.NAME]:
        assert files == NEW
    replace(folder, NEW)
    assert found(folder) == NEW  # nothing is left of the one that was killed


@pytest.mark.parametrize("at", range(1, 6))
@pytest.mark.parametrize("name", STRIKES)
def test_interrupted_anywhere_it_is_one_run_and_nothing_more(
    name: str, at: int, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        struck(at, name, interrupt, patch)
        with suppress(KeyboardInterrupt):
            replace(folder, NEW)
    assert found(folder) in (OLD, NEW)


@pytest.mark.parametrize("at", range(1, 5))
@pytest.mark.parametrize("name", ["mkdir", "open"])
def test_a_disk_that_is_full_costs_no_old_file(
    name: str, at: int, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        struck(at, name, refuse, patch)
        with suppress(OSError):
            replace(folder, NEW)
    assert found(folder) in (OLD, NEW)


@pytest.mark.mutant("the list of a run is written before its tables")
def test_the_list_that_is_not_the_last_is_seen(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = otherwise(replacing, "name == run_list.NAME)", "name != run_list.NAME)").replace
    monkeypatch.setitem(globals(), "replace", first)
    with pytest.raises(AssertionError):
        test_killed_anywhere_each_file_is_whole_and_the_list_is_the_last("replace", 2, folder)


def test_a_folder_in_the_place_of_a_file_costs_none_of_the_others(folder: Path) -> None:
    (folder / "d.csv").mkdir()
    with pytest.raises(OSError, match=r"d\.csv"):
        replace(folder, NEW)
    (folder / "d.csv").rmdir()
    assert found(folder) == OLD


@pytest.mark.slow
def test_two_at_once_are_one_after_the_other(folder: Path) -> None:
    def many(text: str) -> None:
        for _ in range(10):
            replace(folder, dict.fromkeys(NEW, text))

    processes = [FORK.Process(target=many, args=(text,)) for text in "xyz"]
    for process in processes:
        process.start()
    for process in processes:
        process.join()
        assert process.exitcode == 0
    assert len(set(found(folder).values())) == 1
    assert set(found(folder)) == set(NEW)


# A folder for one run.

IN_ONE = """\
import sys
from textmech.reports.runs.processes import termination
from textmech.reports.runs.processes.temporary_folder import temporary_folder
termination.listen()
with temporary_folder("textmech-run-") as folder:
    (folder / "ab").mkdir()
    print(folder, flush=True)
    sys.stdin.read()
"""


@pytest.mark.slow
@pytest.mark.parametrize("times", [1, 5])
def test_a_temporary_folder_goes_with_a_run_that_is_struck(times: int, tmp_path: Path) -> None:
    with subprocess.Popen(
        [sys.executable, "-c", IN_ONE],
        stdin=subprocess.PIPE, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
        env=os.environ | {"TMPDIR": str(tmp_path)},
    ) as process:  # fmt: skip
        assert process.stdout
        made = Path(process.stdout.readline().strip())
        assert made.parent == tmp_path
        for _ in range(times):
            process.send_signal(signal.SIGINT)
            time.sleep(0.02)
        process.wait(10)
    assert not made.exists()
