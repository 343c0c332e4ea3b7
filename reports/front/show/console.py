"""Prints text and the progress line, so that no stream, encoding or content breaks a command.

Streams may be closed, or lack letters; text may hold control characters that a terminal obeys.
Every print first erases the progress line, which stands in the terminal's last line.
"""

import io
import os
import sys
import threading
from contextlib import suppress
from typing import Any

import click

KEPT = "\n\t\r"  # control characters that may stand in text
_STREAM = threading.RLock()  # a thread of its own draws the progress line meanwhile
_GONE: list[bool] = []  # holds something once the output has failed
_DRAWN: list[int] = []  # the width of the progress line that stands there; empty: none does


def prepare() -> None:
    """Makes both streams safe: one the caller closed leads nowhere, missing letters are escaped."""
    # Descriptors 0 to 2 that are closed are taken first: else the next file that we open would be
    # given one of them, and what is printed would be written into it.
    while (free := os.open(os.devnull, os.O_RDWR)) <= 2:
        pass
    os.close(free)
    if sys.stdout is not None:
        sys.stdout = _whole(sys.stdout)
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            stream.reconfigure(errors="backslashreplace")  # type: ignore[union-attr]


def _whole(stream: Any) -> Any:
    """The output so that it takes all of a text or fails; as PYTHONUNBUFFERED has it, it may not.

    What a full disk or a pipe has no room for is dropped there without a word.
    """
    if not isinstance(getattr(stream, "buffer", None), io.RawIOBase):
        return stream
    encoding = stream.encoding
    return io.TextIOWrapper(io.BufferedWriter(stream.detach()), encoding, line_buffering=True)


def say(text: str = "", *, nl: bool = True) -> None:
    """Prints to the output. Raises OSError if it takes no more, but not if its reader has gone."""
    try:
        with _STREAM:
            with suppress(OSError):  # of the error stream, which may be gone though this one is not
                _clear()
            click.echo(shown(text), nl=nl)
    except BrokenPipeError:
        _silence()
    except OSError:
        _silence()
        raise


def tell(text: str = "", *, nl: bool = True) -> None:
    """Prints to the error stream; one that is gone is no reason to end."""
    with suppress(OSError), _STREAM:
        _clear()
        click.echo(shown(text), nl=nl, err=True)


def draw(line: str) -> None:
    """Draws the progress line on the error stream's terminal, over the one drawn before.

    It must be at least as wide as that, for nothing is erased first.
    """
    with suppress(OSError), _STREAM:
        click.echo(f"\r{shown(line)}", nl=False, err=True)
        _DRAWN[:] = [len(line)]


def _clear() -> None:
    """Erases the progress line, if one stands there."""
    if _DRAWN:
        click.echo(f"\r{' ' * _DRAWN.pop()}\r", nl=False, err=True)


def shown(text: str) -> str:
    """Returns the text with its control characters spelled out, as \\x1b, but for those of KEPT."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() or c in KEPT else repr(c)[1:-1] for c in text)


def gone() -> bool:
    """Whether the output has failed, so that nobody reads what is said."""
    return bool(_GONE)


def _silence() -> None:
    """Lets the output lead nowhere: the interpreter flushes it at its end, and must not fail."""
    _GONE[:] = [True]
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
