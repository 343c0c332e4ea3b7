"""What MuJoCo has of the same name and is another law: how far off it is, as near as it can be."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

from typing import Any

import mujoco
import numpy as np
import pytest
from given import scenes

STEP = 5e-4

# The load of `muscle_load` on MuJoCo's muscle: activated from the start on, without a passive force
# and with a force that does not depend on its length, as fast as Hill's is without a load, F₀ b/a;
# the spring beside is the tendon's. It has no place for the spring in series.
MUSCLE = """\
<mujoco>
  <option timestep="5e-4" integrator="RK4" gravity="0 -9.80665 0"/>
  <worldbody>
    <site name="O"/>
    <body pos="0 -0.3 0">
      <joint name="y" type="slide" axis="0 1 0"/>
      <inertial pos="0 0 0" mass="5" diaginertia="1 1 1"/>
      <site name="c"/>
    </body>
  </worldbody>
  <tendon>
    <spatial name="t" stiffness="4000" springlength="0.3"><site site="O"/><site site="c"/></spatial>
  </tendon>
  <actuator>
    <muscle tendon="t" force="1000" vmax="2" fvmax="1.2" fpmax="1e-9" lmin="-99" lmax="101"
            range="0.5 1.5" lengthrange="0.15 0.45" timeconst="1e-3 1e-3"/>
  </actuator>
  <keyframe><key act="1" ctrl="1"/></keyframe>
</mujoco>
"""
FIELD = """\
<mujoco>
  <option timestep="5e-4" gravity="0 0 0" magnetic="0 0 5"/>
  <worldbody><body><freejoint/><geom size="0.1"/></body></worldbody>
</mujoco>
"""


def started(text: str) -> tuple[Any, Any]:
    model = mujoco.MjModel.from_xml_string(text)
    return model, mujoco.MjData(model)


@pytest.mark.slow
def test_its_muscle() -> None:
    case, motion = scenes.SHIPPED["muscle_load"], scenes.solved("muscle_load").trajectory
    known = motion.states["load"][:, 1]
    model, data = started(MUSCLE)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    found = []
    for sample in range(case.samples):
        mujoco.mj_step(model, data, round(case.interval / STEP) if sample else 0)
        found.append(-0.3 + data.qpos[0])
    assert np.ptp(known) == pytest.approx(0.084, abs=1e-3)
    assert np.max(np.abs(np.array(found) - known)) == pytest.approx(0.0101, abs=1e-3)


def test_its_magnetic_field_moves_nothing() -> None:
    model, data = started(FIELD)
    data.qvel[:] = (1.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    mujoco.mj_step(model, data, 1000)
    assert data.qvel.tolist() == [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]
