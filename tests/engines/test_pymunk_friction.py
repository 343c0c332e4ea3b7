"""pymunk's contacts that switch and its dry friction, against closed forms."""

import math
import subprocess
import sys
from functools import partial
from itertools import pairwise
from typing import Literal

import numpy as np
import pytest
from planning import planned, ways
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from textmech.cases.observe import observe
from textmech.cases.scene import (
    Anchor,
    Body,
    Bounds,
    Contact,
    DryFriction,
    Force,
    GroundPoint,
    Joint,
    Push,
    Scene,
    Signal,
    Smooth,
    Spring,
)
from textmech.cases.shape import bar, disk, particle
from textmech.cases.trajectory import ANGLE, OMEGA, VX, Array, Trajectory, X, Y
from textmech.engines.engine import Realised, Start
from textmech.engines.law import smooth_friction
from textmech.engines.pymunk import Pymunk, settings
from textmech.engines.pymunk.law import breakaway as onset

SHIPPED, TUNED = Pymunk("shipped"), Pymunk("tuned")
G, STEP = 9.80665, 1e-4
TIMES = np.linspace(0.0, 2.0, 21)
BLOCK = particle(name="block", mass=1.3)
WHEEL = disk(name="wheel", mass=1.3, radius=0.3, points={})


def moved(
    scene: Scene,
    start: Start,
    times: Array = TIMES,
    *,
    step: float = STEP,
    realised: Realised = "native",
    reactions: tuple[str, ...] = (),
) -> Trajectory:
    return TUNED.run(
        scene,
        start,
        times,
        step,
        planned(TUNED, scene, start, realised),
        reactions=reactions,
        record=True,
    )


def incline(
    body: Body,
    beta: float,
    kinetic: float,
    *,
    static: float | None = None,
    restitution: float = 0.0,
    point: str = "center",
) -> Scene:
    at = Anchor(body.name, point)
    touch = Contact("touch", at, static or kinetic, kinetic, restitution)
    gravity = (G * math.sin(beta), -G * math.cos(beta))
    return Scene(gravity, {}, {body.name: body}, {}, {"touch": touch}, {})


def rail(static: Bounds, kinetic: Bounds, force: Force, smooth: Smooth | None = None) -> Scene:
    """A block of 1 kg on a slide with dry friction, and the end of a spring that is pulled."""
    points = {"O": GroundPoint((0.0, 0.0)), "hook": GroundPoint((10.0, 0.0), (2.0, 0.0))}
    ends = Anchor("ground", "O"), Anchor("block", "center")
    slide = Joint("rail", "slide", *ends, dry_friction=DryFriction(static, kinetic, smooth))
    bodies = {"block": particle(name="block", mass=1.0)}
    return Scene((0.0, -G), points, bodies, {"rail": slide}, {}, {"pull": force})


SIX, THREE = Bounds(6.0, 6.0), Bounds(3.0, 3.0)
PULL = Spring("pull", Anchor("block", "center"), Anchor("ground", "hook"), 2.0, 10.0)
GROWING = Push("pull", Anchor("block", "center"), Signal("ramp", (-1.0, 0.0)))
REST: Start = {"block": (0.0, 0.0, 0.0, 0.0, 0.0, 0.0)}


def thrown(v: float) -> Start:
    return {"block": (0.0, 0.0, 0.0, v, 0.0, 0.0)}


def launched(v: float, omega: float, height: float = 0.0) -> Start:
    return {"wheel": (0.0, 0.3 + height, 0.0, v, 0.0, omega)}


# A block on the floor


def test_block_below_the_friction_angle_does_not_creep() -> None:
    beta = math.radians(16)  # tan β = 0.287
    run = moved(incline(BLOCK, beta, 0.3), thrown(0.0), reactions=("touch.normal", "touch.tangent"))
    assert np.abs(run.states["block"][:, [X, VX]]).max() < 1e-12
    assert run.reactions["touch.normal"] == pytest.approx(1.3 * G * math.cos(beta), abs=1e-9)
    assert run.reactions["touch.tangent"] == pytest.approx(-1.3 * G * math.sin(beta), abs=1e-9)


def test_block_above_the_friction_angle_slides_exactly() -> None:
    beta = math.radians(30)
    x = moved(incline(BLOCK, beta, 0.3), thrown(0.0)).states["block"][:, X]
    a = G * (math.sin(beta) - 0.3 * math.cos(beta))
    assert np.abs(x - a * TIMES**2 / 2).max() < 1e-10


