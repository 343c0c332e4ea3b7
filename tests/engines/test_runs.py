"""A run that blows up says so and leaves nothing behind, and the plain loop makes its motion."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

from pathlib import Path

import mujoco
import numpy as np
import pymunk
import pytest
from bench.adapters import LOOPS
from given.engine_scenes import machine
from given.planning import SETTINGS, begun, moved, planned, words

from textmech.cases.scene import GROUND, Anchor, Spring
from textmech.cases.scene.shape import particle
from textmech.engines.engine import Diverged, Engine

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
    LOOPS[engine.name](engine, hung, start, 0.01, planned(engine, hung, start))()(1000)
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


VERSION = {"mujoco": mujoco.__version__, "pymunk": pymunk.version}


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_version_is_the_packages(engine: Engine) -> None:
    assert engine.version == VERSION[engine.name]
