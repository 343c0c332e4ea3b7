"""The engines that a case names, against those that are installed."""

from collections.abc import Iterable, Iterator, Mapping

from ...mistake import Path, nearest
from ..grammar.file import WAYS, File
from ..parse import Finding

Engines = Mapping[str, tuple[str, ...] | None]
"""Each engine's settings by its name; None: nobody knows them, and nothing is said of them."""


def engines(file: File, known: Engines) -> Iterator[Finding]:
    """Names of engines, of their rows and of their settings that there are not."""
    if isinstance(file.step, Mapping):
        for name in file.step:
            yield from _one_of("engine", ("step", name), known)
    ways = [f"{name}{way}" for name in known for way in WAYS]
    for way in file.reach:
        yield from _one_of("engine", ("reach", way), ways)
    for setting in file.deviates:
        name, _, word = setting.partition(".")
        if name not in known:
            settings = [f"{n}.{each}" for n in known for each in known[n] or (word,)]
            yield from _one_of("setting", ("deviates", setting), settings)
        elif (settings := known[name]) is not None:
            names = [f"{name}.{each}" for each in settings]
            yield from _one_of("setting", ("deviates", setting), names)


def _one_of(kind: str, path: Path, words: Iterable[str]) -> Iterator[Finding]:
    word = str(path[-1])
    if word not in words:
        yield path, f"unknown {kind} {word!r}{nearest(word, words)}"
