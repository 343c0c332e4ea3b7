"""The motions behind the rows, one CSV a case, for looking and plotting."""

from pathlib import Path

import numpy as np
import pandas as pd

from ..cases.quantity import table
from .suite import Report

INSTANTS = 12  # decimals of a second: samples of two grids that are the same


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
