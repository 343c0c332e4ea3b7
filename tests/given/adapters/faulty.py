"""An engine that does one thing wrong, and is else the motion of a free body itself."""

import ctypes
import os
import signal
import sys
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, ClassVar

import numpy as np

from textmech.cases.scene import Scene
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Diverged, Plan, Refusal, Start


class Panic(BaseException):
    """As Rust's panics arrive in Python."""


class Mute(Exception):
    """One that cannot be said."""

    def __str__(self) -> str:
        raise RuntimeError("no words")


class Closed(Exception):
    """One that is pickled and cannot be read back."""

    def __init__(self, one: str, two: str) -> None:
        super().__init__(one)


def fails(error: BaseException) -> Callable[[], Any]:
    def fail() -> None:
        raise error

    return fail


def hangs() -> None:
    time.sleep(3600)


def spins() -> None:
    while True:
        pass


def eats() -> None:
    """Until somebody says no, and here not for ever."""
    taken: list[bytearray] = []
    while len(taken) < 40:
        taken.append(bytearray(2**27))
    raise AssertionError("5 GiB, and nobody said no")


def dies(number: int) -> Callable[[], Any]:
    return lambda: os.kill(os.getpid(), number)


def prints() -> None:
    print("a banner")
    sys.stdout.write("and more\n")
    os.write(1, b"and from C\n")
    ctypes.CDLL(None).puts(b"and from its library")


ACTS: dict[str, Callable[[], Any]] = {
    "raises": fails(ValueError("no")),
    "panics": fails(Panic("called `Option::unwrap()` on a `None` value")),
    "panics for ever": fails(KeyboardInterrupt("no")),
    "is out of memory": fails(MemoryError()),
    "eats": eats,
    "recurses": fails(RecursionError("maximum recursion depth exceeded")),
    "ends": fails(SystemExit(0)),
    "ends otherwise": fails(SystemExit("bye")),
    "leaves": lambda: os._exit(0),
    "leaves otherwise": lambda: os._exit(3),
    "aborts": dies(signal.SIGABRT),
    "is killed": dies(signal.SIGKILL),
    "crashes": dies(signal.SIGSEGV),
    "hangs": hangs,
    "spins": spins,
    "says nothing that can be said": fails(Mute()),
    "says what cannot be read": fails(Closed("one", "two")),
    "says half a letter": fails(ValueError("half \ud800 a letter")),
    "says nothing and more": fails(ValueError("zero \0 and \x1b[31m red \r\n lines")),
    "says a megabyte": fails(ValueError("x" * 1_000_000)),
    "stops iterating": fails(StopIteration("no")),
    "stops generating": fails(GeneratorExit("no")),
}
"""What it may do in any of its verbs."""


def rows(found: Trajectory, shaped: Callable[[Array], Any]) -> Trajectory:
    return replace(found, states={name: shaped(row) for name, row in found.states.items()})


ANSWERS: dict[str, Callable[[Trajectory], Any]] = {
    "nothing": lambda found: None,
    "states alone": lambda found: found.states,
    "13 columns": lambda found: rows(found, lambda row: np.zeros((len(row), 13))),
    "no columns": lambda found: rows(found, lambda row: row[:, 0]),
    "lists": lambda found: rows(found, lambda row: row.tolist()),
    "text": lambda found: rows(found, lambda row: row.astype(str)),
    "objects": lambda found: rows(found, lambda row: row.astype(object)),
    "masked numbers": lambda found: rows(found, lambda row: np.ma.array(row, mask=row > 0.5)),
    "complex numbers": lambda found: rows(found, lambda row: row.astype(complex)),
    "a sample less": lambda found: rows(found, lambda row: row[1:]),
    "other times": lambda found: replace(found, times=found.times * 1.001),
    "fewer times": lambda found: replace(found, times=found.times[1:]),
    "nobody": lambda found: replace(found, states={}),
    "another body": lambda found: replace(found, states={"cube": found.states["ball"]}),
    "NaN": lambda found: rows(found, lambda row: row * np.nan),
    "infinity": lambda found: rows(found, lambda row: row + np.inf),
    "a record of nobody": lambda found: replace(found, record=replace(found, states={})),
    "a record that is none": lambda found: replace(found, record=found.states),
    "short reactions": lambda found: replace(found, reactions={"pin.fx": np.zeros(2)}),
}
"""What it may give for a motion."""

NATIVE = Plan("native", (1, 2))
PLANS: dict[str, Any] = {
    "nothing": None,
    "no ways": [],
    "a way": NATIVE,
    "words": "native",
    "a word": ["native"],
    "a number": 3,
    "two ways that are one": [NATIVE, NATIVE],
    "a way and its refusal": [NATIVE, Refusal("native", "engine: no")],
    "a path": [replace(NATIVE, realised="../x")],  # type: ignore[arg-type]
    "no word": [replace(NATIVE, realised=None)],  # type: ignore[arg-type]
    "exponents in words": [replace(NATIVE, held=("one",))],  # type: ignore[arg-type]
    "withheld in words": [replace(NATIVE, withheld="all")],  # type: ignore[arg-type]
}
"""What it may plan."""

AUDITS: dict[str, Any] = {
    "nothing": None,
    "no number": {},
    "words": {"ball.mass": "two"},
    "complex numbers": {"ball.mass": 2 + 0j},
    "NaN": {"ball.mass": float("nan")},
    "another mass": {"ball.mass": 3.0},
    "of nobody": {"cube.mass": 2.0},
    "numbers of numbers": {3: 2.0},
    "a list": [2.0],
}
"""What it may read back."""


@dataclass(frozen=True)
class Faulty:
    """verb: of the protocol in which it acts; act, answer, planned, read: see above."""

    verb: str = ""
    act: str = ""
    answer: str = ""
    planned: str = ""
    read: str = ""
    setting: str = "tuned"
    options: Mapping[str, Any] = field(default_factory=dict)
    name: str = "faulty"
    version: str = "1.0"
    own_step: float | None = None
    offers: ClassVar[tuple[str, ...]] = ("tuned",)

    def _acts(self, verb: str) -> None:
        if self.verb == verb:
            ACTS[self.act]() if self.act != "prints" else prints()

    def plans(self, scene: Scene, start: Start) -> Any:
        self._acts("plans")
        return PLANS[self.planned] if self.planned else [NATIVE]

    def measure(self, scene: Scene, start: Start) -> Any:
        self._acts("measure")
        return AUDITS[self.read] if self.read else {"ball.mass": 2.0}

    def run(self, scene: Scene, start: Start, times: Array, *_: Any, **__: Any) -> Any:
        self._acts("run")
        if self.act == "diverges at length":
            raise Diverged("y" * 1_000_000 + "\ud800")
        ball = np.zeros((len(times), 6))
        ball[:, 0], ball[:, 3] = times, 1.0
        found = Trajectory(times, {"ball": ball}, {})
        return ANSWERS[self.answer](found) if self.answer else found

    def script(self, *_: Any, **__: Any) -> str:
        self._acts("script")
        return "pass\n"
