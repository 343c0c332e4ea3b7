"""What `textmech run` ends with: a README promises a code for each, and for two at once."""

import importlib
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from given.lines import row
from given.otherwise import otherwise

from textmech.cases.mistake import Mistake
from textmech.reports.batch.suite import Report
from textmech.reports.data.row import BEYOND, FAILS

RUN = importlib.import_module("textmech.reports.command.run")
MISTAKE = Mistake("bad.yaml", 1, 1, "title", "missing key 'title'")


def code(verdict: str, *words: str, mistakes: bool = False, module: Any = RUN) -> int:
    """Of a run with one row and, or not, one file that was left out."""
    found = Report(comparisons=[replace(row(), verdict=verdict)])
    found.mistakes = [MISTAKE] if mistakes else []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "looked_at", lambda *_, **__: found)
        return module.run.main(["swing", *words], standalone_mode=False)


@pytest.mark.parametrize("words", [(), ("--json",)])
@pytest.mark.parametrize("writes", [False, True])
@pytest.mark.parametrize(
    ("verdict", "mistakes", "wanted"),
    [(BEYOND, False, 0), (FAILS, False, 1), (BEYOND, True, 2), (FAILS, True, 2)],
)
def test_the_exit_code_says_what_the_readme_promises(
    tmp_path: Path, words: tuple[str, ...], writes: bool, verdict: str, mistakes: bool, wanted: int
) -> None:
    out = ("--out", str(tmp_path / "out")) if writes else ()
    assert code(verdict, *words, *out, mistakes=mistakes) == wanted


@pytest.mark.mutant("exit code 1 where mistakes and FAILS come together")
def test_a_mistake_outweighs_a_verdict() -> None:
    was = "BAD_INPUT if mistakes else FAILED if report.fails else 0"
    other = otherwise(RUN, was, "FAILED if report.fails else BAD_INPUT if mistakes else 0")
    assert code(FAILS, mistakes=True) == 2
    assert code(FAILS, mistakes=True, module=other) == 1


@pytest.mark.mutant("exit code 0 where reports are written, whatever fails")
def test_reports_that_are_written_hide_no_verdict(tmp_path: Path) -> None:
    words = ("--out", str(tmp_path / "out"))
    other = otherwise(RUN, "if report.fails else 0", "if report.fails and out is None else 0")
    assert code(FAILS, *words) == 1
    assert code(FAILS, *words, module=other) == 0


def test_what_only_shows_ends_well(tmp_path: Path) -> None:
    """As reports/README.md says of page."""
    found = Report(comparisons=[replace(row(), verdict=FAILS)])
    page = importlib.import_module("textmech.reports.command.page")
    written = importlib.import_module("textmech.reports.page.page")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(page, "looked_at", lambda *_, **__: found)
        patch.setattr(written, "write_measured", lambda *_, **__: None)
        words = ["swing", "--out", str(tmp_path / "out")]
        assert not page.page.main(words, standalone_mode=False)


@pytest.mark.parametrize("words", [("--version",), (), ("run", "--help"), ("show", "four_bar")])
def test_python_m_textmech_is_the_command(words: tuple[str, ...]) -> None:
    command = Path(sys.executable).with_name("textmech")
    said = [
        subprocess.run([*line, *words], capture_output=True, text=True, check=False)
        for line in ((command,), (sys.executable, "-m", "textmech"))
    ]
    one, other = ((done.returncode, done.stdout, done.stderr) for done in said)
    assert one == other
    assert any(one[1:])
