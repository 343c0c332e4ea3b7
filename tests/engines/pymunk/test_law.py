"""Our laws on bodies that turn: at the middle of a step, at the places points have there."""

import math
from functools import partial

import numpy as np
import pytest
from given.adapters.engine_scenes import RADIUS, WHEEL, G, incline, launched, machine, pin, touching
from given.adapters.planning import TUNED, moved, planned
from given.machines.closed_motions import sliding_then_rolling
from given.machines.swings import generated

from textmech.cases.fields.friction import Bounds as Bounded
from textmech.cases.fields.friction import DryFriction, Smooth
from textmech.cases.scene import GROUND, Anchor, Damper, Motor, Scene, Signal
from textmech.cases.scene.shape import disk
from textmech.cases.trajectory import ANGLE, OMEGA, VX, Array, X
from textmech.engines.engine import Start
from textmech.engines.law import smooth_under
from textmech.engines.pymunk.callbacks.friction import bound, mean_friction, smooth_mean
from textmech.engines.pymunk.callbacks.line_forces import drifting
from textmech.engines.pymunk.callbacks.turning import motor_load
from textmech.engines.pymunk.stepping.scene import build

ENGINE = TUNED["pymunk"]
STEPS = (2e-3, 1e-3, 5e-4)
SLIPS = 1e-12  # m/s: rounding; measured 6e-14, and 9e-6 with the whole mass


def order(scene: Scene, start: Start, times: Array, column: int) -> float:
    """log2 of the ratio of neighbouring differences, by the law."""
    a, b, c = (
        moved(ENGINE, scene, start, times, h, realised="law").states["wheel"][:, column]
        for h in STEPS
    )
    return math.log2(np.abs(a - b).max() / np.abs(b - c).max())


def spun() -> tuple[Scene, Start]:
    """A disk on an axle, braked by a damper between its rim and the ground."""
    wheel = disk(name="wheel", mass=1.3, radius=RADIUS, points={"P": (0.2, 0.1)})
    oil = Damper("oil", Anchor(GROUND, "Q"), Anchor("wheel", "P"), 4.0)
    scene = machine([wheel], [pin("axle", "ground.O", "wheel.center")], forces=[oil])
    return scene, {"wheel": (0.0, 0.0, 0.3, 0.0, 0.0, 20.0)}


def test_a_damper_on_a_spinning_disk_is_of_second_order() -> None:
    scene, start = spun()
    times = np.linspace(0.0, 0.4, 5)
    assert planned(ENGINE, scene, start, "law").held == (2, 3)
    assert order(scene, start, times, ANGLE) == pytest.approx(2.0, abs=0.05)
    exact = generated(scene, start, times).states["wheel"][:, ANGLE]
    run = moved(ENGINE, scene, start, times, 1e-4, realised="law").states["wheel"][:, ANGLE]
    assert np.abs(run - exact).max() < 1e-6


def test_a_disk_rolls_when_the_law_has_slowed_it() -> None:
    """With two coefficients; what resists at its rim is a third of its mass."""
    v, omega, mu = 2.0, 20.0, 0.2
    rolls = (v + RADIUS * omega) / (3 * mu * G)
    times = np.linspace(0.0, 2.0, 41)
    scene = incline(WHEEL, touching("wheel", mu, static=0.3))
    run = moved(ENGINE, scene, launched(v, omega), times, 1e-4, realised="law").states["wheel"]
    assert np.abs(run[:, X] - sliding_then_rolling(times, v, omega, mu)).max() < 1e-8
    slip = run[:, VX] + RADIUS * run[:, OMEGA]
    assert slip == pytest.approx(np.maximum(0.0, 3 * mu * G * (rolls - times)), abs=1e-11)


def test_a_disk_slips_the_other_way_within_a_step() -> None:
    """On a slope too steep to roll; the mean over that step needs the mass at its rim."""
    beta, mu, times = math.radians(45), 0.2, np.linspace(0.0, 0.5, 11)
    scene = incline(WHEEL, touching("wheel", mu, static=0.25), slope=beta)
    run = moved(ENGINE, scene, launched(-1.0, -2.0), times, 1e-4, realised="law").states["wheel"]
    pull, brake = G * math.sin(beta), mu * G * math.cos(beta)
    turns = (1.0 + 2.0 * RADIUS) / (pull + 3 * brake)
    before, after = np.minimum(times, turns), np.maximum(times - turns, 0.0)
    speed = -1.0 + (pull + brake) * before + (pull - brake) * after
    assert run[:, VX] == pytest.approx(speed, abs=SLIPS)


def test_a_point_ahead_has_turned_with_its_body() -> None:
    scene, start = spun()
    world = build(scene, start, {}, "law")
    lever, x, y, vx, vy = drifting(world, Anchor("wheel", "P"))(0.01)
    turned = 0.3 + 20.0 * 0.01
    wanted = (
        0.2 * math.cos(turned) - 0.1 * math.sin(turned),
        0.2 * math.sin(turned) + 0.1 * math.cos(turned),
    )
    assert lever == pytest.approx(wanted, abs=1e-15)
    assert (x, y) == pytest.approx(wanted, abs=1e-15)
    assert (vx, vy) == pytest.approx((-20.0 * wanted[1], 20.0 * wanted[0]), abs=1e-13)


