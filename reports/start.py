"""The command from its first line on: interrupted while it is still being imported, it says so."""

import sys

from . import ending


def main() -> None:
    """The entry point: what is imported before it is no more than it needs itself."""
    ending.listen()
    try:
        from .cli import main as command

        command()
    except KeyboardInterrupt:
        ending.deaf()
        sys.stderr.write("\ninterrupted: nothing was written\n")
        sys.exit(ending.INTERRUPTED)
