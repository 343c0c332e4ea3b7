"""The command from its first line on: interrupted while it is still being imported, it says so."""

import gc
import os
import sys

from ..runs.processes import termination as ending

SELDOM = 50_000
"""New objects, until Python looks for rubbish: of what is imported none is, and to look a hundred
times is a tenth of a start."""
WINDOWS = "MUJOCO_GL"
"""What MuJoCo opens windows with, where it is asked to. No command opens any, and what would takes
a third of its import."""


def main() -> None:
    """The entry point: what is imported before it is no more than it needs itself."""
    ending.listen()
    gc.set_threshold(SELDOM)
    os.environ.setdefault(WINDOWS, "off")
    try:
        from .cli import main as command

        command()
    except KeyboardInterrupt:
        sys.stderr.write("\ninterrupted: nothing was written\n")
        ending.end(ending.INTERRUPTED)
