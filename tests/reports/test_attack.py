"""Runs that are struck at random moments: their reports are of one run, and nothing stays."""

import multiprocessing
import os
import random
import signal
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from textmech.cases.case import Case
from textmech.reports.batch import suite
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.data.row import Comparison
from textmech.reports.output import write
from textmech.reports.system import termination as ending
from textmech.reports.system.replace import MAKING

FORK = multiprocessing.get_context("fork")
STRIKES = [signal.SIGKILL, signal.SIGTERM, signal.SIGINT, signal.SIGHUP]
LONGEST = 1.5  # s until the strike: several runs, each with its workers and its five files
SOON = 4.0  # s, as for a command that is told to end


def runs(case: Case, trial: Callable[..., Trial], folder: Path) -> None:
    """One run after the other, each with other numbers, until somebody ends it."""
    os.setsid()
    for number in ending.known_signals():  # of tests that run in the background some are ignored
        signal.signal(number, signal.SIG_DFL)
    ending.listen()
    (folder / "out").mkdir(exist_ok=True)
    try:
        for i in range(10_000):
            engine = trial(rate=1.0 + i).engine
            report = suite.measure([case], [engine], jobs=2, progress=lambda *_: None, book=False)
            write.write(write.tables(report, [case]), folder / "out")
            (folder / "began").touch()
    except KeyboardInterrupt:
        os._exit(ending.INTERRUPTED)


def session(leader: int) -> list[int]:
    """The processes of a session that run."""
    found = []
    for stat in Path("/proc").glob("[0-9]*/stat"):
        try:
            _, _, rest = stat.read_text(encoding="utf-8").rpartition(") ")
        except OSError:  # it ended meanwhile
            continue
        state, _, _, leads, *_ = rest.split()
        if int(leads) == leader and state != "Z":
            found.append(int(stat.parent.name))
    return found


def unread(folder: Path) -> str:
    """Why the reports cannot be read; nothing where they can."""
    try:
        write.read(folder / "tolerance.csv", Comparison)
    except ValueError as mixed:
        return str(mixed)
    return ""


def struck(number: signal.Signals, delay: float, start: Callable[[], None], folder: Path) -> None:
    """Starts the runs, strikes once, and looks at what is left."""
    process = FORK.Process(target=start)
    process.start()
    assert process.pid is not None
    try:
        while not (folder / "began").exists():
            time.sleep(0.01)
        time.sleep(delay)
        os.kill(process.pid, number)
        process.join(SOON)
        assert process.exitcode in (ending.INTERRUPTED, -number)
        until = time.monotonic() + SOON
        while left := session(process.pid):
            assert time.monotonic() < until, f"left: {left}"
            time.sleep(0.01)
    finally:
        process.kill()
    why = unread(folder / "out")  # killed between two files: said, and the next writer's to end
    between = (folder / "out" / MAKING).exists()
    assert not why or (number == signal.SIGKILL and between and "of another run" in why), why
    names = {file.name for file in (folder / "out").iterdir()} - set(write.FILES)
    assert number == signal.SIGKILL or not names
    (folder / "began").unlink()


@pytest.mark.slow
@pytest.mark.parametrize("number", STRIKES, ids=lambda number: number.name)
def test_struck_at_random_moments(
    number: signal.Signals, moving: Case, trial: Callable[..., Trial], tmp_path: Path
) -> None:
    moments = random.Random(int(number))
    for _ in range(STRUCK):
        struck(number, LONGEST * moments.random(), lambda: runs(moving, trial, tmp_path), tmp_path)
    report = suite.measure([moving], [], jobs=1, progress=lambda *_: None, book=False)
    write.write(write.tables(report, [moving]), tmp_path / "out")
    assert {file.name for file in (tmp_path / "out").iterdir()} == set(write.FILES)
    assert not unread(tmp_path / "out")


STRUCK = int(os.environ.get("TEXTMECH_STRUCK", "2"))  # times each
