"""Somebody else's engine is tried in a process of its own before it is let into this one."""

import multiprocessing
import os
import pickle
import signal
import sys
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from importlib.metadata import EntryPoint
from math import isfinite
from multiprocessing.connection import Connection
from typing import Any

from ..cases.fields.text import no_formula
from .quiet import quiet, silence

SECONDS = 60.0  # of an import: the slowest package that anybody uses takes ten
LETTERS = 100  # of a version


def why_not(point: EntryPoint, settings: tuple[str, ...]) -> str:
    """Why it cannot be imported and made in the settings that it has of these; empty: it can."""
    if multiprocessing.current_process().daemon:  # a worker, and whoever started it has tried
        return ""
    return apart(_tried, point, settings, most=SECONDS)[1]


def apart(call: Callable[..., Any], *given: Any, most: float) -> tuple[Any, str]:
    """The call's value, from a process of its own that may take `most` s; or why there is none.

    Whatever it does meanwhile is done to another process.
    """
    here, there = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.Process(target=_answer, args=(there, call, given), daemon=True)
    process.start()
    there.close()
    try:
        if not here.poll(most):
            return None, f"it takes longer than {most:g} s"
        value, why = here.recv()
        return value, str(why)
    except EOFError:
        process.join()
        return None, f"its process ended ({_how(process.exitcode)})"
    finally:
        if process.pid is not None:
            end_group(process.pid)
        process.kill()
        process.join()


def lead_group() -> None:
    """Begins a group of processes: what an engine starts in this one ends with it."""
    if hasattr(os, "setpgid"):
        os.setpgid(0, 0)


def end_group(leader: int) -> None:
    """Ends a process that leads a group, with all that it has started and left behind."""
    with suppress(OSError):  # it leads none yet, or all of it is gone
        if hasattr(os, "killpg"):
            os.killpg(leader, signal.SIGKILL)


def unsound(engine: Any, name: str, setting: str) -> str:
    """The first fault in the engine's description, in words; an empty text if there is none."""
    for word, wanted in (("name", name), ("setting", setting)):
        if (found := getattr(engine, word)) != wanted or not isinstance(found, str):
            return f"its {word} should be {wanted!r}, is {_short(found)}"
    version, step = engine.version, engine.own_step
    if not (
        isinstance(version, str) and version.isprintable() and 0 < len(version.strip()) <= LETTERS
    ):
        return f"its version should be a short text, is {_short(version)}"
    if formula := no_formula(version):
        return f"its version {formula}"
    if step is None:
        return ""
    number = isinstance(step, float | int) and not isinstance(step, bool)
    if not (number and isfinite(step) and step > 0):
        return f"its own_step should be a time in s or None, is {_short(step)}"
    return ""


def error_text(error: BaseException | None) -> str:
    """The error's type and its message, in a short line."""
    return f"{type(error).__name__}: {_short(error, str)}"


def guarded(call: Callable[[], Any]) -> tuple[Any, BaseException | None]:
    """The call's result, or the error that it raises but an interruption; nothing is printed."""
    try:
        with quiet():
            return call(), None
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # SystemExit, and what a panic of Rust is
        if _interrupted(error):
            raise KeyboardInterrupt from error
        return None, error


@contextmanager
def restored() -> Iterator[None]:
    """Undo what an import changes of the working folder, the recursion limit and signals."""
    folder, depth, handlers = _folder(), sys.getrecursionlimit(), _handlers()
    try:
        yield
    finally:
        if folder is not None:
            os.chdir(folder)
        sys.setrecursionlimit(depth)
        for number, handler in handlers.items():
            signal.signal(number, handler)


def _folder() -> str | None:
    """The working folder; None where it is gone."""
    try:
        return os.getcwd()
    except OSError:
        return None


def _handlers() -> dict[int, Any]:
    """By signal, what Python does then; nothing in a thread, which may not set it."""
    if threading.current_thread() is not threading.main_thread():
        return {}
    numbers = [getattr(signal, name, None) for name in ("SIGINT", "SIGTERM", "SIGHUP")]
    found = {number: signal.getsignal(number) for number in numbers if number is not None}
    return {number: handler for number, handler in found.items() if handler is not None}


def _interrupted(error: BaseException | None) -> bool:
    """Whether an interruption is behind it: an extension that is being imported hides it."""
    seen = set[int]()  # one may be its own cause
    while error is not None and id(error) not in seen:
        if isinstance(error, KeyboardInterrupt):
            return True
        seen.add(id(error))
        error = error.__cause__ or error.__context__
    return False


def _answer(there: Connection, call: Callable[..., Any], given: tuple[Any, ...]) -> None:
    lead_group()
    silence()
    try:
        there.send((call(*given), ""))
    except BaseException as error:
        there.send((None, error_text(error)))


def _tried(point: EntryPoint, settings: tuple[str, ...]) -> None:
    """Make the engine with each setting."""
    maker: Any = point.load()
    offers = getattr(maker, "offers", ())
    for setting in settings if isinstance(offers, tuple) else ():  # else its own words say so
        if setting in offers:
            engine = maker(setting, {})
            pickle.loads(pickle.dumps(engine))
            unsound(engine, point.name, setting)


def _how(code: int | None) -> str:
    return signal.Signals(-code).name if code is not None and code < 0 else f"exit code {code}"


def _short(value: object, say: Callable[[object], str] = repr) -> str:
    try:
        said = say(value)
    except BaseException as error:
        return f"what raises {type(error).__name__}"
    said = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in said[: 2 * LETTERS])
    return said if len(said) < 2 * LETTERS else f"{said}…"
