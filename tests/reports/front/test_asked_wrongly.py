"""What the command refuses the interface refuses, and what a word cannot be costs that word."""

import json
import subprocess
import sys
from math import inf, nan
from pathlib import Path
from typing import Any

import pytest
from given.command import textmech

from textmech.cases.mistake import CaseError
from textmech.reports import advise, load, run
from textmech.reports.compare.trial import limit
from textmech.reports.front.versions.release import alike
from textmech.reports.runs.processes import pool
from textmech.reports.runs.request import Request
from textmech.reports.runs.selection import sound_cases
from textmech.reports.runs.suite import measure

FALLS = """\
title: A ball that falls
scene: {bodies: {b: {particle: {mass: 1}}}}
initial: {b: {x: 0, y: 1, vx: 0, vy: 0}}
duration: 0.1
samples: 3
allow: {b.y: 1.0e-3}
"""
LONG = "a" * 300  # letters: no file can be called so


@pytest.fixture
def file(tmp_path: Path) -> Path:
    path = tmp_path / "falls.yaml"
    path.write_text(FALLS)
    return path


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ({"tolerance": 0.0}, "tolerance: should be a number above 0, is 0.0"),
        ({"tolerance": -1.0}, "above 0"),
        ({"tolerance": nan}, "above 0, is nan"),
        ({"tolerance": inf}, "above 0, is inf"),
        ({"margin": 0.1}, "margin: should be a number from 1 on, is 0.1"),
        ({"margin": nan}, "from 1 on"),
        ({"jobs": 0}, "jobs: should be a whole number up to 1024, from 1 on, is 0"),
    ],
)
def test_advise_refuses_what_is_no_bar(given: dict[str, Any], said: str, file: Path) -> None:
    with pytest.raises(CaseError, match=said):
        advise(str(file), engines=["pymunk"], **given)


def test_a_run_in_no_process_is_refused(file: Path) -> None:
    with pytest.raises(
        CaseError, match="jobs: should be a whole number up to 1024, from 1 on, is -1"
    ):
        run(str(file), engines=["pymunk.shipped"], jobs=-1)


@pytest.mark.parametrize(
    "words", [("--tolerance", "nan"), ("--margin", "inf"), ("--margin", "nan")]
)
def test_no_number_is_no_bar(words: tuple[str, str], file: Path) -> None:
    done = textmech("advise", file, "--engine", "pymunk", *words)
    assert done.returncode == 2
    assert "no finite number" in done.stderr


def test_a_setting_is_looked_for_and_not_given(file: Path) -> None:
    done = textmech("advise", file, "--engine", "pymunk.tuned")
    assert done.returncode == 2
    assert "--engine: pymunk.tuned: advise looks for the setting" in done.stderr
    done = textmech("causes", file, "--engine", "pymunk.nope")
    assert done.returncode == 2
    assert "no such engine" in done.stderr


def test_a_name_that_no_file_can_have_costs_itself(file: Path) -> None:
    cases, mistakes = sound_cases([LONG, str(file)])
    assert [case.name for case in cases] == ["falls"]
    assert [mistake.what for mistake in mistakes] == ["cannot be read: File name too long"]
    done = textmech("check", LONG, file, "--json")
    assert done.returncode == 2
    assert [one["cases"] for one in json.loads(done.stdout)["files"]] == [[], ["falls"]]


def test_a_folder_that_may_not_be_read_costs_its_file(
    tmp_path: Path, file: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Whoever runs this may read everything: so Python is told that it may not."""
    locked, is_file = tmp_path / "locked" / "falls.yaml", Path.is_file

    def refusing(path: Path) -> bool:
        if path == locked:
            raise PermissionError(13, "Permission denied", str(path))
        return is_file(path)

    monkeypatch.setattr(Path, "is_file", refusing)
    cases, mistakes = sound_cases([str(locked), str(file)])
    assert [case.name for case in cases] == ["falls"]
    assert [mistake.what for mistake in mistakes] == ["cannot be read: Permission denied"]


@pytest.mark.slow
def test_whatever_ends_a_command_is_a_document(tmp_path: Path, file: Path) -> None:
    (tmp_path / "tolerance.csv").write_text("mine\n")
    done = textmech("run", file, "--engine", "pymunk.shipped", "--json", "--out", tmp_path)
    assert done.returncode == 2
    assert json.loads(done.stdout)["exit_code"] == 2
    assert "would be overwritten" in json.loads(done.stdout)["mistakes"][0]["what"]
    done = textmech("list", "nosuchword", "--json")
    assert (done.returncode, json.loads(done.stdout)["exit_code"]) == (2, 2)


@pytest.mark.slow
def test_a_pipe_is_no_link_that_leads_nowhere(file: Path) -> None:
    code = "from textmech.reports.front.start import main; main()"
    command = [sys.executable, "-c", code, "check", "/dev/stdin"]
    done = subprocess.run(command, input=file.read_bytes(), capture_output=True, check=False)
    assert done.returncode == 2
    assert "/dev/stdin: is no file" in done.stderr.decode().splitlines()


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        ("7.3", "7.3.0", True),
        ("7.3.0", "7.3", True),
        ("7.30", "7.3", False),
        ("7.0.1", "7.1", False),
    ],
)
def test_a_release_has_two_names(one: str, other: str, same: bool) -> None:
    assert alike(one, other) is same


@pytest.mark.slow
@pytest.mark.mutant("a worker's share of memory holds what its parent already had")
def test_memory_is_counted_from_what_a_process_has(monkeypatch: pytest.MonkeyPatch) -> None:
    """A notebook holds more than a worker's share: its workers begin all the same."""
    monkeypatch.setenv(limit.MEMORY, "0.3")
    held = bytearray(400 * 2**20)
    with pool.local(1) as executor:
        assert executor.submit(abs, -3).result(timeout=60) == 3
    assert len(held) > 0.3 * limit.GIB
    monkeypatch.setattr(limit, "_data_size", lambda: 0)
    with pool.local(1) as executor:
        assert executor.submit(bytearray, 10**8).exception(timeout=60) is not None


@pytest.mark.mutant("one case is judged by the reference of another that is called as it is")
def test_two_cases_of_one_name_are_not_run_together(file: Path, tmp_path: Path) -> None:
    other = tmp_path / "other" / file.name
    other.parent.mkdir()
    other.write_text(file.read_text("utf-8"), encoding="utf-8")
    (one,), (two,) = load(file), load(other)
    for ask in (load, run, advise):
        with pytest.raises(CaseError, match="another case beside it has the name"):
            ask([one, two])
    with pytest.raises(CaseError, match="another case beside it has the name"):
        measure(Request([one, two], []))
    assert load([one, one]) == [one]
