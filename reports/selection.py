"""From the words of a command line to cases and engines."""

from collections.abc import Mapping, Sequence
from dataclasses import fields
from pathlib import Path
from typing import Any, cast

from .. import engines
from ..cases.case import Case
from ..cases.find import find, shipped
from ..cases.language.read.document import read
from ..cases.load import load
from ..cases.mistake import CaseError, Mistake, nearest
from ..engines.engine import Engine
from ..reference.systems import SYSTEMS

BOOK = "book"
HANDWRITTEN = {
    name: tuple(f.name for f in fields(cast(Any, system))) for name, system in SYSTEMS.items()
}


def choose_cases(words: Sequence[str]) -> list[Case]:
    """The cases of the words: names, `name.variant`, or paths; all shipped ones for none.

    Raises CaseError with the mistakes of all files.
    """
    cases: dict[str, Case] = {}
    mistakes: list[Mistake] = []
    for word in words or shipped():
        try:
            for case in _cases(word):
                other = Path(cases.setdefault(case.name, case).source.file)
                if other.resolve() != Path(case.source.file).resolve():
                    what = f"{other} already has the name {case.name!r}: rename one of the files"
                    mistakes.append(Mistake(case.source.file, 0, 0, "", what))
        except CaseError as error:
            mistakes += error.mistakes
    if mistakes:
        raise CaseError(mistakes)
    return list(cases.values())


def _cases(word: str) -> list[Case]:
    stem, _, variant = word.partition(".")
    if stem not in shipped() or not variant or Path(word).exists():
        return load(find([word])[0], systems=HANDWRITTEN)
    cases = load(shipped()[stem], systems=HANDWRITTEN)
    chosen = [case for case in cases if case.name == word]
    if not chosen:
        names = [case.name for case in cases]
        raise CaseError([Mistake(word, 0, 0, "", f"no such variant{nearest(word, names)}")])
    return chosen


def choose_engines(names: Sequence[str], settings: Sequence[str]) -> list[Engine]:
    """Engines × settings, in the order of the one list; none means all.

    A name may carry its setting (`mujoco.tuned`). A setting that is not `shipped` or `tuned` is a
    file of the user's own options, a further column. Raises CaseError.
    """
    files = [Path(word) for word in settings if word not in engines.SETTINGS]
    named = [word for word in settings if word in engines.SETTINGS] or list(engines.SETTINGS)
    for word in names:
        _known(word)
    wanted = [
        (name, setting)
        for name in engines.NAMES
        for setting in named
        if not names or name in names or f"{name}.{setting}" in names
    ]
    found = [engines.engine(name, setting) for name, setting in wanted]
    for file in files:
        own = read_settings(file)
        found += [e for name, e in own.items() if not names or name in names]
    if not found and not choose_book(names, settings):
        what = f"with --settings {', '.join(settings)} no engine is left"
        raise CaseError([Mistake("--engine", 0, 0, ", ".join(names), what)])
    return found


def choose_book(names: Sequence[str], settings: Sequence[str]) -> bool:
    """Whether the book's approximations are wanted: by name, or where nothing is named."""
    return BOOK in names or not (names or settings)


def _known(word: str) -> None:
    known = [BOOK, *engines.NAMES, *(f"{n}.{s}" for n in engines.NAMES for s in engines.SETTINGS)]
    if word not in known:
        raise CaseError([Mistake("--engine", 0, 0, word, f"no such engine{nearest(word, known)}")])


def read_settings(file: Path) -> dict[str, Engine]:
    """A file of engine → options as engines with the setting `own`. Raises CaseError."""
    if not file.exists() and file.suffix not in (".yaml", ".yml"):
        hint = nearest(str(file), engines.SETTINGS) or "; shipped, tuned, or a YAML file"
        raise CaseError([Mistake("--settings", 0, 0, str(file), f"no such setting{hint}")])
    document = read(file)
    mistakes, found = list(document.mistakes), {}
    for name, options in document.data.items():
        if name not in engines.NAMES:
            what = f"no such engine{nearest(name, engines.NAMES)}"
            mistakes.append(document.source.mistake((name,), what))
        elif not isinstance(options, Mapping):
            what = "should be a map of the engine's options, for instance {step: 1.0e-3}"
            mistakes.append(document.source.mistake((name,), what))
        else:
            mistakes += _options(document.source, name, options, found)
    if mistakes:
        raise CaseError(mistakes)
    return found


def _options(
    source: Any, name: str, options: Mapping[str, Any], found: dict[str, Engine]
) -> list[Mistake]:
    try:
        found[name] = engines.engine(name, "own", options)
    except ValueError as error:
        return [
            source.mistake(tuple(place.split(".")), what)
            for place, _, what in (line.partition(": ") for line in str(error).splitlines())
        ]
    return []
