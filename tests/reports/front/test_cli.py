"""The command as a user meets it: what it prints, where, its exit codes, its documents."""

import importlib
import json
import math
import os
import re
import signal
import subprocess
import sys
from collections.abc import Sequence
from dataclasses import replace
from math import inf, nan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.command import NEW, process, textmech
from given.command.lines import row
from given.otherwise import otherwise

from textmech.cases.case import Case
from textmech.cases.find import models, questions
from textmech.cases.mistake import Mistake
from textmech.cases.scene import unnamed
from textmech.cases.scene.unnamed import penetrations
from textmech.reference import solve as solving
from textmech.reference.solve import solve
from textmech.reports import solve as solved
from textmech.reports.compare.trial import limit
from textmech.reports.front.show.document import write as write_document
from textmech.reports.runs.request import Request
from textmech.reports.runs.selection import choose_engines
from textmech.reports.runs.suite import Report
from textmech.reports.tables import write
from textmech.reports.tables.row import BEYOND, FAILS

# The command as a user meets it: what it prints, where, and its exit codes.


@pytest.fixture(autouse=True)
def nothing_stored(monkeypatch: pytest.MonkeyPatch) -> None:
    """A folder that nobody can make: every run computes."""
    monkeypatch.setenv("TEXTMECH_CACHE", os.devnull)


@pytest.fixture
def new(tmp_path: Path) -> Path:
    file = tmp_path / "cart.yaml"
    file.write_text(NEW, encoding="utf-8")
    return file


def reports() -> dict[str, bytes]:
    return {file.name: file.read_bytes() for file in write.HERE.glob("*.csv")}


@pytest.mark.slow
def test_a_case_of_ones_own_runs_in_both_engines_and_writes_nothing(new: Path) -> None:
    before = reports()
    done = process("run", new, folder=new.parent)
    assert done.returncode == 0, done.stderr
    for engine in ("mujoco", "pymunk"):
        for setting in ("shipped", "tuned"):
            assert re.search(
                rf"^cart in {engine} [\d.]+ {setting} \(.*\), h", done.stdout, re.MULTILINE
            )
        assert f"  {engine}.shipped  " in done.stdout
    assert reports() == before
    assert [file.name for file in new.parent.iterdir()] == ["cart.yaml"]


@pytest.mark.slow
def test_a_verdict_that_fails_is_exit_code_1_and_is_named(new: Path) -> None:
    new.write_text(f"{NEW}reach: {{mujoco: {{rod.angle: 1.0e-13}}}}\n", encoding="utf-8")
    done = textmech("run", new, "--engine", "mujoco.tuned")
    assert done.returncode == 1
    assert "FAILS: cart: mujoco.tuned rod.angle" in done.stdout


@pytest.mark.slow
def test_a_question_is_answered_and_does_not_fail(new: Path) -> None:
    """That our recipe keeps a user's own tolerance nobody has promised."""
    new.write_text(NEW.replace("rod.angle: 1.0e-2", "rod.angle: 1.0e-12"), encoding="utf-8")
    done = textmech("run", new, "--engine", "mujoco.tuned")
    assert done.returncode == 0
    told = "cart in mujoco: no setting keeps it at the judged step; nearest: mujoco.tuned, rod."
    assert told in done.stdout
    assert "FAILS" not in done.stdout


@pytest.mark.slow
def test_an_unknown_tolerance_is_never_written_but_said(new: Path) -> None:
    new.write_text(NEW.replace("rod.angle: 1.0e-2", "rod.angle: unknown"), encoding="utf-8")
    done = textmech("run", new, "--engine", "mujoco.tuned")
    assert done.returncode == 1
    assert "was measured: type a number" in done.stdout
    assert "unknown" in new.read_text()


@pytest.mark.slow
@pytest.mark.parametrize("command", ["run", "page", "versions"])
def test_help_names_every_setting_that_engines_offer(command: str) -> None:
    offered = {engine.setting for engine in choose_engines(["mujoco", "pymunk"], [])}
    metavar = next(line for line in textmech(command, "--help").stdout.split() if "|FILE" in line)
    assert set(metavar.split("|")) == {*offered, "FILE"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["run", "bar_pendulm"], "did you mean 'bar_pendulum'?"),
        (["run", "rolling_wheel.pushd"], "did you mean 'rolling_wheel.pushed'?"),
        (["run", "--engine", "mojoco"], "did you mean 'mujoco'?"),
        (["run", "--settings", "tunned"], "did you mean 'tuned'?"),
        (["run", "--jobs", "0"], "--jobs"),
        (["run", "nowhere.yaml"], "no such file"),
        (["run", "reference"], "directory"),
        (["check", "nowhere.yaml"], "no such file"),
        (["show", "rolling_wheel", "--engine", "mujoco"], "rolling_wheel.pushed"),
        (["show", "four_bar"], "--engine"),
        (["rnu"], "No such command"),
    ],
)
def test_bad_input_is_exit_code_2_and_says_what_would_be_right(
    words: list[str], message: str
) -> None:
    before = reports()
    done = textmech(*words)
    assert done.returncode == 2
    assert message in done.stderr
    assert reports() == before


