"""What is handed over to paste, in models and scripts that somebody else has written.

Plain engines and no adapter: what `textmech advise` prints stands in an ordinary MJCF file (geoms
that touch, a loop that is cut at another joint) or behind an ordinary script, and does there what
was promised.
"""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import re
from collections.abc import Mapping, Sequence
from math import cos, degrees, sin
from typing import Any

import mujoco
import numpy as np
import pytest
from given import scenes
from given.adapters.planning import begun

from textmech.engines.mujoco import MuJoCo
from textmech.reference.solve import solve
from textmech.reports.front.show.advice import advice_lines
from textmech.reports.front.show.readme import listed_questions as listed
from textmech.reports.runs.cache.store import usable
from textmech.reports.runs.request import Request
from textmech.reports.runs.selection import choose_engines
from textmech.reports.search.advice.advice_rows import Advised, Requirement
from textmech.reports.search.advice.advise import advised

pytestmark = pytest.mark.slow

G = 9.81  # m/s²


def handed_over(name: str, engine: str) -> list[str]:
    """The texts below `to paste`, one for each recipe."""
    asked, chosen = Requirement(None, 2.0), choose_engines([engine], ["shipped"])
    cases = [scenes.EVERY[name]]
    with advised(Request(cases, chosen, jobs=1, store=usable()), asked) as (one,):
        return list(below(one))


def below(one: Advised) -> Sequence[str]:
    lines, texts = list(advice_lines(one)), list[str]()
    for place, line in enumerate(lines):
        if line.strip() == "to paste":
            end = lines.index("    as a file of --settings", place)
            texts.append("\n".join(line[6:] for line in lines[place + 1 : end]))
    assert texts
    return texts


BARS = scenes.EVERY["four_bar"]
LINKAGE = """
<mujoco>
  {pasted}
  <worldbody>
    <body name="crank" pos="0 0 0" euler="0 {crank} 0">
      <joint name="A" type="hinge" axis="0 -1 0"/>
      <inertial pos="0.15 0 0" mass="1" diaginertia="1e-4 0.0075 0.0075"/>
      <body name="coupler" pos="0.3 0 0" euler="0 {coupler} 0">
        <joint name="B" type="hinge" axis="0 -1 0"/>
        <inertial pos="0.4 0 0" mass="1" diaginertia="1e-4 {j_coupler} {j_coupler}"/>
      </body>
    </body>
    <body name="rocker" pos="0.9 0 0" euler="0 {rocker} 0">
      <joint name="D" type="hinge" axis="0 -1 0"/>
      <inertial pos="0.3 0 0" mass="1" diaginertia="1e-4 0.03 0.03"/>
    </body>
  </worldbody>
  <equality><connect body1="coupler" body2="rocker" anchor="0.8 0 0"/></equality>
</mujoco>
"""


def linkage(pasted: str) -> float:
    """How far [rad] the crank is off the textbook's at worst; the loop is cut at C, ours at D.

    As a user writes it: in the xz plane, with the first pose as the model's own.
    """
    reference = solve(BARS).trajectory
    angles = {name: reference.states[name][:, 2] for name in ("crank", "coupler", "rocker")}
    crank, coupler, rocker = (float(angle[0]) for angle in angles.values())
    text = LINKAGE.format(
        pasted=pasted,
        crank=-degrees(crank),
        coupler=-degrees(coupler - crank),
        rocker=-degrees(rocker),
        j_coupler=0.8**2 / 12,
    )
    model = mujoco.MjModel.from_xml_string(text)
    data, found = mujoco.MjData(model), [crank]
    steps = round(BARS.interval / model.opt.timestep)
    for _ in BARS.times[1:]:
        mujoco.mj_step(model, data, nstep=steps)
        found.append(crank + float(data.qpos[0]))
    return float(np.max(np.abs(np.array(found) - angles["crank"])))


def test_a_linkage_whose_loop_is_cut_elsewhere() -> None:
    allowed = 1e-2  # rad: the case's own
    assert linkage("") > 10 * allowed
    for text in handed_over("four_bar", "mujoco"):
        assert linkage(text) <= allowed


