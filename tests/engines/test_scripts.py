"""A script makes the same motion as the run, and a title is text in it."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import ast
import re
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path
from typing import get_args
from xml.etree import ElementTree as ET

import mujoco
import numpy as np
import pytest
from given.adapters import engine_scenes as given
from given.adapters.planning import NATIVE, SETTINGS, TUNED, begun, moved, pair, planned, words
from given.scenes import SHIPPED, typed

from textmech.cases.fields.signal import Law, Signal
from textmech.cases.scene import Scene
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.rotation import matrix
from textmech.cases.scene.shape import bar
from textmech.engines.engine import Engine, Start
from textmech.engines.mujoco.callbacks.signal import installed
from textmech.engines.mujoco.model.force import BY_ITSELF
from textmech.engines.mujoco.model.script import control_script
from textmech.reports.compare.trial.start import assembled

STEP = 1e-3  # s: whole steps in the 1 s that a script of pymunk's runs
END = np.array([0.0, 1.0])


def stepped(text: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The MJCF file after 1 s, with the callback that its comment says."""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    with installed(None):  # and takes away what is pasted
        for pasted in re.findall(r"<!--\n(.*?)-->", text, flags=re.DOTALL):
            exec(pasted, {})
        mujoco.mj_step(model, data, round(1.0 / model.opt.timestep))
    mujoco.mj_kinematics(model, data)
    return model, data


def by_mujoco(text: str, scene: Scene) -> dict[str, list[float]]:
    """The places after 1 s of the MJCF file."""
    _, data = stepped(text)
    size = scene.frame.dimension
    return {name: data.body(name).xipos[:size].tolist() for name in scene.bodies}


def by_python(text: str, scene: Scene) -> dict[str, list[float]]:
    """The states after 1 s that the script prints."""
    run = [sys.executable, "-c", text]
    done = subprocess.run(run, capture_output=True, text=True, check=True)
    rows = {line.split()[0]: line.split()[1:] for line in done.stdout.splitlines()}
    return {name: [float(x) for x in rows[name]] for name in scene.bodies}


# How a script is run, and how near it comes: MuJoCo's file is what the run loads, bit for bit, but
# its places are worked out by our kinematics (measured 3e-16); pymunk's script adds forces up in
# another order.
RUN = {"mujoco": (by_mujoco, 1e-15), "pymunk": (by_python, 1e-12)}


def same(engine: Engine, scene: Scene, start: Start) -> None:
    """The script's end is the run's."""
    run, near = RUN[engine.name]
    ends = run(engine.script(scene, start, STEP, planned(engine, scene, start)), scene)
    motion = moved(engine, scene, start, END, STEP)
    for body, states in motion.states.items():
        wanted = states[-1, : len(ends[body])].tolist()
        assert ends[body] == pytest.approx(wanted, rel=near, abs=near)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "engine"), NATIVE, ids=pair)
def test_a_cases_script_makes_the_same_motion(name: str, engine: Engine) -> None:
    same(engine, *begun(name))


BAR = bar(name="rod", mass=1.1, length=0.8, points={})
TOUCHED: dict[str, tuple[Scene, Start]] = {
    "a block that one bound of friction brakes": (
        given.guided(given.DRAWN, given.THREE),
        given.RESTS,
    ),
    "a block thrown up an incline": (
        given.incline(given.BLOCK, given.touching("block", 0.3), slope=0.2),
        given.thrown(-1.0),
    ),
    "a wheel that bounces": (
        given.incline(given.WHEEL, given.touching("wheel", 0.2, restitution=0.5)),
        given.launched(2.0, 3.0, height=0.2),
    ),
    "a bar's end on the floor": (
        given.incline(BAR, given.touching("rod", 0.3, point="start")),
        given.leaning(0.8, 1.0),
    ),
}


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
@pytest.mark.parametrize("what", TOUCHED)
def test_a_script_with_friction_makes_the_same_motion(what: str, engine: Engine) -> None:
    same(engine, *TOUCHED[what])


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_a_script_with_a_slot_makes_the_same_motion(engine: Engine) -> None:
    same(engine, *given.in_a_slot())


