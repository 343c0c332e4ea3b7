"""Reports are whole or old: never half, never unsorted, never uncounted."""

from pathlib import Path

import pandas as pd
import pytest

from reports import write
from reports.row import Comparison
from reports.suite import Report

ROW = Comparison(
    case="b", source="(2.1)", engine="mujoco", version="4.0.0", setting="tuned",
    realised="native", protocol="", quantity="bar.angle", unit="rad", step=1e-3,
    largest=1.23456e-9, rms=None, final=0.0, allowed=1e-2, ratio=1.23456e-7,
    verdict="agrees", because="a, b \"c\"",
)  # fmt: skip


def frames(*rows: Comparison) -> dict[str, pd.DataFrame]:
    return write.tables(Report(comparisons=list(rows)), [])


def test_what_is_written_is_read_back(tmp_path: Path) -> None:
    write.write(frames(ROW), tmp_path)
    (row,) = write.read(tmp_path / "tolerance.csv", Comparison)
    assert (row.largest, row.rms, row.because) == (1.23e-9, None, ROW.because)
    assert sorted(p.name for p in tmp_path.iterdir()) == [
        "convergence.csv", "coverage.csv", "reference.csv", "tolerance.csv",
    ]  # fmt: skip


def test_rows_are_sorted(tmp_path: Path) -> None:
    from dataclasses import replace

    first = replace(ROW, case="a")
    write.write(frames(ROW, first), tmp_path)
    rows = write.read(tmp_path / "tolerance.csv", Comparison)
    assert [row.case for row in rows] == ["a", "b"]


def test_a_cut_file_is_told(tmp_path: Path) -> None:
    write.write(frames(ROW, ROW), tmp_path)
    file = tmp_path / "tolerance.csv"
    lines = file.read_text().splitlines(keepends=True)
    file.write_text("".join([*lines[:2], lines[-1]]))
    with pytest.raises(ValueError, match="cut"):
        write.read(file, Comparison)


def test_an_interrupted_run_leaves_the_old_reports_whole(tmp_path: Path, monkeypatch) -> None:
    write.write(frames(ROW), tmp_path)
    before = {p.name: p.read_bytes() for p in tmp_path.iterdir()}

    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(pd.DataFrame, "to_csv", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write.write(frames(), tmp_path)
    assert {p.name: p.read_bytes() for p in tmp_path.iterdir()} == before