def test_block_brakes_to_rest() -> None:
    end = moved(incline(BLOCK, 0.0, 0.4), thrown(3.0)).states["block"][-1]
    assert abs(end[X] - 9.0 / (2 * 0.4 * G)) < STEP**2 * 0.4 * G
    assert abs(end[VX]) < 1e-12


@pytest.mark.parametrize("static", [0.6, 0.42])  # tan 25° = 0.466: it stays, it comes back
def test_block_thrown_up_by_the_law_with_two_bounds(static: float) -> None:
    beta = math.radians(25)
    scene = incline(BLOCK, beta, 0.4, static=static)
    up, down = (G * (math.sin(beta) + sign * 0.4 * math.cos(beta)) for sign in (1, -1))
    stop, rest = 2.0 / up, np.maximum(TIMES - 2.0 / up, 0.0)
    before = np.minimum(TIMES, stop)
    x = -2.0 * before + up * before**2 / 2 + (static < 0.466) * down * rest**2 / 2
    law, native = (
        np.abs(moved(scene, thrown(-2.0), realised=r).states["block"][:, X] - x).max()
        for r in ("law", "native")
    )
    assert law < 5 * STEP**2 * up
    assert native > 100 * law  # one bound: slides back, or turns back a step late


def test_block_falls_for_one_step_without_the_seed(monkeypatch: pytest.MonkeyPatch) -> None:
    seedless = [c for c in settings._TUNED if c.name != "start.seed"]
    monkeypatch.setattr(settings, "_TUNED", seedless)
    y = moved(incline(BLOCK, 0.0, 0.4), thrown(1.0)).states["block"][:, Y]
    assert np.abs(y).max() > 1e-8


# A disk


@pytest.mark.parametrize("omega", [0.0, 20.0], ids=["without spin", "backspin"])
def test_disk_slides_then_rolls(omega: float) -> None:
    run = moved(incline(WHEEL, 0.0, 0.2), launched(2.0, omega))
    a = 0.2 * G
    rolls = (2.0 + 0.3 * omega) / (3 * a)
    sliding = np.minimum(TIMES, rolls)
    x = 2.0 * TIMES - a * sliding**2 / 2 - a * rolls * np.maximum(TIMES - rolls, 0.0)
    states = run.states["wheel"]
    assert np.abs(states[:, X] - x).max() < 2 * STEP**2 * a
    assert abs(states[-1, VX] - (2.0 - a * rolls)) < 1e-11
    assert abs(states[-1, VX] + 0.3 * states[-1, OMEGA]) < 1e-11


def test_disk_on_a_slope_too_steep_slides_and_turns() -> None:
    beta = math.radians(40)
    states = moved(incline(WHEEL, beta, 0.1), launched(0.0, 0.0)).states["wheel"]
    a = G * (math.sin(beta) - 0.1 * math.cos(beta))
    assert np.abs(states[:, X] - a * TIMES**2 / 2).max() < 1e-10
    turned = -2 * 0.1 * G * math.cos(beta) / 0.3 * TIMES**2 / 2
    assert np.abs(states[:, ANGLE] - turned).max() < 1e-9


@pytest.mark.parametrize("restitution", [1.0, 0.8, 0.0])
def test_disk_bounces(restitution: float) -> None:
    run = moved(incline(WHEEL, 0.0, 0.3, restitution=restitution), launched(0.0, 0.0, height=1.0))
    impact = math.sqrt(2 / G)
    after = TIMES - impact
    v = restitution * G * impact
    flight = np.where(after < 0, 1 - G * TIMES**2 / 2, v * after - G * after**2 / 2)
    first = after < 2 * v / G if restitution else np.full(len(TIMES), True)
    flight = np.maximum(flight, 0.0)
    assert np.abs(run.states["wheel"][:, Y] - 0.3 - flight)[first].max() < 20 * STEP
    # the record shows the floor reached, however short the bounce
    record = run.record
    assert record is not None
    gap = observe(incline(WHEEL, 0.0, 0.3), record, "touch.gap")
    falls = np.flatnonzero((gap[:-1] > 0) & (gap[1:] <= 0))
    share = gap[falls[0]] / (gap[falls[0]] - gap[falls[0] + 1])
    t = record.times[falls[0]] + share * np.diff(record.times)[falls[0]]
    assert t == pytest.approx(impact, abs=STEP / 10)
    assert np.abs(np.diff(record.times)).min() > STEP / 3