STACK = """
<mujoco>
  {pasted}
  <default><geom friction="0.5 0.005 0.0001"/></default>
  <worldbody>
    <geom name="floor" type="plane" size="0 0 1"/>
    <body pos="0 0 0.05">
      <freejoint/>
      <geom type="box" size="0.2 0.2 0.05" mass="1"/>
    </body>
    <body pos="0 0 0.15">
      <freejoint/>
      <geom type="box" size="0.1 0.1 0.05" mass="20"/>
    </body>
  </worldbody>
</mujoco>
"""


def sunk(pasted: str) -> float:
    """How deep [m] the heavy box sinks into the light one and that into the floor, in 1 s."""
    model = mujoco.MjModel.from_xml_string(STACK.format(pasted=pasted))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=round(1.0 / model.opt.timestep))
    return 0.15 - float(data.qpos[9])


def test_a_heavy_box_of_geoms_does_not_sink() -> None:
    assert sunk("") > 5e-4
    for text in handed_over("heavy_on_light", "mujoco"):
        assert abs(sunk(text)) < 2e-4  # m: what the case allows


LYING = """
<mujoco>
  {pasted}
  <worldbody>
    <geom type="plane" size="0 0 1"/>
    <body pos="0 0 0.1">
      <freejoint/>
      <geom type="sphere" size="0.1" mass="20"/>
    </body>
  </worldbody>
</mujoco>
"""


def lies(pasted: str) -> float:
    """How deep [m] a ball lies in the floor after 1 s, with the friction 1 that MuJoCo gives it."""
    model = mujoco.MjModel.from_xml_string(LYING.format(pasted=pasted))
    data = mujoco.MjData(model)
    mujoco.mj_step(model, data, nstep=round(1.0 / model.opt.timestep))
    return 0.1 - float(data.qpos[2])


def test_a_ball_of_geoms_does_not_sink_as_the_question_is_answered() -> None:
    """A finer step alone changes nothing of it, where friction is larger than the case's."""
    (scene, start), engine = begun("sinking_ball"), MuJoCo("shipped")
    setting = listed()["sinking_ball"].settings["mujoco"]
    assert isinstance(setting, Mapping)
    options = {name: value for name, value in setting.items() if name != "step"}
    step = setting.get("step", engine.own_step)
    allowed = 1e-4  # m: the case's own
    assert lies("") > 3 * allowed
    assert lies('<option timestep="0.001"/>') > 3 * allowed
    assert lies(engine.snippet(scene, start, options, step)) < allowed


BLOCK = """
<mujoco>
  {pasted}
  <worldbody>
    <geom name="floor" type="plane" size="0 0 1" friction="0.5 0.005 0.0001"/>
    <body pos="0 0 0.05">
      <freejoint/>
      <geom type="box" size="0.1 0.1 0.05" mass="1" friction="0.5 0.005 0.0001"/>
    </body>
  </worldbody>
</mujoco>
"""


def crept(pasted: str) -> float:
    """How far [m] a box creeps down 15 degrees in 2 s, after 0.2 s in which its faces meet."""
    model = mujoco.MjModel.from_xml_string(BLOCK.format(pasted=pasted))
    slope = np.radians(15.0)
    model.opt.gravity[:] = -G * sin(slope), 0, -G * cos(slope)
    data, places = mujoco.MjData(model), list[float]()
    for seconds in (0.2, 2.0):
        mujoco.mj_step(model, data, nstep=round(seconds / model.opt.timestep))
        places.append(float(data.qpos[0]))
    return places[0] - places[1]


def test_a_box_of_geoms_does_not_creep() -> None:
    assert crept("") > 1e-3
    for text in handed_over("creeping_block", "mujoco"):
        assert abs(crept(text)) < 1e-4  # m: what the case allows in 2 s


BALL = """
<mujoco>
  {pasted}
  <worldbody>
    <geom name="floor" type="plane" size="0 0 1" friction="0.5 0 0"/>
    <body pos="0 0 0.1">
      <freejoint/>
      <geom type="sphere" size="0.1" mass="1" friction="0.5 0 0"/>
    </body>
  </worldbody>
</mujoco>
"""


