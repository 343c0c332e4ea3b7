"""The script of a model's run: pasted, it moves the model bit for bit as our own steps do."""

from contextlib import redirect_stdout
from dataclasses import replace
from io import StringIO
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from given.otherwise import otherwise

from textmech.cases.fields.signal import Signal
from textmech.cases.find import models
from textmech.cases.load_model import load_model
from textmech.cases.model_case import Law, Steps
from textmech.engines.own_model import script as module
from textmech.engines.own_model.limit import stepped_states
from textmech.engines.own_model.model import OwnModel, compiled
from textmech.engines.own_model.opened import opened

H = 0.01
LAWS: dict[str, Law] = {
    "constant": Signal("constant", (0.3,)),
    "ramp": Signal("ramp", (0.7,)),
    "sine": Signal("sine", (0.3,), angular_frequency=7.1, phase=0.3),
    "step": Signal("step", (-0.4,), times=(0.05,)),
    "pulse": Signal("pulse", (0.9,), times=(0.02, 0.07)),
    "polynomial": Signal("polynomial", (1.0,), values=(0.1, -2.0, 3.0)),
    "table": Signal("table", (1.0,), times=(0.01, 0.033, 0.1), values=(0.0, 1.0, -0.2)),
    "held": Steps((0.02, 0.05), (0.4, -0.3)),
}
ROBOT = """\
<mujoco><option timestep="0.01"/><worldbody>
<geom type="plane" size="1 1 1" solref=".005 1"/>
<body mocap="true" name="goal"><geom size=".01" contype="0" conaffinity="0"/></body>
<body name="base" pos="0 0 .09"><freejoint/><geom size=".1" mass="1" solref=".005 1"/>
<body pos=".3 0 0"><joint type="ball"/><geom size=".05" mass="1" pos=".1 0 0"/>
<body name="it's &quot;&#10;import os#"><joint name="it's &quot;&#10;import os#"/><geom size=".05" mass="1" pos="0 .1 0"/></body></body></body>
</worldbody><equality><connect body1="goal" body2="base" anchor="0 0 0" solref="1 1"/></equality><tendon><fixed name="sum"><joint joint="it's &quot;&#10;import os#" coef="2"/></fixed></tendon>
<actuator><motor tendon="sum"/><general tendon="sum" dyntype="filter" dynprm=".1"/></actuator>
<keyframe><key mpos="1 2 3" act=".2" ctrl=".1 .3"/></keyframe></mujoco>"""  # noqa: E501


def printed(lines: list[str]) -> np.ndarray:
    """Runs a script in this process; (N, 1 + m) [s] what it prints."""
    with redirect_stdout(StringIO()) as output:
        exec("\n".join(lines), {})
    return np.array([[*map(float, line.split())] for line in output.getvalue().splitlines()])


def same(own: OwnModel, options: dict[str, Any], h: float, script: Any = module.script) -> bool:
    """Whether the script moves a model as its own steps do, at each second step of ten."""
    rows = printed(script(own, own.file, options, h, 10, 2))
    times = np.arange(0.0, 11.0, 2.0) * h
    states = stepped_states(own, times, options, h)
    assert states is not None
    assert np.array_equal(rows[:, 0], times)
    assert np.ptp(rows[:, 1:], axis=0).any()
    return rows[:, 1:].tobytes() == states[:, : own.model.nq].tobytes()


def robot(folder: Path, laws: dict[int, Law] | None = None) -> OwnModel:
    file = folder / "it's a robot.xml"
    file.write_text(ROBOT)
    return replace(compiled(str(file)), laws=laws or {})


@pytest.mark.parametrize("name", LAWS)
def test_laws_in_time_are_followed(tmp_path: Path, name: str) -> None:
    other = Signal("table", (1.0,), times=(0.01, 0.033, 0.1), values=(2.0, 1.0, 0.0))
    own = robot(tmp_path, {0: LAWS[name], 1: other})
    own = replace(own, begun=begun_with(own))
    assert same(own, {}, H)


def begun_with(own: OwnModel) -> Any:
    """Returns its start, with the controls that its laws begin with."""
    start = own.start()
    start.ctrl[:] = own.controls.at(0.0)
    return start


@pytest.mark.parametrize(
    ("options", "h"),
    [
        ({}, H),
        ({"integrator": "RK4"}, H),
        ({"integrator": "implicitfast", "solver": "CG", "cone": "elliptic", "iterations": 3}, H),
        ({}, H / 4),
        ({"tolerance": 1e-3, "iterations": 1}, 2 * H),
    ],
)
def test_each_setting_is_written(tmp_path: Path, options: dict[str, Any], h: float) -> None:
    assert same(robot(tmp_path), options, h)


@pytest.mark.parametrize("name", models())
def test_the_shipped_models_are(name: str) -> None:
    (case,) = load_model(models()[name])
    assert same(opened(case).own, {}, opened(case).own.model.opt.timestep)


def test_contacts_may_be_off(tmp_path: Path) -> None:
    own = robot(tmp_path)
    own.model.opt.disableflags |= module.CONTACT
    assert same(own, {}, H)
    assert "mjDSBL_CONTACT" in "\n".join(module.script(own, own.file, {}, H, 1, 1))


@pytest.mark.mutant("a script that loses {lost}")
@pytest.mark.parametrize(
    ("lost", "was", "now", "h"),
    [
        ("where mocap bodies stand", '"mocap_pos", ', "", H),
        ("the law of its own step", "if h < step and", "if h < 0.0 and", H / 4),
        ("when a control jumps", "(k + {SLIGHT!r}) * h", "(k + 1) * h", H),
        ("a held value", "\") - 1'", "\") - 2'", H),
        ("the activation", '"act", ', "", H),
    ],
)
def test_a_script_that_loses_something_moves_otherwise(
    tmp_path: Path, lost: str, was: str, now: str, h: float
) -> None:
    wrong: ModuleType = otherwise(module, was, now)
    own = robot(tmp_path, {0: Steps((0.02, 0.05), (0.4, -0.3))})
    assert same(own, {}, h)
    assert not same(own, {}, h, wrong.script)


def test_what_diverges_ends_the_script(tmp_path: Path) -> None:
    own = robot(tmp_path)
    start = own.start()
    start.qvel[:] = 1e9
    with pytest.raises(SystemExit, match="diverges in the step from 0"):
        printed(module.script(replace(own, begun=start), own.file, {}, H, 10, 2))
