"""Prints text: on any stream, in any encoding, and never a terminal's own commands."""

import os
import sys
import threading
from contextlib import suppress

import click

KEPT = "\n\t\r"
_STREAM = threading.RLock()  # a thread draws what is being done
_DRAWN: list[int] = []  # the width of the line that the next one replaces


def prepare() -> None:
    """Streams that a caller closed lead nowhere; letters that one lacks are spelled out."""
    while (free := os.open(os.devnull, os.O_RDWR)) <= 2:  # or a file of ours becomes the stream
        pass
    os.close(free)
    for stream in (sys.stdout, sys.stderr):
        if stream is not None:
            stream.reconfigure(errors="backslashreplace")  # type: ignore[union-attr]


def say(text: str = "", *, nl: bool = True) -> None:
    """To the output. Raises OSError if it takes nothing more, but not if nobody reads on."""
    try:
        with _STREAM:
            _clear()
            click.echo(shown(text), nl=nl)
    except BrokenPipeError:
        _silence()
    except OSError:
        _silence()
        raise


def tell(text: str = "", *, nl: bool = True) -> None:
    """To the error stream; one that is gone is no reason to end."""
    with suppress(OSError), _STREAM:
        _clear()
        click.echo(shown(text), nl=nl, err=True)


def draw(line: str) -> None:
    """To the terminal of the error stream: a line in the place of the one drawn before."""
    with suppress(OSError), _STREAM:
        click.echo(f"\r{shown(line)}", nl=False, err=True)
        _DRAWN[:] = [len(line)]


def _clear() -> None:
    """Erases the line that was drawn last, so that it stands in nobody's way."""
    if _DRAWN:
        click.echo(f"\r{' ' * _DRAWN.pop()}\r", nl=False, err=True)


def shown(text: str) -> str:
    """The text with its control characters spelled out."""
    if text.isprintable():
        return text
    return "".join(c if c.isprintable() or c in KEPT else repr(c)[1:-1] for c in text)


def _silence() -> None:
    """The interpreter flushes at its end, and must not fail again."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
