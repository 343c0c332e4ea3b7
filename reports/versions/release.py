"""A release of an engine: its name on the command line, and a folder that Python finds it in first.

Whatever this environment has or asks for plays no part: nothing else is installed there but the
pieces that the release itself pins to one version.
"""

import os
import platform
import re
import shutil
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from importlib import metadata, util
from pathlib import Path

from ... import engines
from ...cases.mistake import CaseError, Mistake, nearest
from ..system import child
from ..system.temporary_folder import temporary_folder

ZEROS = re.compile(r"(\.0)+(?![.\d])")
VERSION = re.compile(r"\d[\w.+!]*", re.ASCII)
PINNED = re.compile(r"(?P<name>[^=<>~!]*)(?P<sign>[=<>~!]+)(?P<version>.*)", re.DOTALL)
PIECE = re.compile(r"([\w.-]+) ?\(?== ?([\w.+!]+)\)?")
LISTED = re.compile(r"\(from versions: ([^)]*)\)")
UNREACHED = ("NewConnectionError", "ConnectTimeout", "name resolution", "dns error", "Max retries")
NEAR = 6  # of the releases that there are


@dataclass(frozen=True)
class Release:
    """An engine's release: its package has the engine's name."""

    engine: str
    version: str

    def __str__(self) -> str:
        return f"{self.engine}=={self.version}"


def alike(one: str, other: str) -> bool:
    """Whether two versions are one: 7.3 is 7.3.0, and pip takes it so."""
    return ZEROS.sub("", one) == ZEROS.sub("", other)


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


def place(release: Release, among: Path, tell: Callable[[str], None]) -> Path | None:
    """The folder of the release, installed there if it was not; None: this environment has it.

    Raises CaseError where it cannot be had.
    """
    if alike(here(release.engine) or "", release.version):
        return None
    tag = f"{sys.implementation.cache_tag}-{platform.system()}-{platform.machine()}"
    folder = among / f"{release}-{tag}"
    if not _holds(folder, release):
        tell(f"installing {release}")
        shutil.rmtree(folder, ignore_errors=True)  # what somebody took a part of
        among.mkdir(parents=True, exist_ok=True, mode=0o700)
        with temporary_folder(".making-", among) as made:
            _install([str(release)], made / "first", release)
            pieces = [*_pieces(made / "first")]
            if pieces:
                _install([str(release), *pieces], made / "whole", release)
            _kept(made / ("whole" if pieces else "first"), folder)
    return folder


def here(engine: str) -> str | None:
    """The release that this environment has."""
    try:
        return metadata.version(engine)
    except metadata.PackageNotFoundError:
        return None


def _holds(folder: Path, release: Release) -> bool:
    found = metadata.distributions(path=[str(folder)])
    return any(one.name == release.engine and alike(one.version, release.version) for one in found)


def _kept(made: Path, folder: Path) -> None:
    try:
        made.rename(folder)
    except OSError:
        if not folder.is_dir():  # else another process was first
            raise


def _install(names: Sequence[str], folder: Path, release: Release) -> None:
    """Raises CaseError."""
    scratch = folder.with_name(f"{folder.name}-tmp")  # what it leaves there goes with ours
    scratch.mkdir()
    code, said = child.run(
        [*_installer(release), "--no-deps", "--only-binary", ":all:", "--target", folder, *names],
        env=os.environ | {"TMPDIR": str(scratch)},
        heard="stderr",
    )
    if code:
        raise _wrong(release, _because(release, said))


def _installer(release: Release) -> list[str]:
    """pip of this environment, else uv."""
    if util.find_spec("pip"):
        quiet = ["--quiet", "--disable-pip-version-check", "--no-input", "--retries", "1"]
        return [sys.executable, "-m", "pip", "install", *quiet, "--timeout", "15"]
    if uv := shutil.which("uv"):
        return [uv, "pip", "install", "--quiet", "--python", sys.executable]
    raise _wrong(release, "cannot be installed: there is neither pip nor uv")


def _pieces(folder: Path) -> Iterator[str]:
    """Yields what a folder's packages pin to one version, and not just for an extra."""
    for package in metadata.distributions(path=[str(folder)]):
        for needed in package.requires or []:
            if piece := PIECE.fullmatch(needed.strip()):
                yield f"{piece[1]}=={piece[2]}"


def _because(release: Release, said: str) -> str:
    """Says why a release cannot be installed, in a sentence, from the output of pip or uv."""
    if any(sign in said for sign in UNREACHED):
        return "cannot be installed: the package index is not reached; is there a network?"
    if listed := LISTED.search(said):
        known = [version.strip() for version in listed[1].split(",")]
        close = get_close_matches(release.version, known, n=NEAR, cutoff=0.5) or known[-NEAR:]
        near = ", ".join(sorted(close, key=known.index))
        return f"there is no such release for this Python and machine; near ones: {near}"
    lines = [line for line in said.splitlines() if line.strip()]
    return f"cannot be installed: {' '.join(lines[-2:]) or 'nothing was said'}"


def _wrong(release: Release, what: str) -> CaseError:
    return CaseError([Mistake("versions", 0, 0, str(release), what)])
