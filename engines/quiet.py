"""Redirects what engines print to the error stream: the output is a document, or a table."""

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager, redirect_stdout, suppress

OUTPUT, ERRORS = 1, 2


@contextmanager
def quiet() -> Iterator[None]:
    """Within the block neither Python nor a library of C writes to the output."""
    _flush()
    try:
        kept = os.dup(OUTPUT)
    except OSError:  # it is closed
        kept = None
    try:
        _redirect()
        with redirect_stdout(sys.stderr):
            yield
    finally:
        _flush()
        if kept is not None:
            os.dup2(kept, OUTPUT)
            os.close(kept)


def silence() -> None:
    """From now on, in a process that has no output of its own."""
    _redirect()
    sys.stdout = sys.stderr


def _redirect() -> None:
    with suppress(OSError):
        os.dup2(ERRORS, OUTPUT)


def _flush() -> None:
    for stream in (sys.stdout, sys.stderr):
        with suppress(Exception):
            stream.flush()
