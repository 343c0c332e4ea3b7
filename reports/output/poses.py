"""Where every body is, as a long table: one number a row, with its unit."""

from collections.abc import Iterator
from importlib.util import find_spec
from io import BytesIO

import pandas as pd

from ...cases.case import Case
from ...cases.scene.frame import PLANE, SPACE
from ...cases.trajectory import Array
from ..batch.suite import Report
from ..compare.trial.run import Samples, sample_columns

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
    reference = sample_columns(report.solutions[case.name].trajectory)
    parts = list(_rows(("reference", "", ""), case, case.times, reference))
    for one in report.tried:
        if one.pair.case.name == case.name:
            who = (one.pair.engine.name, one.pair.engine.setting, one.realised)
            parts += _rows(who, case, one.pair.sampled.times, one.outcome.samples)
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


def _rows(
    who: tuple[str, str, str], case: Case, times: Array, samples: Samples
) -> Iterator[pd.DataFrame]:
    for body in case.scene.bodies:
        for field, unit, column in COLUMNS[case.scene.frame] if body in samples else ():
            told = dict(zip(HEAD, (*who, body, field, unit), strict=False))
            yield pd.DataFrame({**told, "t [s]": times, "value": samples[body][:, column]})
