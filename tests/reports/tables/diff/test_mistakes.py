"""What is no report is told with its place, and what would be right; it is never compared."""

import json
import os
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pandas as pd
import pytest
from given.command import textmech
from given.command.report_folders import COVERED, ROW, RUNGS, damaged, report
from given.scenes.damage import damaged as accidents
from hypothesis import given, settings
from hypothesis import strategies as st

from textmech.reports.tables import file_content, run_list
from textmech.reports.tables.diff.columns import OF_A_RUN

NAME = "tolerance.csv"


@pytest.fixture
def old(tmp_path: Path) -> Path:
    return report(tmp_path / "old")


@pytest.fixture
def new(tmp_path: Path) -> Path:
    return report(tmp_path / "new", rows=[replace(ROW, case=c) for c in ("swing", "top")])


def said(old: Path, new: Path) -> str:
    done = textmech("diff", old, new)
    assert (done.returncode, done.stdout) == (2, "")
    return done.stderr


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda text: "", "cut, or changed by hand: 0 rows, and runs.csv says 2"),
        (lambda text: text.rsplit("\n", 2)[0] + "\n", "cut, or changed by hand: 1 rows, and"),
        (lambda text: text.replace("swing", "swims"), "changed by hand, or of another run"),
        (lambda text: text.replace("allowed", "allow", 1), "changed by hand, or of another run"),
        (lambda text: text.replace("swing,", '"swing,'), "is no CSV"),
        (lambda text: text.replace("(2.44)", "x" * 200_000), "field larger than"),
    ],
)
def test_a_file_that_is_not_as_a_run_wrote_it(
    old: Path, new: Path, change: Callable[[str], str], message: str
) -> None:
    err = said(old, damaged(new, NAME, change))
    assert message in err
    assert NAME in err


def test_a_table_of_another_version_is_refused(old: Path, tmp_path: Path) -> None:
    """Verdicts of several words, as convergence.csv had them, are not taken for a change."""
    worded = replace(RUNGS, verdict="converges to the textbook")
    rungs = [worded, replace(worded, quantity="bar.omega")]
    err = said(old, report(tmp_path / "words", rungs=rungs))
    assert "'converges to the textbook' is no verdict: of another version of textmech?" in err
    assert err.count("is no verdict") == 1
    lacking = COVERED.drop(columns="otherwise")
    err = said(old, report(tmp_path / "columns", covered=lacking))
    assert "coverage.csv: has no column 'otherwise': of another version of textmech?" in err
    wrong = replace(ROW, allowed="one")  # type: ignore[arg-type]
    err = said(old, report(tmp_path / "cells", rows=[wrong]))
    assert "tolerance.csv: allowed: should be a number or nothing, is 'one'" in err


def test_all_mistakes_of_both_folders_are_told_at_once(old: Path, new: Path) -> None:
    damaged(old, "events.csv", lambda text: text[:40])
    damaged(new, NAME, lambda text: text.replace("agrees", "?"))
    err = said(old, new)
    assert "2 mistakes" in err
    assert str(old / "events.csv") in err
    assert str(new / NAME) in err


def test_files_of_two_runs_are_not_compared(old: Path, new: Path) -> None:
    run = run_list.read(new)["events.csv"].run
    damaged(
        new, run_list.NAME, lambda text: text.replace(f"events.csv,1,{run}", "events.csv,1,abc")
    )
    assert "events.csv: of run abc, and tolerance.csv beside it" in said(old, new)


@pytest.mark.mutant("a folder without one of its tables is compared")
@pytest.mark.parametrize("lost", ["steps.csv", "convergence.csv", "events.csv"])
def test_a_folder_that_was_cut_is_not_compared(lost: str, old: Path, new: Path) -> None:
    (new / lost).unlink()
    what = f"{lost}: is not there, and runs.csv names it: the folder was cut; run it again"
    assert what in said(old, new)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda text: "", "should be"),
        (lambda text: text.replace("rows", "row", 1), "its first line should be file,rows,run"),
        (lambda text: text.replace(",1,", ",one,"), "runs.csv: line 3: should be a file"),
        (lambda text: text.replace(",1,", f",{'9' * 5000},"), "should be a file, a count"),
        (lambda text: text.replace("tolerance", "t"), "tolerance.csv: no run has written it"),
        (lambda text: text.replace("events.csv", '"events'), "is no CSV"),
        (lambda text: text + "\xff" * 3, "should be a file"),
    ],
)
def test_a_list_that_is_none(
    old: Path, new: Path, change: Callable[[str], str], message: str
) -> None:
    assert message in said(old, damaged(new, run_list.NAME, change))