def test_end_of_a_bar_slides_on_the_floor() -> None:
    """Smooth floor, released at 60 deg: the centre falls straight down."""
    length, angle = 0.8, math.radians(60)
    rod = bar(name="rod", mass=1.1, length=length, points={})
    cos, sin = length / 2 * math.cos(angle), length / 2 * math.sin(angle)
    times = np.linspace(0.0, 0.28, 8)

    def rate(t: float, s: Array) -> list[float]:
        a, w = s
        c = math.cos(a) * length / 2
        lift = math.sin(a) * length / 2
        return [w, -c * (G - lift * w * w) / (length**2 / 12 + c * c)]

    exact = solve_ivp(rate, (0, 0.3), [angle, 0.0], "DOP853", times, rtol=1e-12, atol=1e-12).y[0]
    scene = incline(rod, 0.0, 0.0, point="start")
    run = moved(scene, {"rod": (cos, sin, angle, 0.0, 0.0, 0.0)}, times)
    assert np.abs(run.states["rod"][:, ANGLE] - exact).max() < 2e-3
    assert np.abs(run.states["rod"][:, X] - cos).max() < 1e-12


# Dry friction on a slide


def test_block_under_a_growing_force() -> None:
    """Example 2.3: it slips at t = 6 s."""
    times = np.linspace(0.0, 8.0, 81)
    run = moved(rail(SIX, THREE, GROWING), REST, times, realised="law")
    slid = np.maximum(times - 6.0, 0.0)
    error = run.states["block"][:, X] + slid**3 / 6 + 3 * slid**2 / 2
    assert np.abs(error).max() < STEP**2


def _speed(s: float, *, w: float, a: float, b: float) -> float:
    return 2.0 + w * (b * math.cos(w * s) - a * math.sin(w * s))


def pulled(times: Array) -> Array:
    """Example 2.4: phases of rest, and of ẍ = −2 x + 4 t − 3."""
    x, start, w, found = 0.0, 0.0, math.sqrt(2.0), np.zeros_like(times)
    while start < times[-1]:
        slips = (6.0 + 2 * x) / 4
        a, b = x - (2 * slips - 1.5), -2.0 / w

        speed = partial(_speed, w=w, a=a, b=b)
        grid = np.linspace(0.1, 4.0, 40)
        low, high = next((p, q) for p, q in pairwise(grid) if speed(p) > 0 >= speed(q))
        lasts = float(brentq(speed, low, high, xtol=1e-14))
        s = np.clip(times - slips, 0.0, lasts)
        slid = 2 * (slips + s) - 1.5 + a * np.cos(w * s) + b * np.sin(w * s)
        found = np.where(times >= start, np.where(times > slips, slid, x), found)
        x = 2 * (slips + lasts) - 1.5 + a * math.cos(w * lasts) + b * math.sin(w * lasts)
        start = slips + lasts
    return found


PULLED_BAR = 1e-7  # m over 10 s at h = 1e-4


def pulled_error() -> float:
    times = np.linspace(0.0, 10.0, 101)
    run = moved(rail(SIX, THREE, PULL), REST, times, realised="law")
    return np.abs(run.states["block"][:, X] - pulled(times)).max()


def test_block_pulled_through_a_spring() -> None:
    assert pulled_error() < PULLED_BAR


def test_a_whole_step_at_the_onset_is_of_first_order(monkeypatch: pytest.MonkeyPatch) -> None:
    def plain(friction: DryFriction, middle: float, end: float) -> float:
        return onset.dry_friction(friction, 0.0, middle)

    monkeypatch.setattr(onset, "_from_rest", plain)
    assert PULLED_BAR < pulled_error() < 2 * STEP


def test_the_engine_alone_has_one_bound() -> None:
    times = np.linspace(0.0, 10.0, 101)
    x = moved(rail(SIX, THREE, PULL), REST, times).states["block"][:, X]
    assert np.abs(x - pulled(times)).max() > 1.0
    one_bound = moved(rail(THREE, THREE, PULL), REST, times).states["block"][:, X]
    by_law = moved(rail(THREE, THREE, PULL), REST, times, realised="law").states["block"][:, X]
    assert np.abs(one_bound - by_law).max() < 1e-3


def test_smooth_law_by_the_implicit_midpoint() -> None:
    smooth = Smooth(5e-4, 1e5)
    friction, times = DryFriction(SIX, THREE, smooth), np.linspace(0.0, 4.0, 41)

    def rate(t: float, s: Array) -> list[float]:
        applied = 4 * t - 2 * s[0]
        return [s[1], applied + smooth_friction(friction, s[1], applied, smooth=smooth)]

    exact = solve_ivp(rate, (0, 4), [0.0, 0.0], "Radau", times, rtol=1e-9, atol=1e-12).y[0]
    run = moved(rail(SIX, THREE, PULL, smooth), REST, times, realised="law")
    assert np.abs(run.states["block"][:, X] - exact).max() < 1e-4


