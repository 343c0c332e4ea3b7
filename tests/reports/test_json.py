"""`--json`: one document on the output, whatever becomes of the command."""

import json
import os
import subprocess
import sys
from math import inf, nan
from pathlib import Path
from typing import Any

import pytest
from given.command import NEW, textmech

from textmech.cases.find import questions
from textmech.reports.show.document import write


@pytest.fixture(autouse=True)
def nothing_stored(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("TEXTMECH_CACHE", os.devnull)


@pytest.fixture
def new(tmp_path: Path) -> Path:
    file = tmp_path / "cart.yaml"
    file.write_text(NEW, encoding="utf-8")
    return file


def document(*words: object) -> dict[str, Any]:
    """The output, which is JSON in the strict sense, and nothing else."""
    done = textmech(*words, "--json")

    def none(name: str) -> None:
        raise AssertionError(f"{name} is no JSON")

    found = json.loads(done.stdout, parse_constant=none)
    assert found.get("exit_code", 0) == done.returncode
    return found


@pytest.mark.slow
def test_a_run_tells_all_its_rows(new: Path, tmp_path: Path) -> None:
    found = document("run", new, "--engine", "mujoco.tuned", "--out", tmp_path / "o")
    assert list(found) == [
        "summary",
        "tolerance",
        "convergence",
        "steps",
        "events",
        "reference",
        "causes",
        "warnings",
        "mistakes",
        "written",
        "exit_code",
    ]
    assert [row["quantity"] for row in found["tolerance"]] == ["audit", "cart.x", "rod.angle"]
    assert found["summary"] == [
        {
            "case": "cart",
            "setting": "mujoco.tuned",
            "worst": "agrees",
            "agrees": "tuned 8 ms",
            "cured": "",
        }
    ]
    assert found["written"] == str(tmp_path / "o")
    assert {row["verdict"] for row in found["reference"]} == {"holds"}


@pytest.mark.slow
def test_a_verdict_that_fails_is_in_it(new: Path) -> None:
    new.write_text(f"{NEW}reach: {{mujoco: {{rod.angle: 1.0e-13}}}}\n", encoding="utf-8")
    found = document("run", new, "--engine", "mujoco.tuned")
    assert found["exit_code"] == 1
    assert "FAILS" in {row["verdict"] for row in found["tolerance"]}


@pytest.mark.parametrize("command", ["run", "check"])
def test_mistakes_are_in_it_with_their_places(command: str, new: Path) -> None:
    new.write_text(NEW.replace("mass: 2.0", "mass: -2.0"), encoding="utf-8")
    found = document(command, new)
    (mistake,) = found.get("mistakes") or found["files"][0]["mistakes"]
    assert mistake["file"] == str(new)
    assert (mistake["line"], mistake["column"]) == (5, 20)
    assert mistake["field"] == "scene.bodies.cart.block.mass"
    assert found["exit_code"] == 2


@pytest.mark.slow
def test_one_of_two_files_is_left_out_and_the_other_is_told(new: Path) -> None:
    other = new.with_name("other.yaml")
    other.write_text(NEW.replace("mass: 2.0", "mass: -2.0"), encoding="utf-8")
    found = document("run", new, other, "--engine", "pymunk.tuned")
    assert {row["case"] for row in found["tolerance"]} == {"cart"}
    assert [mistake["file"] for mistake in found["mistakes"]] == [str(other)]


@pytest.mark.parametrize(
    "words",
    [
        ("run", "four_bra"),
        ("run", "four_bar", "--engine", "mojoco"),
        ("causes", "four_bra"),
        ("advise", "four_bra"),
    ],
)
def test_a_wrong_word_is_in_it(words: tuple[str, ...]) -> None:
    (mistake,) = document(*words)["mistakes"]
    assert "did you mean" in mistake["what"]


def test_check_tells_each_file(new: Path) -> None:
    found = document("check", new)
    nothing = {"mistakes": [], "fails": [], "because": [], "warnings": []}
    assert found == {"files": [{"file": str(new), "cases": ["cart"], **nothing}], "exit_code": 0}


@pytest.mark.slow
def test_list_tells_every_case_and_its_group() -> None:
    cases = {case["name"]: case for case in document("list")["cases"]}
    assert cases["sliding_block.below"]["group"] == "textbook"
    assert cases["four_bar"]["source"] == "figure 2.3, (2.14), (2.60)"
    asked = {name for name, case in cases.items() if case["group"] == "questions"}
    assert {name.partition(".")[0] for name in asked} == set(questions())  # with its variants
    assert all("#" in cases[name]["thread"] for name in asked)


def test_what_json_has_not_is_null(capsys: pytest.CaptureFixture[str]) -> None:
    write({"rows": [{"error": inf, "ratio": nan}, {"error": 1e300}], "title": "→ \x1b[31m"})
    out = capsys.readouterr().out
    assert out.isascii()
    assert json.loads(out) == {
        "rows": [{"error": None, "ratio": None}, {"error": 1e300}],
        "title": "→ \x1b[31m",
    }


LOUD = """\
import os
import subprocess
import sys
import sys

from textmech.engines.pymunk import Pymunk
from textmech.reports import cli

quiet = Pymunk.run


def run(*args, **kwargs):
    print("a banner")
    os.write(1, b"and more\\n")  # as a library in C does
    return quiet(*args, **kwargs)


Pymunk.run = run
cli.main()
"""


@pytest.mark.mutant("what an engine prints as it runs stands in the document")
@pytest.mark.slow
def test_what_an_engine_prints_is_not_in_it(new: Path) -> None:
    words = ["run", str(new), "--engine", "pymunk.shipped", "--json", "--no-cache"]
    done = subprocess.run(
        [sys.executable, "-c", LOUD, *words],
        capture_output=True,
        text=True,
        check=False,
        timeout=120,
    )
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["tolerance"]
    assert "a banner\n" in done.stderr
    assert "and more\n" in done.stderr
