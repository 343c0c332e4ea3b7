"""One release of an engine on some cases: run by `measure` in a process that finds it first.

Written into the folder are its reports; or, where it cannot be imported, in BROKEN why.
"""

import json
import os
import sys
import threading
from pathlib import Path

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
