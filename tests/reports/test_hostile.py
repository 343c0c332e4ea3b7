"""What a disk, a terminal or a file name can do to a run: a message, and never a traceback."""

import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
from given.command import NEW, textmech

from textmech.reports.command.options import Folder
from textmech.reports.output import write
from textmech.reports.show.console import shown

ONE = ("--engine", "mujoco.shipped")


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("TEXTMECH_CACHE", os.devnull)
    (tmp_path / "cart.yaml").write_text(NEW, encoding="utf-8")
    return tmp_path


@pytest.fixture
def said(folder: Path) -> Callable[..., str]:
    """What the command says that ends with bad input."""

    def run(*words: str) -> str:
        done = textmech("run", *words, *ONE, folder=folder)
        assert done.returncode == 2
        return done.stderr

    return run


NAMES = ["#h", "=cmd()", "+1", "-1", "@a", "b\033[31m", "b\n", os.fsdecode(b"b\xff")]


@pytest.mark.parametrize("name", NAMES)
def test_a_name_that_no_table_can_hold_is_refused(
    name: str, folder: Path, said: Callable[..., str]
) -> None:
    (folder / f"{name}.yaml").write_text(NEW, encoding="utf-8")
    err = said(f"./{name}.yaml")
    assert "name should begin with a letter" in err
    assert "\033" not in err


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--out", ""], "name is empty"),
        (["--keep", ""], "name is empty"),
        (["--keep", "/proc"], "cannot write to /proc"),
        (["--out", "cart.yaml"], "cart.yaml"),
        (["--out", "o", "--keep", "o"], "one folder"),
    ],
)
def test_a_place_that_takes_nothing_is_said_before_the_work(
    words: list[str], message: str, said: Callable[..., str]
) -> None:
    err = said("cart.yaml", *words)
    assert message in err
    assert "engines" not in err


def test_a_folder_that_is_tried_keeps_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Also where the signal comes while something is made there."""
    (tmp_path / "o").mkdir()
    make = os.mkdir

    def struck(*words: Any) -> None:
        make(*words)
        raise KeyboardInterrupt

    monkeypatch.setattr(os, "mkdir", struck)
    with pytest.raises(KeyboardInterrupt):
        Folder().convert(str(tmp_path / "o"), None, None)
    assert list((tmp_path / "o").iterdir()) == []


@pytest.mark.slow
def test_a_folder_in_a_reports_place_costs_no_other_report(
    folder: Path, said: Callable[..., str]
) -> None:
    (folder / "o" / "events.csv").mkdir(parents=True)
    assert "events.csv: Is a directory; nothing was written" in said("cart.yaml", "--out", "o")
    assert [file.name for file in (folder / "o").iterdir()] == ["events.csv"]


def shell(script: str, folder: Path, **variables: str) -> subprocess.CompletedProcess[str]:
    """The run by a shell, which does something to its streams."""
    command = f"{sys.executable} -m textmech.reports.cli run cart.yaml {' '.join(ONE)} --out o"
    return subprocess.run(
        ["bash", "-o", "pipefail", "-c", script.replace("RUN", command)],
        capture_output=True,
        encoding="latin-1",
        cwd=folder,
        env=os.environ | variables,
        check=False,
    )


@pytest.mark.slow
@pytest.mark.parametrize(
    ("script", "code"),
    [("RUN 2>&-", 0), ("RUN >&- 2>&- <&-", 0), ("RUN | head -c 1", 0), ("RUN >/dev/full", 2)],
)
def test_a_stream_that_takes_nothing_costs_no_report(script: str, code: int, folder: Path) -> None:
    done = shell(script, folder)
    assert done.returncode == code
    assert "Traceback" not in done.stderr
    assert "Exception ignored" not in done.stderr
    assert {file.name for file in (folder / "o").iterdir()} == set(write.FILES)
    assert ("the reports are in o" in done.stderr) == (code == 2)


@pytest.mark.slow
@pytest.mark.parametrize("words", ["list", "list --json"])
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_an_output_that_is_cut_short_is_told_where_somebody_reads(
    words: str, unbuffered: str, folder: Path
) -> None:
    """A file may have 1 kB: of what is unbuffered Python drops the rest without a word."""
    script = f"trap '' XFSZ; ulimit -f 1; {sys.executable} -m textmech.reports.cli {words} > said"
    done = shell(script, folder, PYTHONUNBUFFERED=unbuffered)
    assert done.returncode == 2
    assert "File too large" in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize("unbuffered", ["", "1"])
def test_a_document_that_finds_no_room_names_its_reports(unbuffered: str, folder: Path) -> None:
    done = shell("RUN --json >/dev/full", folder, PYTHONUNBUFFERED=unbuffered)
    assert done.returncode == 2
    assert "Error: No space left on device; the reports are in o" in done.stderr


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "file", "said"),
    [
        ("plot cart.yaml -o p.png", "p.png", "the picture is p.png"),
        ("page cart.yaml --engine mujoco.shipped --out lk", "lk/index.html", "the page is lk/"),
        ("advise cart.yaml --engine mujoco --out ad", "ad/advice.csv", ""),
    ],
)
def test_what_is_there_is_not_called_unwritten(
    words: str, file: str, said: str, folder: Path
) -> None:
    done = shell(f"{sys.executable} -m textmech.reports.cli {words} >/dev/full", folder)
    assert (folder / file).exists() == bool(said)
    assert done.returncode == 2
    assert (said or "nothing was written") in done.stderr


@pytest.mark.slow
def test_a_stream_without_the_letters_spells_them_out(folder: Path) -> None:
    done = shell("RUN", folder, PYTHONIOENCODING="cp437", PYTHONUTF8="0")
    assert done.returncode == 0, done.stderr
    assert r"worst, \xd7 allowed" in done.stdout  # ×


def test_control_characters_are_shown_and_not_sent() -> None:
    assert shown("a\033[31m\0\x9b\n\tb×") == r"a\x1b[31m\x00\x9b" + "\n\tb×"
