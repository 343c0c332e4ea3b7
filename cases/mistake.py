"""Mistakes in a case file, as a person wants to read them: place, field, what is wrong."""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches
from functools import partial
from heapq import nlargest
from itertools import groupby

Path = tuple[str | int, ...]

NO_VALUE = "has no value"  # of a key: whatever else is wrong with it follows from that
SHOWN = 20  # mistakes of one file: whoever has more has one cause, and reads no further
MANY = 60  # words that are compared letter by letter
_JOINERS = "\u00ad\u200c\u200d"  # not printable to Python, and part of how words are written


def invisible(text: str) -> str | None:
    """The first character that would steer a terminal or hide what follows, or None."""
    return next((c for c in text if not (c.isprintable() or c in _JOINERS)), None)


def plain(text: str) -> str:
    """The text with such characters written out, as \\x1b."""
    return "".join(c if invisible(c) is None else c.encode("unicode_escape").decode() for c in text)


@dataclass(frozen=True, order=True)
class Mistake:
    """One mistake; `line` and `column` count from 1, and 0 means the whole file."""

    file: str
    line: int
    column: int
    where: str  # the field, `scene.bodies.crank.bar.mass`
    what: str
    text: str = field(default="", compare=False)  # the source line

    def __str__(self) -> str:
        place = f"{self.file}:{self.line}:{self.column}" if self.line else self.file
        head = f"{place}: {self.where}: {self.what}" if self.where else f"{place}: {self.what}"
        head = plain(head)
        if not self.text.strip():
            return head
        start = max(0, self.column - 60) if len(self.text) > 100 else 0  # a window on a long line
        window = self.text[start : start + 100]
        line = "".join(c if invisible(c) is None else " " for c in window)  # the caret stays below
        return f"{head}\n    {line}\n    {' ' * (self.column - 1 - start)}^"


class CaseError(Exception):
    """Raised with all mistakes of case files at once; its text shows SHOWN of each file."""

    def __init__(self, mistakes: Sequence[Mistake]) -> None:
        self.mistakes = sorted(set(mistakes))
        super().__init__("\n".join(_lines(self.mistakes)))

    def __reduce__(self) -> tuple[type["CaseError"], tuple[list[Mistake]]]:
        return CaseError, (self.mistakes,)  # errors cross the border of a process


def _lines(mistakes: Sequence[Mistake]) -> Iterator[str]:
    for file, group in groupby(mistakes, key=lambda mistake: mistake.file):
        all_ = [*group]
        yield from map(str, all_[:SHOWN])
        if len(all_) > SHOWN:
            yield f"{plain(file)}: and {len(all_) - SHOWN} more"


@dataclass(frozen=True)
class Source:
    """A file's name, its lines, and the place (line, column from 1) of every key in it."""

    file: str
    lines: tuple[str, ...]
    places: Mapping[Path, tuple[int, int]]

    def mistake(self, path: Path, what: str) -> Mistake:
        """A mistake at `path`, or at the nearest enclosing key that stands in the file."""
        known = path
        while known and known not in self.places:
            known = known[:-1]
        line, column = self.places.get(known, (0, 0))
        text = self.lines[line - 1] if 0 < line <= len(self.lines) else ""
        return Mistake(self.file, line, column, ".".join(str(p) for p in path), what, text)


def nearest(word: str, words: Iterable[str]) -> str:
    """A hint: `; did you mean 'crank.angle'?`, or what there is, or nothing."""
    known = list(words)
    hint = did_you_mean(word, known)
    return f"; {hint}" if hint else list_hint(known)


def did_you_mean(word: str, known: Sequence[str]) -> str:
    """Returns `did you mean 'crank.angle'?`, or nothing where no word is alike."""
    # To compare two words thoroughly takes long: of very many those that begin or end alike.
    alike = known if len(known) <= MANY else nlargest(MANY, known, key=partial(_ends_alike, word))
    close = get_close_matches(word, alike, n=1, cutoff=0.6)
    return f"did you mean {close[0]!r}?" if close else ""


def _ends_alike(word: str, other: str) -> int:
    """A measure of how alike the beginnings and ends of two words are."""
    begins = (word[:1] == other[:1]) + (word[:3] == other[:3]) + (word[:6] == other[:6])
    ends = (word[-1:] == other[-1:]) + (word[-3:] == other[-3:]) + (word[-6:] == other[-6:])
    return 4 * (begins + ends) - abs(len(word) - len(other))


def list_hint(words: Sequence[str]) -> str:
    """A hint that lists the words, or nothing if they are too many."""
    return f"; known: {', '.join(words)}" if 0 < len(words) <= 12 else ""
