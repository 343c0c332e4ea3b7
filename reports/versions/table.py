"""versions.csv: each number of each release, and where it is another than one release before."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import pandas as pd

from ..diff.change import Change, Place
from ..diff.compare import difference
from ..diff.errors import ERRORS, place
from ..diff.rule import Rule
from ..diff.table import Row
from .measure import Measured
from .wanted import Release

NAME = "versions.csv"
COLUMNS = ("case", "engine", "version", "setting", "realised", "quantity", "unit")
NUMBERS = {"error": "largest", "allow": "allowed"}
"""By the column here the column of tolerance.csv."""
FURTHER = ("verdict", "moved", "change")


@dataclass(frozen=True)
class Step:
    """From one release to the next: what changed in tolerance.csv; before None: the first."""

    before: Release | None
    now: Measured
    changes: tuple[Change, ...] = ()

    @property
    def rows(self) -> Sequence[Row]:
        """What it was measured to, as tolerance.csv has it."""
        return self.now.folder.errors.rows if self.now.folder else ()


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
    """A row for each number. moved: `yes` where it is not as one release before; change: how.

    Of a release that cannot be run a row for each of the cases says why.
    """
    rows: list[Mapping[str, str]] = []
    for step in steps:
        moved: dict[Place, str] = {change.place: change.kind for change in step.changes}
        for row in step.rows:
            told = {name: row[name] for name in COLUMNS}
            told |= {name: row[column] for name, column in NUMBERS.items()}
            change = moved.get(place(row), "")
            told |= {"verdict": _verdict(row), "moved": "yes" if change else "", "change": change}
            rows.append(told)
        if not step.now.folder:
            release = step.now.release
            head = {"engine": release.engine, "version": release.version}
            rows += [head | {"case": case, "verdict": step.now.because} for case in cases]
    columns = [*COLUMNS, *NUMBERS, *FURTHER]
    whole = [{name: row.get(name, "") for name in columns} for row in rows]
    frame = pd.DataFrame(whole, columns=columns)
    return frame.sort_values(["engine", "case"], kind="stable", ignore_index=True)


def _verdict(row: Row) -> str:
    """With its reason, where no number says more."""
    if row["largest"] or not row["because"]:
        return row["verdict"]
    return f"{row['verdict']}: {row['because']}"
