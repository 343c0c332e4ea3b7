"""A run that is told to end ends soon, with its workers, with one line, and leaves nothing."""

import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import suppress
from pathlib import Path
from types import FrameType
from typing import Any

import pandas as pd
import pytest
from given.command import endless

from textmech.reports.front.command import done
from textmech.reports.tables import write

SOON = 4.0  # s: two are promised, of a machine that does nothing else
ROOM = Path(__file__).parents[2]


@pytest.fixture
def run(tmp_path: Path) -> Iterator[subprocess.Popen[str]]:
    """A run of one case whose engine is at work and will not end."""
    case, work = tmp_path / "moving.yaml", tmp_path / "work"
    case.write_text(endless.CASE, encoding="utf-8")
    work.mkdir()
    words = [str(work), "run", str(case), "--out", str(tmp_path / "out")]
    path = os.pathsep.join([str(ROOM), *sys.path])
    cache = {"PYTHONPATH": path, "TEXTMECH_CACHE": str(tmp_path / "cache")}
    process = subprocess.Popen(
        [sys.executable, "-m", "given.command.endless", *words],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
        env=os.environ | cache,
        start_new_session=True,
    )
    try:
        within(60.0, lambda: any(work.iterdir()))
        yield process
    finally:
        with suppress(ProcessLookupError):  # orphans too, which would hold the pipes open for ever
            os.killpg(process.pid, signal.SIGKILL)
        process.communicate()


def within(seconds: float, holds: Callable[[], bool]) -> None:
    end = time.monotonic() + seconds
    while not holds():
        assert time.monotonic() < end
        time.sleep(0.02)


def alive(process: int) -> bool:
    """Whether it runs; one that nobody has buried yet does not."""
    try:
        text = Path(f"/proc/{process}/stat").read_text(encoding="utf-8")
    except OSError:
        return False
    return text.rpartition(") ")[2][0] != "Z"


def at_work(folder: Path) -> list[int]:
    return [int(file.name) for file in (folder / "work").iterdir()]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("number", "strike"),
    [(signal.SIGINT, os.killpg), (signal.SIGTERM, os.kill), (signal.SIGHUP, os.killpg)],
    ids=["Ctrl-C in its terminal", "kill", "its terminal is closed"],
)
def test_it_ends_soon_and_says_so(
    run: subprocess.Popen[str],
    number: signal.Signals,
    strike: Callable[[int, int], None],
    tmp_path: Path,
) -> None:
    workers = at_work(tmp_path)
    assert any(map(alive, workers))
    strike(run.pid, number)
    _, said = run.communicate(timeout=SOON)
    assert run.returncode == 130
    assert said.count("interrupted:") == 1
    assert "nothing was written" in said
    assert "Traceback" not in said
    assert not any(map(alive, workers))
    assert not (tmp_path / "out").exists()  # made for it, and empty


@pytest.mark.slow
def test_told_twice_it_ends_without_a_traceback(run: subprocess.Popen[str], tmp_path: Path) -> None:
    for _ in range(5):
        os.killpg(run.pid, signal.SIGINT)
        time.sleep(0.02)  # told at once, they are heard as one
    _, said = run.communicate(timeout=SOON)
    assert run.returncode == 130
    assert "Traceback" not in said
    within(SOON, lambda: not any(map(alive, at_work(tmp_path))))


@pytest.mark.slow
def test_killed_it_leaves_no_workers(run: subprocess.Popen[str], tmp_path: Path) -> None:
    workers = at_work(tmp_path)
    run.kill()
    within(SOON, lambda: not any(map(alive, workers)))


SHUTTING = """\
import atexit
import os
import signal
import sys
import threading
import time

from textmech.reports.front import cli


def forever():
    while True:
        time.sleep(3600)


class Late:
    def __del__(self):
        forever()


def told(**_):
    sys.stdout.write("the last word")  # which waits to be written out
    {ends}


{leaves}
cli.command = told
cli.main()
"""
ENDS = [("raise KeyboardInterrupt", 130), ("return 0", 0), ("return 1", 1), ("raise OSError", 2)]
LEAVES = {
    "a signal as it ends": "atexit.register(os.kill, os.getpid(), signal.SIGINT)",
    "a thread": "threading.Thread(target=forever).start()",
    "an exit handler": "atexit.register(forever)",
    "an object": "late = Late()",
}


def shut(leaves: str, ends: str) -> subprocess.CompletedProcess[str]:
    """A command that ends so, where an engine's import has left something behind."""
    return subprocess.run(
        [sys.executable, "-c", SHUTTING.format(leaves=leaves, ends=ends)],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )


@pytest.mark.parametrize(("ends", "code"), ENDS)
def test_told_while_it_shuts_down_it_ends_as_it_would(ends: str, code: int) -> None:
    done = shut(LEAVES["a signal as it ends"], ends)
    assert (done.returncode, done.stdout) == (code, "the last word"), done.stderr


@pytest.mark.mutant("a command that has finished waits for a thread that an engine has left")
@pytest.mark.parametrize("left", LEAVES)
def test_what_an_engine_leaves_behind_is_not_waited_for(left: str) -> None:
    """Neither by the user nor by a signal, which would be ignored by then."""
    done = shut(LEAVES[left], "return 1")
    assert (done.returncode, done.stdout) == (1, "the last word"), done.stderr


EARLY = """\
import os
import signal
import sys


class Struck:
    def find_spec(self, name, path=None, target=None):
        if name == {name!r}:  # while that is being imported
            os.kill(os.getpid(), signal.SIGINT)


sys.meta_path.insert(0, Struck())
from textmech.reports.front.start import main

sys.argv = ["textmech", "list"]
main()
"""


@pytest.mark.mutant("what is imported before the command listens prints a traceback")
@pytest.mark.parametrize("name", ["click", "textmech.cases.titled"])
def test_told_in_its_first_moments_it_says_so(name: str) -> None:
    done = subprocess.run(
        [sys.executable, "-c", EARLY.format(name=name)],
        capture_output=True,
        text=True,
        check=False,
        timeout=60,
    )
    assert (done.returncode, done.stdout) == (130, "")
    assert done.stderr.splitlines()[-1] == "interrupted: nothing was written"


# Whenever a run is interrupted, what it says of its reports is true.

FRAMES = {"advice.csv": pd.DataFrame({"case": ["swing"], "cost": [2.0]})}
LOOKED_AT = (done.__file__, write.__file__)


class Strike:
    """Interrupts once, at the n-th line of those files."""

    def __init__(self, at: int) -> None:
        self.left = at

    def __call__(self, frame: FrameType, event: str, _: Any) -> "Strike":
        if event == "line" and frame.f_code.co_filename in LOOKED_AT:
            self.left -= 1
            if self.left == 0:
                raise KeyboardInterrupt
        return self


def interrupted(at: int, out: Path) -> bool:
    """Whether the writing was struck there."""
    before = sys.gettrace()
    sys.settrace(Strike(at))
    try:
        done.written(FRAMES, out)
    except KeyboardInterrupt:
        return True
    finally:
        sys.settrace(before)
    return False


def test_what_is_said_is_what_is_there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two of 16 strikes at that moment were told as `nothing was written`, and it was."""
    at, said = 0, set[bool]()
    struck = True
    while struck:
        at += 1
        monkeypatch.setattr(done, "DONE", [])
        out = tmp_path / str(at)
        struck = interrupted(at, out)
        there = (out / "advice.csv").exists()
        assert bool(done.DONE) == there, at
        said.add(struck and there)
    assert at > 10
    assert said == {True, False}  # it was struck before they were there, and after
