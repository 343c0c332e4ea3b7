"""A difference on the terminal, in Markdown and in JSON: the same, and never markup."""

import json
import re
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import pytest
from given.command import textmech
from given.command.report_folders import ROW, report

from textmech.reports.tables import write

WORSE = replace(ROW, error=9e-3)
FAILING = replace(ROW, quantity="bar.omega", unit="rad/s", verdict="FAILS")
SLOW = replace(ROW, setting="shipped")


@pytest.fixture
def two(tmp_path: Path) -> tuple[Path, Path]:
    sound = replace(FAILING, verdict="agrees")
    old = report(tmp_path / "old", rows=[ROW, sound, SLOW])
    return old, report(tmp_path / "new", rows=[WORSE, FAILING, replace(ROW, case="other")])


def test_the_terminal_names_each_regression_and_what_was_not_looked_at(
    two: tuple[Path, Path],
) -> None:
    done = textmech("diff", *two)
    assert done.returncode == 1
    out = done.stdout
    assert "bar.angle: agrees; 0.002 → 0.009 rad ×4.5, allowed 0.01" in out
    assert "bar.omega: agrees → FAILS; 0.002 rad/s, allowed 0.01" in out
    assert "1 row of OLD: only it has column mujoco.shipped" in " ".join(out.split())
    assert "1 row of NEW: only it has case other" in " ".join(out.split())
    assert out.splitlines()[-1] == "2 regressions"
    assert all(len(line) <= 80 for line in out.splitlines())


def test_of_many_changes_the_first_are_shown_and_all_on_request(tmp_path: Path) -> None:
    rows = [replace(ROW, quantity=f"q{i}.angle", error=1e-3 * (1 + i / 100)) for i in range(40)]
    old = report(tmp_path / "old", rows=rows)
    new = report(tmp_path / "new", rows=[replace(row, error=9e-3) for row in rows])
    first, every = (textmech("diff", old, new, *words).stdout for words in ([], ["--all"]))
    assert "and 10 more: --all shows them" in first
    assert (first.count("×"), every.count("×")) == (30, 40)


def test_json_says_it_all(two: tuple[Path, Path]) -> None:
    done = textmech("diff", *two, "--json")
    assert done.returncode == 1
    told = json.loads(done.stdout)
    assert told["counts"] == {"regression": 2, "better": 0, "changed": 0, "lost": 0, "new": 0}
    assert told["new"]["versions"] == {"mujoco": "4.0.0"}
    assert told["rows"]["tolerance.csv"] == {
        "compared": 2,
        "not looked at": [1, 1],
        "not searched by both": [0, 0],
    }
    first = told["changes"][0]
    assert (first["case"], first["column"], first["what"]) == ("swing", "mujoco.tuned", "bar.angle")
    assert (first["old"]["number"], first["new"]["number"]) == (2e-3, 9e-3)
    assert first["times"] == pytest.approx(4.5)


def test_mistakes_are_a_document_too(two: tuple[Path, Path]) -> None:
    (two[1] / "events.csv").write_text("")
    done = textmech("diff", *two, "--json")
    assert (done.returncode, done.stderr) == (2, "")
    told = json.loads(done.stdout)
    assert told["exit_code"] == 2
    assert told["mistakes"][0]["file"] == str(two[1] / "events.csv")


def test_one_document_at_a_time(two: tuple[Path, Path]) -> None:
    done = textmech("diff", *two, "--json", "--markdown")
    assert (done.returncode, done.stdout) == (2, "")
    assert "--json or --markdown" in done.stderr


def test_numbers_that_json_does_not_have_are_null(tmp_path: Path) -> None:
    old = report(tmp_path / "old", rows=[replace(ROW, error=0.0)])
    new = report(tmp_path / "new", rows=[replace(ROW, error=float("inf"), verdict="beyond")])
    told = json.loads(textmech("diff", old, new, "--json").stdout, parse_constant=pytest.fail)
    assert told["changes"][0]["new"] == {"words": "beyond", "number": None}


def test_markdown_is_a_table_of_regressions(two: tuple[Path, Path]) -> None:
    lines = textmech("diff", *two, "--markdown").stdout.splitlines()
    assert lines[0] == "### ❌ textmech: 2 regressions"
    rows = [line for line in lines if line.startswith("| swing")]
    assert len(rows) == 2
    assert "| bar.angle | agrees; 0.002 → 0.009 rad ×4.5, allowed 0.01 |" in rows[0]


HOSTILE = "</td><script>|`x`\n\0\ufffe\033[0m ![i](http://e)"


def test_text_of_a_report_is_never_markup(tmp_path: Path) -> None:
    rows = [replace(ROW, quantity=HOSTILE, error=x) for x in (1e-3, 9e-3)]
    folders = [report(tmp_path / str(i), rows=[row]) for i, row in enumerate(rows)]
    done = textmech("diff", *folders, "--markdown")
    assert done.returncode == 1, done.stderr
    (row,) = [line for line in done.stdout.splitlines() if line.startswith("| swing")]
    assert len(re.findall(r"(?<!\\)\|", row)) == 6  # five cells
    assert "<" not in row
    assert "\\`x\\`" in row
    assert "!\\[i\\]" in row


@pytest.mark.slow
def test_one_folder_is_compared_with_the_committed_reports(tmp_path: Path) -> None:
    copy = tmp_path / "copy"
    copy.mkdir()
    for file in write.HERE.glob("*.csv"):
        (copy / file.name).write_bytes(file.read_bytes())
    done = textmech("diff", copy)
    assert done.returncode == 0
    assert done.stdout.startswith("OLD the committed reports: run")
    assert done.stdout.endswith("nothing changed\n")
    shown = textmech("diff", copy, "--markdown").stdout
    assert shown.startswith("### ✅ textmech: nothing changed")


def test_it_loads_nothing_that_takes_long() -> None:
    """So that it answers in a third of a second."""
    program = "import sys, textmech.reports.front.cli, textmech.reports.tables.diff.forms"
    program += "; print(*sys.modules)"
    words = [sys.executable, "-c", program]
    loaded = subprocess.run(words, capture_output=True, text=True, check=True).stdout.split()
    assert "textmech.reports.tables.diff.compare" in loaded
    assert not {"numpy", "pandas", "scipy", "pydantic"} & {*loaded}
