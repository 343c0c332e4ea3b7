"""versions.csv: each number of each release, and where it is another than one release before."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby

import pandas as pd

from ...tables.diff.columns import ERRORS, Row, Rule
from ...tables.diff.compare import Place, difference, place
from ...tables.diff.forms import fitted
from ...tables.row import NUMBERS
from .measure import Measured

NAME = "versions.csv"
COLUMNS = (
    *("case", "theme", "engine", "version", "setting", "realised", "quantity", "unit"),
    *("error", "allowed", "verdict", "because"),
)
"""Those of tolerance.csv."""
FURTHER = ("release", "moved", "change", "ratio")
MOST = 40  # rows of a table on a terminal; the CSV has them all
NONE = "–"


def table(measured: Sequence[Measured], cases: Sequence[str]) -> pd.DataFrame:
    """Returns a row for each number. release: the how manieth of its engine, as named, from 1.

    moved: `yes` where it is not as one release before that could be run; change: how; ratio: the
    error over that of the release before. Of a release that cannot be run a row for each of the
    cases says why.
    """
    rows: list[Mapping[str, str]] = []
    count: Counter[str] = Counter()
    last: dict[str, Measured] = {}
    for run in measured:
        engine = run.release.engine
        count[engine] += 1
        number = {"release": str(count[engine])}
        if run.folder is None:
            outcome = {"verdict": run.verdict, "because": run.because}
            head = {"engine": engine, "version": run.release.version, **outcome, **number}
            rows += [head | {"case": case} for case in cases]
            continue
        moved = _change_cells(last[engine], run) if engine in last else {}
        for row in run.folder.errors:
            cells = {name: row[name] for name in COLUMNS}
            rows.append(cells | number | moved.get(place(ERRORS, row), {}))
        last[engine] = run
    columns = [*COLUMNS, *FURTHER]
    frame = pd.DataFrame([{name: row.get(name, "") for name in columns} for row in rows])
    return frame.sort_values(["engine", "case"], kind="stable", ignore_index=True)


def _change_cells(before: Measured, now: Measured) -> dict[Place, dict[str, str]]:
    """Returns the further cells of each row that changed from one release to another."""
    if before.folder is None or now.folder is None:
        return {}
    return {
        change.place: {
            "moved": "yes",
            "change": change.kind,
            "ratio": "" if change.times is None else format(change.times, NUMBERS),
        }
        for change in difference(before.folder, now.folder, Rule()).changes
        if change.file == ERRORS.name
    }


def text(table: pd.DataFrame, width: int) -> str:
    """Returns for each engine a line a release, and the numbers that one of them moved."""
    lines: list[str] = []
    for engine, some in table.groupby("engine"):
        lines += ["", str(engine)]
        ran: list[Sequence[Row]] = []
        moved: list[set[Place]] = []
        for _, part in some.groupby(some["release"].astype(int)):
            rows = [dict(zip(part.columns, cells, strict=True)) for cells in part.to_numpy()]
            before = ran[-1] if ran else []
            numbers = _numbers(rows).keys() & _numbers(before).keys()
            places = {place(ERRORS, row) for row in rows if row["moved"]} & numbers
            paragraphs = _release_lines(rows, before, len(places))
            lines += [line for paragraph in paragraphs for line in fitted(paragraph, width)]
            if rows[0]["quantity"]:
                ran.append(rows)
                moved.append(places)
        lines += _table(ran, moved, width)
    return "\n".join(lines[1:])


def _numbers(rows: Sequence[Row]) -> dict[Place, Row]:
    return {place(ERRORS, row): row for row in rows if row["error"]}


def _release_lines(rows: Sequence[Row], before: Sequence[Row], moved: int) -> Iterator[str]:
    """Yields how many numbers a release gave and moved, and what the one before did not lack."""
    version = rows[0]["version"]
    if not rows[0]["quantity"]:
        yield f"  {version}: {rows[0]['verdict']}: {rows[0]['because']}"
        return
    count = len(_numbers(rows))
    since = f", {moved} moved since {before[0]['version']}" if before else ""
    yield f"  {version}: {count} number{'' if count == 1 else 's'}{since}"
    for why, count in _lacking(rows).items():
        if why not in _lacking(before):
            yield f"    {count} without: {why}"


def _lacking(rows: Sequence[Row]) -> Counter[str]:
    """Returns why rows have no number, and how many."""
    lacking = (row for row in rows if not row["error"])
    return Counter(": ".join(filter(None, (row["verdict"], row["because"]))) for row in lacking)


def _table(ran: Sequence[Sequence[Row]], moved: Sequence[set[Place]], width: int) -> list[str]:
    """Returns quantities by releases, as many as fit: one that moved nothing is as its left one."""
    places = sorted(set[Place]().union(*moved))
    if not places:
        return []
    numbers = [_numbers(rows) for rows in ran]
    lines: list[tuple[str, ...]] = []
    for head, some in groupby(places[:MOST], key=lambda where: where[:2]):
        lines.append((" ".join(head), *[""] * len(ran)))
        for where in some:
            rows = [by_place.get(where) for by_place in numbers]
            unit = next(row["unit"] for row in rows if row)
            marks = ["*" * (where in its) for its in moved]
            cells = (_cell(row, mark) for row, mark in zip(rows, marks, strict=True))
            lines.append((f"  {where[2]} {unit}", *cells))
    names, *columns = zip(*lines, strict=True)
    versions = pd.Index([rows[0]["version"] for rows in ran], name="* moved")
    frame = pd.DataFrame(dict(enumerate(columns)), index=names).set_axis(versions, axis=1)
    if max(map(len, frame.to_string().splitlines())) > width:
        frame = frame.iloc[:, [i for i, its in enumerate(moved) if its or i == 0]]
    more = [f"  and {len(places) - MOST} more"] * (len(places) > MOST)
    return ["", *(line.rstrip() for line in frame.to_string().splitlines()), *more]


def _cell(row: Row | None, mark: str) -> str:
    return NONE if row is None else f"{mark}{float(row['error']):.2g}"
