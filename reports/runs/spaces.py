"""A pymunk Space of the user's own as a case: from Python, or by the function that makes it."""

import os
import re
import sys
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, redirect_stdout
from dataclasses import replace
from functools import partial
from importlib import import_module
from pathlib import Path
from traceback import extract_tb
from typing import Any

import numpy as np

from ...cases.case import Case
from ...cases.language.check.engines import Engines
from ...cases.language.document import Document
from ...cases.load import load_document
from ...cases.mistake import CaseError, Mistake, Source
from ...engines.own_space import is_space
from ...engines.probe import error_text
from ...reference.assumptions import OPEN, stays
from ...reference.solve import motion_of
from ...reference.start.assembly import size_of

LOOKS = 1001  # times of the motion at which it is looked at whether anything else meets


def space_of(word: str) -> Any:
    """Returns what the user's function makes, which is run as `python -c` in this folder would.

    What it prints goes to the error stream. Raises CaseError, whatever it raises.
    """
    module, _, function = word.partition(":")
    if not all(part.isidentifier() for part in (*module.split("."), function)):
        raise _refused(word, "is no file; a function is named as mygame:make_space")
    with _from_here(), redirect_stdout(sys.stderr):
        imported = _run(word, f"importing {module}", lambda: import_module(module))
        make = _run(word, function, lambda: getattr(imported, function, None))
        if make is None:
            there = getattr(imported, "__file__", None) or "part of Python"
            raise _refused(word, f"{module} ({there}) has no function {function!r}")
        made = _run(word, f"{function}()", make)
    if not is_space(made):
        kind = type(made).__name__
        raise _refused(word, f"{function}() should return a pymunk.Space, and not {kind}")
    return made


@contextmanager
def _from_here() -> Iterator[None]:
    here = os.getcwd()
    sys.path.insert(0, here)
    try:
        yield
    finally:
        if here in sys.path:
            sys.path.remove(here)


def _run(word: str, what: str, call: Callable[[], Any]) -> Any:
    """Returns what code of the user's returns; what it raises is told with its place."""
    try:
        return call()
    except (Exception, SystemExit) as error:
        frames = extract_tb(error.__traceback__)
        ours = (__file__, import_module.__code__.co_filename)
        own = [f for f in frames if f.filename not in ours and not f.filename.startswith("<")]
        at = f" ({own[-1].filename}:{own[-1].lineno})" if own else ""
        raise _refused(word, f"{what} raises {error_text(error)}{at}") from None


def _refused(word: str, what: str) -> CaseError:
    return CaseError([Mistake(word, 0, 0, "", what)])


def space_case(
    space: Any,
    file: str,
    name: str,
    *,
    known: Engines | None = None,
    long: bool = False,
) -> Case:
    """Returns the case of a Space; file, name: how messages and tables call it.

    Its motion is computed once to see what meets. Raises CaseError with what has no word in a case
    file, by its place in the Space.
    """
    from ...engines.own_space.space import Read, read_space

    def loaded(data: Mapping[str, Any]) -> Case:
        document = Document(Source(file, (), {}), dict(data), [])
        (case,) = load_document(document, Path(name), engines=known, long=long)
        return case

    def sound(entries: Read) -> Read:
        if entries.refused:
            raise CaseError([Mistake(file, 0, 0, place, what) for place, what in entries.refused])
        return entries

    entries = sound(read_space(space))
    try:
        while True:
            case = loaded(entries.data())
            motion = motion_of(case)(np.linspace(0.0, case.duration, LOOKS))
            before, entries = entries, sound(entries.seen(case.scene, motion))
            if entries is before:
                break
        ajar = OPEN * size_of(case)
        return loaded(entries.claims(case.scene, motion, ajar, partial(stays, case, motion)))
    except CaseError as error:
        raise CaseError(
            [replace(each, where=_place(each.where)) for each in error.mistakes]
        ) from None


def _place(where: str) -> str:
    """Returns a place of a case as one in the Space: `space.bodies[3] (initial.body3.x)`."""
    named = re.search(r"\b(body|constraint|shape)(\d+)", where)
    if named is None or where.startswith("space."):
        return where
    kind = {"body": "bodies"}.get(named[1], f"{named[1]}s")
    return f"space.{kind}[{named[2]}] ({where})"
