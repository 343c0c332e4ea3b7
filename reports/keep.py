"""The motions behind the rows, for looking and plotting: two files a case, in full precision."""

from dataclasses import asdict
from pathlib import Path

import numpy as np
import pandas as pd

from ..cases.case import Case
from ..cases.observe import observe
from ..cases.quantity import table
from ..cases.trajectory import ANGLE, X, Y
from .replace import replace
from .suite import Report

INSTANTS = 12  # decimals of a second: samples of two grids that are the same


def keep(report: Report, folder: Path) -> None:
    """`<case>.csv`: times, each observed quantity of the reference and of every engine side by
    side, and the reference's poses. `<case>.events.csv`: the times of all events.

    Raises OSError: then the folder holds what it held.
    """
    texts: dict[str, str] = {}
    for case in report.cases:
        if case.name in report.solutions:
            texts[f"{case.name}.csv"] = _motions(report, case).to_csv(index=False)
            texts[f"{case.name}.events.csv"] = _events(report, case).to_csv(index=False)
    replace(folder, texts)


def _motions(report: Report, case: Case) -> pd.DataFrame:
    reference = report.solutions[case.name].trajectory
    here = np.round(case.times, INSTANTS)
    columns: dict[str, pd.Series] = {}
    known = table(case.scene)
    for name in (name for name in case.allow if name in known):
        unit = known[name].unit
        columns[f"{name} [{unit}] reference"] = pd.Series(
            observe(case.scene, reference, name), here
        )
        for one in report.tried:
            engine = one.pair.engine
            if one.pair.case.name == case.name and name in one.outcome.samples:
                label = f"{engine.name}.{engine.setting}.{one.realised}"
                times = np.round(one.pair.sampled.times, INSTANTS)  # its own step's, if it has one
                columns[f"{name} [{unit}] {label}"] = pd.Series(one.outcome.samples[name], times)
    for body, states in reference.states.items():
        for field, unit, column in (("x", "m", X), ("y", "m", Y), ("angle", "rad", ANGLE)):
            values = pd.Series(states[:, column], here)
            columns.setdefault(f"{body}.{field} [{unit}] reference", values)
    return pd.DataFrame(columns).rename_axis("t [s]").reset_index()


def _events(report: Report, case: Case) -> pd.DataFrame:
    told = ["engine", "setting", "realised", "event", "k", "time", "difference"]
    rows = [asdict(instant) for instant in report.instants if instant.case == case.name]
    frame = pd.DataFrame(rows, columns=told)
    return frame.rename(columns={"time": "time [s]", "difference": "difference [s]"})
