"""The motions behind the rows, for looking and plotting: three files a case, in full precision."""

from collections.abc import Iterator, Sequence
from dataclasses import asdict
from importlib.util import find_spec
from io import BytesIO
from pathlib import Path

import numpy as np
import pandas as pd

from ...cases.case import Case
from ...cases.mistake import CaseError, Mistake
from ...cases.scene.difference import deviation
from ...cases.scene.frame import PLANE, SPACE
from ...cases.scene.observe import observe
from ...cases.scene.states import MASS_MATRIX
from ...cases.trajectory import Array
from ..compare.trial.run import Samples
from ..tables.ownership import unasked
from ..tables.replace import replace
from .suite import Report

INSTANTS = 12  # decimals of a second: samples of two grids that are the same


def names(cases: Sequence[Case]) -> list[str]:
    """The files of the cases. Raises CaseError where two cases would have one."""
    by_file: dict[str, Case] = {}
    for case in cases:
        ends = ["csv", "events.csv"]
        ends += [f"poses.{ending()}"] if case.states is None else []
        for file in (f"{case.name}.{end}" for end in ends):
            if (other := by_file.setdefault(file, case)) is not case:
                what = f"{file} would be kept of {other.name!r} and of {case.name!r}: rename one"
                raise CaseError([Mistake(case.source.file, 0, 0, "--keep", what)])
    return [*by_file]


def keep(report: Report, folder: Path, *, overwrite: bool = False) -> None:
    """`<case>.csv`: times, each observed quantity of the reference and of every engine side by
    side, and the reference's poses. `<case>.events.csv`: the times of all events.
    `<case>.poses.csv`, or `.parquet` where pyarrow is installed: where every body is, in the
    reference and in every run, one number a row.

    overwrite: also what was not kept here. Raises OSError: then the folder holds what it held.
    """
    files: dict[str, str | bytes] = {}
    for case in report.cases:
        if case.name in report.solutions:
            files[f"{case.name}.csv"] = _motions(report, case).to_csv(index=False)
            files[f"{case.name}.events.csv"] = _events(report, case).to_csv(index=False)
            if case.states is None:
                files[f"{case.name}.poses.{ending()}"] = filed(poses(report, case))
    names(report.cases)  # or one case's motions would be lost in another's
    unasked(folder, files, overwrite=overwrite)
    replace(folder, files)


def _motions(report: Report, case: Case) -> pd.DataFrame:
    reference = report.solutions[case.name].trajectory
    here = np.round(case.times, INSTANTS)
    columns: dict[str, pd.Series] = {}
    known = case.quantities
    for name in (name for name in case.allow if name in known and name != MASS_MATRIX):
        unit = known[name].unit
        columns[f"{name} [{unit}] reference"] = pd.Series(
            _angles(observe(case.scene, reference, name)), here
        )
        for run in report.tried:
            engine = run.pair.engine
            if run.pair.case.name == case.name and name in run.outcome.samples:
                label = f"{engine.name}.{engine.setting}.{run.realised}"
                times = np.round(run.pair.sampled.times, INSTANTS)  # its own step's, if it has one
                samples = run.outcome.samples[name]
                if samples.ndim > 1:  # an attitude: by how much it is off the reference
                    label, samples = f"{label} off", np.linalg.norm(samples, axis=1)
                columns[f"{name} [{unit}] {label}"] = pd.Series(samples, times)
    for body, states in reference.states.items():
        for field, unit, column in COLUMNS[case.scene.frame]:
            values = pd.Series(states[:, column], here)
            columns.setdefault(f"{body}.{field} [{unit}] reference", values)
    head = "t [s]" if case.states is None else "state"
    return pd.DataFrame(columns).rename_axis(head).reset_index()


def _angles(samples: Array) -> Array:
    """Returns numbers as they are, and of an attitude the angle from its first."""
    return samples if samples.ndim == 1 else deviation(samples, samples[:1])


def _events(report: Report, case: Case) -> pd.DataFrame:
    columns = ["engine", "setting", "realised", "event", "k", "time", "difference"]
    rows = [asdict(instant) for instant in report.instants if instant.case == case.name]
    frame = pd.DataFrame(rows, columns=columns)
    return frame.rename(columns={"time": "time [s]", "difference": "difference [s]"})


# Where every body is, as a long table: one number a row, with its unit.


COLUMNS = {
    PLANE: [("x", "m", 0), ("y", "m", 1), ("angle", "rad", 2)],
    SPACE: [*zip("xyz", "mmm", range(3), strict=True)]
    + [(f"quaternion_{part}", "1", 3 + i) for i, part in enumerate("wxyz")],
}
"""What is told of every body, with its unit and its column."""
HEAD = ["engine", "setting", "realised", "body", "field", "unit", "t [s]", "value"]


def poses(report: Report, case: Case) -> pd.DataFrame:
    """Returns the poses of a case's bodies: of the reference, and of every run that has samples.

    The reference is called `reference`, without a setting.
    """
    reference = report.solutions[case.name].trajectory.states
    parts = list(_pose_rows(("reference", "", ""), case, case.times, reference))
    for run in report.tried:
        if run.pair.case.name == case.name:
            who = (run.pair.engine.name, run.pair.engine.setting, run.realised)
            parts += _pose_rows(who, case, run.pair.sampled.times, run.outcome.samples)
    return pd.concat(parts, ignore_index=True)[HEAD]


def ending() -> str:
    """Returns the ending of the file of poses: Parquet where pyarrow is installed, else CSV."""
    return "csv" if find_spec("pyarrow") is None else "parquet"


def filed(frame: pd.DataFrame) -> str | bytes:
    """Returns the content of the file of poses: the bytes of Parquet, or the text of CSV."""
    if ending() == "csv":
        return frame.to_csv(index=False)
    out = BytesIO()
    frame.to_parquet(out, index=False)
    return out.getvalue()


def _pose_rows(
    who: tuple[str, str, str], case: Case, times: Array, samples: Samples
) -> Iterator[pd.DataFrame]:
    for body in case.scene.bodies:
        for field, unit, column in COLUMNS[case.scene.frame] if body in samples else ():
            labels = dict(zip(HEAD, (*who, body, field, unit), strict=False))
            yield pd.DataFrame({**labels, "t [s]": times, "value": samples[body][:, column]})
