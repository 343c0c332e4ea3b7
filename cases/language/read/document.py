"""A YAML file as plain data with the place of every key, and the mistakes of its form."""

from collections.abc import Collection
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path as FilePath
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError
from ruamel.yaml.reader import ReaderError

from ...mistake import CaseError, Mistake, Source, plain
from .tree import Tree

LARGEST = 200_000  # bytes, read in 1.5 s; a case has 2000
AT_HAND = 128  # files whose text is not parsed again: all that are shipped
MARK = "\ufeff"  # with which some editors begin a file


@dataclass
class Document:
    """The data of one file, which nobody changes. `mistakes` leave the rest readable."""

    source: Source
    data: dict[str, Any]
    mistakes: list[Mistake]


def read(path: FilePath, *, only: Collection[str] = ()) -> Document:
    """The file's data, or CaseError where nothing sensible can be read from it.

    only: the keys at its margin to read, where not all are asked for, in a quarter of the time.
    """
    return _parsed(str(path), _only(_text(path), only) if only else _text(path))


@lru_cache(AT_HAND)
def _parsed(file: str, text: str) -> Document:
    """What the text says. Parsing is most of what reading costs, and a test session reads twice."""
    lines = tuple(text.splitlines())
    tree = Tree(file, lines)
    try:
        data = tree.document(YAML(typ="safe", pure=True).parse(text))
    except ReaderError as error:
        line, column = _end(text[: error.position])
        what = f"the character {plain(text[error.position])} cannot stand in YAML"
        shown = lines[line - 1] if line <= len(lines) else ""
        raise CaseError([Mistake(file, line, column, "", what, shown)]) from None
    except YAMLError as error:
        raise CaseError([tree.unreadable(error)]) from None
    except (ValueError, OverflowError) as error:  # ruamel on an escape such as "\U99999999"
        raise CaseError([tree.at(None, (), f"not YAML: {error}")]) from None
    if tree.fatal:
        raise CaseError(tree.fatal)
    assert isinstance(data, dict)  # anything else is fatal
    return Document(Source(file, lines, tree.places), data, tree.mistakes)


def _only(text: str, keys: Collection[str]) -> str:
    """Nothing stands on the lines of other keys: places stay what they are."""
    kept, lines = True, []
    for line in text.split("\n"):
        if line[:1].strip(" \t#"):
            kept = line.partition(":")[0] in keys
        lines.append(line if kept else "")
    return "\n".join(lines)


def _text(path: FilePath) -> str:
    def refuse(what: str) -> CaseError:
        return CaseError([Mistake(str(path), 0, 0, "", what)])

    if path.is_dir():
        raise refuse("is a directory; a case is one YAML file")
    try:
        with path.open("rb") as file:
            content = file.read(LARGEST + 1)
    except FileNotFoundError:
        raise refuse("no such file") from None
    except (OSError, ValueError) as error:  # ValueError: a zero byte in the name
        raise refuse(f"cannot be read: {getattr(error, 'strerror', None) or error}") from None
    if len(content) > LARGEST:
        raise refuse(f"is larger than {LARGEST // 1000} kB, too large for a case")
    try:
        return content.decode().removeprefix(MARK)
    except UnicodeDecodeError as error:
        before = content[: error.start].decode().removeprefix(MARK)
        what = f"is not UTF-8 text: here is the byte {content[error.start]:#x}"
        raise CaseError([Mistake(str(path), *_end(before), "", what)]) from None


def _end(text: str) -> tuple[int, int]:
    """Line and column, from 1, of what would follow the text."""
    head, _, last = text.rpartition("\n")
    return head.count("\n") + 1 + ("\n" in text), len(last) + 1
