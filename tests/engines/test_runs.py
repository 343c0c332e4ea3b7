"""A run that blows up says so and leaves nothing behind, and the bare loop makes its motion."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

from pathlib import Path
from pkgutil import resolve_name
from typing import Any

import mujoco
import numpy as np
import pymunk
import pytest
from given.engine_scenes import machine
from given.planning import SETTINGS, begun, moved, planned, words

from textmech.cases.scene import GROUND, Anchor, Spring
from textmech.cases.shape import particle
from textmech.engines.engine import Diverged, Engine, Loop

# What each says of a step that is too large. MuJoCo alone would go back to its start without a
# word, and write a file into the user's folder.
SAYS = {"mujoco": r"MuJoCo warns: .*unstable", "pymunk": r"not finite any more at t = \d"}


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_a_blow_up_is_diverged(
    engine: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    stiff = Spring("coil", Anchor(GROUND, "O"), Anchor("bead", "center"), 1e6, 0.5)
    hung = machine([particle(name="bead", mass=1.0)], forces=[stiff])
    start = {"bead": (0.0, -0.6, 0.0, 0.0, 0.0, 0.0)}
    with pytest.raises(Diverged, match=SAYS[engine.name]):
        moved(engine, hung, start, np.linspace(0.0, 10.0, 11), 0.01)
    assert isinstance(engine, Loop)
    engine.loop(hung, start, 0.01, planned(engine, hung, start))(1000)
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize("record", [False, True], ids=["samples", "record"])
@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_samples_between_steps_are_refused(engine: Engine, record: bool) -> None:
    """A sample that is no whole multiple of the step would be answered at another time."""
    scene, start = begun("bar_pendulum")
    for times in ([0.0, 0.0105], [0.0, 0.01, 0.0205]):
        with pytest.raises(ValueError, match="no whole multiple"):
            moved(engine, scene, start, np.array(times), 1e-3, record=record)


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_samples_may_be_uneven(engine: Engine) -> None:
    scene, start = begun("bar_pendulum")
    even = moved(engine, scene, start, np.linspace(0.0, 0.05, 6), 1e-3).states["bar"]
    uneven = moved(engine, scene, start, np.array([0.0, 0.01, 0.04, 0.05]), 1e-3).states["bar"]
    assert np.array_equal(uneven, even[[0, 1, 4, 5]])


# Where each engine makes what its loop steps.
MAKES = {
    "mujoco": "textmech.engines.mujoco.MuJoCo._placed",
    "pymunk": "textmech.engines.pymunk.run.build",
}


def bob_of_mujoco(made: Any) -> tuple[slice, list[float]]:
    """Which columns, and what they are."""
    model, data, _ = made
    mujoco.mj_kinematics(model, data)
    return slice(0, 2), data.body("bob").xipos[:2].tolist()


def bob_of_pymunk(made: Any) -> tuple[slice, list[float]]:
    """Its velocity, which is of the time it is read at in both settings."""
    return slice(3, 5), list(made.bodies["bob"].velocity)


BOB = {"mujoco": bob_of_mujoco, "pymunk": bob_of_pymunk}


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_the_bare_loop_makes_the_same_motion(
    engine: Engine, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene, start = begun("towed_pendulum")
    made: list[Any] = []
    where, _, what = MAKES[engine.name].rpartition(".")
    owner = resolve_name(where)
    makes = getattr(owner, what)

    def kept(*given: Any) -> Any:
        made.append(makes(*given))
        return made[-1]

    monkeypatch.setattr(owner, what, kept)
    assert isinstance(engine, Loop)
    plan = planned(engine, scene, start)  # which may rehearse
    made.clear()
    steps = engine.loop(scene, start, 1e-3, plan)
    steps(300)
    steps(700)
    monkeypatch.undo()
    columns, found = BOB[engine.name](made[0])
    run = moved(engine, scene, start, np.array([0.0, 1.0]), 1e-3)
    assert found == run.states["bob"][-1, columns].tolist()


VERSION = {"mujoco": mujoco.__version__, "pymunk": pymunk.version}


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_version_is_the_packages(engine: Engine) -> None:
    assert engine.version == VERSION[engine.name]
