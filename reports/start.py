"""The command from its first line on: interrupted while it is still being imported, it says so."""

import gc
import sys

from . import ending

SELDOM = 50_000
"""New objects, until Python looks for rubbish: of what is imported none is, and to look a hundred
times is a tenth of a start."""


def main() -> None:
    """The entry point: what is imported before it is no more than it needs itself."""
    ending.listen()
    gc.set_threshold(SELDOM)
    try:
        from .cli import main as command

        command()
    except KeyboardInterrupt:
        ending.deaf()
        sys.stderr.write("\ninterrupted: nothing was written\n")
        sys.exit(ending.INTERRUPTED)
