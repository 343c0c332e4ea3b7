"""A set of files is the old one or the new one, wherever a run is struck."""

import multiprocessing
import os
import signal
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

import pytest

from textmech.reports.system.replace import replace

NAMES = ("a.csv", "b.csv", "c.csv")
OLD = {name: f"old {name}\n" for name in NAMES}
NEW = {name: f"new {name}\n" for name in (*NAMES, "d.csv")}
FORK = multiprocessing.get_context("fork")
STRIKES = ("mkdir", "open", "rename", "replace")  # what a replacement does to the disk
SWEEPS = ("unlink", "rmdir")  # after it


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


@pytest.mark.parametrize("name", STRIKES + SWEEPS)
@pytest.mark.parametrize("at", range(1, 6))
def test_killed_anywhere_the_next_writer_finds_one_run(name: str, at: int, folder: Path) -> None:
    def doomed() -> None:
        with pytest.MonkeyPatch.context() as patch:
            struck(at, name, kill, patch)
            replace(folder, NEW)

    process = FORK.Process(target=doomed)
    process.start()
    process.join()
    replace(folder, {})  # whoever writes there next finishes it
    assert found(folder) in (OLD, NEW)
    replace(folder, OLD | NEW)
    assert found(folder) == NEW  # nothing is left of the one that was killed


@pytest.mark.parametrize("strike", [interrupt, refuse])
@pytest.mark.parametrize("name", STRIKES)
@pytest.mark.parametrize("at", range(1, 6))
def test_interrupted_or_refused_anywhere_it_is_one_run_and_nothing_more(
    strike: Callable[[], None],
    name: str,
    at: int,
    folder: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with monkeypatch.context() as patch:
        struck(at, name, strike, patch)
        try:
            replace(folder, NEW)
        except OSError:
            assert found(folder) == OLD
        except KeyboardInterrupt:
            assert found(folder) in (OLD, NEW)
        else:
            assert found(folder) == NEW


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


@pytest.mark.parametrize("strike", [interrupt, refuse])
@pytest.mark.parametrize("name", SWEEPS)
@pytest.mark.parametrize("at", range(1, 6))
def test_a_sweep_that_is_struck_costs_nothing_and_is_the_next_ones(
    strike: Callable[[], None], name: str, at: int, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with monkeypatch.context() as patch:
        struck(at, name, strike, patch)
        with suppress(KeyboardInterrupt):
            replace(folder, NEW)
    assert {name: (folder / name).read_text() for name in NEW} == NEW
    replace(folder, NEW)
    assert found(folder) == NEW


@pytest.mark.mutant("what is put back is moved back, and deleted by the second try")
@pytest.mark.parametrize("refused", NEW)
def test_a_file_that_cannot_be_replaced_costs_no_other(
    refused: str, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As one that a container mounts, or that somebody holds open: nobody takes its place."""
    whole = Path.replace

    def busy(self: Path, target: Path) -> Path:
        if target == folder / refused:
            raise OSError(16, "Device or resource busy")
        return whole(self, target)

    monkeypatch.setattr(Path, "replace", busy)
    for _ in range(2):  # and again: nothing of the first try is in the way
        with pytest.raises(OSError, match="busy"):
            replace(folder, NEW)
        assert found(folder) == OLD
    monkeypatch.undo()
    replace(folder, NEW)
    assert found(folder) == NEW
