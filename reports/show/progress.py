"""What a run shows while it works: how much is done, of what, and how long the rest may take."""

import shutil
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager

from ..results import Progress
from .say import tell

INTERVAL = 10.0  # s between two lines where no bar can be drawn
BAR = 20  # columns
SOON = 0.02  # of the work: before that much is done nobody knows how long the rest takes


@contextmanager
def progress() -> Iterator[Progress]:
    """A bar for each phase on the error stream; a line now and then where that is no terminal."""
    terminal = sys.stderr is not None and sys.stderr.isatty()
    shown = _Shown(terminal)
    try:
        yield shown
    except BaseException:
        if terminal:
            tell()  # the message that follows starts on a line of its own
        raise


class _Shown:
    """The phase that is being shown, since when, and what was said of it last."""

    def __init__(self, terminal: bool) -> None:
        self.terminal = terminal
        self.what = ""
        self.last = ""
        self.began = self.said = time.monotonic()

    def __call__(
        self, what: str, done: int, total: int, last: str = "", part: float = 0.0, /
    ) -> None:
        now = time.monotonic()
        if what != self.what:
            self.what, self.began, self.last = what, now, ""
        self.last = last or self.last
        rest = "" if done == total else left(now - self.began, part)
        if self.terminal:
            tell(f"\r{bar(what, done, total, rest, self.last)}", nl=done == total)
        elif done == total or now >= self.said + INTERVAL:
            after = f", last {self.last}" if self.last and done < total else ""
            tell(f"{what}: {done} of {total} done{rest and ', ' + rest}{after}")
            self.said = now


def left(seconds: float, part: float) -> str:
    """How long the rest takes if it goes on like that, in words; or nothing, if nobody knows."""
    if part < SOON:
        return ""
    rest = seconds * (1.0 - part) / part
    if rest < 1.0:
        return ""
    minutes, whole = divmod(round(rest), 60)
    return f"about {minutes}:{whole:02} left" if minutes else f"about {whole} s left"


def bar(what: str, done: int, total: int, rest: str, last: str) -> str:
    """One line, as wide as the terminal, so that nothing of the one before is left."""
    filled = BAR * done // max(total, 1)
    parts = [f"{what:10} [{'#' * filled}{'.' * (BAR - filled)}] {done}/{total}", rest]
    line = "  ".join(part for part in (*parts, last if done < total else "") if part)
    width = shutil.get_terminal_size().columns - 1  # in the last column a line would break
    return f"{line[:width]:{width}}"
