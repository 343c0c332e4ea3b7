"""A YAML file as plain data with the place of every key, and the mistakes of its form."""

import re
from collections.abc import Collection, Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path as FilePath
from typing import Any

from ruamel.yaml import YAML
from ruamel.yaml.error import YAMLError
from ruamel.yaml.events import (
    AliasEvent,
    DocumentStartEvent,
    MappingEndEvent,
    MappingStartEvent,
    NodeEvent,
    ScalarEvent,
    SequenceEndEvent,
    SequenceStartEvent,
)
from ruamel.yaml.reader import ReaderError

from ..mistake import NO_VALUE, CaseError, Mistake, Path, Source, plain

LARGEST = 200_000  # bytes, read in 1.5 s; a case has 2000
AT_HAND = 128  # files whose text is not parsed again: all that are shipped
BREAK = re.compile("(\r\n|[\n\r])")  # what ends a line of YAML 1.2; kept, at the odd places
EITHER = re.compile("[\x85\u2028\u2029]")  # ended a line until YAML 1.1
MARK = "\ufeff"  # with which some editors begin a file


@dataclass
class Document:
    """The data of one file, which nobody changes. `mistakes` leave the rest readable."""

    source: Source
    data: dict[str, Any]
    mistakes: list[Mistake]


def read(path: FilePath, *, only: Collection[str] = ()) -> Document:
    """Read the file's data. Raises CaseError where nothing sensible can be read from it.

    only: the keys at its margin to read, where not all are asked for, in a quarter of the time.
    """
    return _parsed(str(path), _blank_others(_text(path), only) if only else _text(path))


@lru_cache(AT_HAND)
def _parsed(file: str, text: str) -> Document:
    """Parses the text; that is most of what reading costs, and a test session reads twice."""
    lines = tuple(BREAK.split(text)[::2])
    if either := EITHER.search(text):
        raise CaseError([_ambiguous_break(file, lines, text, either.start())])
    tree = Tree(file, lines)
    try:
        data = tree.document(YAML(typ="safe", pure=True).parse(text))
    except ReaderError as error:
        line, column = _end(text[: error.position])
        what = f"the character {plain(text[error.position])} cannot stand in YAML"
        source_line = lines[line - 1] if line <= len(lines) else ""
        raise CaseError([Mistake(file, line, column, "", what, source_line)]) from None
    except YAMLError as error:
        raise CaseError([tree.unreadable(error)]) from None
    except (ValueError, OverflowError) as error:  # ruamel on an escape such as "\U99999999"
        raise CaseError([tree.at(None, (), f"not YAML: {error}")]) from None
    if tree.fatal:
        raise CaseError(tree.fatal)
    assert isinstance(data, dict)  # anything else is fatal
    return Document(Source(file, lines, tree.places), data, tree.mistakes)


def _ambiguous_break(file: str, lines: tuple[str, ...], text: str, at: int) -> Mistake:
    """The mistake of a line break that ruamel counts in comments only."""
    line, column = _end(text[:at])
    what = f"the character {plain(text[at])} ends a line for some and not for others: leave it out"
    return Mistake(file, line, column, "", what, lines[line - 1])


def _blank_others(text: str, keys: Collection[str]) -> str:
    """Blank the lines of all other keys, so that places stay the same."""
    keep, parts = True, BREAK.split(text)
    for k in range(0, len(parts), 2):
        if parts[k][:1].strip(" \t#"):
            keep = parts[k].partition(":")[0] in keys
        parts[k] = parts[k] if keep else ""
    return "".join(parts)


def _text(path: FilePath) -> str:
    def refuse(what: str) -> CaseError:
        return CaseError([Mistake(str(path), 0, 0, "", what)])

    if path.is_dir():
        raise refuse("is a directory; a case is one YAML file")
    if path.exists() and not path.is_file():
        raise refuse("is no file")  # a pipe would be waited for
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
    """Line and column, from 1, just after the end of the text."""
    lines = BREAK.split(text)[::2]
    return len(lines), len(lines[-1]) + 1


# Events of YAML → maps, tuples, text, numbers and truth values, and nothing else.
#
# Nothing is ever constructed by the file's wish: anchors, aliases and tags are refused as events,
# before they could mean anything. So no file can run code, grow or refer to itself.


DEEPEST = 20  # levels; a case has 6

_INTEGER = re.compile(r"[-+]?[0-9]{1,18}")
_FLOAT = re.compile(r"[-+]?(\.[0-9]+|[0-9]+(\.[0-9]*)?)([eE][-+]?[0-9]+)?")
_WORDS = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
    **{
        sign + word: float(sign + "inf")
        for sign in ("", "+", "-")
        for word in (".inf", ".Inf", ".INF")
    },
    **dict.fromkeys((".nan", ".NaN", ".NAN"), float("nan")),
}


