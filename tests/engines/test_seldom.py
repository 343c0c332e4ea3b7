"""What hardly a scene does: laws of engines that no shipped case comes to, by the reference."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.adapters.engine_scenes import GROWING, guided
from given.adapters.planning import TUNED, apart, begun, certified, moved, planned

from textmech.cases.case import Case
from textmech.cases.scene import Signal
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Realised
from textmech.engines.mujoco.callbacks import friction_law, smooth
from textmech.engines.mujoco.callbacks import rope_limit as taut
from textmech.engines.mujoco.model import contact
from textmech.reports.compare.trial.start import first

# At its length, and on the way to its anchor; gravity would pull it taut.
INWARD = """\
scene:
  points: {O: [0, 1]}
  bodies: {ball: {particle: {mass: 1}}}
  forces: {cord: {rope: [ground.O, ball.center], length: 1}}
initial: {ball: {x: 0, y: 0, vx: 3.0, vy: 0.5}}
allow: {ball.x: 1.0e-2, ball.y: 1.0e-2, cord.force: 1}
"""
# A bar swings on what slides: friction feels it by the mass of both, and a push on the bar too.
SWINGS_ON_SLIDE = """\
scene:
  points: {O: [0, 0]}
  bodies: {cart: {particle: {mass: 1.5}}, rod: {bar: {mass: 1, length: 0.6}}}
  joints:
    rail:
      slide: [ground.O, cart.center]
      along: [1, 0]
      dry_friction: {static: 2, kinetic: 1.5, smooth: {band: 5.0e-3, sharpness: 1.0e3}}
    hinge: {pin: [cart.center, rod.start]}
  forces: {hand: {push: rod.end, sine: {amplitude: [4, 0], angular_frequency: 9}}}
initial: {cart: {x: 0, vx: 0.3}, rod: {angle: -60 deg, omega: 0}}
allow: {cart.x: 1.0e-2, rod.angle: 1.0e-2}
"""


def known(folder: Path, text: str, duration: float, samples: int = 26) -> tuple[Case, Trajectory]:
    return certified(folder, text, scenes.tail(duration, samples))


def off(
    case: Case, motion: Trajectory, step: float, *, engine: str = "mujoco", way: Realised = "native"
) -> Array:
    """(6,) how far states are from the reference's, of any body."""
    found = moved(TUNED[engine], case.scene, first(motion), case.times, step, realised=way)
    return apart(motion, found)


# Two disks meet at 0.082 s, not along the line of their centres, and rub while they do.
OBLIQUE = """\
scene:
  gravity: none
  bodies: {a: {disk: {mass: 1, radius: 0.1}}, b: {disk: {mass: 2, radius: 0.15}}}
  contacts: {hit: {between: [a, b], friction: MU, restitution: 0.6}}
events: {strike: {hit.gap: falls to zero}}
initial:
  a: {x: 0, y: 0, angle: 0, vx: 2, vy: 0.2, omega: 3}
  b: {x: 0.4, y: 0.1, angle: 0, vx: 0, vy: 0, omega: 0}
allow: {a.x: 1.0e-2, a.omega: 1.0e-2}
"""


@pytest.mark.slow
@pytest.mark.parametrize("mu", [0.02, 0.3])
@pytest.mark.parametrize(("engine", "near"), [("mujoco", 1e-2), ("pymunk", 2e-3)])
def test_an_oblique_strike_keeps_its_tangential_part(
    engine: str, near: float, mu: float, tmp_path: Path
) -> None:
    """By velocities of 2 m/s and 3 rad/s after it: measured 4.9e-3 in MuJoCo, whose strike lasts
    16 steps, and 1.0e-3 in pymunk, which strikes up to a step late."""
    case, motion = known(tmp_path, OBLIQUE.replace("MU", repr(mu)), 0.2)
    errors = off(case, motion, 1e-4, engine=engine)
    assert errors[3:].max() < near


@pytest.mark.slow
def test_a_rope_that_starts_inward_is_slack(tmp_path: Path) -> None:
    """Until 0.053 s it falls freely, which RK4 has exactly."""
    case, motion = known(tmp_path, INWARD, 0.05, 11)
    assert not len(motion.switches)
    assert off(case, motion, 1e-3).max() < 1e-13
    case, motion = known(tmp_path, INWARD, 0.3)
    assert off(case, motion, 1e-3)[:2].max() < 1e-3


