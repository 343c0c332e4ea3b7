"""Reads what a list says of the cases of a file; neither grammar nor nouns are imported."""

from dataclasses import dataclass
from itertools import chain
from pathlib import Path
from typing import Any

from .find import case_name
from .language.document import read
from .origin import Origin

SAID = ("title", "source", "variants")  # what is read of a file


@dataclass(frozen=True)
class Titled:
    """A case as a list shows it."""

    name: str
    title: str
    origin: Origin
    file: str


def titled(path: Path) -> list[Titled]:
    """Read only titles and sources of a file's cases, which is known to be sound.

    Raises CaseError for what `load` finds, where that much cannot be read.
    """
    document = read(path, only=SAID)
    data = document.data
    title, variants = data.get("title"), data.get("variants")
    origin = _origin(data.get("source", {}))
    if (
        origin is None
        or document.mistakes
        or not isinstance(title, str)
        or not isinstance(variants, dict | None)
    ):
        from .load import load  # it alone can say what is wrong, and is half of a list's start

        return [Titled(c.name, c.title, c.origin, c.source.file) for c in load(path)]
    return [Titled(case_name(path, each), title, origin, str(path)) for each in variants or [""]]


def _origin(source: Any) -> Origin | None:
    """Where the cases come from, or None where that is not written as the grammar has it."""
    if not isinstance(source, dict):
        return None
    words = {key: source.get(key) for key in ("example", "exercise", "section", "thread")}
    equations, figures = source.get("equations", ()), source.get("figure", ())
    if isinstance(figures, str):
        figures = (figures,)
    if not (isinstance(equations, tuple) and isinstance(figures, tuple)):
        return None
    said = chain(equations, figures, (word for word in words.values() if word is not None))
    if not all(isinstance(word, str) for word in said):
        return None
    return Origin(equations=equations, figures=figures, **words)
