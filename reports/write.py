"""The reports as tables and as CSV files: sorted, counted, and replaced all together."""

import os
import shutil
import tempfile
from collections.abc import Mapping, Sequence
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
import pandas as pd

from ..cases.case import Case
from ..cases.quantity import table
from .coverage import coverage
from .row import Certificate, Comparison, Instant, Rungs
from .suite import Report

HERE = Path(__file__).parent
INSTANTS = 12  # decimals of a second: samples of two grids that are the same
ELSEWHERE = Path("textmech-reports")
KEYS = ("case", "engine", "setting", "realised", "ladder", "quantity", "check", "event", "k")
NUMBERS = ".3g"  # three digits: more would be noise from one machine to the next
TIMES = ".9g"  # of an event's time: its difference is a thousandth of a step

Row = TypeVar("Row", Comparison, Rungs, Certificate, Instant)


def by_default() -> Path:
    """Where a full run writes: the committed reports of a checkout, else the user's own folder."""
    return HERE if (HERE.parent / "pyproject.toml").is_file() else ELSEWHERE


def tables(report: Report, cases: Sequence[Case]) -> dict[str, pd.DataFrame]:
    """Each report by its file name."""
    return {
        "tolerance.csv": _table(report.comparisons, Comparison),
        "convergence.csv": _table(report.rungs, Rungs),
        "events.csv": _table(report.instants, Instant),
        "reference.csv": _table(report.certificates, Certificate),
        "coverage.csv": coverage(cases, report.equations),
    }


def _table(rows: Sequence[Any], kind: type) -> pd.DataFrame:
    columns = [column.name for column in fields(kind)]
    frame = pd.DataFrame([asdict(row) for row in rows], columns=columns)
    keys = [key for key in KEYS if key in columns]
    return frame.sort_values(keys, kind="stable", ignore_index=True)


def write(frames: Mapping[str, pd.DataFrame], folder: Path) -> None:
    """Writes all files beside the old ones, then renames them: an interruption leaves the old.

    The last line of each file counts its rows, so that a cut file can be told.
    """
    folder.mkdir(parents=True, exist_ok=True)
    new = Path(tempfile.mkdtemp(prefix=".writing-", dir=folder))
    try:
        for name, frame in frames.items():
            text = _rounded(frame).to_csv(index=False, lineterminator="\n")
            (new / name).write_text(f"{text}# {len(frame)} rows\n", encoding="utf-8")
        for name in frames:
            os.replace(new / name, folder / name)
    finally:
        shutil.rmtree(new, ignore_errors=True)


def read(path: Path, kind: type[Row]) -> list[Row]:
    """The rows of a written report. Raises ValueError if the file was cut."""
    footer = path.read_text(encoding="utf-8").splitlines()[-1]
    frame = pd.read_csv(path, dtype=str, comment="#", keep_default_na=False)
    if footer != f"# {len(frame)} rows":
        raise ValueError(f"{path}: cut, or changed by hand: it ends in {footer!r}")
    numbers = {column.name for column in fields(kind) if "float" in str(column.type)}
    counts = {column.name for column in fields(kind) if column.type is int}
    rows: list[Row] = []
    for record in frame.to_dict("records"):
        values: dict[str, Any] = {str(name): text for name, text in record.items()}
        values |= {name: _number(values[name]) for name in numbers}
        values |= {name: int(values[name]) for name in counts}
        rows.append(kind(**values))
    return rows


def _number(text: str) -> Any:
    return float(text) if text else None


def _rounded(frame: pd.DataFrame) -> pd.DataFrame:
    """Numbers as text with three significant digits; what is not known is empty."""
    out = frame.copy()
    for name in out.select_dtypes(include=[np.number]).columns:
        digits = TIMES if name in ("time", "when", "k") else NUMBERS
        out[name] = ["" if pd.isna(x) else format(x, digits) for x in out[name]]
    return out.fillna("")


def keep(report: Report, folder: Path) -> None:
    """One CSV a case: times, and each quantity of the reference and of every engine, side by side.

    In full precision: these files are for looking and plotting, and are not committed.
    """
    folder.mkdir(parents=True, exist_ok=True)
    for case in {trial.case.name: trial.case for trial, _ in report.trials}.values():
        columns: dict[str, pd.Series] = {}
        trials = [(t, outcome) for t, outcome in report.trials if t.case.name == case.name]
        for name in (name for name in case.allow if name in table(case.scene)):
            for trial, outcome in trials:
                times = np.round(trial.case.times, INSTANTS)
                columns[f"{name} reference"] = pd.Series(trial.wanted(name), times).combine_first(
                    columns.get(f"{name} reference", pd.Series(dtype=float))
                )
                if name in outcome.samples:
                    engine = f"{trial.engine.name}.{trial.engine.setting}.{trial.realised}"
                    columns[f"{name} {engine}"] = pd.Series(outcome.samples[name], times)
        pd.DataFrame(columns).to_csv(folder / f"{case.name}.csv", index_label="t")
