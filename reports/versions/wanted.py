"""From the words of the command line to releases and cases."""

import re
from collections.abc import Sequence
from dataclasses import dataclass

from ... import engines
from ...cases.mistake import CaseError, Mistake, nearest

VERSION = re.compile(r"\d[\w.+!]*", re.ASCII)
PINNED = re.compile(r"(?P<name>[^=<>~!]*)(?P<sign>[=<>~!]+)(?P<version>.*)", re.DOTALL)


@dataclass(frozen=True)
class Release:
    """An engine's release: its package has the engine's name."""

    engine: str
    version: str

    def __str__(self) -> str:
        return f"{self.engine}=={self.version}"


def parted(words: Sequence[str]) -> tuple[list[Release], list[str]]:
    """The releases among the words, in their order, and the other words: cases.

    Raises CaseError with all mistakes.
    """
    releases: list[Release] = []
    cases: list[str] = []
    mistakes: list[Mistake] = []
    for word in words:
        pinned = PINNED.fullmatch(word)
        if pinned is None:
            cases.append(word)
        elif what := _mistaken(**pinned.groupdict()):
            mistakes.append(Mistake("versions", 0, 0, word, what))
        else:
            releases.append(Release(pinned["name"], pinned["version"]))
    twice = {release for release in releases if releases.count(release) > 1}
    mistakes += [Mistake("versions", 0, 0, str(r), "is named twice") for r in twice]
    if not releases and not mistakes:
        what = f"name releases of an engine, as {engines.names()[0]}==1.2.3"
        mistakes.append(Mistake("versions", 0, 0, "", what))
    if mistakes:
        raise CaseError(mistakes)
    return releases, cases


def _mistaken(name: str, sign: str, version: str) -> str:
    if name not in engines.names():
        return f"no such engine{nearest(name.lower(), engines.names())}"
    if sign != "==" or not VERSION.fullmatch(version):
        return f"should name one release, as {name}==1.2.3"
    return ""
