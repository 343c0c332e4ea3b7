"""A script makes the same motion as the run, and a title is text in it."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import ast
import subprocess
import sys
from collections.abc import Callable
from xml.etree import ElementTree as ET

import mujoco
import numpy as np
import pytest
from given import engine_scenes as given
from given.planning import NATIVE, SETTINGS, begun, moved, pair, planned, words

from textmech.cases.frame import PLANE
from textmech.cases.scene import Scene
from textmech.cases.shape import bar
from textmech.engines.engine import Engine, Start
from textmech.engines.mujoco import force
from textmech.engines.mujoco.law.signal import swinging, together
from textmech.engines.mujoco.space import scene as space

STEP = 1e-3  # s: whole steps in the 1 s that a script of pymunk's runs
END = np.array([0.0, 1.0])


def by_mujoco(text: str, scene: Scene) -> dict[str, list[float]]:
    """The places after 1 s of the MJCF file; signals in time are a user's own callback."""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    laws = force.signals(scene) if scene.frame is PLANE else space.signals(scene)  # type: ignore[arg-type]
    with together([swinging(laws)]):
        mujoco.mj_step(model, data, round(1.0 / model.opt.timestep))
    mujoco.mj_kinematics(model, data)
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


@pytest.mark.whole
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
