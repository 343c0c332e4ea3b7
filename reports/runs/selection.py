"""From the words of a command line to cases and engines."""

import os
import re
import warnings
from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import fields
from itertools import chain
from pathlib import Path
from typing import Any, get_args
from xml.etree.ElementTree import ParseError, iterparse

from ... import engines
from ...cases.case import Case
from ...cases.find import SUFFIXES, find, shipped
from ...cases.language.check.engines import Engines
from ...cases.language.document import read
from ...cases.load import load
from ...cases.mistake import CaseError, Mistake, nearest
from ...engines.engine import Engine, Realised
from ...reference.integrators.now import doing
from ...reference.systems import SYSTEMS
from ...reference.systems.states.stated import STATED
from ..tables.user_settings import SUFFIXES as OF_SETTINGS
from ..tables.user_settings import read_settings

BOOK = "book"
NAME = re.compile(r"\w[\w-]*", re.ASCII)
ENGINES = engines.Known()


class Parameters(Mapping[str, tuple[str, ...]]):
    """The parameters of every hand-written system by its name, for which it is imported."""

    def __getitem__(self, name: str) -> tuple[str, ...]:
        system: Any = STATED[name] if name in STATED else SYSTEMS[name]
        return tuple(field.name for field in fields(system))

    def __contains__(self, name: object) -> bool:
        return name in SYSTEMS or name in STATED

    def __iter__(self) -> Iterator[str]:
        return chain(SYSTEMS, STATED)

    def __len__(self) -> int:
        return len(SYSTEMS) + len(STATED)


HANDWRITTEN = Parameters()


def choose_cases(
    words: Sequence[str], *, known: Engines | None = ENGINES, long: bool = False
) -> list[Case]:
    """The cases of the words: names, `name.variant`, or paths; all shipped ones for none.

    known: the engines that they may name; None: whatever they name, and nothing is imported.
    long: whether they may ask for any amount of work.

    Raises CaseError with the mistakes of all files.
    """
    cases, mistakes = sound_cases(words, known=known, long=long)
    if mistakes:
        raise CaseError(mistakes)
    return cases


def sound_cases(
    words: Sequence[str], *, known: Engines | None = ENGINES, long: bool = False
) -> tuple[list[Case], list[Mistake]]:
    """Returns the cases of files without mistakes, and all mistakes; else as `choose_cases`."""
    cases: dict[str, Case] = {}
    mistakes: list[Mistake] = []
    for word in words or shipped():
        try:
            nameable(word)
            for case in _cases(word, known, long):
                other = Path(cases.setdefault(case.name, case).source.file)
                if other.resolve() != Path(case.source.file).resolve():
                    what = f"{other} already has the name {case.name!r}: rename one of the files"
                    mistakes.append(Mistake(case.source.file, 0, 0, "", what))
        except CaseError as error:
            mistakes += _another_kind(word) or error.mistakes
        except OSError as error:  # in a folder that may not be read, or of a name too long for any
            mistakes.append(Mistake(word, 0, 0, "", f"cannot be read: {error.strerror}"))
    return sound(list(cases.values()), mistakes), mistakes


def told_apart(cases: Sequence[Case]) -> list[Case]:
    """The cases, each once, in their order; references and rows are found by the name of a case.

    Raises CaseError where two that are not the same have one name.
    """
    known: dict[str, Case] = {}
    twice = [case for case in cases if known.setdefault(case.name, case) is not case]
    if twice:
        what = "another case beside it has the name {!r}: run them apart, or rename one"
        raise CaseError(
            [Mistake(case.source.file, 0, 0, "", what.format(case.name)) for case in twice]
        )
    return list(known.values())


def sound(cases: Sequence[Case], mistakes: Sequence[Mistake]) -> list[Case]:
    """The cases of the files without mistakes."""
    mistaken = {mistake.file for mistake in mistakes}
    return [case for case in cases if case.source.file not in mistaken]


def _another_kind(word: str) -> list[Mistake]:
    """One mistake in place of many, where what should be a case is a file of another kind."""
    file = Path(word)
    if not file.is_file():
        return []
    if root := xml_root(file):
        return [Mistake(word, 0, 0, "", _no_case(root))]
    try:
        keys = set(read(file).data)
    except CaseError:
        return []
    what = f"holds an engine's options, and is no case: say --settings {word}"
    ours = bool(keys) and keys <= set(engines.names())
    return [Mistake(word, 0, 0, "", what)] if ours else []