def test_check_names_all_mistakes_of_all_files_with_their_places(new: Path) -> None:
    text = NEW.replace("mass: 2.0", "mass: -2.0").replace("[cart.center, rod", "[carrt.center, rod")
    new.write_text(text, encoding="utf-8")
    other = new.with_name("other.yaml")
    other.write_text(NEW.replace("rod: {angle: -40 deg}", "rod: {}"), encoding="utf-8")
    done = textmech("check", new.name, other.name, folder=new.parent)
    assert done.returncode == 2
    assert "cart.yaml:5:20" in done.stderr
    assert "did you mean 'cart" in done.stderr
    assert "rod.angle" in done.stderr
    assert "other.yaml" in done.stderr


@pytest.mark.slow
def test_two_files_of_one_name_are_refused(new: Path) -> None:
    other = new.parent / "other" / new.name
    other.parent.mkdir()
    other.write_text(NEW.replace("samples: 6", "samples: 11"), encoding="utf-8")
    done = textmech("run", new, other)
    assert done.returncode == 2
    assert "already has the name 'cart'" in done.stderr
    assert textmech("check", new, new).returncode == 0


@pytest.mark.slow
def test_the_own_settings_of_the_readme(new: Path) -> None:
    readme = Path(write.HERE.parent / "README.md").read_text(encoding="utf-8")
    own = next(block for block in readme.split("```") if block.startswith("yaml\nmujoco: {step"))
    file = new.with_name("mine.yaml")
    file.write_text(own.removeprefix("yaml"), encoding="utf-8")
    done = textmech("run", new, "--settings", file)
    assert done.returncode == 0, done.stderr
    assert {"mujoco.mine", "pymunk.mine"} <= set(done.stdout.split())


def test_what_moves_late_is_no_mistake(new: Path) -> None:
    """Under a force that grows from zero nothing is to be seen in the first samples."""
    new.write_text(
        """\
title: A slow start
scene:
  gravity: none
  bodies: {dot: {particle: {mass: 1.0}}}
  forces: {hand: {push: dot.center, ramp: [1.0e-2, 0]}}
initial: {dot: {x: 1000, y: 0}}
duration: 2.0
samples: 51
step: {mujoco: 1.0e-3, pymunk: 1.0e-3}
allow: {dot.x: 1.0e-3}
""",
        encoding="utf-8",
    )
    done = textmech("check", new)
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("mujoko: {step: 1.0e-3}\n", "did you mean 'mujoco'?"),
        ("mujoco: {stepp: 1.0e-3}\n", "did you mean 'step'?"),
        ("mujoco: {integrator: rk4}\n", "RK4"),
        ("pymunk: {iterations: 0}\n", "iterations"),
        ("pymunk: fast\n", "map"),
        ("", "empty"),
    ],
)
def test_bad_settings_are_exit_code_2(new: Path, text: str, message: str) -> None:
    file = new.with_name("mine.yaml")
    file.write_text(text, encoding="utf-8")
    done = textmech("run", new, "--settings", file)
    assert done.returncode == 2
    assert message in done.stderr


@pytest.mark.slow
def test_list_names_every_case_with_its_source() -> None:
    done = textmech("list")
    assert done.returncode == 0
    book, _, asked = done.stdout.partition("What people ask")
    asked, _, own = asked.partition("Models")
    assert "four_bar\n" in book
    assert "figure 2.3" in book
    assert "creeping_block\n" in asked
    assert "google-deepmind/mujoco#3328" in asked
    assert "hopper\n      A hopper that lands" in own
    assert max(map(len, done.stdout.splitlines())) <= 80


