"""The command as a user meets it: what it prints, where, and its exit codes."""

import os
import re
import signal
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given.command import NEW, process, textmech

from textmech.cases.case import Case
from textmech.reference import solve as solving
from textmech.reports.batch.selection import choose_engines
from textmech.reports.output import write
from textmech.reports.system import limit


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
def test_out_and_keep_write_where_they_are_told(new: Path, tmp_path: Path) -> None:
    done = textmech(
        "run", new, "--engine", "mujoco.tuned", "--out", "o", "--keep", "k", folder=tmp_path
    )
    assert done.returncode == 0, done.stderr
    assert sorted(p.name for p in (tmp_path / "o").iterdir()) == [
        "causes.csv",
        "convergence.csv",
        "coverage.csv",
        "events.csv",
        "reference.csv",
        "runs.csv",
        "steps.csv",
        "tolerance.csv",
    ]
    head, *rows = (tmp_path / "k" / "cart.csv").read_text().splitlines()
    assert head.split(",") == [
        "t [s]",
        "cart.x [m] reference",
        "cart.x [m] mujoco.tuned.native",
        "rod.angle [rad] reference",
        "rod.angle [rad] mujoco.tuned.native",
        *(f"{pose} reference" for pose in ("cart.y [m]", "cart.angle [rad]", "rod.x [m]")),
        "rod.y [m] reference",
    ]
    assert len(rows) == 6
    events = (tmp_path / "k" / "cart.events.csv").read_text()
    assert events == "engine,setting,realised,event,k,time [s],difference [s]\n"


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
def test_a_verdict_that_fails_is_exit_code_1_though_it_is_written(new: Path) -> None:
    new.write_text(f"{NEW}reach: {{pymunk: {{cart.x: 1.0e-12}}}}\n", encoding="utf-8")
    done = textmech("run", new, "--engine", "pymunk.tuned", "--out", "o", folder=new.parent)
    assert done.returncode == 1
    assert (new.parent / "o" / "tolerance.csv").is_file()


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
        (["run", "."], "directory"),
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


def test_check_of_sound_files(new: Path) -> None:
    done = textmech("check", new)
    assert (done.returncode, done.stderr) == (0, "")
    assert "1 case, no mistakes" in done.stdout


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
def test_own_settings_are_a_line_below_shipped(new: Path) -> None:
    file = new.with_name("mine.yaml")
    file.write_text("mujoco: {step: 4.0e-3, integrator: implicitfast}\n", encoding="utf-8")
    done = textmech("run", new, "--engine", "mujoco", "--settings", file)
    assert done.returncode == 0, done.stderr
    assert [w for w in done.stdout.split() if w.startswith("mujoco.")] == [
        "mujoco.shipped",
        "mujoco.recommended",
        "mujoco.mine",
    ]
    assert "cart in mujoco 4.0.0 tuned" in done.stdout


@pytest.mark.slow
def test_the_own_settings_of_the_readme(new: Path) -> None:
    readme = Path(write.HERE.parent / "README.md").read_text(encoding="utf-8")
    own = next(block for block in readme.split("```") if block.startswith("yaml\nmujoco: {step"))
    file = new.with_name("mine.yaml")
    file.write_text(own.removeprefix("yaml"), encoding="utf-8")
    done = textmech("run", new, "--settings", file)
    assert done.returncode == 0, done.stderr
    assert {"mujoco.mine", "pymunk.mine"} <= set(done.stdout.split())


@pytest.mark.slow
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
    done = textmech("run", new)
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
    done = process("list")
    assert done.returncode == 0
    book, _, asked = done.stdout.partition("What people ask")
    assert "four_bar\n" in book
    assert "figure 2.3" in book
    assert "creeping_block\n" in asked
    assert "google-deepmind/mujoco#3328" in asked
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
@pytest.mark.parametrize("engine", ["mujoco", "mujoco.shipped", "pymunk", "pymunk.shipped"])
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
    monkeypatch.setattr(solving, "_moved", moved)
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
