"""What commands cost before their work begins, in processes of their own.

A person waits for it each time, so what is imported at the top of a module that all commands read
is paid for by all of them.
"""

import os
import subprocess
import sys
from collections.abc import Iterator, Sequence

from textmech.cases.find import shipped

from .row import Row

UNIT = "import numpy"  # what nothing here does without: a measure of the machine
COMMAND = "from textmech.reports.front.start import main; main()"
# s, where they were promised; elsewhere the ratio tells. Of check a third and more is the
# reference's own work.
BOUNDS = {"--help": 0.2, "list": 0.5, "show": 0.5, "check": 0.8, "import": 0.5}


def starts(rounds: int) -> Iterator[Row]:
    """Yields a row for each of BOUNDS: the least of the rounds, over that of `import numpy`."""
    unit = least(["-c", UNIT], rounds)
    for name, words in lines().items():
        seconds = least(words, rounds)
        note = f"{seconds / unit:.1f} of {UNIT}"
        yield Row("start", name, seconds=seconds, aim=BOUNDS[name], note=note)


def lines() -> dict[str, list[str]]:
    """Returns for each of BOUNDS the arguments with which Python is started."""
    return {
        "--help": ["-c", COMMAND, "--help"],
        "list": ["-c", COMMAND, "list"],
        "show": ["-c", COMMAND, "show", "four_bar", "--engine", "mujoco.tuned"],
        "check": ["-c", COMMAND, "check", str(shipped()["bar_pendulum"])],
        "import": ["-c", "from textmech.reports import run"],
    }


def least(words: Sequence[str], rounds: int) -> float:
    """Returns CPU seconds of Python with these words, user and system; compiled before."""
    command = [sys.executable, *words]
    env = {k: v for k, v in os.environ.items() if k != "PYTHONDONTWRITEBYTECODE"}
    seconds = []
    for _ in range(rounds + 1):
        before = os.times()
        subprocess.run(command, env=env, capture_output=True, check=True)
        after = os.times()
        user = after.children_user - before.children_user
        seconds.append(user + after.children_system - before.children_system)
    return min(seconds[1:])