@pytest.mark.parametrize(
    ("word", "names"),
    [
        ("restitution", {"bouncing_disk", "bouncing_ball", "stopped_pendulum"}),
        ("motor", {"pulled_hook", "torsion_pendulum"}),
        ("penetration", {"sinking_ball", "heavy_on_light"}),
        ("revolute", {"bar_pendulum", "skew_chain"}),
        ("mass_matrix", {"robot_states"}),
    ],
)
def test_list_finds_what_a_scene_is_about(word: str, names: set[str]) -> None:
    found = {line.split()[0] for line in textmech("list", word).stdout.splitlines() if line}
    assert names <= found
    assert "falling_too_far" not in found


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["mujoco", "pymunk.shipped"])
def test_show_is_ready_to_paste(engine: str) -> None:
    done = textmech("show", "double_pendulum", "--engine", engine)
    assert done.returncode == 0, done.stderr
    if engine.startswith("pymunk"):
        compile(done.stdout, "shown", "exec")
    else:
        import mujoco

        mujoco.MjModel.from_xml_string(done.stdout)  # pyright: ignore[reportAttributeAccessIssue]


@pytest.mark.slow
def test_the_number_of_workers_does_not_change_the_rows(new: Path, tmp_path: Path) -> None:
    for jobs in ("1", "2"):
        assert textmech("run", new, "--jobs", jobs, "--out", tmp_path / jobs).returncode == 0
    for file in (tmp_path / "1").iterdir():
        assert file.read_bytes() == (tmp_path / "2" / file.name).read_bytes()


@pytest.mark.slow
@pytest.mark.mutant("a file is looked for from where a worker is")
def test_several_files_are_checked_at_once_in_their_order(tmp_path: Path) -> None:
    for name, text in (("b", NEW), ("a", NEW), ("c", NEW.replace("title", "tittle"))):
        (tmp_path / f"{name}.yaml").write_text(text, encoding="utf-8")
    done = textmech("check", "b.yaml", "c.yaml", "a.yaml", "--jobs", 2, folder=tmp_path)
    assert done.returncode == 2
    assert done.stdout == "b.yaml: 1 case, no mistakes\na.yaml: 1 case, no mistakes\n"
    assert "c.yaml:1:1: tittle: unknown key 'tittle'" in done.stderr


def eats(case: Case) -> Any:
    return np.ones(2**28)  # 2 GiB


def dies(case: Case) -> Any:
    os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.mutant("a reference may take all of the memory")
