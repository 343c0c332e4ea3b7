"""The reports as tables and as CSV files: sorted, counted, and replaced all together."""

import os
import shutil
import tempfile
from collections.abc import Sequence
from dataclasses import asdict, fields
from pathlib import Path

import numpy as np
import pandas as pd

from cases.case import Case
from reports.coverage import coverage
from reports.row import Certificate, Comparison, Rungs
from reports.suite import Report

HERE = Path(__file__).parent
KEYS = ("case", "engine", "setting", "realised", "ladder", "quantity", "check")
NUMBERS = ".3g"  # three digits: more would be noise from one machine to the next


def tables(report: Report, cases: Sequence[Case]) -> dict[str, pd.DataFrame]:
    """Each report by its file name."""
    return {
        "tolerance.csv": _table(report.comparisons, Comparison),
        "convergence.csv": _table(report.rungs, Rungs),
        "reference.csv": _table(report.certificates, Certificate),
        "coverage.csv": coverage(cases, report.equations),
    }


def _table(rows: Sequence, kind: type) -> pd.DataFrame:
    columns = [column.name for column in fields(kind)]
    frame = pd.DataFrame([asdict(row) for row in rows], columns=columns)
    keys = [key for key in KEYS if key in columns]
    return frame.sort_values(keys, kind="stable", ignore_index=True)


def write(frames: dict[str, pd.DataFrame], folder: Path) -> None:
    """Writes all files beside the old ones, then renames them: an interruption leaves the old.

    The last line of each file counts its rows, so that a cut file can be told.
    """
    folder.mkdir(parents=True, exist_ok=True)
    new = Path(tempfile.mkdtemp(prefix=".writing-", dir=folder))
    try:
        for name, frame in frames.items():
            text = rounded(frame).to_csv(index=False, lineterminator="\n")
            (new / name).write_text(f"{text}# {len(frame)} rows\n", encoding="utf-8")
        for name in frames:
            os.replace(new / name, folder / name)
    finally:
        shutil.rmtree(new, ignore_errors=True)


def read(path: Path) -> pd.DataFrame:
    """A written report, as text. Raises ValueError if it was cut."""
    *lines, footer = path.read_text(encoding="utf-8").splitlines()
    frame = pd.read_csv(path, dtype=str, comment="#", keep_default_na=False)
    if footer != f"# {len(frame)} rows":
        raise ValueError(f"{path}: cut or changed by hand: it ends in {footer!r}")
    return frame


def rounded(frame: pd.DataFrame) -> pd.DataFrame:
    """Numbers as text with three significant digits; what is not known is empty."""
    out = frame.copy()
    for name in out.select_dtypes(include=[np.number]).columns:
        out[name] = ["" if pd.isna(x) else format(x, NUMBERS) for x in out[name]]
    return out.fillna("")


def keep(report: Report, folder: Path) -> None:
    """One CSV a case: times, the reference, and every engine side by side, in full precision."""
    folder.mkdir(parents=True, exist_ok=True)
    columns: dict[str, dict[str, np.ndarray]] = {}
    for trial, outcome in report.trials:
        kept = columns.setdefault(trial.case.name, {"t": trial.case.times})
        engine = f"{trial.engine.name}.{trial.engine.setting}.{trial.realised}"
        for name in trial.case.allow:
            kept[f"{name} reference"] = trial.wanted(name)
            if name in outcome.samples:
                kept[f"{name} {engine}"] = outcome.samples[name]
    for case, kept in columns.items():
        order = ["t", *sorted(set(kept) - {"t"}, key=lambda c: (c.split()[0], "reference" not in c))]
        pd.DataFrame(kept)[order].to_csv(folder / f"{case}.csv", index=False)
