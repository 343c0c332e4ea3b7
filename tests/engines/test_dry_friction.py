"""Dry friction on a slide: natively with one bound; by our law the textbook's.

Examples 2.3 (a growing force) and 2.4 (drawn by a spring), and the smooth law of the same.
"""

import math
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from given.closed_motions import drawn, growing, sliding_then_rolling, to_and_fro
from given.engine_scenes import (
    BLOCK,
    DRAWN,
    GROWING,
    RADIUS,
    RESTS,
    SIX,
    THREE,
    WHEEL,
    G,
    guided,
    incline,
    launched,
    thrown,
    touching,
)
from given.planning import NAMES, TUNED, every, moved, planned, ways
from scipy.integrate import solve_ivp

from textmech.cases.scene import Anchor, Bounds, DryFriction, Push, Signal, Smooth
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import OMEGA, VX, Array, X
from textmech.engines.engine import Realised
from textmech.engines.law import smooth_friction
from textmech.engines.mujoco.callbacks import friction_law

STEPS = {"mujoco": 1e-3, "pymunk": 1e-4}  # s: RK4 is of fourth order, position Verlet of second
EIGHT, TEN = np.linspace(0.0, 8.0, 81), np.linspace(0.0, 10.0, 101)


@dataclass(frozen=True)
class Near:
    """How near a way comes at its engine's step, in m."""

    growing: float
    drawn: float
    braking: float


NEAR: dict[tuple[str, Realised], Near] = {
    # The force is held over a step that slipping begins or ends in: h²/6, and several of them.
    ("mujoco", "law"): Near(growing=5e-7, drawn=8e-6, braking=8e-6),  # 1.7e-7, 2.7e-6, 2.5e-6
    # The law's mean over a step, exact where the force is linear; then Verlet's h².
    ("pymunk", "law"): Near(growing=5e-9, drawn=4e-8, braking=1e-15),  # 1.7e-9, 1.3e-8, 2e-16
}
ROWS = [pytest.param(*row, id=".".join(row)) for row in NEAR]


@pytest.mark.parametrize("name", NAMES)
def test_these_are_the_ways(name: str) -> None:
    ours = [way for engine, way in NEAR if engine == name]
    assert ways(TUNED[name], guided(GROWING), RESTS) == ("native", *ours)


@pytest.mark.slow
@pytest.mark.parametrize(("name", "way"), ROWS)
def test_block_under_a_growing_force(name: str, way: Realised) -> None:
    """It slips at t = 6 s."""
    engine, scene = TUNED[name], guided(GROWING)
    wanted = ("guide.friction",)
    run = moved(engine, scene, RESTS, EIGHT, STEPS[name], realised=way, reactions=wanted)
    assert np.abs(run.states["block"][:, X] - growing(EIGHT)).max() < NEAR[name, way].growing
    if "guide.friction" in planned(engine, scene, RESTS, way).withheld:
        assert not run.reactions
        return
    friction = run.reactions["guide.friction"] - np.where(EIGHT < 6.0, EIGHT, 3.0)
    assert np.delete(friction, 60) == pytest.approx(0, abs=1e-12)  # at 6 s it falls from 6 to 3 N


# A force held over a step that begins to slip inside it has the right impulse, and 6 − 3 N for a
# part s of it: s (1 − s)/2 of 3 h² m at most, whatever comes after.
INSIDE = 3 / 8


@pytest.mark.slow
@pytest.mark.parametrize("b", [1.0007, 0.99])
@pytest.mark.parametrize(("name", "way"), ROWS)
def test_it_slips_inside_a_step(name: str, way: Realised, b: float) -> None:
    """With b = 1 N/s it slips where a step ends, and no formula for a part of one is asked."""
    x = _slips_inside(name, way, b)
    bound = NEAR[name, way].growing + INSIDE * STEPS[name] ** 2
    assert np.abs(x - growing(EIGHT, b)).max() < bound


