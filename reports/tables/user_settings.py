"""A file of engine → options: the user's own settings."""

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from ... import engines
from ...cases.language.check.work import GO_ON
from ...cases.language.document import Document, read
from ...cases.mistake import CaseError, Mistake, Source, nearest
from ...engines.engine import Engine

SWEEPS = 10_000  # what a chain of 200 pins needs in pymunk; as shipped engines take 10 and 100
SHORTEST = 1e-30  # s: a duration over it is a double
SUFFIXES = (".yaml", ".yml")


def read_settings(file: Path, offered: Sequence[str], *, long: bool = False) -> dict[str, Engine]:
    """A file of engine → options as engines with a setting of its name. Raises CaseError."""
    if not file.exists() and file.suffix not in SUFFIXES:
        files = [str(f) for f in map(file.with_suffix, SUFFIXES) if f.is_file()]
        hint = nearest(str(file), [*offered, *files])
        raise CaseError([Mistake("--settings", 0, 0, str(file), f"no such setting{hint}")])
    return made(read(file), file.stem, long=long)


def made(document: Document, setting: str, *, long: bool = False) -> dict[str, Engine]:
    """Engines with the options of a document, by name. Raises CaseError."""
    mistakes, made_engines = list(document.mistakes), {}
    for name, options in document.data.items():
        if name not in engines.names():
            what = f"no such engine{nearest(name, engines.names())}"
            mistakes.append(document.source.mistake((name,), what))
        elif not isinstance(options, Mapping):
            what = "should be a map of the engine's options, for instance {step: 1.0e-3}"
            mistakes.append(document.source.mistake((name,), what))
        elif endless := [*_endless(document.source, name, options, long=long)]:
            mistakes += endless
        else:
            mistakes += _options(document.source, (name, setting), options, made_engines)
    if mistakes:
        raise CaseError(mistakes)
    return made_engines


def _endless(
    source: Source, name: str, options: Mapping[str, Any], *, long: bool
) -> Iterator[Mistake]:
    """Yields a mistake for sweeps that take hours (`…iterations`), and for a step near zero.

    How many steps there are is counted for each case.
    """
    numbers = {k: v for k, v in options.items() if isinstance(v, int | float)}
    for key, value in numbers.items():
        if key.endswith("iterations") and value > SWEEPS and not long:
            what = f"{value:g} iterations in each step, and the limit is {SWEEPS}: {GO_ON}"
            yield source.mistake((name, key), what)
        elif key == "step" and 0 < value < SHORTEST:
            yield source.mistake((name, key), f"must be at least {SHORTEST:g} s, is {value:g}")


def _words(options: Any) -> Iterator[str]:
    if isinstance(options, Mapping):
        for word, value in options.items():
            yield str(word)
            yield from _words(value)


def _options(
    source: Source, key: tuple[str, str], options: Mapping[str, Any], chosen: dict[str, Engine]
) -> list[Mistake]:
    name, setting = key
    if hidden := [word for word in _words(options) if len(word.splitlines()) > 1]:
        what = "unknown option: a name is one line"  # and so is a mistake, as an engine tells it
        return [source.mistake((name, word), what) for word in hidden]
    try:
        chosen[name] = engines.make(name, setting, options)
    except engines.Broken as broken:
        return [source.mistake((name,), str(broken))]
    except ValueError as error:
        return [
            source.mistake(tuple(place.split(".")), what)
            for place, _, what in (line.partition(": ") for line in str(error).splitlines())
        ]
    return []
