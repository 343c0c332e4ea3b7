"""The work that this process is at, for whoever waits: written by the work, read from a thread.

One task is worked on at a time in a process, so there is one of it.
"""

import time
from dataclasses import dataclass, field


@dataclass
class Now:
    """In words what is being done, since when, and how far it is of how much: of s, or of states.

    task: of what, as `four_bar`. unit: empty for numbers of things. motions: of the task, so far.
    """

    task: str = ""
    what: str = ""
    at: float = 0.0
    begin: float = 0.0
    end: float = 0.0
    unit: str = "s"
    motions: int = 0
    since: float = field(default_factory=time.monotonic)

    def text(self) -> str:
        """The work that is being done in one line, with how long this part of it still takes."""
        span = self.end - self.begin
        if not (self.what and span > 0.0):
            return self.what
        part = min(max((self.at - self.begin) / span, 0.0), 1.0)
        unit = f" {self.unit}" if self.unit else ""
        rest = time_left(time.monotonic() - self.since, part)
        return f"{self.what}, at {self.at:.4g} of {self.end:.4g}{unit}{rest and ', ' + rest}"

    def line(self) -> str:
        """The text, after the name of what the work is done for."""
        return ": ".join(part for part in (self.task, self.text()) if part)


NOW = Now()
SURE = 0.02  # of a part: before that much is done nobody knows how long the rest takes


def begun(task: str) -> None:
    """Notes the name of what all following work is done for."""
    NOW.task, NOW.motions = task, 0
    doing("")


def doing(what: str, begin: float = 0.0, end: float = 0.0, unit: str = "s") -> None:
    """Notes the work that begins, and its range if that is known."""
    NOW.at, NOW.begin, NOW.end, NOW.unit = begin, begin, end, unit
    NOW.since, NOW.what = time.monotonic(), what


def reached(at: float) -> None:
    """Notes how far the work has come."""
    NOW.at = at


def time_left(seconds: float, part: float) -> str:
    """How long the rest takes if it goes on like that, in words; or nothing, if nobody knows."""
    if part < SURE:
        return ""
    rest = seconds * (1.0 - part) / part
    if rest < 1.0:
        return ""
    minutes, whole = divmod(round(rest), 60)
    return f"about {minutes}:{whole:02} left" if minutes else f"about {whole} s left"
