"""The command, in this process or in one of its own, and a case of a user's for it."""

import math
import os
import subprocess
import sys
from contextlib import redirect_stderr, redirect_stdout
from io import BytesIO, TextIOWrapper
from pathlib import Path

import pytest

from textmech.reports.front import cli
from textmech.reports.front.command import done
from textmech.reports.front.show import progress
from textmech.reports.runs.processes import termination as ending

NEW = """\
title: A bar that hangs on a cart
scene:
  points: {O: [0, 0]}
  bodies:
    cart: {block: {mass: 2.0, width: 0.3, height: 0.1}}
    rod: {bar: {mass: 0.5, length: 0.6}}
  joints:
    rail: {slide: [ground.O, cart.center], along: [1, 0]}
    hinge: {pin: [cart.center, rod.start]}
initial: {cart: {x: 0}, rod: {angle: -40 deg}}
duration: 0.4
samples: 6
step: {mujoco: 1.0e-3, pymunk: 1.0e-3}
allow: {cart.x: 1.0e-2, rod.angle: 1.0e-2}
"""


def textmech(*words: object, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    """All that the command does, but for its signals; what it does not catch is raised."""
    out, err = (TextIOWrapper(BytesIO(), encoding="utf-8", write_through=True) for _ in range(2))
    with pytest.MonkeyPatch.context() as patch, redirect_stdout(out), redirect_stderr(err):
        patch.setattr(sys, "argv", line := ["textmech", *map(_argument, words)])
        patch.setattr(ending, "listen", lambda: None)
        patch.setattr(ending, "ignore_signals", lambda: None)
        patch.setattr(ending, "end", sys.exit)
        patch.setattr(done, "DONE", [])
        patch.setattr(progress, "FIRST", math.inf)  # no line more where a machine is slow
        if folder:
            patch.chdir(folder)
        with pytest.raises(SystemExit) as ended:
            cli.main()
    said = [stream.buffer.getvalue().decode() for stream in (out, err)]
    return subprocess.CompletedProcess(line, int(ended.value.code or 0), *said)


def _argument(word: object) -> str:
    return os.fsdecode(word) if isinstance(word, bytes) else str(word)


def process(*words: object, folder: Path | None = None) -> subprocess.CompletedProcess[str]:
    """The command as a user's shell starts it."""
    return subprocess.run(
        [sys.executable, "-m", "textmech.reports.front.cli", *map(str, words)],
        capture_output=True,
        text=True,
        cwd=folder,
        timeout=120,
        check=False,
    )