@pytest.mark.slow
@pytest.mark.mutant("stiction that holds to the end of its step")
def test_a_step_that_holds_to_its_end_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """3 N too much for a part s = 0.8 or 0.4 of a step; with b = 1 N/s there is no such part."""

    def holds(slide: Any, now: float, soon: float) -> float:
        limit = slide.friction.static.forward
        return slide.brakes(slide.sense, 0.0) if slide.sense * now >= limit else abs(now + soon) / 2

    monkeypatch.setattr(friction_law, "_breaking_loose", holds)
    bound = NEAR["mujoco", "law"].growing
    assert np.abs(_slips_inside("mujoco", "law", 1.0) - growing(EIGHT)).max() < bound
    for b in (1.0007, 0.99):
        assert np.abs(_slips_inside("mujoco", "law", b) - growing(EIGHT, b)).max() > 1e-4


def _slips_inside(name: str, way: Realised, b: float) -> Array:
    """x [m] under a force that grows by b [N/s]."""
    pull = replace(GROWING, signal=Signal("ramp", (-b, 0.0)))
    run = moved(TUNED[name], guided(pull), RESTS, EIGHT, STEPS[name], realised=way)
    return run.states["block"][:, X]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "way"), ROWS)
def test_block_drawn_by_a_spring(name: str, way: Realised) -> None:
    """It sticks, slips from 1.5 s on, is at rest from 4.790543662 s, and slips again."""
    run = moved(TUNED[name], guided(DRAWN), RESTS, TEN, STEPS[name], realised=way)
    assert np.abs(run.states["block"][:, X] - drawn(TEN)).max() < NEAR[name, way].drawn


@pytest.mark.parametrize(("name", "way"), ROWS)
@pytest.mark.parametrize(("sign", "force"), [(1, 2.0), (-1, 5.0)], ids=["forward", "backward"])
def test_friction_to_and_fro(sign: int, force: float, name: str, way: Realised) -> None:
    """Braking takes the bound of the way it goes."""
    bounds, times = Bounds(2.0, 5.0), np.linspace(0.0, 1.0, 21)
    scene, start = guided(None, bounds, bounds), thrown(sign * 1.0)
    run = moved(TUNED[name], scene, start, times, 1e-3, realised=way)
    assert abs(run.states["block"][-1, X] - sign / (2 * force)) < NEAR[name, way].braking


# m, in 4 s at h. Over the steps with a reversal the mean of two bounds is right to h².
REVERSED: dict[tuple[str, Realised], float] = {
    ("mujoco", "law"): 2.2e-5,  # 7.3e-6
    ("pymunk", "law"): 5e-7,  # 1.7e-7
}


@pytest.mark.slow
@pytest.mark.parametrize(("name", "way"), ROWS)
def test_a_block_turns_back_without_a_rest(name: str, way: Realised) -> None:
    """Under a strong sine: friction jumps from one bound to the other within a step."""
    times, bounds = np.linspace(0.0, 4.0, 101), Bounds(2.0, 3.0)
    shake = Push("shake", Anchor("block", "center"), Signal("sine", (30.0, 0.0), 6.0, 0.0))
    scene = guided(shake, bounds, bounds)
    run = moved(TUNED[name], scene, RESTS, times, STEPS[name], realised=way)
    error = np.abs(run.states["block"][:, X] - to_and_fro(times, 30.0, 6.0, bounds)).max()
    assert error < REVERSED[name, way]


# m. MuJoCo's own is regularised: it creeps while it sticks, and brakes a step too long when it
# stops; measured 9.4e-7.
ONE = {"mujoco": 3e-6, "pymunk": 1e-15}


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_engine_alone_has_one_bound(name: str) -> None:
    """It breaks loose at 3 N; where that is the only bound, it does as our law."""
    step = 1e-3
    loose = moved(TUNED[name], guided(GROWING), RESTS, EIGHT, step).states["block"]
    assert loose[50, X] < -1.0  # at 5 s
    x = moved(TUNED[name], guided(DRAWN), RESTS, TEN, step).states["block"][:, X]
    assert np.abs(x - drawn(TEN)).max() > 1.0
    native, law = (
        moved(TUNED[name], guided(DRAWN, THREE), RESTS, TEN, step, realised=way).states["block"]
        for way in ("native", "law")
    )
    assert np.abs(native[:, X] - law[:, X]).max() < ONE[name]


