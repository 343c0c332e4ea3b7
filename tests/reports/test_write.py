"""Reports are whole or old: never half, never unsorted, never uncounted."""

import re
import shutil
from dataclasses import replace
from math import inf
from pathlib import Path

import pandas as pd
import pytest
from given.otherwise import otherwise
from given.report_folders import STEPS, report

from textmech.reports.batch.suite import Report
from textmech.reports.data import runs
from textmech.reports.data.row import Comparison, Instant, StepError
from textmech.reports.output import write

ROW = Comparison(
    case="b", theme="pins", source="(2.1)", engine="mujoco", version="4.0.0", setting="tuned",
    realised="native", protocol="", quantity="bar.angle", unit="rad", step=1e-3,
    error=1.23456e-9, when=0.4515, rms=None, final=0.0, allowed=1e-2, ratio=1.23456e-7,
    verdict="agrees", because="a, b \"c\"",
)  # fmt: skip

NUMBER = r"[-+]?(\d+\.?\d*(e[-+]?\d+)?|inf|nan)"


def frames(*rows: Comparison) -> dict[str, pd.DataFrame]:
    return write.tables(Report(comparisons=list(rows)), [])


def test_what_is_written_is_read_back(tmp_path: Path) -> None:
    write.write(frames(ROW), tmp_path)
    (row,) = write.read(tmp_path / "tolerance.csv", Comparison)
    assert (row.error, row.rms, row.because) == (1.23e-9, None, ROW.because)
    assert sorted(p.name for p in tmp_path.iterdir()) == [
        "causes.csv", "convergence.csv", "coverage.csv", "events.csv", "reference.csv", "runs.csv",
        "steps.csv", "tolerance.csv",
    ]  # fmt: skip


def test_rows_are_sorted(tmp_path: Path) -> None:
    first = replace(ROW, case="a")
    write.write(frames(ROW, first), tmp_path)
    rows = write.read(tmp_path / "tolerance.csv", Comparison)
    assert [row.case for row in rows] == ["a", "b"]


def test_a_cut_file_is_told(tmp_path: Path) -> None:
    write.write(frames(ROW, ROW), tmp_path)
    file = tmp_path / "tolerance.csv"
    lines = file.read_text().splitlines(keepends=True)
    file.write_text("".join(lines[:2]))
    with pytest.raises(ValueError, match="cut"):
        write.read(file, Comparison)


def test_files_of_two_runs_are_told(tmp_path: Path) -> None:
    write.write(frames(ROW), tmp_path)
    write.write({"events.csv": frames()["events.csv"]}, tmp_path)
    with pytest.raises(ValueError, match=r"another run than events\.csv"):
        write.read(tmp_path / "tolerance.csv", Comparison)


@pytest.mark.mutant("a table that another run wrote, or a hand, is believed")
def test_a_table_in_anothers_place_is_told(tmp_path: Path) -> None:
    write.write(frames(ROW), tmp_path / "one")
    write.write(frames(replace(ROW, case="a")), tmp_path / "other")
    file = tmp_path / "other" / "tolerance.csv"
    shutil.copy(tmp_path / "one" / "tolerance.csv", file)
    with pytest.raises(ValueError, match="changed by hand, or of another run"):
        write.read(file, Comparison)
    text = file.read_text(encoding="utf-8")
    blind = otherwise(runs, "if digest(text) != known.content:", "if False:")
    assert blind.doubt(file.name, 1, text, runs.read(file.parent)) == ""


def test_other_runs_stay_in_the_list_of_a_folder(tmp_path: Path) -> None:
    write.write(frames(ROW), tmp_path)
    write.write({"more.csv": pd.DataFrame({"a": [1]})}, tmp_path)
    assert set(runs.read(tmp_path)) == {*write.NAMES, "more.csv"}
    assert runs.read(tmp_path)["more.csv"].run != runs.read(tmp_path)["events.csv"].run
    assert write.read(tmp_path / "tolerance.csv", Comparison)


