"""Which numbered equations a case really uses: those whose function runs, not those it claims.

A function stands for the equations that open its docstring: `(2.44) d/dt ∂T/∂q̇ − …`. They are
noted while the case is solved. Watching every call would double its time, so a watch lasts for so
many calls, and starts anew wherever something else begins: a phase, an event, a law. What an import
calls is none of them: whether somebody had it before would decide how far a watch sees.
"""

import re
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import CodeType, FrameType
from typing import Any

HERE = str(Path(__file__).parent)
CALLS = 5000  # of one watch: the laws of a slider crank at one sample take 3300
IMPORT = "<frozen importlib._bootstrap>"  # the file of what does one
_OPENING = re.compile(r"\s*(?:\(2\.\d+\)(?:[-–](?:\(2\.\d+\))?)?(?:,| and)?\s*)+")
_NUMBER = re.compile(r"2\.\d+")


def equations(docstring: str | None) -> list[str]:
    """The equations a docstring opens with: "(2.23), (2.27) …" → ["2.23", "2.27"]."""
    opening = _OPENING.match(docstring or "")
    return _NUMBER.findall(opening.group()) if opening else []


class _Watch:
    """The functions seen so far, how many calls are still looked at, and who looked before."""

    def __init__(self) -> None:
        self.codes: set[CodeType] = set()
        self.left = 0
        self.importing: FrameType | None = None  # what began it
        self.before: Any = sys.getprofile()

    def start(self) -> None:
        self.left, self.importing = CALLS, None
        sys.setprofile(self.note)

    def note(self, frame: FrameType, event: str, _: Any) -> None:
        if self.importing is not None:
            if event == "return" and frame is self.importing:
                self.importing = None
        elif event == "call" and frame.f_code.co_filename == IMPORT:
            self.importing = frame
        elif event == "call":
            self.codes.add(frame.f_code)
            self.left -= 1
            if self.left < 0:
                self.end()

    def end(self) -> None:
        """Whoever profiled before does so again."""
        if hasattr(self.before, "enable"):  # cProfile's, which is no function
            sys.setprofile(None)
            self.before.enable()
        else:
            sys.setprofile(self.before)

    def equations(self) -> Iterator[str]:
        for code in self.codes:
            if code.co_filename.startswith(HERE) and code.co_consts:
                text = code.co_consts[0]
                yield from equations(text if isinstance(text, str) else None)


_watches: list[_Watch] = []


def look() -> None:
    """Something else begins: whoever notes equations looks again."""
    if _watches:
        _watches[-1].start()


@contextmanager
def noting() -> Iterator[set[str]]:
    """The equations of the functions of `reference` that run inside, filled in at the end."""
    found: set[str] = set()
    watch = _Watch()
    _watches.append(watch)
    watch.start()
    try:
        yield found
    finally:
        _watches.pop()
        watch.end()
        found.update(watch.equations())
