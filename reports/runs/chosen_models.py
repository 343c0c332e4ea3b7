"""From the words of a command line to the cases of models; nothing is compiled."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from ...cases.find import models as shipped_models
from ...cases.load_model import has_model, load_model
from ...cases.mistake import CaseError, Mistake, nearest
from ...cases.model_case import ModelCase, of_model
from .selection import is_model, nameable

SUFFIXES = (".xml", ".urdf")


@dataclass(frozen=True)
class Chosen:
    """The cases of models among some words, the other words, and the mistakes of the first."""

    cases: Sequence[ModelCase]
    others: Sequence[str]
    mistakes: Sequence[Mistake]


def choose_models(words: Sequence[str], *, long: bool = False) -> Chosen:
    """Returns the cases of models: files of XML, case files with a `model`, folders, shipped names.

    No words choose all shipped ones. A mistake costs its own file.
    """
    known = shipped_models()
    others: list[str] = []
    mistakes: list[Mistake] = []
    cases: dict[str, ModelCase] = {}
    for word in words or known:
        try:
            path = _path(word, known)
            if word and path.is_dir():  # no word is the folder here to Path
                some = [*_folder(path)]
                if not some:
                    others.append(word)
            elif path.is_file() and is_model(path):
                nameable(word)
                some = [of_model(str(path.resolve()), word, path.stem)]
            elif path.is_file() and has_model(path):
                nameable(word)
                some = _variants(load_model(path, long=long), word, path)
            else:
                others.append(word)
                continue
        except CaseError as error:
            mistakes += error.mistakes
            continue
        except OSError as error:
            mistakes.append(Mistake(word, 0, 0, "", f"cannot be read: {error.strerror}"))
            continue
        for case in some:
            name = case.name if case.name not in cases else case.file
            cases[name] = replace(case, name=name)
    return Chosen([*cases.values()], others, mistakes)


def _path(word: str, known: Mapping[str, Path]) -> Path:
    """Returns a shipped file by its name, or by a variant's that is no file of the user's."""
    own, name = Path(word), word.partition(".")[0]
    return known.get(word) or (own if own.exists() else known.get(name, own))


def _variants(cases: list[ModelCase], word: str, path: Path) -> list[ModelCase]:
    """Returns all variants of a file, or the one that the word is of. Raises CaseError."""
    if word == path.stem or Path(word).exists():
        return cases
    names = [case.name for case in cases]
    if word not in names:
        raise CaseError([Mistake(word, 0, 0, "", f"no such variant{nearest(word, names)}")])
    return [case for case in cases if case.name == word]


def _folder(folder: Path) -> Iterator[ModelCase]:
    """Yields the models below a folder that are not hidden, called by their paths in it."""
    for path in sorted(folder.rglob("*")):
        inside = path.relative_to(folder)
        hidden = any(part.startswith(".") for part in inside.parts)  # as what is installed is
        if path.suffix.lower() in SUFFIXES and not hidden and path.is_file() and is_model(path):
            name = inside.with_suffix("").as_posix()
            if not (name.isprintable() and (name[0].isalnum() or name[0] == "_")):
                name = ascii(name)  # a table would misread it, or no file hold it
            yield of_model(str(path.resolve()), str(path), name, in_folder=True)
