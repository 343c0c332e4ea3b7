"""A record is every step of the run, and keeping it, or reading forces, changes nothing."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pymunk
import pytest
from bench.adapters import LOOPS
from given.adapters.engine_scenes import (
    BLOCK,
    RESTS,
    WHEEL,
    G,
    incline,
    launched,
    machine,
    touching,
)
from given.adapters.planning import (
    EVERY,
    HELD,
    NAMES,
    NATIVE,
    SETTINGS,
    TUNED,
    begun,
    every,
    moved,
    pair,
    planned,
    words,
)

from textmech.cases.case import Event
from textmech.cases.scene import GROUND, Anchor, Push, Signal, Spring
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.quantity import table
from textmech.cases.scene.shape import particle
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Diverged, Engine, Refusal
from textmech.reports.compare.events.times import engine_events
from textmech.reports.compare.trial.ladder import wanted_reactions


def holds_every_step(motion: Trajectory, bare: Trajectory, step: float) -> None:
    """Of a run that was recorded, and one that was not."""
    stride = round((motion.times[1] - motion.times[0]) / step)
    record = every(motion)
    assert bare.record is None
    assert record.phase is not None
    assert not record.phase.any()
    assert len(record.times) == stride * (len(motion.times) - 1) + 1
    assert record.times == pytest.approx(np.arange(len(record.times)) * step, abs=1e-14)
    for name, rows in motion.states.items():
        assert equal(rows, bare.states[name])
        assert np.array_equal(record.states[name][::stride], rows)


def equal(a: Array, b: Array) -> bool:
    """Bit for bit; of an attitude's two quaternions a row has the one nearer to the row before."""
    if a.shape[1] == SPACE.width:
        flips = np.sign(np.sum(a[:, SPACE.attitude] * b[:, SPACE.attitude], axis=1))
        b = b.copy()
        b[:, SPACE.attitude] *= flips[:, None]
    return np.array_equal(a, b)


@pytest.mark.parametrize(("name", "engine"), NATIVE, ids=pair)
def test_of_a_case(name: str, engine: Engine) -> None:
    case, (scene, start) = EVERY[name], begun(name)
    step, times = case.interval / 8, case.times[:5]
    found, bare = (moved(engine, scene, start, times, step, record=r) for r in (True, False))
    holds_every_step(found, bare, step)


@pytest.mark.parametrize("name", NAMES)
def test_of_a_disk_that_comes_to_roll(name: str) -> None:
    scene, start = incline(WHEEL, touching("wheel", 0.2)), launched(2.0, 20.0)
    times = np.linspace(0.0, 2.0, 21)
    found, bare = (moved(TUNED[name], scene, start, times, 1e-3, record=r) for r in (True, False))
    holds_every_step(found, bare, 1e-3)


REPEATED = ("towed_pendulum", "slider_crank", "rolling_wheel.pushed")
IN_SPACE = ("spatial_four_bar", "rolling_sphere", "robot_knife")  # by points, a floor, our law


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "engine"),
    [(name, engine) for name, engine in [*NATIVE, *HELD] if name in (*REPEATED, *IN_SPACE)],
    ids=pair,
)
def test_two_runs_are_equal_bit_for_bit(name: str, engine: Engine) -> None:
    """Also whatever is read, and however often."""
    case, (scene, start) = EVERY[name], begun(name)
    times, step = case.times[:6], case.interval / 20
    wanted = wanted_reactions(scene, table(scene))
    for plan in engine.plans(scene, start):
        way = plan.realised
        if isinstance(plan, Refusal):  # of an edge, natively
            continue
        first = moved(engine, scene, start, times, step, realised=way)
        read, again = (
            moved(engine, scene, start, times, step, realised=way, reactions=wanted)
            for _ in range(2)
        )
        sparse = moved(engine, scene, start, times[::5], step, realised=way)
        for body, states in first.states.items():
            assert np.array_equal(states, read.states[body])
            assert np.array_equal(states, again.states[body])
            assert equal(states[::5], sparse.states[body])
        assert read.reactions
        assert all(np.array_equal(read.reactions[n], again.reactions[n]) for n in read.reactions)


@pytest.mark.parametrize("name", ["mujoco", "pymunk"])
def test_a_contact_opens_when_its_force_falls_to_zero(name: str) -> None:
    """A block that is pulled up by 20 N more each second leaves when it weighs nothing."""
    pull = Push("pull", Anchor("block", "center"), Signal("ramp", (0.0, 20.0)))
    scene = replace(incline(BLOCK, touching("block", 0.3)), forces={"pull": pull})
    times, step = np.linspace(0.0, 1.0, 11), 1e-3
    wanted = ("touch.normal", "touch.tangent")
    run = moved(TUNED[name], scene, RESTS, times, step, reactions=wanted, record=True)
    record, weight = every(run), BLOCK.mass * G
    opens = Event("touch.normal", "falls to zero")
    assert engine_events(scene, record, opens) == pytest.approx([weight / 20.0], abs=step)
    normal = record.reactions["touch.normal"]
    assert normal[::100] == pytest.approx(run.reactions["touch.normal"], abs=1e-9)
    assert normal == pytest.approx(np.maximum(weight - 20.0 * record.times, 0.0), abs=20 * step)
    assert not record.reactions["touch.tangent"].any()


def test_forces_stand_beside_the_rows_of_a_bounce() -> None:
    """pymunk's record has a row more for each bounce between two steps."""
    case, (scene, start) = EVERY["bouncing_disk.elastic"], begun("bouncing_disk.elastic")
    wanted, times = ("touch.normal",), case.times
    step = 1e-4
    record = every(moved(TUNED["pymunk"], scene, start, times, step, reactions=wanted, record=True))
    assert len(record.times) > round(times[-1] / step) + 2
    normal, high = record.reactions["touch.normal"], record.states["wheel"][:, 1]
    assert len(normal) == len(record.times)
    assert not normal[high > high.min() + 0.01].any()
    assert normal.max() > 100.0  # N: an impact within a step


# A run that blows up says so and leaves nothing behind, and the plain loop makes its motion.


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
