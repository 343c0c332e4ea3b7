"""Motions that no shipped case makes: other turns, masses far from one, a floor from the start."""

import math
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from given.adapters.engine_scenes import (
    BOX,
    ROD,
    ROLLS,
    WHEEL,
    G,
    launched,
    machine,
    on_a_swing,
    pin,
    shaken,
)
from given.adapters.planning import NAMES, SETTINGS, TUNED, begun, moved, planned, words
from given.scenes import SHIPPED, tail, typed
from given.scenes.landings import HINGED

from textmech.cases.scene import Anchor, Push, Signal
from textmech.cases.scene.shape import bar
from textmech.cases.trajectory import ANGLE, Array, X
from textmech.engines.engine import Engine, Start
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

CARRIED = {"mujoco": 6e-9, "pymunk": 1e-4}  # N: 2.4e-9; 3.3e-5 at the start, extrapolated
ALIKE = {"mujoco": 3e-15, "pymunk": 5e-13}  # rounding: 8.9e-16, 1.4e-13


def worst(a: Array, b: Array) -> float:
    """The largest difference."""
    return float(np.abs(a - b).max())


@pytest.mark.parametrize("name", NAMES)
def test_angle_of_a_weld_may_stand_on_another_turn(name: str) -> None:
    scene, start = on_a_swing("weld")
    x, y, angle, vx, vy, omega = start["box"]
    turned: Start = {**start, "box": (x, y, angle + math.tau, vx, vy, omega)}
    times = np.array([0.0, 0.4])
    a, b = (moved(TUNED[name], scene, s, times, 1e-3).states["rod"][-1] for s in (start, turned))
    assert b == pytest.approx(a, abs=1e-12)


@pytest.mark.parametrize("name", NAMES)
def test_angles_stay_on_their_turn(name: str) -> None:
    """A slide that holds 10° holds 370° too, and what hangs on it counts from there."""
    turn = math.tau + 0.2
    joints = [
        pin("A", "ground.O", "box.center", "slide", angle=0.2),
        pin("B", "box.center", "rod.start"),
    ]
    end = (0.5 * math.cos(8.0), 0.5 * math.sin(8.0))
    start = {"box": (0, 0, turn, 0, 0, 0), "rod": (*end, 8.0, 0, 0, 0)}
    found = moved(TUNED[name], machine([BOX, ROD], joints), start, np.linspace(0, 0.01, 3), 1e-3)
    assert found.states["box"][:, ANGLE] == pytest.approx(turn, abs=1e-14)
    assert found.states["rod"][0, ANGLE] == pytest.approx(8.0, abs=1e-14)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("mass", [1e-9, 1e9])
def test_masses_far_from_one_fall_alike(mass: float, name: str) -> None:
    def fall(m: float) -> Array:
        rod = bar(name="rod", mass=m, length=1.0, points={})
        scene, start = machine([rod], [pin("A", "ground.O", "rod.start")]), (0.5, 0, 0, 0, 0, 0)
        return moved(TUNED[name], scene, {"rod": start}, np.linspace(0, 0.8, 11), 2e-3).states[
            "rod"
        ]

    assert worst(fall(mass), fall(1.0)) < ALIKE[name]


@pytest.mark.parametrize("name", NAMES)
def test_the_floor_carries_a_disk_from_the_start(name: str) -> None:
    """Also under a sine's first push."""
    push = Push("push", Anchor("wheel", "center"), Signal("sine", (0.0, -30.0), 5.0, math.pi / 2))
    scene = machine([WHEEL], contacts=[ROLLS], forces=[push])
    times = np.linspace(0, 0.01, 3)
    found = moved(TUNED[name], scene, launched(0.0), times, 1e-4, reactions=("touch.normal",))
    wanted = 1.3 * G + 30 * np.cos(5.0 * times)
    assert worst(found.reactions["touch.normal"], wanted) < CARRIED[name]


@pytest.mark.parametrize("name", NAMES)
def test_a_size_is_that_of_the_components(name: str) -> None:
    """Where they are told: else the components are withheld, and the size is not."""
    scene, start = begun("double_pendulum")
    wanted = tuple(f"elbow.{field}" for field in ("fx", "fy", "force"))
    times = SHIPPED["double_pendulum"].times[:3]
    found = moved(TUNED[name], scene, start, times, 1e-3, reactions=wanted).reactions
    if set(found) == set(wanted):
        assert found["elbow.force"] == pytest.approx(np.hypot(found["elbow.fx"], found["elbow.fy"]))
    else:
        assert set(found) == {"elbow.force"}
        assert set(planned(TUNED[name], scene, start).withheld) >= {"elbow.fx", "elbow.fy"}


@pytest.mark.slow
@pytest.mark.parametrize(("name", "near"), [("pymunk", 8e-4), ("mujoco", 1.3e-3)])
def test_a_pin_and_the_floor_do_not_undo_each_other(name: str, near: float, tmp_path: Path) -> None:
    """What a joint holds down is lifted slowly: at once it would shake by 0.02 rad.

    Measured 2.7e-4 and 4.3e-4 rad.
    """
    case = typed(tmp_path, HINGED, tail=tail(0.5, 26))
    exact = solve(case).trajectory
    run = moved(TUNED[name], case.scene, first(exact), case.times, 1e-4)
    assert worst(run.states["rod"][:, ANGLE], exact.states["rod"][:, ANGLE]) < near


# The order that a plan declares is the one at which differences shrink, and its limit is right.


STEPS = (2e-3, 1e-3, 5e-4)
SETTLED = 0.05  # of an order: these steps are that far into the expansion; measured 0.036
ROUGH = {"mujoco.tuned": (8e-3, 4e-3, 2e-3)}  # where RK4 is above rounding


def order(run: Callable[[float], Array], steps: tuple[float, float, float]) -> float:
    """log2 of the ratio of neighbouring differences, in max-norm."""
    a, b, c = (run(step) for step in steps)
    return math.log2(np.max(np.abs(a - b)) / np.max(np.abs(b - c)))


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_a_pendulum_shows_the_declared_order(engine: Engine) -> None:
    scene, start = begun("bar_pendulum")
    times = np.linspace(0.0, 1.6, 6)

    def angle(h: float) -> Array:
        return moved(engine, scene, start, times, h).states["bar"][:, ANGLE]

    found = order(angle, ROUGH.get(words(engine), STEPS))
    assert found == pytest.approx(planned(engine, scene, start).exponents[0], abs=SETTLED)


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_a_fast_sine_shows_the_declared_order(engine: Engine) -> None:
    """Taken at the stages or at the middle of a step, where the setting is of a higher order."""
    scene, start = shaken()
    times = np.linspace(0.0, 0.8, 11)

    def place(h: float) -> Array:
        return moved(engine, scene, start, times, h).states["box"][:, X]

    found = order(place, ROUGH.get(words(engine), STEPS))
    assert found == pytest.approx(planned(engine, scene, start).exponents[0], abs=SETTLED)
