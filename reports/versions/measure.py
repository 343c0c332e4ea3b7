"""Every release in a process of its own; references are solved once, and lie in the store."""

import json
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

from ...cases.mistake import CaseError, Mistake
from ..batch.cache.store import FOLDER, by_default, usable
from ..data.row import CRASHED, REFUSED
from ..output.diff.folder import Folder, opened
from ..system import child
from ..system.temporary_folder import passing
from .install import place
from .one import BROKEN
from .wanted import Release

ENVIRONMENTS = "versions"  # in the user's cache


@dataclass(frozen=True)
class Measured:
    """A release and its report; or, where there is none, a verdict and why."""

    release: Release
    folder: Folder | None
    verdict: str = ""
    because: str = ""


def measure(
    releases: Sequence[Release],
    cases: Sequence[str],
    settings: Sequence[str],
    jobs: int | None,
    long: bool,
    tell: Callable[[str], None],
) -> Iterator[Measured]:
    """Each as it is done; all are installed before the first one runs. Raises CaseError.

    long: whether the cases may ask for any amount of work.
    """
    with _cache() as cache:
        places = []
        for release in releases:
            places.append(place(release, cache / ENVIRONMENTS, tell))
        for release, found in zip(releases, places, strict=True):
            tell(f"running {release}")
            with passing("textmech-release-") as out:
                asked = {
                    "engine": release.engine,
                    "version": release.version,
                    "cases": [*cases],
                    "settings": [*settings],
                    "folder": str(out),
                    "jobs": jobs,
                    "long": long,
                }
                code, _ = child.run(
                    [sys.executable, "-P", "-m", f"{__package__}.one", json.dumps(asked)],
                    env=_environment(found, cache),
                )
                yield _measured(release, code, out)


@contextmanager
def _cache() -> Iterator[Path]:
    """The user's, or one for this command where it cannot be written to."""
    if usable() is not None:
        yield by_default()
        return
    with passing("textmech-releases-") as folder:
        yield folder


def _environment(found: Path | None, cache: Path) -> dict[str, str]:
    paths = [found, os.environ.get("PYTHONPATH")]
    path = os.pathsep.join(str(part) for part in paths if part)
    return {**os.environ, FOLDER: str(cache)} | ({"PYTHONPATH": path} if path else {})


def _measured(release: Release, code: int, out: Path) -> Measured:
    if code > 0:
        what = "was not run: what is wrong is said above"
        raise CaseError([Mistake("versions", 0, 0, str(release), what)])
    if code < 0:
        return Measured(release, None, CRASHED, f"its process ended by signal {-code}")
    if (out / BROKEN).exists():
        why = (out / BROKEN).read_text(encoding="utf-8")
        return Measured(release, None, REFUSED, f"adapter: {why}")
    (folder,) = opened({str(release): out})
    return Measured(release, folder)
