"""`textmech show` of a model: what it is, what each claim covers, and a script that is run."""

import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from given.command import textmech
from given.otherwise import otherwise

from textmech.cases.fields.number import Amount
from textmech.cases.find import models
from textmech.cases.load_model import load_model
from textmech.cases.mistake import CaseError
from textmech.cases.model_case import JOINTS, ModelCase, of_model
from textmech.cases.tree import PARTS, PASSIVE
from textmech.engines.own_model.limit import stepped_states
from textmech.engines.own_model.opened import opened
from textmech.reports.compare.own_equations import equations
from textmech.reports.compare.own_steps import OWN, Setting, times_of
from textmech.reports.front.show import own_model
from textmech.reports.front.show.own_model import described, script_lines

SWING = """\
<mujoco model=""><worldbody>
<body name="{name}">
  <joint name="{name}" axis="0 1 0"/>
  <geom size=".1" pos="1 0 0" solref=".001 1"/>
</body></worldbody>
<actuator>
  <motor name="{name}" joint="{name}" delay=".01" nsample="2"/>
</actuator></mujoco>"""
URDF = """<robot name="arm"><link name="base"/><link name="hand"><inertial><mass value="1"/>
<inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<joint name="turn" type="revolute"><parent link="base"/><child link="hand"/><axis xyz="0 1 0"/>
<limit lower="-1" upper="2" effort="5" velocity="3"/></joint></robot>"""


def told(case: ModelCase) -> str:
    """What is printed of a case."""
    lines = described(case)
    assert not isinstance(lines, CaseError)
    return "\n".join(lines)


def of_text(text: str) -> ModelCase:
    return of_model("", "robot.xml", "robot", text)


def test_a_case_is_described_as_it_is_run() -> None:
    (case,) = load_model(models()["closed_loop"])
    text = told(case)
    assert text.startswith("closed_loop: A four-bar linkage")
    assert "A      hinge  crank    0 rad" in text
    assert "drive     joint A  kv 2" in text
    assert "control    drive: 2 t\n" in text
    assert "run        1 s, 26 samples\n" in text
    assert "tolerance  each joint 0.001 rad or m, rocker.place 0.001 m" in text
    assert "    compared, with equalities\n" in text
    assert "without contacts" in told(replace(case, contacts=False))


def test_what_a_claim_does_not_cover_is_named_with_its_line() -> None:
    text = told(of_text(SWING.format(name="x")))
    assert "no limit: a delay or history is counted in steps: actuator x (robot.xml:7)" in text
    assert (
        "solref 0.001 s is below 2h = 0.004 s; the law is what refsafe makes of that: geom" in text
    )
    assert "geom #0 (robot.xml:4)" in " ".join(text.split())
    fluid = SWING.format(name="x").replace("<worldbody>", '\n<option density="1"/><worldbody>')
    assert "passive forces   not compared: option (robot.xml:2): a fluid" in told(of_text(fluid))


def test_a_tolerance_of_some_joint_is_not_that_of_each() -> None:
    for allow, words in (
        ({"x.angle": Amount(0.1)}, "x.angle 0.1 rad"),
        ({JOINTS: Amount(0.2), "energy": Amount(3.0)}, "each joint 0.2 rad or m, energy 3 J"),
    ):
        case = replace(of_text(SWING.format(name="x")), allow=allow)
        assert f"  tolerance  {words}\n" in told(case)


@pytest.mark.mutant("a part that is called compared and is not")
def test_what_is_called_compared_is() -> None:
    """As `check` does, at two states."""
    text = SWING.replace(' delay=".01" nsample="2"', "").format(name="x")
    case = of_text(text.replace("<worldbody>", '<option density="1"/><worldbody>'))
    compared = {part.name for part in equations(opened(case).own, 2) if part.off is not None}
    assert compared == {*PARTS} - {PASSIVE}
    words = {module: "\n".join(module.described(case)) for module in (
        own_model, otherwise(own_model, "own.tree.unread.get(part, ())", "()"))}  # fmt: skip
    said = {module: {part for part in PARTS if f"{part:15}  compared" in text}
            for module, text in words.items()}  # fmt: skip
    assert [parts == compared for parts in said.values()] == [True, False]


@pytest.mark.parametrize("name", ["&lt;b&gt;", "x" * 300, "&#27;[31m&#10;rm", " ", "'"])
def test_odd_names_are_printed_and_no_more(name: str) -> None:
    text = told(of_text(SWING.format(name=name)))
    assert all(line.isprintable() for line in text.splitlines())


