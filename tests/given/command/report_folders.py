"""Small report folders, written as a run writes them, and what an accident does to their files."""

from collections.abc import Callable, Mapping
from pathlib import Path

import pandas as pd

from textmech.reports.runs.suite import Report
from textmech.reports.tables import write
from textmech.reports.tables.row import Cause, Certificate, Comparison, Instant, Rungs, StepError

ROW = Comparison(
    case="swing", theme="pins", source="(2.44)", engine="mujoco", version="4.0.0", setting="tuned",
    realised="native", protocol="", quantity="bar.angle", unit="rad", step=1e-3,
    error=2e-3, when=0.4, rms=1e-3, final=1e-3, allowed=1e-2, ratio=0.2,
    verdict="agrees", because="",
)  # fmt: skip
RUNGS = Rungs(
    case="swing", engine="mujoco", version="4.0.0", setting="tuned", realised="native",
    ladder="held", quantity="bar.angle", unit="rad",
    order=1.0, order_low=0.9, order_high=1.1, limit=1e-9, uncertainty=1e-6, usable_step=2e-3,
    verdict="converges",
)  # fmt: skip
STEPS = [
    StepError("swing", "mujoco", "tuned", "native", "held", "bar.angle", "rad", 1e-3, 1e-3),
    StepError("swing", "mujoco", "tuned", "native", "held", "bar.angle", "rad", 2e-3, 2e-3),
]
INSTANT = Instant("swing", "mujoco", "4.0.0", "tuned", "native", "stops", 1, 0.451600756, 1e-9)
CERTIFICATE = Certificate("swing", "(2.44)", "pendulum", "drift", 1e-14, 1e-9, 1e-12, "m", "holds")
COVERED = pd.DataFrame(
    [("equation", "(2.44)", "other swing", ""), ("equation", "(2.45)", "", "photograph")],
    columns=["kind", "number", "cases", "otherwise"],
)


def report(
    folder: Path,
    rows: list[Comparison] | None = None,
    rungs: list[Rungs] | None = None,
    steps: list[StepError] | None = None,
    instants: list[Instant] | None = None,
    certificates: list[Certificate] | None = None,
    causes: list[Cause] | None = None,
    covered: pd.DataFrame = COVERED,
    further: Mapping[str, pd.DataFrame] | None = None,
) -> Path:
    """A whole folder of one run; what is not given is one row a file."""
    told = Report(
        comparisons=[ROW] if rows is None else rows,
        rungs=[RUNGS] if rungs is None else rungs,
        steps=STEPS if steps is None else steps,
        instants=[INSTANT] if instants is None else instants,
        certificates=[CERTIFICATE] if certificates is None else certificates,
        causes=causes or [],
    )
    frames = write.tables(told, [])
    write.write({**frames, "coverage.csv": covered, **(further or {})}, folder)
    return folder


def damaged(folder: Path, name: str, change: Callable[[str], str]) -> Path:
    """The folder, with the text of one file changed behind its back."""
    file = folder / name
    with file.open(encoding="utf-8", newline="") as opened:
        text = opened.read()
    file.write_text(change(text), encoding="utf-8", newline="")
    return folder
