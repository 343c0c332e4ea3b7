"""Runs `textmech run` with each release in a process of its own.

References are solved once, and lie in the cache.
"""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from ....cases.mistake import CaseError, Mistake
from ...runs.cache.store import FOLDER, by_default, usable
from ...tables.diff.columns import ERRORS
from ...tables.diff.folder import Folder, opened
from ...tables.row import CRASHED, REFUSED
from .release import Release, alike, place

ENVIRONMENTS = "versions"  # in the user's cache
DONE = (0, 1)
"""The exit codes of a run that was done: that a verdict FAILS is a finding here."""
MUJOCO = "mujoco"
"""The engine that reads models."""


@dataclass(frozen=True)
class Measured:
    """A release and its report; or, where there is none, a verdict and why.

    motions: by the name of a model of the user's own what `stepping` says of it.
    """

    release: Release
    folder: Folder | None
    verdict: str = ""
    because: str = ""
    motions: Mapping[str, Any] = field(default_factory=dict[str, Any])


def measure(
    releases: Sequence[Release],
    cases: Sequence[str],
    settings: Sequence[str],
    jobs: int | None,
    long: bool,
    tell: Callable[[str], None],
    models: Sequence[str] = (),
) -> Iterator[Measured]:
    """Yields each as it is done; all are installed before the first one runs. Raises CaseError.

    long: whether the cases may ask for any amount of work. models: the files of the user's own
    among the cases. Cases, models and settings are sound in this environment: what a release says
    of settings and models is what it lacks.
    """
    words = [word for setting in settings for word in ("--settings", setting)]
    words += ["--jobs", str(jobs)] if jobs else []
    words += ["--allow-long"] if long else []
    with TemporaryDirectory(prefix="textmech-releases-") as passing:
        cache = Path(passing) if usable() is None else by_default()
        places = [place(release, cache / ENVIRONMENTS, tell) for release in releases]
        for i, (release, path) in enumerate(zip(releases, places, strict=True)):
            tell(f"running {release}")
            out = Path(passing) / str(i)
            asked = ["--json", "--engine", release.engine, "--out", out, *words, "--", *cases]
            done = subprocess.run(
                [sys.executable, "-P", "-m", "textmech", "run", *asked],
                env=_environment(path, cache),
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                check=False,
            )
            said = done.stdout.decode(errors="replace")
            own = ["--engine", "--settings", *settings]
            measured = _measured(release, done.returncode, said, out, own, models)
            if models and release.engine == MUJOCO:
                measured = replace(measured, motions=_motions(path, cache, cases))
            yield measured


def _motions(place: Path | None, cache: Path, cases: Sequence[str]) -> dict[str, Any]:
    """Returns what the release's own process says of the models; nothing if it ended before."""
    command = [sys.executable, "-P", "-m", f"{__package__}.stepping", *cases]
    done = subprocess.run(
        command, env=_environment(place, cache), stdout=subprocess.PIPE, check=False
    )
    return {} if done.returncode else json.loads(done.stdout)


def _environment(place: Path | None, cache: Path) -> dict[str, str]:
    paths = [place, os.environ.get("PYTHONPATH")]
    path = os.pathsep.join(str(part) for part in paths if part)
    return {**os.environ, FOLDER: str(cache)} | ({"PYTHONPATH": path} if path else {})


def _measured(
    release: Release, code: int, said: str, out: Path, asked: Sequence[str],
    models: Sequence[str] = (),
) -> Measured:  # fmt: skip
    """Returns what a run in the folder `out` gave, by its exit code and document.

    asked, models: where a mistake stands that is the release's own; of a model it costs that model
    alone. Raises CaseError for any other.
    """
    if code < 0:
        return Measured(release, None, CRASHED, f"its process ended by signal {-code}")
    mistakes = _mistakes(said)
    some = bool(mistakes) and all(mistake.file in models for mistake in mistakes)
    written = (out / ERRORS.name).exists()
    if not written or not (some or code in DONE):  # 1 is a traceback's code too
        own = {Path(place) for place in (*asked, *models)}
        if mistakes and all(Path(mistake.file) in own for mistake in mistakes):
            why = "; ".join(" ".join(mistake.what.split()) for mistake in mistakes)
            return Measured(release, None, REFUSED, f"adapter: {why}")
        above = "" if mistakes else ": what is wrong is said above"
        raise CaseError([release.mistake(f"was not run{above}"), *mistakes])
    (folder,) = opened({str(release): out})
    version = folder.versions.get(release.engine)
    if version is None or not alike(version, release.version):
        what = f"is asked for, and Python finds {version or 'none'}"
        anew = f"if its folder in `{ENVIRONMENTS}` of the cache is damaged, delete that"
        raise CaseError([release.mistake(f"{what}; {anew}")])
    return Measured(release, folder)


def _mistakes(said: str) -> list[Mistake]:
    """Returns the mistakes of a run's document; none if it ended before it could say one."""
    try:
        mistakes = json.loads(said)["mistakes"]
    except ValueError:
        return []
    return [Mistake(m["file"], m["line"], m["column"], m["field"], m["what"]) for m in mistakes]
