"""A model's motion with two releases: which joint moved and by how much, and which is nearer."""

from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given.command import textmech
from given.command.releases import index, wheel
from given.otherwise import otherwise

from textmech.cases.model_case import ModelCase, of_model
from textmech.engines.own_model.limit import stepped_states
from textmech.engines.own_model.opened import opened
from textmech.reports.front.versions import motions
from textmech.reports.front.versions.measure import Measured
from textmech.reports.front.versions.release import Release
from textmech.reports.front.versions.stepping import stepped

ARM = """\
<mujoco><option timestep="0.01" integrator="implicitfast"/><worldbody>
<body><joint name="shoulder" axis="0 1 0" damping="0.1"/>
<geom type="capsule" size=".05 .5" pos="0 0 .5" mass="1"/>
<body pos="0 0 1"><joint name="wrist" axis="0 1 0" damping=".02"/>
<geom type="capsule" size=".02 .05" pos="0 0 .05" mass=".05"/></body></body></worldbody>
<keyframe><key qpos="1 0.5" qvel="0 0"/></keyframe></mujoco>"""


@pytest.fixture
def case(tmp_path: Path) -> ModelCase:
    file = tmp_path / "arm.xml"
    file.write_text(ARM, encoding="utf-8")
    return of_model(str(file), str(file), "arm")


def with_integrator(case: ModelCase, word: str) -> dict[str, Any]:
    """What a release would say that steps the model by another integrator than it asks for."""
    own, times = opened(case).own, np.array(stepped(case)["times"])
    y = stepped_states(own, times, {"integrator": word}, own.model.opt.timestep)
    return {"because": "diverges"} if y is None else {"times": times.tolist(), "y": y.tolist()}


def lines(case: ModelCase, samples: Sequence[dict[str, Any]], module: Any = motions) -> list[str]:
    releases = [
        Measured(Release("mujoco", f"{k}.0"), None, motions={case.name: each})
        for k, each in enumerate(samples, 1)
    ]
    return [*module.motion_lines([case], releases)]


@pytest.mark.mutant("the farther release is called the nearer one")
def test_which_joint_moved_and_which_release_is_nearer_is_said(case: ModelCase) -> None:
    own, other = stepped(case), with_integrator(case, "RK4")
    told = lines(case, [own, other])
    moved = np.abs(np.array(own["y"]) - other["y"])[:, :2]
    joint = ("shoulder", "wrist")[int(moved.max(axis=0).argmax())]
    assert f"since 1.0 {joint}.angle moved by up to {moved.max():.2g} rad" in told[3]
    assert "2.0: " in told[3]
    assert told[-1].startswith("    it is nearer")  # RK4's fourth order
    assert lines(case, [other, own])[-1].startswith("    1.0 is nearer")
    swapped = otherwise(motions, "was_off.ratio < off.ratio", "was_off.ratio > off.ratio")
    assert lines(case, [own, other], swapped)[-1].startswith("    1.0 is nearer")


@pytest.mark.mutant("of the worst error alone it is told what moved, and a joint that it hides")
def test_what_moved_is_of_the_motions_and_not_of_their_errors(case: ModelCase) -> None:
    """A motion as far before the limit as the other is behind it has the same error."""
    own = opened(case).own
    own_samples = stepped(case)
    times = np.array(own_samples["times"])
    exact = motions.limit_and_horizon(opened(case), times)[0].y
    mirrored = {**own_samples, "y": (2 * exact - own_samples["y"]).tolist()}
    told = lines(case, [own_samples, mirrored])
    off = np.abs(own_samples["y"] - exact)[:, : own.model.nq].max()
    assert f"moved by up to {2 * off:.2g} rad" in told[3]
    assert told[-1].startswith("    as near as 1.0")
    of_errors = otherwise(motions, "farthest(ready, earlier, motion)", "was_off or off")
    assert f"moved by up to {2 * off:.2g} rad" not in lines(case, [own_samples, mirrored],
                                                           of_errors)[3]  # fmt: skip


def test_what_cannot_be_compared_is_said(case: ModelCase) -> None:
    own = stepped(case)
    assert lines(case, [own, own])[-1] == "  2.0: moved nothing since 1.0"
    lost = {"because": "its own step diverges"}
    narrow = {**own, "y": [row[:-1] for row in own["y"]]}
    told = lines(case, [own, lost, narrow, {}, own])
    assert told[3:6] == [
        "  2.0: its own step diverges",
        "  3.0: has other coordinates",
        "  4.0: has other coordinates",
    ]
    assert told[6] == "  5.0: moved nothing since 1.0"
    assert lines(case, []) == []


OTHER_LAW = """\
step = real.mj_step
def undamped(model, data, nstep=1):
    damping = model.dof_damping.copy()
    model.dof_damping[0] = 0
    step(model, data, nstep)
    model.dof_damping[:] = damping
real.mj_step = undamped
real.__version__ = '90.1'
"""


@pytest.mark.slow
def test_a_release_that_moved_a_joint_is_seen(
    tmp_path: Path, case: ModelCase, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("TEXTMECH_CACHE", str(tmp_path / "store"))
    index(monkeypatch, tmp_path / "index")
    wheel(tmp_path / "index", "90.1", OTHER_LAW, name="mujoco")
    now = version("mujoco")
    done = textmech("versions", f"mujoco=={now}", "mujoco==90.1", case.path)
    assert done.returncode == 0, done.stderr
    assert f"since {now} shoulder.angle moved by up to" in done.stdout
    assert f"{now} is nearer" in done.stdout
    head = done.stdout.partition("* moved")[2].splitlines()[0]
    assert head.split() == [now, "90.1"]