def test_any_program_reads_the_tables_as_they_are(tmp_path: Path) -> None:
    write.write(frames(ROW, replace(ROW, case="c")), tmp_path)
    frame = pd.read_csv(tmp_path / "tolerance.csv")
    assert frame["case"].tolist() == ["b", "c"]
    assert frame["error"].dtype == frame["allowed"].dtype == float


def test_the_same_run_has_the_same_name(tmp_path: Path) -> None:
    one, same, other = (write.texts(frames(*rows)) for rows in ([ROW], [ROW], [ROW, ROW]))
    assert one == same
    assert one["runs.csv"] != other["runs.csv"]
    assert one["events.csv"] == other["events.csv"]  # it holds the same rows, none


def test_a_name_may_begin_like_a_comment(tmp_path: Path) -> None:
    write.write(frames(replace(ROW, case="#b")), tmp_path)
    (row,) = write.read(tmp_path / "tolerance.csv", Comparison)
    assert row.case == "#b"


def test_an_interrupted_run_leaves_the_old_reports_whole(tmp_path: Path, monkeypatch) -> None:
    write.write(frames(ROW), tmp_path)
    before = {p.name: p.read_bytes() for p in tmp_path.iterdir()}

    def interrupt(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(pd.DataFrame, "to_csv", interrupt)
    with pytest.raises(KeyboardInterrupt):
        write.write(frames(), tmp_path)
    assert {p.name: p.read_bytes() for p in tmp_path.iterdir()} == before


def test_steps_are_numbers_to_any_program(tmp_path: Path) -> None:
    """One in a cell: of a ladder a row for each, the smallest first; inf where a count is off."""
    steps = [*STEPS, replace(STEPS[1], step=4e-3, error=inf)]
    others = [replace(step, quantity="a") for step in steps]
    found = pd.read_csv(report(tmp_path, steps=steps + others) / "steps.csv")
    assert found[["step", "error"]].dtypes.tolist() == [float, float]
    assert found.quantity.tolist() == 3 * ["a"] + 3 * ["bar.angle"]
    assert found.step.tolist() == 2 * [1e-3, 2e-3, 4e-3]
    assert found.error.tolist() == 2 * [1e-3, 2e-3, inf]
    assert write.read(tmp_path / "steps.csv", StepError) == others + steps


@pytest.mark.slow
def test_no_cell_of_the_committed_tables_holds_two_numbers() -> None:
    def crowded(table: pd.DataFrame) -> list[str]:
        return [str(name) for name in table if table[name].map(_several).any()]

    tables = {file.name: pd.read_csv(file, dtype=str) for file in write.HERE.glob("*.csv")}
    assert len(tables) > 10
    assert {name: found for name, one in tables.items() if (found := crowded(one))} == {}
    assert crowded(pd.DataFrame({"steps": ["0.001 0.002"], "unit": ["kg m"]})) == ["steps"]


def _several(cell: object) -> bool:
    parts = str(cell).split()
    return len(parts) > 1 and all(re.fullmatch(NUMBER, part) for part in parts)


def test_instants_are_sorted_counted_and_read_back(tmp_path: Path) -> None:
    rows = [
        Instant(
            "a", "mujoco", "4.0.0", "tuned", "native", "slips", k, 1.5 * k, None if k > 9 else 0.0
        )
        for k in (10, 9)
    ]
    rows.append(Instant("a", "mujoco", "4.0.0", "tuned", "law", "slips", 1, 1.23456789e-3, 1e-9))
    write.write(write.tables(Report(instants=rows), []), tmp_path)
    assert runs.read(tmp_path)["events.csv"].rows == 3
    found = write.read(tmp_path / "events.csv", Instant)
    assert [(i.realised, i.k) for i in found] == [("law", 1), ("native", 9), ("native", 10)]
    assert [i.difference for i in found] == [1e-9, 0.0, None]
    assert found[0].time == 1.23456789e-3