@pytest.mark.parametrize("bounds", [(Bounds(2, 4), Bounds(1, 3)), (Bounds(1, 3), Bounds(1, 3))])
@pytest.mark.parametrize("speed", [0.0, 2e-3, -2e-3, 0.5])
@pytest.mark.parametrize("force", [-6.0, -3.5, 0.0, 1.9, 6.0])
def test_mean_over_a_step_is_the_law_stepped_finely(
    bounds: tuple[Bounds, Bounds], speed: float, force: float
) -> None:
    friction, h, n = DryFriction(*bounds), 1e-3, 5000
    v, rate = speed, 20.0  # N/s
    for i in range(n):
        applied = force + rate * (i + 0.5) * h / n
        after = v + (applied + onset.dry_friction(friction, v, applied)) * h / n
        v = 0.0 if after * v < 0 else after
    mean = onset.mean_friction(friction, speed, 1.0, lambda ahead: force + rate * ahead, h)
    assert speed + (force + rate * h / 2 + mean) * h == pytest.approx(v, abs=2e-5)


# What the adapter says


def test_declared_expansions() -> None:
    scene = rail(SIX, THREE, PULL)
    assert planned(TUNED, scene, REST).exponents == (1, 2)
    assert planned(TUNED, scene, REST, "law").exponents == (2, 3)
    assert planned(TUNED, incline(BLOCK, 0.1, 0.3), REST).exponents == (1, 2)


def test_realisations_audit_and_what_is_withheld() -> None:
    scene = rail(SIX, THREE, PULL)
    assert ways(TUNED, scene, REST) == ("native", "law")
    assert ways(SHIPPED, scene, REST) == ("native",)
    assert ways(TUNED, incline(BLOCK, 0.1, 0.3), REST) == ("native",)
    assert ways(TUNED, incline(BLOCK, 0.1, 0.3, static=0.4), REST) == ("native", "law")
    measured = TUNED.measure(scene, REST)
    assert measured["rail.friction_forward"] == measured["rail.friction_backward"] == 3.0
    uneven = rail(SIX, Bounds(1.0, 3.0), PULL)
    assert "rail.friction_forward" not in TUNED.measure(uneven, REST)
    assert "magnitude only" in planned(TUNED, scene, REST).withheld["rail.friction"]
    assert TUNED.measure(incline(BLOCK, 0.1, 0.3), thrown(0.0))["touch.friction"] == 0.3


@pytest.mark.parametrize("engine", [SHIPPED, TUNED], ids=lambda e: e.setting)
@pytest.mark.parametrize("kind", ["rail", "block", "wheel", "rod"])
def test_the_script_makes_the_same_motion(
    engine: Pymunk, kind: Literal["rail", "block", "wheel", "rod"]
) -> None:
    rod = bar(name="rod", mass=1.1, length=0.8, points={})
    scene, start = {
        "rail": (rail(THREE, THREE, PULL), REST),
        "block": (incline(BLOCK, 0.2, 0.3), thrown(-1.0)),
        "wheel": (incline(WHEEL, 0.0, 0.2, restitution=0.5), launched(2.0, 3.0, height=0.2)),
        "rod": (
            incline(rod, 0.0, 0.3, point="start"),
            {"rod": (0.4 * math.cos(1), 0.4 * math.sin(1), 1.0, 0.0, 0.0, 0.0)},
        ),
    }[kind]
    plan = planned(engine, scene, start)
    script = engine.script(scene, start, 0.01, plan)
    out = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    ends = {line.split()[0]: line.split()[1:] for line in out.stdout.splitlines()}
    run = engine.run(scene, start, np.array([0.0, 1.0]), 0.01, plan, reactions=())
    for body, states in run.states.items():
        assert [float(x) for x in ends[body]] == pytest.approx(states[-1].tolist(), abs=1e-12)


def test_record_holds_every_step_and_changes_nothing() -> None:
    scene, start = incline(WHEEL, 0.0, 0.2), launched(2.0, 20.0)
    run = moved(scene, start, step=1e-3)
    bare = TUNED.run(scene, start, TIMES, 1e-3, planned(TUNED, scene, start), reactions=())
    assert bare.record is None
    assert run.record is not None
    assert np.array_equal(run.states["wheel"], bare.states["wheel"])
    assert np.array_equal(run.record.states["wheel"][::100], run.states["wheel"])
    assert run.record.times[::100] == pytest.approx(TIMES, abs=1e-12)
    assert run.record.phase is not None
    assert not run.record.phase.any()
