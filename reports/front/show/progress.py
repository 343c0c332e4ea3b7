"""Shows while a command works how much is done, of what, and how long the rest may take.

A phase tells its tasks as they are done; from a thread it is said what the work is at meanwhile, so
that whatever takes longer than two seconds has a line that moves.
"""

import shutil
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager

from ....reference.integrators.now import NOW, begun, time_left
from .console import draw, tell

FIRST = 2.0  # s before anything is said: most commands are done by then
INTERVAL = 10.0  # s between two lines where no bar can be drawn
BEAT = 0.5  # s between two looks
BAR = 20  # columns


@contextmanager
def progress(*, quiet: bool = False) -> "Iterator[Shown]":
    """A bar for each phase on the error stream; a line now and then where that is no terminal.

    quiet: nothing is said but `aloud`.
    """
    shown = Shown(_terminal() and not quiet, quiet=quiet)
    _PHASES.append(shown)
    try:
        yield shown
    except BaseException:
        if shown.terminal:
            tell()  # the message that follows starts on a line of its own
        raise
    finally:
        _PHASES.remove(shown)


@contextmanager
def aloud(write: Callable[[str], object] | None = None) -> Iterator[None]:
    """Within the block there is a line that moves, from two seconds on, on the error stream.

    write: takes the lines in its place; then there is one now and then.
    """
    if _ALOUD.locked():  # somebody further out sees to it
        yield
        return
    ended = threading.Event()
    thread = threading.Thread(target=_tell_on, args=(ended, write), daemon=True)
    with _ALOUD:
        begun("")
        thread.start()
        try:
            yield
        finally:
            ended.set()
            thread.join()


class Shown:
    """The phase that is being shown, since when, and what was said of it last."""

    def __init__(self, terminal: bool, *, quiet: bool = False) -> None:
        self.terminal, self.quiet = terminal, quiet
        self.what = ""
        self.last = ""
        self.line = ""
        self.began = self.said = time.monotonic()
        self.working: Callable[[], Sequence[str]] = tuple

    def __call__(
        self, what: str, done: int, total: int, last: str = "", part: float = 0.0, /
    ) -> None:
        now = time.monotonic()
        if what != self.what:
            self.what, self.began, self.last = what, now, ""
        self.last = last or self.last
        rest = "" if done == total else time_left(now - self.began, part)
        if self.terminal:
            self.line = bar(what, done, total, rest, self.last)
            if done == total:
                tell(self.line)
            else:
                draw(self.line)
            return
        after = f", last {self.last}" if self.last and done < total else ""
        self.line = f"{what}: {done} of {total} done{rest and ', ' + rest}{after}"
        if not self.quiet and (done == total or now >= self.said + INTERVAL):
            tell(self.line)
            self.said = now

    def watch(self, executor: Executor) -> None:
        """Sets the executor whose tasks are shown while they work, if it tells what it is at."""
        self.working = getattr(executor, "doing", tuple)


_PHASES: list[Shown] = []
_ALOUD = threading.Lock()


def _terminal() -> bool:
    return sys.stderr is not None and sys.stderr.isatty()


def _tell_on(ended: threading.Event, write: Callable[[str], object] | None) -> None:
    """Runs in the thread: prints now and then what the work is at, until `ended` is set."""
    began, said, terminal = time.monotonic(), 0.0, write is None and _terminal()
    while not ended.wait(BEAT):
        now = time.monotonic()
        recent = max([said, *(phase.said for phase in _PHASES if phase.said > phase.began)])
        if now < began + FIRST or (not terminal and now < recent + INTERVAL):
            continue
        line = f"{now - began:.0f} s: {_at() or 'reading and preparing'}"
        if terminal:
            draw(fitting(line))
        else:
            (write or tell)(line)
            said = now
            for phase in _PHASES:
                phase.said = now


def _at() -> str:
    """Returns what is being worked on: by the processes of a phase, or by this one."""
    if not _PHASES or not (working := _PHASES[-1].working()):
        return (_PHASES[-1].line.strip() if _PHASES else "") or NOW.line()
    phase = _PHASES[-1]
    at, done = "; ".join(working), phase.line.strip()
    return working[0] if phase.terminal else f"{done}; at {at}" if done else at


def bar(what: str, done: int, total: int, rest: str, last: str) -> str:
    """One line, as wide as the terminal, so that nothing of the one before is left."""
    filled = BAR * done // max(total, 1)
    parts = [f"{what:10} [{'#' * filled}{'.' * (BAR - filled)}] {done}/{total}", rest]
    return fitting("  ".join(p for p in (*parts, last if done < total else "") if p))


def fitting(line: str) -> str:
    """Fits the line to the terminal's width."""
    width = shutil.get_terminal_size().columns - 1  # in the last column a line would break
    return f"{line[:width]:{width}}"
