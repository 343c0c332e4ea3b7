"""Measures the CPU time of commands before their work begins, each in own processes, with bounds.

A person waits for it each time, so what is imported at the top of a module that all commands read
is paid for by all of them.
"""

import os
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from textmech.cases.find import shipped

UNIT = "import numpy"  # what nothing here does without: a measure of the machine
COMMAND = "from textmech.reports.start import main; main()"
CASE = "four_bar"
# s, where they were promised; elsewhere the ratio tells. Of check a third and more is the
# reference's own work.
BOUNDS = {"--help": 0.2, "list": 0.5, "show": 0.5, "check": 0.8, "import": 0.5}


@dataclass(frozen=True)
class Begun:
    """seconds: the least of the rounds; over: that of `import numpy` in the same run."""

    name: str
    seconds: float
    bound: float
    over: float


def begun(rounds: int) -> Iterator[Begun]:
    """Each of them, in turn with what they are measured by."""
    unit = least(["-c", UNIT], rounds)
    for name, words in lines().items():
        seconds = least(words, rounds)
        yield Begun(name, seconds, BOUNDS[name], seconds / unit)


def lines() -> dict[str, list[str]]:
    """Returns for each of BOUNDS the arguments with which Python is started."""
    return {
        "--help": ["-c", COMMAND, "--help"],
        "list": ["-c", COMMAND, "list"],
        "show": ["-c", COMMAND, "show", CASE, "--engine", "mujoco.tuned"],
        "check": ["-c", COMMAND, "check", str(shipped()["bar_pendulum"])],
        "import": ["-c", "from textmech.reports import run"],
    }


def least(words: Sequence[str], rounds: int) -> float:
    """CPU seconds of Python with these words, of user and system; modules are compiled before."""
    command = [sys.executable, *words]
    env = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    found = []
    for _ in range(rounds + 1):
        before = os.times()
        subprocess.run(command, env=env, capture_output=True, check=True)
        after = os.times()
        user = after.children_user - before.children_user
        found.append(user + after.children_system - before.children_system)
    return min(found[1:])