@pytest.mark.mutant("a motor by law that turns backward")
def test_a_motor_turns_the_second_part_of_its_joint() -> None:
    """As `twist`, whose law of the angle between the two is another one."""
    hand = Motor("hand", "axle", Signal("ramp", (0.31,)))
    wheel = disk(name="wheel", mass=1.3, radius=RADIUS, points={})
    scene = machine([wheel], [pin("axle", "ground.O", "wheel.center")], forces=[hand])
    world = build(scene, {"wheel": (0.0,) * 6}, {}, "law")
    load = motor_load(world, hand, "wheel")(0.5, 1e-3, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
    assert load == pytest.approx((0.0, 0.0, 0.155))


# The mean of the law of dry friction over one step, against integrals done by hand.


LAW = DryFriction(Bounded(6.0, 2.0), Bounded(3.0, 1.0))  # forward, backward [N]
H, M = 0.5, 2.0  # s, kg


def line(begin: float, end: float, ahead: float) -> float:
    """A force [N] that grows through the step."""
    return begin + (end - begin) * ahead / H


def mean(speed: float, begin: float, end: float) -> float:
    return mean_friction(LAW, speed, M, partial(line, begin, end), H)


@pytest.mark.parametrize(
    ("begin", "end", "friction"),
    [
        (4.0, 5.9, -4.95),  # it holds
        (5.9, 6.3, -(0.25 * 5.95 + 0.75 * 3.0)),  # from 6 N on, a quarter of the step, it slides
        (5.0, 7.0, -(0.5 * 5.5 + 0.5 * 3.0)),
        (6.5, 7.0, -3.0),  # it slides all the time
        (-1.0, -3.0, 0.5 * 1.5 + 0.5 * 1.0),  # from −2 N on, the other way
        (-1.0, -1.9, 1.45),
        (6.2, 6.4, -3.0),
    ],
)
def test_from_rest(begin: float, end: float, friction: float) -> None:
    """The force that grows while it slides belongs to the slide alone."""
    assert mean(0.0, begin, end) == pytest.approx(friction, abs=1e-13)


@pytest.mark.parametrize(
    ("speed", "force", "friction"),
    [
        (1.0, 2.0, -3.0),  # Δv = −0.25 m/s: it goes on
        (-1.0, 2.0, 1.0),  # Δv = 0.75 m/s
        (0.1, 2.0, -(2.0 + 0.1 * M / H)),  # it stops, and 2 N do not move it
        (-0.1, 2.0, -2.0 + 0.1 * M / H),
        (0.1, -3.0, -1 / 15 * 3.0 + 14 / 15 * 1.0),  # at 6 N it stops after a fifteenth
        (-0.1, 7.0, 1 / 20 * 1.0 - 19 / 20 * 3.0),  # at 8 N after a twentieth; then 3 N brake
    ],
)
def test_while_it_moves(speed: float, force: float, friction: float) -> None:
    assert mean(speed, force, force) == pytest.approx(friction, abs=1e-13)


def test_what_pymunk_may_use_of_it() -> None:
    """Held: the static bound; braked: the law's force; what turns back late in a step: a push."""
    told = partial(bound, LAW, mass=M, step=H)
    assert told(0.0, applied=partial(line, 4.0, 5.0)) == (6.0, 0.0)
    assert told(0.0, applied=partial(line, -1.0, -1.5)) == (2.0, 0.0)
    assert told(1.5, applied=partial(line, 2.0, 2.0)) == (3.0, 0.0)
    limit, push = told(1.2, applied=partial(line, -3.0, -3.0))  # after 4/5 of the step
    assert (limit, push) == (0.0, pytest.approx(-0.8 * 3.0 + 0.2 * 1.0, abs=1e-13))


SMOOTH = Smooth(1e-3, 1e4)  # m/s, s/m: A F h / m is 150, far beyond what explicit steps bear


@pytest.mark.parametrize(
    ("speed", "applied"),
    [
        (0.0, 4.0),  # it creeps
        (1e-4, -1.5),
        (-1e-3, 3.0),  # at the edge of the band
        (5e-4, -4.0),
        (0.0, 7.0),  # it breaks loose
        (0.1, 2.0),  # it slides
    ],
)
def test_the_smooth_law_is_that_of_the_middle_of_the_step(speed: float, applied: float) -> None:
    """F = F_fr((v₀ + v)/2) with m (v − v₀) = h (F_a + F), which is no law of the engine's."""
    step = 0.01
    force = smooth_mean(LAW, SMOOTH, speed, M, applied, step)
    after = speed + step * (applied + force) / M
    law = smooth_under(LAW, SMOOTH, applied)
    # a speed is known to 1e-9 of the band, and the law's slope is at most A (7 N + 3 N)/2
    assert force == pytest.approx(law((speed + after) / 2), abs=5e-8)
