"""What sweeps and health know of a slot that a pin joint holds: its line at every pose."""

import math

import numpy as np
import pytest
from given.engine_scenes import machine, pin
from given.planning import TUNED, planned
from scipy.linalg import subspace_angles

from textmech.cases.scene import Scene
from textmech.cases.scene.shape import bar
from textmech.cases.trajectory import Array
from textmech.engines.engine import Start
from textmech.engines.pymunk.model.solver_contraction import halving
from textmech.engines.pymunk.model.world import World
from textmech.engines.pymunk.read.health import _left
from textmech.engines.pymunk.stepping.run import placed

ARM = bar(name="arm", mass=0.9, length=1.0, points={})
ROD = bar(name="rod", mass=1.2, length=0.8, points={})
ALONG = (0.6, 0.8)  # of the slot, in the arm's axes, through its end
STEP = 1e-3  # s


def scene() -> Scene:
    """An arm on a hinge, and a rod whose end shifts in the arm's slot."""
    guide = pin("guide", "arm.end", "rod.start", kind="slot", along=ALONG)
    return machine([ARM, ROD], [pin("hinge", "ground.O", "arm.start"), guide])


def directions(arm: float) -> tuple[Array, Array]:
    """Along the slot and across it, in ground axes."""
    cos, sin = math.cos(arm), math.sin(arm)
    u = np.array([0.6 * cos - 0.8 * sin, 0.6 * sin + 0.8 * cos])
    return u, np.array([-u[1], u[0]])


def start(arm: float, rod: float, shifted: float) -> Start:
    """At rest: two angles [rad], and how far the rod's end is along the slot [m]."""
    tip = np.array([math.cos(arm), math.sin(arm)])
    centre = tip + shifted * directions(arm)[0] + 0.4 * np.array([math.cos(rod), math.sin(rod)])
    middle = 0.5 * tip
    return {
        "arm": (*middle.tolist(), arm, 0.0, 0.0, 0.0),
        "rod": (*centre.tolist(), rod, 0.0, 0.0, 0.0),
    }


def world(at: Start) -> World:
    plan = planned(TUNED["pymunk"], scene(), at)
    numbers = {choice.name: choice.value for choice in plan.choices(STEP)}
    return placed(scene(), at, STEP, numbers, "native")


def by_angle(at: Start) -> float:
    """Two blocks, one after the other: an error keeps cos² of the angle between their rows."""
    (ax, ay, arm, *_), (bx, by, rod, *_) = at["arm"], at["rod"]
    n = directions(arm)[1]
    point = np.array([bx, by]) - 0.4 * np.array([math.cos(rod), math.sin(rod)])
    on_arm, on_rod = point - (ax, ay), point - (bx, by)
    turn = lambda r: n @ np.array([-r[1], r[0]])  # noqa: E731
    hinge = np.array([[1, 0, ay, 0, 0, 0], [0, 1, -ax, 0, 0, 0]])
    slot = np.array([[*-n, -turn(on_arm), *n, turn(on_rod)]])
    masses = [ARM.mass, ARM.mass, ARM.moment, ROD.mass, ROD.mass, ROD.moment]
    weights = 1 / np.sqrt(np.array(masses, float))
    angle = float(np.min(subspace_angles((hinge * weights).T, (slot * weights).T)))
    return max(1.0, math.log(2) / -math.log(math.cos(angle) ** 2))


POSES = [start(0.2, 2.9, -0.9), start(1.1, -2.0, 0.8), start(-0.4, 1.0, -0.9)]


@pytest.mark.parametrize("k", range(len(POSES)))
def test_sweeps_of_a_slot_and_a_hinge(k: int) -> None:
    assert by_angle(POSES[k]) > 1.1  # where fewer do, 1 is told
    assert halving(world(POSES[k])) == pytest.approx(by_angle(POSES[k]), rel=1e-4)


def test_sweeps_are_those_of_the_present_pose() -> None:
    made = world(POSES[0])
    for name, (x, y, angle, *_) in POSES[1].items():
        made.bodies[name].position, made.bodies[name].angle = (x, y), angle
    assert halving(made) == pytest.approx(by_angle(POSES[1]), rel=1e-4)


def test_health_sees_a_gap_across_the_slot_and_no_sliding_along_it() -> None:
    at = POSES[0]
    u, n = directions(at["arm"][2])

    def left(shift: Array, speed: Array) -> float:
        row = np.array([at["arm"], at["rod"]])
        row[1, :2] += shift
        row[1, 3:5] += speed
        return float(_left(world(at), row[None], np.zeros(1), STEP)[1][0])

    assert left(0.01 * u, 2.0 * u) < 1e-9
    assert left(1e-4 * n, 0.0 * n) == pytest.approx(1e-4 / STEP, rel=1e-6)
    assert left(0.0 * n, 0.3 * n) == pytest.approx(0.3, rel=1e-6)