def carried(pasted: str) -> list[float]:
    """What the floor carries [N] at the first instants of a ball that rolls."""
    model = mujoco.MjModel.from_xml_string(BALL.format(pasted=pasted))
    data, forces, found = mujoco.MjData(model), np.zeros(6), list[float]()
    data.qvel[0], data.qvel[4] = 1.0, 10.0
    for _ in range(5):
        mujoco.mj_forward(model, data)
        total = 0.0
        for contact in range(data.ncon):
            mujoco.mj_contactForce(model, data, contact, forces)
            total += float(forces[0])
        found.append(total)
        mujoco.mj_step(model, data)
    return found


def test_a_ball_of_geoms_is_carried_from_the_first_step_on() -> None:
    assert carried("")[0] == 0.0
    for text in handed_over("rolling_wheel.pushed", "mujoco"):
        assert carried(text) == pytest.approx([G] * 5, rel=1e-2)


DISK = """
<mujoco>
  {pasted}
  <worldbody>
    <geom name="floor" type="plane" size="0 0 1" friction="0.4 0 0"/>
    <body pos="0 0 0.25">
      <freejoint/>
      <geom name="disk" type="cylinder" size="0.25 0.05" euler="90 0 0" friction="0.4 0 0"/>
    </body>
  </worldbody>
  {pair}
</mujoco>
"""


def thrown(pasted: str) -> tuple[float, float]:
    """How far [m] a disk that spins back, slides up 10 degrees and rolls is off, and its hop."""
    pair = "".join(re.findall("<contact>.*</contact>", pasted))
    pair = pair.replace("…", "floor", 1).replace("…", "disk", 1)
    model = mujoco.MjModel.from_xml_string(DISK.format(pasted=pasted, pair=pair))
    slope, radius, v, spin = np.radians(10.0), 0.25, -3.0, -20.0
    pulled, rubbed = G * sin(slope), 0.4 * G * cos(slope)
    model.opt.gravity[:] = pulled, 0, -G * cos(slope)
    data, hop = mujoco.MjData(model), 0.0
    data.qvel[0], data.qvel[4] = v, -spin
    for _ in range(round(2.0 / model.opt.timestep)):
        mujoco.mj_step(model, data)
        hop = max(hop, float(data.qpos[2]) - radius)
    # it slides until its slip v + spin R is gone, which grows by pulled + 3 rubbed; then it rolls
    slides = -(v + spin * radius) / (pulled + 3 * rubbed)
    reached = v * slides + (pulled + rubbed) * slides**2 / 2
    rolls, fast = 2.0 - slides, v + (pulled + rubbed) * slides
    return abs(float(data.qpos[0]) - reached - fast * rolls - pulled / 3 * rolls**2), hop


def test_a_disk_of_geoms_slides_and_rolls_where_the_pair_is_pasted_too() -> None:
    off, hop = thrown("")
    assert off > 3e-3
    for text in handed_over("sliding_disk.uphill", "mujoco"):
        assert thrown(text)[0] < 1e-3  # m: what the case allows
        forgotten = re.sub("<contact>.*</contact>", "", text)
        assert thrown(forgotten)[1] < 2 * hop  # where no pair is, it does no harm


PENDULUM = """
import pymunk

space = pymunk.Space()
space.gravity = 0, -9.81
h = 0.01
rod = pymunk.Body(1.0, 1.0 / 12)
rod.position = 0.5, 0
space.add(rod, pymunk.PivotJoint(space.static_body, rod, (0, 0), (-0.5, 0)))
"""


def pendulum(pasted: str) -> float:
    """Which share of its largest kinetic energy a rod of 1 m has lost, or won, after 2 s."""
    names: dict[str, Any] = {}
    exec(PENDULUM + pasted, names)
    h, rod, space = names["h"], names["rod"], names["space"]
    ahead = h / 2 if "half" in pasted or "h/2" in pasted else 0.0
    for _ in range(round(2.0 / h)):
        space.step(h)
    spin, v = rod.angular_velocity, rod.velocity
    y = rod.position.y + ahead * v.y
    return abs(v.length**2 / 2 + spin**2 / 24 + G * y) / (G / 2)


def test_a_pendulum_of_pymunk_keeps_its_energy() -> None:
    assert pendulum("") > 0.05
    for text in handed_over("leaking_pendulum", "pymunk"):
        assert pendulum(text) < 1e-3
