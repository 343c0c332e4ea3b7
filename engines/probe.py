"""Somebody else's engine is tried in a process of its own before it is let into this one."""

import multiprocessing
import os
import pickle
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from importlib.metadata import EntryPoint
from math import isfinite
from multiprocessing.connection import Connection
from typing import Any

from ..cases.fields.text import no_formula
from .quiet import quiet, silence

GLANCE = 0.2  # s
SECONDS = 60.0  # of an import: the slowest package that anybody uses takes ten
LETTERS = 100  # of a version


def why_not(point: EntryPoint, settings: tuple[str, ...]) -> str:
    """Why it cannot be imported and made in the settings that it has of these; empty: it can."""
    if multiprocessing.parent_process() is not None:  # a worker, and who started it has tried
        return ""
    return apart(_tried, point, settings, most=SECONDS)[1]


def apart(
    call: Callable[..., Any],
    *given: Any,
    most: float,
    ended: Callable[[], bool] = lambda: False,
) -> tuple[Any, str]:
    """The call's value, from a process of its own that may take `most` s; or why there is none.

    Whatever it does meanwhile is done to another process, which ends with all that it has started.
    ended: is asked now and then whether nobody waits for the value any more.
    """
    here, there = multiprocessing.Pipe(duplex=False)
    process = multiprocessing.Process(target=_answer, args=(there, call, given), daemon=True)
    with _CHILDREN:
        process.start()  # looks at all others too
    there.close()
    try:
        until = time.monotonic() + most
        # What it forked may hold its end of the pipe: it is looked at now and then.
        while not here.poll(max(0.0, min(GLANCE, until - time.monotonic()))):
            if ended():
                return None, "the run was ended"
            if not _is_alive(process):
                break
            if time.monotonic() >= until:
                return None, f"it takes longer than {most:g} s"
        if here.poll():
            value, why = here.recv()
            return value, str(why)
    except EOFError:
        pass
    except Exception as error:  # an answer that cannot be read
        return None, error_text(error)
    finally:
        _end(process)
    return None, f"its process ended ({_how(process.exitcode)})"


_CHILDREN = threading.Lock()
"""One thread looks at them at a time: the system tells each end only once."""


def _is_alive(process: multiprocessing.Process) -> bool:
    with _CHILDREN:
        return process.is_alive()


def _end(process: multiprocessing.Process) -> None:
    """Ends it, whatever it does, with what it has started and left behind."""
    with _CHILDREN:
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


def end_with_parent() -> None:
    """From now on this process, with its group, ends soon after the one that started it."""

    def watch() -> None:
        parent = multiprocessing.parent_process()
        assert parent is not None
        parent.join()
        end_group(os.getpid())
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def unsound(engine: Any, name: str, setting: str) -> str:
    """The first fault in the engine's description, in words; an empty text if there is none."""
    for word, wanted in (("name", name), ("setting", setting)):
        if (given := getattr(engine, word)) != wanted or not isinstance(given, str):
            return f"its {word} should be {wanted!r}, is {_short(given)}"
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
    handlers = {number: signal.getsignal(number) for number in numbers if number is not None}
    return {number: handler for number, handler in handlers.items() if handler is not None}


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
    own = os.getpid()
    try:
        answer = call(*given), ""
    except BaseException as error:
        answer = None, error_text(error)
    if os.getpid() != own:  # the engine forked, and came back in both: one answer is enough
        os._exit(0)
    try:
        there.send(answer)
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
    if code is None or code >= 0:
        return f"exit code {code}"
    names = {number.value: number.name for number in signal.Signals}
    return names.get(-code, f"signal {-code}")  # those for real time have no names


def _short(value: object, say: Callable[[object], str] = repr) -> str:
    try:
        text = say(value)
    except BaseException as error:
        return f"what raises {type(error).__name__}"
    text = "".join(c if c.isprintable() else ascii(c)[1:-1] for c in text[: 2 * LETTERS])
    return text if len(text) < 2 * LETTERS else f"{text}…"