def test_what_is_nearly_empty_is_described() -> None:
    assert "nothing moves, and nothing is compared" in told(of_text("<mujoco/>"))
    still = SWING.replace(SWING[SWING.index("  <joint") : SWING.index("  <geom")], "")
    text = told(of_text(still[: still.index("<actuator>")] + "</mujoco>"))
    assert "nothing moves, and nothing is compared" in text
    assert "actuator" not in text


def test_a_urdf_is_described(tmp_path: Path) -> None:
    file = tmp_path / "arm.urdf"
    file.write_text(URDF)
    text = told(of_model(str(file), "arm.urdf", "arm"))
    assert "turn   hinge  hand  -1 to 2 rad  -5 to 5" in text
    assert "nothing drives it" in text


def test_what_does_not_compile_is_a_mistake() -> None:
    for answer in (described(of_text("<mujoco><worldbody>")),
                   script_lines(of_text("<mujoco><worldbody>"), Setting(OWN, {}))):  # fmt: skip
        assert isinstance(answer, CaseError)
        assert "does not compile" in answer.mistakes[0].what


LOOP = models()["closed_loop"]


@pytest.mark.slow
@pytest.mark.parametrize("setting", ["own", "rk4"])
def test_a_pasted_script_runs_the_samples_of_its_case(tmp_path: Path, setting: str) -> None:
    """Bit for bit, in a process that imports nothing of ours."""
    shown = textmech("show", "closed_loop", "--engine", f"mujoco.{setting}", folder=tmp_path)
    assert shown.returncode == 0, shown.stderr
    file = tmp_path / "pasted.py"
    file.write_text(shown.stdout, encoding="utf-8")
    done = subprocess.run([sys.executable, "-I", str(file)], capture_output=True, text=True,
                          check=True, timeout=60)  # fmt: skip
    rows = np.array([[*map(float, line.split())] for line in done.stdout.splitlines()])
    (case,) = load_model(LOOP)
    own, options = opened(case).own, {"integrator": "RK4"} if setting == "rk4" else {}
    times = times_of(case, [own.model.opt.timestep])
    states = stepped_states(own, times, options, own.model.opt.timestep)
    assert states is not None
    assert np.allclose(rows[:, 0], times, atol=1e-12)
    assert rows[:, 1:].tobytes() == states[:, : own.model.nq].tobytes()


def test_a_script_says_what_it_runs() -> None:
    (case,) = load_model(LOOP)
    lines = script_lines(case, Setting("mine", {"integrator": "RK4", "iterations": 5}, 1e-3))
    assert not isinstance(lines, CaseError)
    assert lines[1].endswith("mine: RK4, h = 0.001 s")
    assert {"model.opt.iterations = 5", "model.opt.timestep = 0.001"} <= set(lines)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["show", "hoper"], "did you mean 'hopper'?"),
        (["show", "hopper.slow"], "no such variant"),
        (["show", "hopper", "--engine", "pymunk"], "a model is stepped by mujoco alone"),
        (["show", "hopper", "--engine", "mujoco.rk5"], "did you mean 'rk4'?"),
        (["show", "hopper", "--settings", "mine.yaml"], "holds no options of mujoco"),
        (["show", "torn.xml"], "torn.xml:1"),
        (["show", "many.yaml", "--engine", "mujoco"], "show one of: many.a, many.b"),
        (["causes", "hopper"], "is a model"),
    ],
)
def test_what_is_asked_wrongly_is_told(tmp_path: Path, words: list[str], message: str) -> None:
    (tmp_path / "torn.xml").write_text("<mujoco><worldbody>")
    (tmp_path / "mine.yaml").write_text("pymunk: {step: 0.001}")
    (tmp_path / "swing.xml").write_text(SWING.format(name="x"))
    (tmp_path / "many.yaml").write_text("model: swing.xml\nvariants: {a: {}, b: {}}\n")
    done = textmech(*words, folder=tmp_path)
    assert done.returncode == 2
    assert message in done.stderr


@pytest.mark.slow
def test_a_file_of_ones_own_stands_before_a_shipped_name(tmp_path: Path) -> None:
    (tmp_path / "hopper.xml").write_text(SWING.format(name="mine"))
    shown = textmech("show", "hopper.xml", folder=tmp_path)
    assert "mine" in shown.stdout
    assert shown.returncode == 0
    assert "trunk" in textmech("show", "hopper", folder=tmp_path).stdout