def test_a_folder_without_the_list_cannot_be_told_to_be_whole(old: Path, new: Path) -> None:
    (new / run_list.NAME).unlink()
    assert "tells whether the others are whole" in said(old, new)
    os.mkfifo(new / run_list.NAME)
    assert "is no file" in said(old, new)


@pytest.mark.parametrize(
    ("place", "message"),
    [
        ("nowhere", "no such folder"),
        ("old/tolerance.csv", "is no folder"),
        ("empty", "is no report: it has no tolerance.csv; `textmech run --out folder`"),
        ("", "is no report"),
        ("old", "are one folder"),
        ("old/../old", "are one folder"),
        ("a" * 300, "name too long"),
    ],
)
def test_a_place_that_holds_no_report(
    old: Path, tmp_path: Path, place: str, message: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "empty").mkdir()
    monkeypatch.chdir(tmp_path)
    assert message in said(old, Path(place)).lower()


@pytest.mark.parametrize(
    "words", [["--moved", "nan"], ["--moved", "-1"], ["--worse", "0.5"], ["--floor", "inf"],
              ["--matters", "x"], [], ["a", "b", "c"]]
)  # fmt: skip
def test_words_that_make_no_sense(words: list[str]) -> None:
    done = textmech("diff", *words)
    assert done.returncode == 2
    assert "should be a number of at least" in done.stderr or "one folder or two" in done.stderr


def test_bytes_that_are_no_text(old: Path, new: Path) -> None:
    (new / NAME).write_bytes(b"\xff\xfe" + (new / NAME).read_bytes())
    assert "is no text in UTF-8: byte 0" in said(old, new)


def test_a_file_that_is_far_too_large_is_not_read(
    old: Path, new: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = file_content.text
    monkeypatch.setattr(file_content, "text", lambda path: text(path, most=100))
    assert "is too large: 0 MB" in said(old, new)


def test_a_pipe_is_no_file(old: Path, new: Path) -> None:
    (new / NAME).unlink()
    os.mkfifo(new / NAME)
    assert "is no file" in said(old, new)


def test_a_table_that_an_editor_saved_is_read(old: Path, tmp_path: Path) -> None:
    """With a mark of its order of bytes, and lines that end as on Windows."""
    other = report(tmp_path / "other")
    for file in other.glob("*.csv"):
        damaged(other, file.name, lambda text: "\ufeff" + text.replace("\n", "\r\n"))
    done = textmech("diff", old, other)
    assert done.returncode == 0, done.stderr
    assert "nothing changed" in done.stdout


def test_names_of_any_letters_are_compared_and_steer_no_terminal(tmp_path: Path) -> None:
    name = 'Ωmega\u2028\u0085 | `<b>` \033[31m"x",\ny'
    for folder, largest in (("old", 1e-3), ("new", 9e-3)):
        report(tmp_path / folder, rows=[replace(ROW, quantity=name, error=largest)])
    done = textmech("diff", tmp_path / "old", tmp_path / "new")
    assert done.returncode == 1
    assert "1 regression" in done.stdout
    assert "\033" not in done.stdout


@pytest.fixture(scope="module")
def pair(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Path]:
    """Two sound folders that differ."""
    new = [ROW, replace(ROW, case="a, b", quantity="Ω")]
    return (
        report(tmp_path_factory.mktemp("old"), covered=COVERED.assign(otherwise="x")),
        report(tmp_path_factory.mktemp("new"), rows=new),
    )


@pytest.mark.slow
@settings(max_examples=100, deadline=None)
@given(data=st.data())
def test_no_accident_ends_in_a_traceback(pair: tuple[Path, Path], data: st.DataObject) -> None:
    file = pair[1] / data.draw(st.sampled_from([*sorted(OF_A_RUN), run_list.NAME]))
    sound = file.read_text(encoding="utf-8")
    try:
        file.write_bytes(data.draw(accidents([sound])))
        done = textmech("diff", *data.draw(st.permutations(pair)), "--json")
    finally:
        file.write_text(sound, encoding="utf-8")
    document = json.loads(done.stdout)
    assert document["exit_code"] == done.returncode
    assert bool(document["mistakes"]) == (done.returncode == 2)


def test_a_table_without_rows_has_nothing_to_compare(old: Path, tmp_path: Path) -> None:
    empty = report(tmp_path / "empty", rows=[], covered=pd.DataFrame(columns=COVERED.columns))
    assert "no case is in both folders" in said(old, empty)
