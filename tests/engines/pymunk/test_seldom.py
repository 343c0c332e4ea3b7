"""What hardly a scene does, in pymunk: laws and joints that no shipped case tells apart."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pymunk
import pytest
from given import scenes
from given.adapters.planning import TUNED, apart, begun, certified, every, moved

from textmech.cases.case import Case
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Realised
from textmech.engines.pymunk.callbacks import point_forces as points
from textmech.engines.pymunk.callbacks.friction import turn
from textmech.engines.pymunk.model import limit
from textmech.engines.pymunk.model.pair import closed_pairs
from textmech.engines.pymunk.settings import recipe
from textmech.engines.pymunk.stepping.run import placed
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

PYMUNK = TUNED["pymunk"]
Patch = pytest.MonkeyPatch

# The drag at its end is what slows it, and its spin is all that moves there.
SPINS = """\
scene:
  gravity: none
  bodies: {rod: {bar: {mass: 1, length: 0.8}}}
  forces: {air: {drag: rod.end, coefficient: 0.6, exponent: 2}}
initial: {rod: {x: 0, y: 0, angle: 0, vx: 0.5, omega: 8}}
allow: {rod.x: 1.0e-2, rod.angle: 1.0e-2}
"""
# It swings on a pin that rubs: its weight's moment about the pin is what friction holds.
RUBS = """\
scene:
  points: {O: [0, 0]}
  bodies: {rod: {bar: {mass: 1, length: 0.8}}}
  joints: {hinge: {pin: [ground.O, rod.start], dry_friction: {static: 1.2, kinetic: 0.4}}}
initial: {rod: {angle: -20 deg, omega: 0}}
allow: {rod.angle: 1.0e-2}
"""


def known(folder: Path, text: str, duration: float) -> tuple[Case, Trajectory]:
    return certified(folder, text, scenes.tail(duration, 26))


def off(case: Case, motion: Trajectory, step: float, way: Realised) -> Array:
    """(6,) how far the states are from the reference's."""
    found = moved(PYMUNK, case.scene, first(motion), case.times, step, realised=way)
    return apart(motion, found)


def test_a_force_is_told_the_spin_of_its_point(tmp_path: Path) -> None:
    """Extrapolated by the step before: of second order."""
    case, motion = known(tmp_path, SPINS, 1.0)
    one, two = (off(case, motion, step, "law")[:3].max() for step in (1e-3, 5e-4))
    assert one < 2e-5
    assert 3.5 < one / two < 4.5


@pytest.mark.mutant("spin of a told point without what is missing from the step before")
def test_a_spin_that_is_half_too_large_is_seen(tmp_path: Path, monkeypatch: Patch) -> None:
    ahead = points.ahead

    def blind(state: Any, at: Any, drift: float, share: float, was: Any) -> Any:
        return ahead(state, at, drift, share, (*was[:5], 0.0))

    monkeypatch.setattr(points, "ahead", blind)
    case, motion = known(tmp_path, SPINS, 1.0)
    assert off(case, motion, 1e-3, "law")[:3].max() > 1e-2


@pytest.mark.slow
def test_friction_about_a_pin_feels_the_weight_at_its_time(tmp_path: Path) -> None:
    case, motion = known(tmp_path, RUBS, 1.0)
    one, two = (off(case, motion, step, "law")[2] for step in (1e-3, 5e-4))
    assert one < 2e-5  # measured 8.2e-6
    assert 3.5 < one / two < 4.5


def moments(folder: Path, *, late: float = 0.0) -> tuple[Array, Array]:
    """N m about the pin of a rod that turns by 6 rad/s: as friction sees it, and as it will be.

    Places are half a step behind in pymunk, and friction asks how it is from now on.
    """
    case = scenes.typed(folder, RUBS.replace("omega: 0", "omega: 6"), tail=scenes.tail(1.0, 26))
    start, step = first(solve(case).trajectory), 1e-2
    world = placed(case.scene, start, step, {"time.midpoint": True}, "law")
    slip = turn(world, case.scene.joints["hinge"], step)
    asked = np.array([0.0, step / 2, step])
    now = slip.read()
    seen = np.array([slip.applied(0.0, ahead - late * step, now) for ahead in asked.tolist()])
    return seen, -9.80665 * 0.4 * np.cos(np.radians(-20) + 6 * asked)


