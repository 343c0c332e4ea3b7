"""A release of an engine: its name on the command line, and a folder that Python finds it in first.

Whatever this environment has or asks for plays no part: nothing else is installed there but the
pieces that the release itself pins to one version.
"""

import re
import shutil
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from importlib import metadata, util
from pathlib import Path
from tempfile import TemporaryDirectory

from .... import engines
from ....cases.mistake import CaseError, Mistake, nearest

ZEROS = re.compile(r"(\.0)+(?![.\d])")
VERSION = re.compile(r"\d[\w.+!]*", re.ASCII)
PINNED = re.compile(r"(?P<name>[^=<>~!]*)(?P<sign>[=<>~!]+)(?P<version>.*)", re.DOTALL)
PIECE = re.compile(r"([\w.-]+) ?\(?== ?([\w.+!]+)\)?")


@dataclass(frozen=True)
class Release:
    """An engine's release: its package has the engine's name."""

    engine: str
    version: str

    def __str__(self) -> str:
        return f"{self.engine}=={self.version}"

    def mistake(self, what: str) -> Mistake:
        """Returns what is wrong with it, at its place on the command line."""
        return Mistake("versions", 0, 0, str(self), what)


def alike(one: str, other: str) -> bool:
    """Whether two versions are one: 7.3 is 7.3.0, and pip takes it so."""
    return ZEROS.sub("", one) == ZEROS.sub("", other)


def parted(words: Sequence[str]) -> tuple[list[Release], list[str]]:
    """Returns the releases among the words, in their order, and the other words: cases.

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
    mistakes += [release.mistake("is named twice") for release in twice]
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


def place(release: Release, among: Path, tell: Callable[[str], None]) -> Path | None:
    """Returns the folder of the release, installed there if it was not; None: Python has it here.

    Raises CaseError where it cannot be had.
    """
    if alike(here(release.engine) or "", release.version):
        return None
    folder = among / f"{release}-{sys.implementation.cache_tag}"
    if not folder.is_dir():
        tell(f"installing {release}")
        among.mkdir(parents=True, exist_ok=True, mode=0o700)
        with TemporaryDirectory(prefix=".making-", dir=among) as made:
            first, whole = Path(made) / "first", Path(made) / "whole"
            _install([str(release)], first, release, tell)
            if pieces := [*_pieces(first)]:
                _install([str(release), *pieces], whole, release, tell)
            (whole if pieces else first).rename(folder)
    return folder


def here(engine: str) -> str | None:
    """Returns the release that this environment has."""
    try:
        return metadata.version(engine)
    except metadata.PackageNotFoundError:
        return None


def _install(
    names: Sequence[str], folder: Path, release: Release, tell: Callable[[str], None]
) -> None:
    """Raises CaseError where it cannot, and tells what the installer says of it."""
    how = ["--no-deps", "--only-binary", ":all:", "--target", str(folder), *names]
    done = subprocess.run(
        [*_installer(release), *how], capture_output=True, text=True, errors="replace", check=False
    )
    if done.returncode:
        tell(done.stderr.strip())
        raise CaseError([release.mistake("cannot be installed: the installer says why above")])


def _installer(release: Release) -> list[str]:
    """Returns the command of this environment's pip, else of uv."""
    if util.find_spec("pip"):
        quiet = ["--quiet", "--disable-pip-version-check", "--no-input", "--retries", "1"]
        return [sys.executable, "-m", "pip", "install", *quiet, "--timeout", "15"]
    if uv := shutil.which("uv"):
        return [uv, "pip", "install", "--quiet", "--python", sys.executable]
    raise CaseError([release.mistake("cannot be installed: there is neither pip nor uv")])


def _pieces(folder: Path) -> Iterator[str]:
    """Yields what a folder's packages pin to one version, and not just for an extra."""
    for package in metadata.distributions(path=[str(folder)]):
        for needed in package.requires or []:
            if piece := PIECE.fullmatch(needed.strip()):
                yield f"{piece[1]}=={piece[2]}"
