"""versions.csv: each number of each release, and where it is another than one release before."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from ..data.row import NUMBERS
from ..output.diff.columns import ERRORS, Row, Rule
from ..output.diff.compare import Change, Place, difference, place
from .measure import Measured
from .release import Release

NAME = "versions.csv"
COLUMNS = (
    "case", "theme", "engine", "version", "setting", "realised", "quantity", "unit", "error",
    "allowed", "verdict", "because",
)  # fmt: skip
"""Those of tolerance.csv."""
FURTHER = ("release", "moved", "change", "ratio")


@dataclass(frozen=True)
class Step:
    """From one release to the next: what changed in tolerance.csv; before None: the first."""

    before: Release | None
    now: Measured
    changes: tuple[Change, ...] = ()

    @property
    def rows(self) -> Sequence[Row]:
        """The rows of tolerance.csv for the release; none where it could not be run."""
        return self.now.folder.errors if self.now.folder else ()


def steps(measured: Sequence[Measured]) -> list[Step]:
    """In the order of the releases, each beside the last of its engine that could be run."""
    last: dict[str, Measured] = {}
    found: list[Step] = []
    for one in measured:
        before = last.get(one.release.engine)
        if before and before.folder and one.folder:
            changes = difference(before.folder, one.folder, Rule()).changes
            told = tuple(change for change in changes if change.file == ERRORS.name)
            found.append(Step(before.release, one, told))
        else:
            found.append(Step(None, one))
        if one.folder:
            last[one.release.engine] = one
    return found


def table(steps: Sequence[Step], cases: Sequence[str]) -> pd.DataFrame:
    """A row for each number. release: the how manieth of its engine, from 1, the oldest first.

    moved: `yes` where it is not as one release before; change: how; ratio: the error over that of
    the release before.

    Of a release that cannot be run a row for each of the cases says why.
    """
    rows: list[Mapping[str, str]] = []
    number: dict[Release, str] = {}
    for step in steps:
        engine = step.now.release.engine
        number[step.now.release] = str(1 + sum(one.engine == engine for one in number))
        moved: dict[Place, Change] = {change.place: change for change in step.changes}
        for row in step.rows:
            change = moved.get(place(ERRORS, row))
            told = {name: row[name] for name in COLUMNS} | {"release": number[step.now.release]}
            if change is not None:
                times = "" if change.times is None else format(change.times, NUMBERS)
                told |= {"moved": "yes", "change": change.kind, "ratio": times}
            rows.append(told)
        if not step.now.folder:
            release, verdict, because = step.now.release, step.now.verdict, step.now.because
            head = {"engine": release.engine, "version": release.version, "verdict": verdict}
            head |= {"release": number[release], "because": because}
            rows += [head | {"case": case} for case in cases]
    columns = [*COLUMNS, *FURTHER]
    whole = [{name: row.get(name, "") for name in columns} for row in rows]
    frame = pd.DataFrame(whole, columns=columns)
    return frame.sort_values(["engine", "case"], kind="stable", ignore_index=True)
