"""The reports as tables and as CSV files: sorted, rounded, and all files of a run together."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import fields
from dataclasses import replace as changed
from pathlib import Path
from typing import Any, Protocol, TypeVar

import numpy as np
import pandas as pd

from ...cases.case import Case
from ...reference.certificate.errors import ERROR
from . import run_list
from .coverage import coverage
from .file_content import text as content
from .model_line import ModelLine
from .ownership import HERE, is_checkout, unasked
from .replace import replace
from .row import NUMBERS, Advice, Cause, Certificate, Comparison, Instant, Rungs, StepError

ELSEWHERE = Path("textmech-reports")
NAMES = (
    "tolerance.csv", "convergence.csv", "steps.csv", "events.csv", "causes.csv", "reference.csv",
    "coverage.csv", "models.csv",
)  # fmt: skip
FILES = (*NAMES, run_list.NAME)
"""What a run writes."""
ADVICE = "advice.csv"
KEYS = ("case", "engine", "setting", "realised", "ladder", "quantity", "check", "event", "k")
KNOWN = 1e-6  # of `allow`: the least certified error that is written
TIMES = ".9g"  # of an event's time: its difference is a thousandth of a step

Row = TypeVar("Row", Comparison, Rungs, StepError, Certificate, Instant, Cause, Advice, ModelLine)


class Rows(Protocol):
    """The rows of a run, each kind of which is a table; equations: those executed, by case."""

    comparisons: list[Comparison]
    rungs: list[Rungs]
    steps: list[StepError]
    instants: list[Instant]
    causes: list[Cause]
    certificates: list[Certificate]
    equations: dict[str, set[str]]

    @property
    def lines(self) -> Sequence[ModelLine]: ...


def by_default() -> Path:
    """Returns where a full run writes: a checkout's committed reports, else the user's folder."""
    return HERE if is_checkout() else ELSEWHERE


def tables(report: Rows, cases: Sequence[Case]) -> dict[str, pd.DataFrame]:
    """Returns the frame of each report by its file name."""
    frames = (
        _table(report.comparisons, Comparison),
        _table(report.rungs, Rungs),
        _table(report.steps, StepError),
        _table(report.instants, Instant),
        _table(report.causes, Cause),
        _table(_as_known(report.certificates, cases), Certificate),
        coverage(cases, report.equations),
        _table(report.lines, ModelLine),
    )
    return dict(zip(NAMES, frames, strict=True))


def _as_known(rows: Sequence[Certificate], cases: Sequence[Case]) -> list[Certificate]:
    """Certified errors up to the next power of ten, and none below a millionth of `allow`.

    So is the share of the smallest bound that one takes, as far as it is written at all. What is
    smaller is rounding's, and another on another machine; a run's own rows tell it all.
    """
    least = {
        (case.name, f"{ERROR}{name}"): KNOWN * (allow or 0.0)
        for case in cases
        for name, allow in case.allow.items()
    }
    return [
        row
        if row.certified is None
        else changed(
            row,
            certified=_bound(row.certified, least.get((row.case, row.check), 0.0)),
            difference=_bound(row.difference, 0.0),
        )
        for row in rows
    ]


def _bound(error: float, least: float) -> float:
    at_least = max(error, least)
    if not 0.0 < at_least < math.inf:
        return at_least
    return 10.0 ** math.ceil(math.log10(at_least))


def _table(rows: Sequence[Any], kind: type) -> pd.DataFrame:
    columns = [column.name for column in fields(kind)]
    cells = [[getattr(row, column) for column in columns] for row in rows]
    frame = pd.DataFrame(cells, columns=columns)
    keys = [key for key in KEYS if key in columns]
    return frame.sort_values(keys, kind="stable", ignore_index=True)


def write(frames: Mapping[str, pd.DataFrame], folder: Path, *, overwrite: bool = False) -> None:
    """Replaces all files together or none of them. Raises OSError: then none.

    overwrite: also what is no report; else that is a FileExistsError.

    Beside them runs.csv counts their rows and names the run by its content, so that a cut file can
    be told, and files of two runs.
    """
    unasked(folder, [*frames, run_list.NAME], overwrite=overwrite)
    replace(folder, lambda: texts(frames, folder))


def advice(rows: Sequence[Advice], folder: Path, *, overwrite: bool = False) -> None:
    """Writes advice.csv, a run of its own: its search asks nothing of the other reports."""
    write({ADVICE: _table(rows, Advice)}, folder, overwrite=overwrite)


def texts(frames: Mapping[str, pd.DataFrame], folder: Path | None = None) -> dict[str, str]:
    """Returns the text of each file by name; what else the folder's runs.csv names stays in it."""
    bodies = {
        name: _rounded(frame).to_csv(index=False, lineterminator="\n")
        for name, frame in frames.items()
    }
    tables = {name: (len(frames[name]), body) for name, body in bodies.items()}
    return bodies | {run_list.NAME: run_list.listed(tables, folder)}


def holds(frames: Mapping[str, pd.DataFrame], folder: Path) -> bool:
    """Whether the folder's reports are these."""
    wanted = texts(frames, folder)
    return all(
        (folder / name).is_file() and content(folder / name) == text
        for name, text in wanted.items()
    )


def read(path: Path, kind: type[Row]) -> list[Row]:
    """The rows of a written report.

    Raises ValueError if the file was cut, or stands beside reports of another run.
    """
    records, written = run_list.table(path), run_list.read(path.parent)
    for name in NAMES if path.name in NAMES else ():  # advice and versions are runs of their own
        other = written.get(name)
        if other is not None and other.run != written[path.name].run:
            raise ValueError(f"{path}: of another run than {name} beside it: run both again")
    numbers = {column.name for column in fields(kind) if "float" in str(column.type)}
    counts = {column.name for column in fields(kind) if column.type is int}
    columns = [column.name for column in fields(kind)]
    if lacking := [name for name in columns if records and name not in records[0]]:
        raise ValueError(f"{path}: has no column {lacking[0]!r}: of another version of textmech?")
    rows: list[Row] = []
    for record in records:
        values: dict[str, Any] = {name: record[name] for name in columns}
        values |= {name: _number(values[name]) for name in numbers}
        values |= {name: int(values[name]) for name in counts}
        rows.append(kind(**values))
    return rows


def _number(text: str) -> Any:
    return float(text) if text else None


def _rounded(frame: pd.DataFrame) -> pd.DataFrame:
    """Formats numbers with three significant digits; what is not known is empty."""
    out = frame.copy()
    for name in out.select_dtypes(include=[np.number]).columns:
        digits = TIMES if name in ("time", "when", "k") else NUMBERS
        out[name] = ["" if pd.isna(x) else format(x, digits) for x in out[name]]
    return out.fillna("")
