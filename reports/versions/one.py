"""One release of an engine on some cases: run by `measure` in a process that finds it first.

Written into the folder are its reports; or, where it cannot be imported, in BROKEN why.
"""

import json
import sys
from pathlib import Path

from ...cases.mistake import CaseError
from .. import ending, pool, suite, write
from ..cache.store import usable
from ..selection import choose_cases, choose_engines
from ..show.progress import progress
from ..show.say import prepare, tell

BROKEN = "broken.txt"
MISTAKEN = 2


def main(told: str) -> int:
    """told: JSON of the engine, its version, cases, settings, folder, jobs, long."""
    asked = json.loads(told)
    name, folder = asked["engine"], Path(asked["folder"])
    try:
        engines = choose_engines([name], asked["settings"], long=asked["long"])
    except (CaseError, ValueError) as error:  # it cannot be imported, or does not have an option
        (folder / BROKEN).write_text(_said(error), encoding="utf-8")
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


def _said(error: CaseError | ValueError) -> str:
    """In one line of a table."""
    told = [m.what for m in error.mistakes] if isinstance(error, CaseError) else [str(error)]
    return " ".join("; ".join(told).split())


if __name__ == "__main__":
    ending.listen()
    prepare()
    try:
        sys.exit(main(sys.argv[1]))
    except KeyboardInterrupt:
        sys.exit(ending.INTERRUPTED)