MODELS = {"mujoco": "an MJCF model", "robot": "a URDF model", "sdf": "an SDF model"}
"""What a file of XML is, by the name of its root element."""


def xml_root(file: Path) -> str:
    """Returns the root element of a file that is XML; an empty text for any other."""
    try:
        return next(iterparse(file, events=("start",)))[1].tag.rpartition("}")[2]
    except (ParseError, StopIteration, OSError, ValueError, LookupError):  # as of its encoding
        return ""


def is_model(file: Path) -> bool:
    """Whether it is a model that MuJoCo compiles: `mujoco` or, of URDF, `robot` is its root."""
    return xml_root(file) in ("mujoco", "robot")


def _no_case(root: str) -> str:
    """Returns why XML with this root is no case, in words."""
    kind = MODELS.get(root, f"XML with the root <{root}>")
    where = "textmech reads cases as YAML, where the scene is in words of its own (cases/README.md)"
    models = "; `check`, `run`, `advise`, `show` and `plot` read a model as it is"
    return f"is {kind}; {where}{models if root in ('mujoco', 'robot') else ''}"


def names_function(word: str) -> bool:
    """Whether it is `module:function`, of a function that makes a Space, and names no file."""
    return ":" in word and not word.endswith(SUFFIXES) and not os.path.lexists(word)


def nameable(word: str) -> None:
    """Checks a file's name, which names its case in tables and on terminals.

    Raises CaseError: a spreadsheet computes what begins with =, +, - or @.
    """
    name = Path(word).stem
    sound = name.isprintable() and (name[:1].isalnum() or name[:1] == "_")
    if Path(word).is_file() and not sound:
        what = (
            "a case's file name should begin with a letter or a digit, and hold nothing unprintable"
        )
        raise CaseError([Mistake(word, 0, 0, "", what)])


def _cases(word: str, known: Engines | None, long: bool) -> list[Case]:
    if names_function(word):
        from .spaces import space_case, space_of  # which look at whole motions

        name = word.rpartition(":")[2]
        return [space_case(space_of(word), word, name, known=known, long=long)]
    stem, _, variant = word.partition(".")
    if stem not in shipped() or not variant or Path(word).exists():
        return load(find([word])[0], systems=HANDWRITTEN, engines=known, long=long)
    cases = load(shipped()[stem], systems=HANDWRITTEN, engines=known, long=long)
    chosen = [case for case in cases if case.name == word]
    if not chosen:
        names = [case.name for case in cases]
        raise CaseError([Mistake(word, 0, 0, "", f"no such variant{nearest(word, names)}")])
    return chosen


def choose_engines(
    names: Sequence[str], settings: Sequence[str], *, long: bool = False, spare: bool = False
) -> list[Engine]:
    """Engines × settings, by name; none means all. A name may carry its setting (`mujoco.tuned`).

    A setting that no engine offers is a file of the user's own options, a further column. long:
    whether these may ask for any number of iterations. spare: whether a file may be of none of the
    named engines. Raises CaseError, also where else none of them has any of a file's options; an
    engine that nobody named and that cannot be imported is a warning.
    """
    for word in names:
        _check_name(word)
    offers = _offers({word.partition(".")[0] for word in names if word != BOOK})
    every = {setting for offered in offers.values() for setting in offered}
    for word in names:
        _offered(word, offers, [Path(word).stem for word in settings if word not in every])
    named = [word for word in settings if word in every] or every
    chosen = [
        engine
        for name, offered in offers.items()
        for setting in offered
        if setting in named and (not names or name in names or f"{name}.{setting}" in names)
        if (engine := _make_engine(name, setting, asked=bool(names))) is not None
    ]
    for file in _files([word for word in settings if word not in every], every):
        own = read_settings(file, sorted(every), long=long)
        used = [
            engine
            for name, engine in own.items()
            if not names or name in names or f"{name}.{file.stem}" in names
        ]
        if not used and not spare:
            of = ", ".join(f"{name}.{file.stem}" for name in own) or "no engine"
            what = f"no chosen engine uses it, which is for {of}"
            raise CaseError([Mistake("--settings", 0, 0, str(file), what)])
        chosen += used
    if not chosen and not choose_book(names, settings):
        what = f"with --settings {', '.join(settings)} no engine is left"
        raise CaseError([Mistake("--engine", 0, 0, ", ".join(names), what)])
    return chosen