@pytest.mark.parametrize("words", [("check",), ("run", "--no-cache"), ("advise", "--no-cache")])
@pytest.mark.parametrize(
    ("moved", "what"),
    [(eats, "needs more memory than its process may take"), (dies, "its process ended (SIGKILL)")],
    ids=["eats", "dies"],
)
def test_a_reference_that_is_lost_is_a_mistake_of_its_case(
    new: Path, words: Sequence[str], moved: Any, what: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(limit.MEMORY, "1")  # GiB
    monkeypatch.setattr(solving, "_solve_islands", moved)
    done = textmech(*words, new)
    assert done.returncode == 2, done.stdout
    assert f"{new}" in done.stderr
    assert what in done.stderr
    assert done.stderr.endswith("1 mistake; nothing was written\n")


@pytest.mark.slow
def test_a_file_whose_check_breaks_down_costs_only_itself(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = solving.solve

    def solve(case: Case) -> Any:
        if case.name == "b":
            raise RuntimeError("of ours")
        return sound(case)

    for name in "ab":
        (tmp_path / f"{name}.yaml").write_text(NEW, encoding="utf-8")
    monkeypatch.setattr(solving, "solve", solve)
    done = textmech("check", "b.yaml", "a.yaml", "--jobs", 2, folder=tmp_path)
    assert (done.returncode, done.stdout) == (2, "a.yaml: 1 case, no mistakes\n")
    assert "b.yaml: could not be checked: RuntimeError: of ours" in done.stderr


# What `textmech run` ends with: a README promises a code for each, and for two at once.

RUN = importlib.import_module("textmech.reports.front.command.run")
MISTAKE = Mistake("bad.yaml", 1, 1, "title", "missing key 'title'")


def code(verdict: str, *words: str, mistakes: bool = False, module: Any = RUN) -> int:
    """Of a run with one row and, or not, one file that was left out."""
    found = Report(comparisons=[replace(row(), verdict=verdict)])
    found.mistakes = [MISTAKE] if mistakes else []
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(module, "named", lambda *_, **__: Request([], []))
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
    page = importlib.import_module("textmech.reports.front.command.page")
    written = importlib.import_module("textmech.reports.front.page.page")
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(page, "named", lambda *_, **__: Request([], []))
        patch.setattr(page, "looked_at", lambda *_, **__: found)
        patch.setattr(written, "write_measured", lambda *_, **__: None)
        words = ["swing", "--out", str(tmp_path / "out")]
        assert not page.page.main(words, standalone_mode=False)


@pytest.mark.parametrize("words", [("run", "--help"), ("show", "four_bar")])
def test_python_m_textmech_is_the_command(words: tuple[str, ...]) -> None:
    command = Path(sys.executable).with_name("textmech")
    said = [
        subprocess.run([*line, *words], capture_output=True, text=True, check=False)
        for line in ((command,), (sys.executable, "-m", "textmech"))
    ]
    one, other = ((done.returncode, done.stdout, done.stderr) for done in said)
    assert one == other
    assert any(one[1:])


# `--json`: one document on the output, whatever becomes of the command.


def document(*words: object) -> dict[str, Any]:
    """The output, which is JSON in the strict sense, and nothing else."""
    done = textmech(*words, "--json")

    def none(name: str) -> None:
        raise AssertionError(f"{name} is no JSON")

    found = json.loads(done.stdout, parse_constant=none)
    assert found.get("exit_code", 0) == done.returncode
    return found


@pytest.mark.slow
def test_a_run_tells_all_its_rows_and_writes_where_it_is_told(new: Path, tmp_path: Path) -> None:
    places = ("--out", tmp_path / "o", "--keep", tmp_path / "k")
    found = document("run", new, "--engine", "mujoco.tuned", *places)
    tables = "summary tolerance convergence steps events reference causes models"
    assert list(found) == f"{tables} warnings mistakes written exit_code".split()
    assert [row["quantity"] for row in found["tolerance"]] == ["audit", "cart.x", "rod.angle"]
    line = {"case": "cart", "setting": "mujoco.tuned", "worst": "agrees", "agrees": "tuned 8 ms"}
    assert found["summary"] == [{**line, "cured": ""}]
    assert found["written"] == str(tmp_path / "o")
    assert {row["verdict"] for row in found["reference"]} == {"holds"}
    assert {file.name for file in (tmp_path / "o").iterdir()} == set(write.FILES)
    head, *rows = (tmp_path / "k" / "cart.csv").read_text().splitlines()
    both = [f"{q} {who}" for q in ("cart.x [m]", "rod.angle [rad]")
            for who in ("reference", "mujoco.tuned.native")]  # fmt: skip
    others = [f"{pose} reference" for pose in ("cart.y [m]", "cart.angle [rad]", "rod.x [m]")]
    assert head.split(",") == ["t [s]", *both, *others, "rod.y [m] reference"]
    assert len(rows) == 6
    events = (tmp_path / "k" / "cart.events.csv").read_text()
    assert events == "engine,setting,realised,event,k,time [s],difference [s]\n"


@pytest.mark.parametrize("command", ["run", "check"])
def test_mistakes_are_in_it_with_their_places(command: str, new: Path) -> None:
    new.write_text(NEW.replace("mass: 2.0", "mass: -2.0"), encoding="utf-8")
    found = document(command, new)
    (mistake,) = found.get("mistakes") or found["files"][0]["mistakes"]
    assert mistake["file"] == str(new)
    assert (mistake["line"], mistake["column"]) == (5, 20)
    assert mistake["field"] == "scene.bodies.cart.block.mass"
    assert found["exit_code"] == 2


@pytest.mark.parametrize(
    "words",
    [
        ("run", "four_bra"),
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
    own = {name for name, case in cases.items() if case["group"] == "models"}
    assert own == set(models())


def test_what_json_has_not_is_null(capsys: pytest.CaptureFixture[str]) -> None:
    write_document(
        {"rows": [{"error": inf, "ratio": nan}, {"error": 1e300}], "title": "→ \x1b[31m"}
    )
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
from textmech.reports.front import cli

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


# What goes through the floor on which its neighbours stand is told in one line, and goes on.

HEAD = "title: What no contact names\n"
DOMINO = """\
scene:
  bodies: {box: {block: {mass: 1, width: 0.1, height: 0.4}}}
  contacts: {right: {between: [box.lower_right, ground.floor], friction: 1}MORE}
initial: {box: {x: 0, angle: 0, on: lower_right, omega: -4}}
allow: {box.angle: 1.0e-3}
"""
STACKED = """\
scene:
  bodies:
    base: {block: {mass: 5, width: 1, height: 0.2}}
    box: {block: {mass: 1, width: 0.1, height: 0.4}}
  contacts:
    bl: {between: [base.lower_left, ground.floor], friction: 1}
    br: {between: [base.lower_right, ground.floor], friction: 1}
    right: {between: [box.lower_right, base.top], friction: 1}
initial: {base: {x: 0, angle: 0, on: [lower_left, lower_right]}, box: {x: 0, y: 0.4, angle: 0}}
allow: {box.angle: 1.0e-3}
"""
SPACE = """\
scene:
  space: 3
  bodies: {box: {block: {mass: 1, size: [0.2, 0.2, 0.4]}, points: {tip: [0, 0, -0.2]}}}
  contacts: {foot: {between: [box.tip, ground.floor], friction: 9, ideal: pivot}}
initial: {box: {x: 0, y: 0, z: 0.2, attitude: {axis: [0, 0, 1], angle: 0}, omega: [0.5, 0, 0]}}
allow: {box.attitude: 1.0e-3}
"""
LENGTH = {DOMINO: 0.5, STACKED: 0.1, SPACE: 0.1}


def told(text: str, more: str = "") -> list[str]:
    case = scenes.parsed(text.replace("MORE", more), tail=scenes.tail(LENGTH[text], 26))
    return [*penetrations(case.scene, solve(case).trajectory)]


@pytest.mark.parametrize(
    ("text", "begins"),
    [
        (DOMINO, "box.upper_left goes 409 mm deep into the floor, which it enters by t = 0.36 s"),
        (STACKED, "box.lower_left goes 4.45 mm deep into the top of base"),
        (SPACE, "box.corner"),
    ],
)
def test_the_deepest_point_is_told(text: str, begins: str) -> None:
    (warning,) = told(text)
    assert warning.startswith(begins)
    assert warning.endswith("no contact names it, so nothing holds it there")


def test_how_deep_is_what_the_angle_says() -> None:
    """A domino about its right corner at φ < 0: its left upper one is h cos φ − w sin φ high."""
    case = scenes.parsed(DOMINO.replace("MORE", ""), tail=scenes.tail(0.5, 26))
    motion = solve(case).trajectory
    angle = motion.states["box"][:, 2]
    above = 0.4 * np.cos(angle) - 0.1 * np.sin(angle)
    (warning,) = penetrations(case.scene, motion)
    assert f"goes {-1e3 * min(above):.3g} mm deep" in warning


def test_nothing_is_told_of_what_is_named() -> None:
    names = ("lower_left", "upper_right", "upper_left")
    more = "".join(f", {n}: {{between: [box.{n}, ground.floor], friction: 1}}" for n in names)
    case = DOMINO.replace("allow:", "events: {falls: {upper_right.gap: falls to zero}}\nallow:")
    LENGTH[case] = 0.5
    assert told(case, more) == []


@pytest.mark.slow
def test_no_shipped_case_is_warned_of() -> None:
    for name, case in scenes.SHIPPED.items():
        if case.scene.contacts or case.scene.pairs:
            assert [*penetrations(case.scene, scenes.solved(name).trajectory)] == [], name


@pytest.fixture
def domino(tmp_path: Path) -> Path:
    file = tmp_path / "domino.yaml"
    tail = scenes.tail(0.5, 26).replace("5e-05", "1e-3")
    file.write_text(HEAD + DOMINO.replace("MORE", "") + tail, encoding="utf-8")
    return file


def test_check_and_python_warn_and_refuse_nothing(domino: Path) -> None:
    done = textmech("check", domino)
    assert done.returncode == 0
    warning, sound = done.stdout.splitlines()
    assert warning.startswith(f"{domino}: warning: box.upper_left goes 409 mm deep")
    assert sound == f"{domino}: 1 case, no mistakes"
    (file,) = json.loads(textmech("check", domino, "--json").stdout)["files"]
    (known,) = file["warnings"]
    assert known["case"] == "domino"
    assert solved(str(domino)).warnings == (known["what"],)


@pytest.mark.slow
def test_run_warns_and_refuses_nothing(domino: Path) -> None:
    done = textmech("run", domino, "--engine", "pymunk.shipped")
    assert done.returncode == 0
    assert "domino: warning: box.upper_left goes 409 mm deep" in done.stdout


@pytest.mark.mutant("a corner that goes through the floor is told of none")
def test_a_warning_that_is_left_out_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(unnamed, "DEEP", math.inf)
    assert told(DOMINO) == []