@pytest.mark.slow
def test_the_moment_about_a_pin_is_that_of_the_time_asked(tmp_path: Path) -> None:
    """Where it stops it hardly turns: a moment half a step behind moves hardly anything there."""
    seen, known = moments(tmp_path)
    assert seen == pytest.approx(known, rel=1e-13)


@pytest.mark.slow
@pytest.mark.mutant("the moment about a pin half a step behind")
def test_a_moment_about_a_pin_that_is_late_is_seen(tmp_path: Path) -> None:
    seen, known = moments(tmp_path, late=0.5)
    assert np.abs(seen - known).min() > 1e-2


def angle(low: float, high: float, at: float) -> tuple[float, float]:
    """What a joint with an impulse tells of its two ends."""
    a, b = pymunk.Body(1, 1), pymunk.Body(1, 1)
    b.angle = at
    joint: Any = Pressed(a, b, low, high)
    return limit.pressed(joint, "low"), limit.pressed(joint, "high")


class Pressed(pymunk.RotaryLimitJoint):
    """A limit that has pushed by 2 N m s."""

    @property
    def impulse(self) -> float:
        return 2.0


@pytest.mark.mutant("both ends of a stop push at once")
def test_one_end_of_a_stop_pushes_at_a_time() -> None:
    """That which is nearer; of a single stop the other is a million radians away."""
    assert angle(-0.5, 1.5, -0.51) == (2.0, 0.0)
    assert angle(-0.5, 1.5, 1.51) == (0.0, 2.0)
    assert angle(-0.5, limit.NEVER, -0.5) == (2.0, 0.0)
    assert angle(-limit.NEVER, 7.0, 7.0) == (0.0, 2.0)


def touching(parting: float) -> list[str]:
    """Two disks of a shipped case put side by side, of which one leaves so fast [m/s]."""
    scene, start = begun("cradle.alike")
    pair = scene.pairs["first"]
    both = pair.radius(scene.bodies) + pair.reach(scene.bodies)
    state = dict(start)
    state[pair.touched] = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    state[pair.body] = (both, 0.0, 0.0, parting, 0.3, 0.0)
    one = replace(scene, pairs={pair.name: pair})
    return [found.name for found in closed_pairs(one, state)]


@pytest.mark.mutant("bodies that part pressed together at the start")
def test_what_is_about_to_part_is_not_pressed_together() -> None:
    assert len(touching(0.0)) == 1
    assert len(touching(-0.2)) == 1
    assert touching(0.2) == []


LADDER = """\
scene:
  planes: {wall: {at: [0, 0], normal: [1, 0]}}
  bodies: {rod: {bar: {mass: 5.0, length: 3.0}}}
  contacts:
    foot: {between: [rod.end, ground.floor], friction: 0}
    top: {between: [rod.start, ground.wall], friction: 0}
events: {leaves: {top.normal: falls to zero}}
initial: {rod: {angle: -0.9, on: [end, start]}}
allow: {rod.angle: 1.0e-2}
"""


def let_go(folder: Path, step: float) -> tuple[float, float]:
    """s: when the wall first pushes no longer, in the reference and in pymunk."""
    case, motion = known(folder, LADDER, 0.5)
    found = moved(
        PYMUNK, case.scene, first(motion), case.times, step, reactions=("top.normal",), record=True
    )
    record = every(found)
    (leaves,) = motion.switches.tolist()
    return leaves, float(record.times[np.argmax(record.reactions["top.normal"] <= 0.0)])


@pytest.mark.slow
@pytest.mark.parametrize("step", [1e-3, 5e-4, 1.25e-4])
def test_a_smooth_ladder_leaves_its_wall_once(step: float, tmp_path: Path) -> None:
    leaves, found = let_go(tmp_path, step)
    assert found == pytest.approx(leaves, abs=2 * step)


@pytest.mark.slow
@pytest.mark.mutant("a seed that the curve of a tip's path uses up")
def test_a_seed_that_is_used_up_is_seen(tmp_path: Path, monkeypatch: Patch) -> None:
    monkeypatch.setattr(recipe, "_TIP_SEED", replace(recipe._TIP_SEED, value=1e-8))
    leaves, found = let_go(tmp_path, 5e-4)
    assert found < leaves - 0.1