@pytest.mark.mutant("a rope that starts inward taken for a taut one")
def test_a_rope_that_is_drawn_though_slack_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is lengthened by what its turn would ask of one that pulls."""
    monkeypatch.setattr(taut, "NEAR", 10.0)
    case, motion = known(tmp_path, INWARD, 0.05, 11)
    assert off(case, motion, 1e-3).max() > 1e-7


@pytest.mark.slow
def test_smooth_friction_of_what_another_body_swings_on(tmp_path: Path) -> None:
    """Measured 6e-6 m and rad at 1 ms; in pymunk 4e-4."""
    case, motion = known(tmp_path, SWINGS_ON_SLIDE, 1.0)
    assert off(case, motion, 1e-3, way="law")[:3].max() < 2e-5


@pytest.mark.slow
@pytest.mark.mutant("smooth friction of a slide by what acts on its own coordinate alone")
def test_friction_that_does_not_feel_what_swings_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(smooth, "_among", smooth.alone)
    case, motion = known(tmp_path, SWINGS_ON_SLIDE, 1.0)
    assert off(case, motion, 1e-3, way="law")[:3].max() > 1e-3


def braked() -> Array:
    """(N, 6) a block that slides against a force which grows, by MuJoCo's law of friction."""
    scene = guided(replace(GROWING, signal=Signal("ramp", (2.3, 0.0))))
    start = {"block": (0.0, 0.0, 0.0, 1.0, 0.0, 0.0)}
    times = np.linspace(0.0, 2.0, 21)
    return moved(TUNED["mujoco"], scene, start, times, 1e-3, realised="law").states["block"]


def test_how_far_a_stop_is_foreseen_costs_only_time(monkeypatch: pytest.MonkeyPatch) -> None:
    """Until six steps before it the force is that of the step before: to the bit as without."""
    usual = braked()
    monkeypatch.setattr(friction_law, "_FAR", 1e9)
    assert np.array_equal(braked(), usual)


@pytest.mark.mutant("a stop foreseen one step ahead")
def test_a_stop_foreseen_too_late_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Then nothing is known of how the force grows in the step in which it stops."""
    usual = braked()
    monkeypatch.setattr(friction_law, "_FAR", 1)
    assert np.abs(braked() - usual)[:, 3].max() > 1e-10


ROCKS = """\
scene:
  bodies: {box: {block: {mass: 1.0, width: 0.2, height: 0.6}}}
  contacts:
    left: {between: [box.lower_left, ground.floor], friction: 2.0}
    right: {between: [box.lower_right, ground.floor], friction: 2.0}
events: {knocks: {left.gap: falls to zero}}
initial: {box: {lower_right: [0, 0], on: lower_right, angle: -0.2}}
allow: {box.angle: 1.0e-2}
"""


@pytest.mark.slow
def test_a_block_that_rocks_is_carried_by_its_corner(tmp_path: Path) -> None:
    """Measured 6e-3 rad over four knocks, and with the recipe of what falls 7e-2."""
    case, motion = known(tmp_path, ROCKS, 1.5, 76)
    assert len(motion.switches) == 4
    assert contact.chosen(case.scene, first(motion)) == "pivot"
    assert off(case, motion, 1e-3)[:3].max() < 1e-2


@pytest.mark.slow
@pytest.mark.mutant("a block that rocks on the spring of what falls")
def test_a_rocking_block_that_sinks_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(contact, "rocks", lambda scene, start: False)
    case, motion = known(tmp_path, ROCKS, 1.5, 76)
    assert off(case, motion, 1e-3)[:3].max() > 3e-2


@pytest.mark.slow
def test_a_bar_that_comes_down_flat_is_no_block_that_rocks(tmp_path: Path) -> None:
    bar = ROCKS.replace("block: {mass: 1.0, width: 0.2, height: 0.6}", "bar: {mass: 1, length: 1}")
    bar = bar.replace("lower_left", "end").replace("lower_right", "start")
    case, motion = known(tmp_path, bar.replace("-0.2", "0.2"), 0.1)
    assert contact.chosen(case.scene, first(motion)) == "land"


def test_the_plan_says_how_a_bounce_is_spread() -> None:
    """MuJoCo has no impulse: its user reads why a smaller step does not mend what is thrown."""
    scene, start = begun("bouncing_disk.elastic")
    said = planned(TUNED["mujoco"], scene, start).protocol(1e-3)
    assert "a bounce lasts 16 steps, and keeps its speed to about" in said


# The drag at its end is what slows it, and turns it: a force of ours beside the centre of mass.
SPINS = """\
scene:
  gravity: none
  bodies: {rod: {bar: {mass: 1, length: 0.8}}}
  forces: {air: {drag: rod.end, coefficient: 0.6, exponent: 2}}
initial: {rod: {x: 0, y: 0, angle: 0.7, vx: 0.5, omega: 8}}
allow: {rod.x: 1.0e-2, rod.angle: 1.0e-2}
"""


@pytest.mark.slow
def test_a_force_of_ours_turns_what_it_acts_on(tmp_path: Path) -> None:
    """Planted by hand: one of the two products of its moment about the centre with another sign."""
    case, motion = known(tmp_path, SPINS, 1.0)
    assert off(case, motion, 1e-3, way="law").max() < 1e-8
