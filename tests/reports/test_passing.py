"""A folder of a run goes with it, in whatever way it ends, and nobody else's ever does."""

import os
import shutil
import signal
import sys
import tempfile
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from subprocess import PIPE, Popen
from typing import Any

import pytest
from given.trees import digest

from textmech.reports.command.options import Folder
from textmech.reports.system import temporary_folder as room
from textmech.reports.system.temporary_folder import passing

PREFIX = "textmech-run-"
HELD = """\
import sys
from textmech.reports.system import termination
from textmech.reports.system.temporary_folder import passing
termination.listen()
with passing({prefix!r}) as folder:
    (folder / "ab").mkdir()
    (folder / "ab" / "result").write_text("x")
    print(folder, flush=True)
    sys.stdin.read()
"""


@pytest.fixture(autouse=True)
def among(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Where temporary files are."""
    monkeypatch.setenv("TMPDIR", str(tmp_path))
    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    return tmp_path


@pytest.fixture
def other() -> Iterator[tuple[Popen[str], Path]]:
    """A process that holds one."""
    text = HELD.format(prefix=PREFIX)
    with Popen([sys.executable, "-c", text], stdin=PIPE, stdout=PIPE, text=True) as process:
        assert process.stdout
        line = process.stdout.readline().strip()
        assert line  # else the folder were the checkout
        yield process, Path(line)
        process.kill()


def test_what_a_killed_run_left_goes_with_the_next(other: tuple[Popen[str], Path]) -> None:
    process, folder = other
    with passing(PREFIX) as mine:
        assert folder.is_dir()  # held by a run
    assert not mine.exists()
    process.kill()
    process.wait()
    assert folder.is_dir()
    with passing("textmech-other-"):
        assert folder.is_dir()
    with passing(PREFIX) as mine:
        assert not folder.exists()
        assert mine.is_dir()


@pytest.mark.slow
@pytest.mark.parametrize("times", [1, 2, 5])
@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM])
def test_struck_it_leaves_none(
    times: int, number: signal.Signals, other: tuple[Popen[str], Path]
) -> None:
    process, folder = other
    for _ in range(times):
        process.send_signal(number)
        time.sleep(0.02)
    process.wait(10)
    assert not folder.exists()


def old(path: Path) -> None:
    os.utime(path, (1, 1))


def named(path: Path) -> None:
    """As a user may call a folder of reports."""
    path.mkdir()
    (path / "tolerance.csv").write_text("x")


def marked(path: Path) -> None:
    """Of a copy, or of one who typed our mark."""
    named(path)
    (path / room.MARK).write_text(f"textmech made {path.name} as 1, and takes it away\n")


def led(path: Path) -> None:
    (path.parent / "victim").mkdir()
    (path.parent / "victim" / "x").write_text("x")
    (path.parent / "victim" / room.MARK).write_text("x")
    path.symlink_to(path.parent / "victim")


def piped(path: Path) -> None:
    path.mkdir()
    os.mkfifo(path / room.MARK)


def device(path: Path) -> None:
    path.mkdir()
    (path / room.MARK).symlink_to("/dev/zero")


@pytest.mark.mutant("a folder in $TMPDIR is swept by its name and age")
@pytest.mark.parametrize("make", [named, marked, led, piped, device, Path.touch, os.mkfifo])
@pytest.mark.parametrize("name", [f"{PREFIX}before", f"{PREFIX}abcd1234", f"{PREFIX}"])
def test_no_other_is_swept(make: Callable[[Path], None], name: str, among: Path) -> None:
    make(among / name)
    if not (among / name).is_symlink():
        old(among / name)
    before = digest(among, folders_dates=False)
    with passing(PREFIX):
        pass
    assert digest(among, folders_dates=False) == before


def test_a_copy_of_one_that_was_left_stays(other: tuple[Popen[str], Path], among: Path) -> None:
    process, folder = other
    process.kill()
    process.wait()
    copy = shutil.copytree(folder, among / f"{PREFIX}zzzzzzzz")
    with passing(PREFIX):
        assert copy.is_dir()
        assert not folder.exists()


def test_its_mark_goes_last(among: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """What is killed while it clears away is still known to be ours, and goes with the next."""
    cleared, seen = room.shutil.rmtree, list[bool]()

    def watched(path: str | Path, **given: Any) -> None:
        if Path(path).name == "inside":
            seen.append((Path(path).parent / room.MARK).exists())
        cleared(path, **given)

    monkeypatch.setattr(room.shutil, "rmtree", watched)
    for _ in range(2):
        with passing(PREFIX) as mine:
            (mine / "a.csv").write_text("1")
            (mine / "inside").mkdir()
            (mine / "led").symlink_to(among)
        assert not mine.exists()
    assert seen == [True, True]
    assert among.is_dir()


@pytest.mark.mutant("the mark of a folder that passes deleted with the rest")
def test_what_is_cut_short_while_it_goes_is_swept(
    other: tuple[Popen[str], Path], monkeypatch: pytest.MonkeyPatch
) -> None:
    process, folder = other
    (folder / "deep").mkdir()
    (folder / "deep" / "rows.csv").write_text("1")
    process.kill()
    process.wait()
    cleared = room.shutil.rmtree

    def struck(path: str | Path, **given: Any) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(room.shutil, "rmtree", struck)
    with pytest.raises(KeyboardInterrupt), passing(PREFIX):
        pass
    monkeypatch.setattr(room.shutil, "rmtree", cleared)
    assert folder.is_dir()
    with passing(PREFIX):
        assert not folder.exists()


def test_one_that_a_person_names_is_theirs(other: tuple[Popen[str], Path]) -> None:
    process, folder = other
    process.kill()
    process.wait()
    Folder().convert(str(folder), None, None)
    assert [path.name for path in folder.iterdir()] == ["ab"]
    with passing(PREFIX):
        assert folder.is_dir()