@dataclass
class Tree:
    """Turns events into data, noting places and mistakes on the way."""

    file: str
    lines: tuple[str, ...]
    places: dict[Path, tuple[int, int]] = field(default_factory=dict)
    mistakes: list[Mistake] = field(default_factory=list)
    fatal: list[Mistake] = field(default_factory=list)

    def at(self, mark: Any, path: Path, what: str) -> Mistake:
        line, column = (mark.line + 1, mark.column + 1) if mark else (0, 0)
        return Source(self.file, self.lines, {path: (line, column)}).mistake(path, what)

    def unreadable(self, error: YAMLError) -> Mistake:
        mark = getattr(error, "problem_mark", None)
        what = getattr(error, "problem", None) or str(error).splitlines()[0]
        return self.at(mark, (), f"not YAML: {what}")

    def document(self, events: Iterator[Any]) -> Any:
        data: Any = None
        documents = 0
        for event in events:
            if isinstance(event, DocumentStartEvent):
                documents += 1
                if documents > 1:
                    what = "a second document; a case is one"
                    self.fatal.append(self.at(event.start_mark, (), what))
                    return data
            elif isinstance(event, NodeEvent):
                data = self.node(event, events, ())
                if not isinstance(data, dict) and not self.fatal:
                    what = "should be a map of keys (`title: …`)"
                    self.fatal.append(self.at(event.start_mark, (), what))
        if not documents:
            self.fatal.append(Mistake(self.file, 0, 0, "", "is empty"))
        return data

    def node(self, event: NodeEvent, events: Iterator[Any], path: Path) -> Any:
        if len(path) > DEEPEST:
            what = f"is nested deeper than {DEEPEST} levels"
            raise CaseError([*self.fatal, self.at(event.start_mark, path[:4], what)])
        self.refuse_references(event, path)
        if isinstance(event, MappingStartEvent):
            return self.mapping(events, path)
        if isinstance(event, SequenceStartEvent):
            return self.sequence(events, path)
        if not isinstance(event, ScalarEvent):
            return None
        value = scalar(event.value) if event.style is None else event.value
        if value is None:
            source = Source(self.file, self.lines, self.places)
            self.mistakes.append(source.mistake(path, NO_VALUE))
        return value

    def refuse_references(self, event: NodeEvent, path: Path) -> None:
        if isinstance(event, AliasEvent):
            what = f"alias '*{event.anchor}': a case has no anchors and aliases"
        elif event.anchor:
            what = f"anchor '&{event.anchor}': a case has no anchors and aliases"
        elif tag := getattr(event, "tag", None):
            what = f"tag {tag!r}: a case has no tags"
        else:
            return
        self.fatal.append(self.at(event.start_mark, path, what))

    def sequence(self, events: Iterator[Any], path: Path) -> tuple[Any, ...]:
        items: list[Any] = []
        while not isinstance(event := next(events), SequenceEndEvent):
            place = (*path, len(items))
            self.places[place] = (event.start_mark.line + 1, event.start_mark.column + 1)
            items.append(self.node(event, events, place))
        return tuple(items)

    def mapping(self, events: Iterator[Any], path: Path) -> dict[str, Any]:
        data: dict[str, Any] = {}
        while not isinstance(event := next(events), MappingEndEvent):
            key = self.key(event, events, path)
            place = (*path, key)
            if key in data:
                first = self.places[place][0]
                what = f"duplicate key {key!r}, already on line {first}"
                self.mistakes.append(self.at(event.start_mark, place, what))
                count = len(self.mistakes)
                self.node(next(events), events, (*path, f"{key} (again)"))
                del self.mistakes[count:]  # it has to go as a whole
                continue
            self.places[place] = (event.start_mark.line + 1, event.start_mark.column + 1)
            data[key] = self.node(next(events), events, place)
        return data

    def key(self, event: Any, events: Iterator[Any], path: Path) -> str:
        if isinstance(event, ScalarEvent):
            self.refuse_references(event, path)
            return event.value
        self.node(event, events, (*path, "?"))
        self.fatal.append(self.at(event.start_mark, path, "a key should be a word"))
        return "?"


def scalar(text: str) -> str | int | float | bool | None:
    """A plain scalar by the core schema of YAML 1.2: 1e-3 is a number, `on` is text."""
    if text in _WORDS:
        return _WORDS[text]
    if _INTEGER.fullmatch(text):
        return int(text)
    return float(text) if _FLOAT.fullmatch(text) else text