def _files(words: Sequence[str], taken: Set[str]) -> list[Path]:
    """Files of own options, by whose names their columns are called. Raises CaseError."""
    files: dict[str, Path] = {}
    mistakes: list[Mistake] = []
    for word in words:
        file = Path(word)
        other = files.setdefault(file.stem, file)
        if what := _unreadable(file):
            mistakes.append(Mistake("--settings", 0, 0, word, what))
            continue
        if not word or file.is_dir():
            what = "is no file; own settings are one YAML file" if word else "has no name"
        elif file.exists() and not NAME.fullmatch(file.stem):
            what = "its name is its column's: letters, digits, - and _, please"
        elif file.exists() and file.stem in get_args(Realised):
            what = f"{file.stem!r} says how an engine realises a scene: rename the file"
        elif file.exists() and (file.stem in taken or file.stem in engines.SETTINGS):
            what = f"{file.stem!r} is a built-in setting: rename the file"
        elif other.resolve() != file.resolve():
            what = f"{other} already has the name {file.stem!r}: rename one of the files"
        else:
            continue
        mistakes.append(Mistake("--settings", 0, 0, word, what))
    if mistakes:
        raise CaseError(mistakes)
    return list(files.values())


def _unreadable(file: Path) -> str:
    try:
        file.is_dir()
    except OSError as error:
        return f"cannot be read: {error.strerror}"
    return ""


def choose_book(names: Sequence[str], settings: Sequence[str]) -> bool:
    """Whether the book's approximations are wanted: by name, or where nothing is named."""
    return BOOK in names or not (names or settings)


def _check_name(word: str) -> None:
    """Raises CaseError for a name that no installed engine has; its setting is not asked yet."""
    name, _, setting = word.partition(".")
    if word == BOOK or name in engines.names():
        return
    hints = [f"{other}.{setting}" for other in engines.names()] if setting else engines.names()
    hints = [BOOK, *hints]  # which has no settings
    raise CaseError([Mistake("--engine", 0, 0, word, f"no such engine{nearest(word, hints)}")])


def _make_engine(name: str, setting: str, *, asked: bool) -> Engine | None:
    """The engine; one that cannot be made is a mistake if it is asked for, else a warning."""
    try:
        return engines.make(name, setting)
    except engines.Broken as broken:
        _tell_broken(name, broken, asked=asked)
        return None


def _tell_broken(name: str, broken: engines.Broken, *, asked: bool) -> None:
    if asked:
        raise CaseError([Mistake("--engine", 0, 0, name, str(broken))]) from None
    warnings.warn(str(broken), stacklevel=4)


def _offers(asked: Set[str]) -> dict[str, tuple[str, ...]]:
    """Returns the settings of the engines asked for, or of all; no other is imported."""
    offers: dict[str, tuple[str, ...]] = {}
    for name in engines.names():
        if not asked or name in asked:
            doing(f"importing {name}")
            try:
                offers[name] = engines.settings(name)
            except engines.Broken as broken:
                _tell_broken(name, broken, asked=bool(asked))
    doing("")
    return offers


def _offered(word: str, offers: Mapping[str, Sequence[str]], own: Sequence[str]) -> None:
    """Raises CaseError for a setting that neither the engine nor a file of the user's has."""
    name, dot, setting = word.partition(".")
    if not dot or setting in offers[name] or setting in own:
        return
    hint = nearest(word, [f"{name}.{offered}" for offered in (*offers[name], *own)])
    files = [file for suffix in OF_SETTINGS if (file := Path(f"{setting}{suffix}")).is_file()]
    if files and not own:
        hint = f"; of your own options say --settings {files[0]} too"
    raise CaseError([Mistake("--engine", 0, 0, word, f"no such engine{hint}")])
