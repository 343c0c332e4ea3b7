"""A contact with two coefficients by the driver: steps end where it sticks and where it slips."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import math
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
import pytest
from given.closed_motions import sliding_then_rolling
from given.engine_scenes import BLOCK, RADIUS, WHEEL, G, incline, launched, thrown, touching
from given.planning import CASES, TUNED, begun, moved, planned, ways
from given.scenes import solved

from textmech.cases.scene import Anchor, Bounds, DryFriction, Push, Signal
from textmech.cases.trajectory import OMEGA, VX, X
from textmech.engines.engine import Diverged, Realised
from textmech.engines.mujoco.adapter.compilation import compiled
from textmech.engines.mujoco.callbacks import stepping
from textmech.engines.mujoco.callbacks.contact_friction import Touch, touches

MUJOCO, STEP = TUNED["mujoco"], 1e-3  # s
CONES = [name for name in CASES if name.startswith("friction_cone")]


def off(name: str) -> float:
    """m from the certified motion."""
    scene, start = begun(name)
    run = moved(MUJOCO, scene, start, CASES[name].times, STEP, realised="driver")
    exact = solved(name).trajectory.states["block"]
    return float(np.max(np.abs(run.states["block"] - exact)[:, X]))


@pytest.mark.slow
@pytest.mark.parametrize("name", CONES)
def test_a_block_leaves_the_friction_cone(name: str) -> None:
    """Where its normal force changes, too: measured 1e-13 m."""
    assert off(name) < 1e-12


@pytest.mark.slow
@pytest.mark.mutant("{name}: normal force of the step's start")
@pytest.mark.parametrize("name", ["friction_cone.forward", "friction_cone.backward"])
def test_mutant_normal_force_of_the_step_s_start(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(stepping, "falling", lambda slide: [])
    assert off(name) > 1e-5


@pytest.mark.mutant("kinetic friction at rest")
def test_mutant_kinetic_friction_at_rest(monkeypatch: pytest.MonkeyPatch) -> None:
    def kinetic(self: Touch) -> DryFriction:
        bounds = Bounds(*(2 * (self.contact.kinetic * self.normal,)))
        return DryFriction(bounds, bounds)

    monkeypatch.setattr(Touch, "friction", property(kinetic))
    assert off("friction_cone.forward") > 1e-2


# m. MuJoCo's least friction, 1e-5, fades as the slip ends, which our push in its place does not
# know: 1e-5 μ g h of the speed. Measured 7.6e-11 where it stays, 2.2e-8 where it comes back.
THROWN = {0.6: 3e-10, 0.42: 7e-8}


@pytest.mark.slow
@pytest.mark.parametrize("static", THROWN)  # tan 25° = 0.466: it stays, it comes back
def test_a_block_thrown_up(static: float) -> None:
    beta, times = math.radians(25), np.linspace(0.0, 2.0, 21)
    scene = incline(BLOCK, touching("block", 0.4, static=static), slope=beta)
    assert ways(MUJOCO, scene, thrown(-2.0)) == ("native", "law", "driver")
    up, down = (G * (math.sin(beta) + sign * 0.4 * math.cos(beta)) for sign in (1, -1))
    stop, rest = 2.0 / up, np.maximum(times - 2.0 / up, 0.0)
    before = np.minimum(times, stop)
    x = -2.0 * before + up * before**2 / 2 + (static < 0.466) * down * rest**2 / 2
    run = moved(MUJOCO, scene, thrown(-2.0), times, STEP, realised="driver")
    assert np.abs(run.states["block"][:, X] - x).max() < THROWN[static]


# m and m/s: it rolls on its radius less half of its depth in the floor, 2 g h². Measured 2.4e-5.
ROLLED = 7e-5


@pytest.mark.slow
def test_a_disk_slides_then_rolls() -> None:
    """It stops slipping by an impulse where it touches, which turns it too."""
    times, v, omega, mu = np.linspace(0.0, 3.0, 21), 2.0, 20.0, 0.2
    scene = incline(WHEEL, touching("wheel", mu, static=0.4))
    run = moved(MUJOCO, scene, launched(v, omega), times, STEP, realised="driver")
    rows = run.states["wheel"]
    assert np.abs(rows[:, X] - sliding_then_rolling(times, v, omega, mu)).max() < ROLLED
    assert abs(rows[-1, VX] + RADIUS * rows[-1, OMEGA]) < ROLLED


PULLED = (2.0, 15.0)  # N on a kilogram: up for 0.2 s, which is more than it weighs


def lifted(way: Realised, until: float) -> float:
    """m/s that a block is off which a pull has lifted off, sliding, from 0.1 s on: nothing rubs.

    It comes down at 0.586 s with 1.765 m/s, of which friction's blow takes 0.3, and stops.
    """
    pull = Signal("pulse", PULLED, times=(0.1, 0.3))
    floor = incline(replace(BLOCK, mass=1.0), touching("block", 0.3, static=0.6))
    scene = replace(floor, forces={"pull": Push("pull", Anchor("block", "center"), pull)})
    times = np.linspace(0.0, until, round(until / 0.05) + 1)
    run = moved(MUJOCO, scene, thrown(0.5), times, STEP, realised=way)
    rubbed, pulled = np.minimum(times, 0.1), np.clip(times - 0.1, 0.0, 0.2)
    exact = 0.5 - 0.3 * G * rubbed + PULLED[0] * pulled
    rise = PULLED[1] - G
    lands = 0.3 + (rise * 0.2 + math.sqrt((rise * 0.2) ** 2 + 2 * G * rise * 0.02)) / G
    blow = 0.3 * (G * (lands - 0.3) - rise * 0.2)
    exact = np.where(times < lands, exact, np.maximum(exact - blow - 0.3 * G * (times - lands), 0))
    return float(np.abs(run.states["block"][:, VX] - exact).max())


# m/s. The law rubs as in the step before: one step too long, 0.3 g h = 2.942e-3, as measured. The
# driver asks at every stage: measured 4e-8, of MuJoCo's least friction.
LIFTS = {"law": 3e-3, "driver": 1e-7}


@pytest.mark.slow
@pytest.mark.mutant("{way} of a contact that rubs where nothing touches")
@pytest.mark.parametrize("way", LIFTS)
def test_what_is_lifted_off_is_not_rubbed(way: Realised, monkeypatch: pytest.MonkeyPatch) -> None:
    assert lifted(way, 0.5) < LIFTS[way]
    with pytest.raises(Diverged, match="comes down again"):
        lifted(way, 1.0)
    bounds = Bounds(0.3 * G, 0.3 * G)
    monkeypatch.setattr(Touch, "friction", property(lambda self: DryFriction(bounds, bounds)))
    assert lifted(way, 0.5) > 0.1


@pytest.mark.slow
@pytest.mark.mutant("{way} of a contact that goes on through a blow")
@pytest.mark.parametrize("way", LIFTS)
def test_a_blow_that_no_law_follows_is_seen(way: Realised, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Touch, "look", lambda self: None)
    assert lifted(way, 0.65) > 0.1


@pytest.mark.parametrize("slip", [0.37, -0.37])
def test_what_stops_slipping_is_turned_about_where_it_touches(slip: float) -> None:
    """An impulse there has no moment about that point: J ω − m R v stays, and v + R ω is zero."""
    scene, start = incline(WHEEL, touching("wheel", 0.2, static=0.4)), launched(slip - 0.6, 2.0)
    model, data = compiled(scene, start, STEP, planned(MUJOCO, scene, start, "driver"))
    mujoco.mj_forward(model, data)
    (touch,) = touches(scene, model, data)
    assert touch.speed == pytest.approx(slip, abs=1e-15)
    x, turn = (model.joint(f"wheel.{way}").dofadr[0] for way in ("x", "angle"))

    def moment() -> float:
        return float(WHEEL.moment * data.qvel[turn] - WHEEL.mass * RADIUS * data.qvel[x])

    before = moment()
    touch.halt()
    assert abs(touch.speed) < 1e-15  # rounding, as the moment's
    assert moment() == pytest.approx(before, rel=1e-14)


@pytest.mark.mutant("a wheel's slip put to zero by its turn alone")
@pytest.mark.slow
def test_mutant_wheel_that_is_only_stopped(monkeypatch: pytest.MonkeyPatch) -> None:
    """Its slip put to zero by its turn alone keeps what the impulse would have changed."""

    def halt(self: Any) -> None:
        self.data.qvel[self.x] = 0.0

    monkeypatch.setattr(Touch, "halt", halt)
    times = np.linspace(0.0, 3.0, 21)
    scene = incline(WHEEL, touching("wheel", 0.2, static=0.4))
    run = moved(MUJOCO, scene, launched(2.0, 20.0), times, STEP, realised="driver")
    error = np.abs(run.states["wheel"][:, X] - sliding_then_rolling(times, 2.0, 20.0, 0.2))
    assert error.max() > 1e-2