def turned(name: str, spoil: Callable[[str], str] = str) -> float:
    """How far the file's bodies stand from the run's after 1 s: entries of their axes."""
    case, engine = SHIPPED[name], TUNED["mujoco"]
    start = assembled(case)
    text = engine.script(case.scene, start, STEP, planned(engine, case.scene, start))
    _, data = stepped(spoil(text))
    motion = moved(engine, case.scene, start, END, STEP)
    ends = {body: matrix(rows[-1, SPACE.attitude]) for body, rows in motion.states.items()}
    found = {body: data.body(body).xmat.reshape(3, 3) for body in ends}
    return max(float(np.max(np.abs(found[body] - axes))) for body, axes in ends.items())


SINES = ["cat_turn", "sprung_gimbal.driven", "driven_robot"]


@pytest.mark.parametrize("name", SINES)
def test_a_script_in_space_says_its_sines(name: str) -> None:
    """Those of motors and of drives: what is pasted does all that the run's callback does."""
    assert turned(name) < 1e-14


@pytest.mark.slow
@pytest.mark.mutant("{name}: a sine left out of the user's script")
@pytest.mark.parametrize("name", SINES)
def test_a_sine_that_is_not_pasted_is_seen(name: str) -> None:
    assert turned(name, lambda text: text.replace("= math.sin", "= 0 * math.sin")) > 1e-3


LAWS = {
    "sine": Signal("sine", (1.0,), angular_frequency=3.0, phase=0.4),
    "step": Signal("step", (1.0,), times=(0.7,)),
    "pulse": Signal("pulse", (1.0,), times=(0.2, 0.7)),
    "polynomial": Signal("polynomial", (1.0,), values=(0.3, -2.0, 0.0, 1.5)),
    "table": Signal("table", (1.0,), times=(0.1, 0.4, 0.8), values=(1.0, -2.0, 0.5)),
}
MOTOR = """<mujoco><worldbody><body><joint name="j"/><geom size="1"/></body></worldbody>
<actuator><motor name="m" joint="j"/></actuator></mujoco>"""


def pasted(law: Signal, times: list[float]) -> list[float]:
    """The control that the printed callback sets at these times."""
    model = mujoco.MjModel.from_xml_string(MOTOR)
    data, space = mujoco.MjData(model), {}
    text = control_script(model, [law]).split("<!--")[-1].split("-->")[0]
    exec(text.replace("mujoco.set_mjcb_control(control)", ""), space)
    found = []
    for data.time in times:
        space["control"](model, data)
        found.append(float(data.ctrl[0]))
    return found


@pytest.mark.parametrize("name", LAWS)
def test_a_script_says_each_law_in_time(name: str) -> None:
    """Before and after each corner, and outside of all; in a step with one its mean."""
    law, h = LAWS[name], 0.002  # s: MuJoCo's own
    smooth = [0.0, 0.15, 0.3, 0.69, 0.75, 2.0]
    known = law.at(np.array(smooth))[:, 0]
    np.testing.assert_allclose(pasted(law, smooth), known, rtol=0, atol=1e-14)
    if law.corners:
        edges = [corner - part * h for corner in law.corners for part in (0.8, 0.55)]
        middles = np.linspace(0.0, h, 1000, endpoint=False) + h / 2000
        means = [np.mean(law.at(begin + middles)[:, 0]) for begin in edges]
        np.testing.assert_allclose(pasted(law, edges), means, rtol=0, atol=1e-8)


