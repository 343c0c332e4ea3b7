"""The command with an engine that never ends, run in a process of its own to be struck.

`python -m given.command.endless <folder> <words of the command>`; the folder gets a file for each
process that is at work, named by its number.
"""

import os
import signal
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from textmech.cases.scene import Scene
from textmech.cases.trajectory import Trajectory
from textmech.engines.engine import Plan, Start
from textmech.reports.front import cli
from textmech.reports.runs import selection
from textmech.reports.runs.processes import termination as ending

CASE = """\
title: A free body that moves at constant velocity
scene:
  gravity: none
  bodies: {ball: {particle: {mass: 2.0}}}
initial: {ball: {x: 0, y: 0, vx: 1, vy: 0}}
duration: 1.0
samples: 26
allow: {ball.x: 1.0e-2}
"""


@dataclass(frozen=True)
class Endless:
    """An engine whose first step takes for ever."""

    folder: Path
    setting: str = "tuned"
    name: str = "mujoco"
    version: str = "0"
    own_step: float | None = None

    def plans(self, scene: Scene, start: Start) -> list[Plan]:
        return [Plan("native", (1,))]

    def measure(self, scene: Scene, start: Start) -> dict[str, float]:
        return {}

    def run(self, *_: Any, **__: Any) -> Trajectory:
        (self.folder / str(os.getpid())).touch()
        while True:
            pass

    def script(self, *_: Any, **__: Any) -> str:
        return ""


def main() -> None:
    """The command, which finds this engine and no other."""
    for number in ending.known_signals():  # of tests that run in the background some are ignored
        signal.signal(number, signal.SIG_DFL)
    engine = Endless(Path(sys.argv.pop(1)))
    selection.choose_engines = lambda *_, **__: [engine]
    cli.main()


if __name__ == "__main__":
    main()
