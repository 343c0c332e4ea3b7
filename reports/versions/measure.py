"""Every release in a process of its own; references are solved once, and lie in the store."""

import json
import os
import sys
import threading
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


# One release of an engine on some cases: run by `measure` in a process that finds it first.
#
# Written into the folder are its reports; or, where it cannot be imported, in BROKEN why.


BROKEN = "broken.txt"
MISTAKEN = 2


def main(told: str) -> int:
    """told: JSON of the engine, its version, cases, settings, folder, jobs, long."""
    from ...cases.mistake import CaseError
    from ..batch import suite
    from ..batch.cache.store import usable
    from ..batch.selection import choose_cases, choose_engines
    from ..output import write
    from ..show.console import tell
    from ..show.progress import progress
    from ..system import pool

    asked = json.loads(told)
    name, folder = asked["engine"], Path(asked["folder"])
    try:
        engines = choose_engines([name], asked["settings"], long=asked["long"])
    except (CaseError, ValueError) as error:  # it cannot be imported, or does not have an option
        mistakes = error.mistakes if isinstance(error, CaseError) else []
        said = "; ".join(m.what for m in mistakes) or str(error)
        (folder / BROKEN).write_text(" ".join(said.split()), encoding="utf-8")  # a table's line
        return 0
    other = {engine.version for engine in engines} - {asked["version"]}
    if other:
        tell(f"{name} {asked['version']} is asked for, and Python finds {', '.join(other)}")
        return MISTAKEN
    try:
        cases = choose_cases(asked["cases"], known=None, long=asked["long"])
        with progress() as told_so_far:
            report = suite.measure(
                cases,
                engines,
                jobs=asked["jobs"] or pool.workers(),
                progress=told_so_far,
                book=False,
                store=usable(),
            )
    except CaseError as error:
        tell(str(error))
        return MISTAKEN
    write.write(write.tables(report, report.cases), folder)
    return 0


def _with_parent() -> None:
    """Ends with whoever started it: its stdin does."""
    while os.read(0, 1):
        pass
    os._exit(1)


if __name__ == "__main__":
    threading.Thread(target=_with_parent, daemon=True).start()  # before seconds of imports
    from ..show.console import prepare
    from ..system import termination as ending

    ending.listen()
    prepare()
    try:
        sys.exit(main(sys.argv[1]))
    except KeyboardInterrupt:
        sys.exit(ending.INTERRUPTED)