JUMPY = """\
scene:
  points: {O: [0, 0]}
  bodies: {cart: {block: {mass: 1.0, width: 0.2, height: 0.1}}}
  joints: {rail: {slide: [ground.O, cart.center], along: [1, 0]}}
  forces:
    hand: {push: cart.center, step: {amplitude: [1.0, 0], at: 0.3}}
    foot: {push: cart.center, pulse: {amplitude: [3.0, 0], from: 0.4003, until: 0.6}}
    wind: {push: cart.center, table: {along: [1, 0], times: [0.1, 0.5, 0.7006], values: [0, 2, 1]}}
initial: {cart: {x: 0, vx: 1.0}}
allow: {cart.vx: 1.0e-5}
"""


def jumped(folder: Path, spoil: Callable[[str], str] = str) -> float:
    """How far the speed of the pasted model is off the textbook's after 1 s [m/s]."""
    case, engine = typed(folder, JUMPY), TUNED["mujoco"]
    start = assembled(case)
    text = engine.script(case.scene, start, STEP, planned(engine, case.scene, start))
    _, data = stepped(spoil(text))
    # 1 N · 0.7 s, 3 N · 0.1997 s, and under the table 0.4 · 1, 0.2006 · 1.5, 0.2994 · 1 N s.
    return abs(float(data.qvel[0]) - 1.0 - 0.7 - 0.5991 - 0.4 - 0.3009 - 0.2994)


@pytest.mark.slow
@pytest.mark.mutant("a pasted law that jumps, weighed by RK4's stages")
@pytest.mark.mutant("a pasted law that jumps, whose step begins where each stage is")
def test_a_pasted_law_that_jumps_gives_what_the_run_does(tmp_path: Path) -> None:
    assert jumped(tmp_path) < 1e-13
    bare = "1.0 if t >= 0.3 else 0.0  #"
    weighed = jumped(tmp_path, lambda text: re.sub(r"min\(1.0, .*- 0.3\) / h\)\)  #", bare, text))
    assert weighed == pytest.approx(STEP / 6, rel=1e-6)
    assert jumped(tmp_path, lambda text: text.replace("begin_of_step(t, h)\n  ", "t\n  ")) > 1e-5


@pytest.mark.mutant("a pasted callback that steps other models too")
def test_a_pasted_callback_leaves_other_models_alone() -> None:
    """It is pasted once the model is loaded: while there is one MuJoCo loads none, as it says."""
    model = mujoco.MjModel.from_xml_string(MOTOR)
    other, data = mujoco.MjModel.from_xml_string("<mujoco/>"), mujoco.MjData(model)
    said, code = control_script(model, [LAWS["sine"]]).split("<!--")[-2:]
    assert "while one is set MuJoCo loads no model" in said
    try:
        exec(code.split("-->")[0], {})
        with pytest.raises(ValueError, match="Python exception"):
            mujoco.MjModel.from_xml_string(MOTOR)
        mujoco.mj_step(other, mujoco.MjData(other))
        mujoco.mj_step(model, data)
    finally:
        mujoco.set_mjcb_control(None)
    assert data.ctrl[0] == pytest.approx(np.sin(0.4), rel=1e-12)


def test_each_law_that_a_callback_follows_is_asked() -> None:
    assert {*LAWS, *BY_ITSELF} == {*get_args(Law)}


HOSTILE = 'a\nimport os\r--> <b/> <!-- --- \x00 \x1b[31m  \x85 \'""" end -'

# What of a text is code.
MEANING: dict[str, Callable[[str], str]] = {
    "mujoco": ET.canonicalize,  # leaves comments out
    "pymunk": lambda text: ast.dump(ast.parse(text)),
}


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_a_title_is_text_in_an_engines_file(engine: Engine) -> None:
    scene, start = begun("four_bar")
    plan = planned(engine, scene, start)
    plain, titled = (engine.script(scene, start, 1e-3, plan, title=t) for t in ("", HOSTILE))
    meaning = MEANING[engine.name]
    assert meaning(plain) == meaning(titled)
    assert "import os" in titled