SMOOTH = Smooth(5e-4, 1e5)
# m over 4 s while it slips, and over 6 s: stopping at 4.79 s is a corner of 5e-4 m/s, within which
# the implicit midpoint's error grows.
SMOOTHLY = {"mujoco": (1e-9, 1.2e-8), "pymunk": (2e-8, 4e-5)}  # measured 3e-10, 4e-9; 7e-9, 1.3e-5


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_smooth_law_slips_and_creeps(name: str) -> None:
    scene, times = guided(DRAWN, smooth=SMOOTH), np.linspace(0.0, 6.0, 61)
    friction = DryFriction(SIX, THREE, SMOOTH)
    assert ways(TUNED[name], scene, RESTS) == ("native", "law")

    def rate(t: float, s: Array) -> list[float]:
        applied = 4 * t - 2 * s[0]
        return [s[1], applied + smooth_friction(friction, s[1], applied, smooth=SMOOTH)]

    exact = solve_ivp(rate, (0, 6), [0.0, 0.0], "Radau", times, rtol=1e-9, atol=1e-12).y[0]
    run = moved(TUNED[name], scene, RESTS, times, 1e-4, realised="law", record=True)
    error = np.abs(run.states["block"][:, X] - exact)
    assert error[:41].max() < SMOOTHLY[name][0]
    assert error.max() < SMOOTHLY[name][1]
    record = every(run)
    stuck = (record.times > 5.0) & (record.times < 6.0)
    slip = observe(scene, record, "guide.slip")[stuck]
    assert slip.min() >= 0.8 * SMOOTH.band
    assert slip.max() <= SMOOTH.band


# Contacts: both engines know one coefficient, and both adapters have a law for two.


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("static", [0.6, 0.42])  # tan 25° = 0.466: it stays, it comes back
def test_a_block_thrown_up_by_the_law_with_two_bounds(static: float, name: str) -> None:
    beta, step, times = math.radians(25), 1e-4, np.linspace(0.0, 2.0, 21)
    scene = incline(BLOCK, touching("block", 0.4, static=static), slope=beta)
    assert ways(TUNED[name], scene, RESTS)[:2] == ("native", "law")
    up, down = (G * (math.sin(beta) + sign * 0.4 * math.cos(beta)) for sign in (1, -1))
    stop, rest = 2.0 / up, np.maximum(times - 2.0 / up, 0.0)
    before = np.minimum(times, stop)
    x = -2.0 * before + up * before**2 / 2 + (static < 0.466) * down * rest**2 / 2

    def error(way: Realised) -> float:
        run = moved(TUNED[name], scene, thrown(-2.0), times, step, realised=way)
        return np.abs(run.states["block"][:, X] - x).max()

    law, native = error("law"), error("native")
    assert law < 0.4 * step**2 * up  # it stops within a step: h²/8 of the deceleration; 0.124
    assert native > 100 * law  # one bound: slides back, or turns back a step late


# m of the way, and m/s of the slip that is left.
ROLLED = {"mujoco": 1.3e-6, "pymunk": 5e-9}  # 4.4e-7, 1.7e-9


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_a_disk_slides_then_rolls_by_the_law_with_two_bounds(name: str) -> None:
    """Its slip falls by 3 μ g, for it resists with a third of its mass."""
    times, v, omega, mu = np.linspace(0.0, 3.0, 21), 2.0, 20.0, 0.2
    scene = incline(WHEEL, touching("wheel", mu, static=0.4))
    start, rolls = launched(v, omega), (v + RADIUS * omega) / (3 * mu * G)
    run = moved(TUNED[name], scene, start, times, 1e-4, realised="law", record=True)
    rows = run.states["wheel"]
    error = np.abs(rows[:, X] - sliding_then_rolling(times, v, omega, mu)).max()
    slip = observe(scene, every(run), "touch.slip")
    assert error < ROLLED[name]
    assert abs(rows[-1, VX] + RADIUS * rows[-1, OMEGA]) < ROLLED[name]
    assert every(run).times[np.argmax(slip < 1e-3)] == pytest.approx(rolls, abs=2e-4)
