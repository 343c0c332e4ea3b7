"""What is said of MuJoCo's bounces: how much of the speed they keep, wherever in a step."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import math

import mujoco
import numpy as np
import pytest

from textmech.cases.trajectory import Array
from textmech.engines.mujoco.model.bounce import springy
from textmech.engines.mujoco.model.limit import BEAT as OF_STOPS

H = 1e-4  # s
V = 2.0  # m/s
BALL = """\
<mujoco>
<option timestep="{h}" integrator="RK4" jacobian="dense" tolerance="1e-14" gravity="0 0 0">
<flag diagexact="enable"/></option>
<worldbody><geom name="wall" type="plane" size="0 0 1" zaxis="-1 0 0"/>
<body><joint type="slide" axis="1 0 0"/><inertial pos="0 0 0" mass="1.3" diaginertia="1 1 1"/>
<geom name="ball" size="0.1"/></body></worldbody>
<contact><pair geom1="wall" geom2="ball" condim="1" solimp="1.01e-4 1.01e-4 1e-3"
solref="{solref}"/></contact>
</mujoco>"""


def kept(e: float, beat: float) -> Array:
    """(40,) of the speed, where the ball meets the wall all over a step."""
    _, b, _ = springy(e, beat)
    text = BALL.format(h=H, solref=f"{-((beat / H) ** 2)} {-b / H}")
    model = mujoco.MjModel.from_xml_string(text)
    data, speeds = mujoco.MjData(model), []
    for part in np.arange(40) / 40:
        mujoco.mj_resetData(model, data)
        data.qpos[0], data.qvel[0] = -0.1 - (10 + part) * V * H, V
        mujoco.mj_step(model, data, 20 + math.ceil(4 * math.pi / beat))
        speeds.append(-data.qvel[0] / V)
    return np.array(speeds)


@pytest.mark.parametrize("beat", [0.2, OF_STOPS])
@pytest.mark.parametrize("e", [1.0, 0.9, 0.8, 0.5, 0.3, 0.1])
def test_it_keeps_as_much_as_is_said(e: float, beat: float) -> None:
    """About, of what is a rule of thumb: 0.85 to 1.3 of it was measured."""
    because = springy(e, beat)[2]
    said = float(because.partition("about ")[2].partition(" %")[0])
    share = kept(e, beat) / e - 1
    off = 100 * np.max(np.abs(share))
    assert np.mean(share) == pytest.approx(0.0, abs=0.15 * off + 1e-4)
    assert 0.7 * said < off < 1.5 * said
