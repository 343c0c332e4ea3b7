"""A disk that falls on the floor is thrown back with e of its speed, when it lands."""

import math
from dataclasses import dataclass, replace

import numpy as np
import pytest
from given.closed_motions import pivoting
from given.engine_scenes import RADIUS, WHEEL, G, incline, launched, machine, pin, touching
from given.planning import NAMES, TUNED, every, moved

from textmech.cases.scene import GroundPoint
from textmech.cases.scene.observe import observe
from textmech.cases.scene.shape import bar, rigid
from textmech.cases.trajectory import ANGLE, OMEGA, VY, Y

STEP = 1e-4
HEIGHT = 1.0  # m
LANDS = math.sqrt(2 * HEIGHT / G)  # s
SPEED = G * LANDS  # m/s


@dataclass(frozen=True)
class Near:
    """How near a tuned engine comes at 1e-4 s."""

    rebound: float  # of the speed of the fall
    lowest: float  # s from landing to the deepest place
    flight: float  # m, of the flight after the first impact
    land: float  # s


NEAR = {
    # The floor is a spring and a damper: a bounce takes about 15 steps, to which the damper's ratio
    # belongs but gravity does not; measured 0.011, 8e-4 s, and 1.8e-2 m at the end of a flight of
    # 0.45 s. The landing is read between two steps: measured 2.5e-7 s.
    "mujoco": Near(rebound=0.02, lowest=10 * STEP, flight=4e-2, land=STEP / 100),
    # An impact is met at a whole step: the speed is off by g h at most, the place by v h; measured
    # 1.7e-6 and 3.9e-4 m. A body that has landed within a step is read there: measured 6.8e-6 s.
    "pymunk": Near(rebound=G * STEP / SPEED, lowest=STEP, flight=SPEED * STEP, land=STEP / 10),
}


@dataclass(frozen=True)
class Spun:
    """How near to the impact's law a disk with spin leaves the floor [m/s, rad/s]."""

    vx: float
    omega: float
    vy: float


SPUN = {
    # A bounce takes 16 steps, in which it slips on; e is off by half a percent with where in a
    # step the floor is met. Measured 4.3e-3, 2.9e-2, 1.5e-2.
    "mujoco": Spun(vx=1.3e-2, omega=9e-2, vy=4.6e-2),
    "pymunk": Spun(vx=5e-4, omega=3.3e-3, vy=1.7e-3),  # g h; measured 1.6e-4, 1.1e-3, 5.4e-4
}


@dataclass(frozen=True)
class Landed:
    """How near a bar's tip lands, over the step: rad/s, rad/s², and N/s once it lies still."""

    angle: float
    omega: float
    normal: float


# A damper stops it in three steps, then a spring lifts it slowly: 4.0, 26, 0.1 at both steps.
LANDED = {"mujoco": Landed(angle=12.0, omega=80.0, normal=0.3)}


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("e", [0.0, 0.1, 0.5, 0.8, 1.0])
def test_a_disk_bounces(e: float, name: str) -> None:
    times, near = np.linspace(0.0, 2.0, 21), NEAR[name]
    scene = incline(WHEEL, touching("wheel", 0.3, restitution=e))
    run = moved(TUNED[name], scene, launched(0.0, height=HEIGHT), times, STEP, record=True)
    record = every(run)
    rows = record.states["wheel"]
    assert rows[:, VY].max() / SPEED == pytest.approx(e, abs=near.rebound)
    meets = record.times < LANDS + 0.01  # the first impact only
    assert abs(record.times[np.argmin(rows[meets, Y])] - LANDS) < near.lowest
    after = np.maximum(times - LANDS, 0.0)
    falling = HEIGHT - G * times**2 / 2
    flight = np.where(times < LANDS, falling, np.maximum(e * SPEED * after - G * after**2 / 2, 0))
    first = (after < 2 * e * SPEED / G) | (times < LANDS) | (e == 0.0)
    assert np.abs(run.states["wheel"][:, Y] - RADIUS - flight)[first].max() < near.flight
    # the record shows the floor reached, however short the bounce
    gap = observe(scene, record, "touch.gap")
    falls = np.flatnonzero((gap[:-1] > 0) & (gap[1:] <= 0))[0]
    share = gap[falls] / (gap[falls] - gap[falls + 1])
    t = record.times[falls] + share * (record.times[falls + 1] - record.times[falls])
    assert t == pytest.approx(LANDS, abs=near.land)
    assert np.abs(np.diff(record.times)).min() > STEP / 3


# Speed and spin with which the wheel is thrown at the floor: what friction then does in the impact.
THROWN = {
    "backspin that friction stops": (1.0, -8.0),
    "forward, and it rolls off": (3.0, 0.0),
    "so much spin that it slips throughout": (3.0, 70.0),
}


@pytest.mark.parametrize("name", SPUN)
@pytest.mark.parametrize("e", [0.5, 0.8, 1.0])
@pytest.mark.parametrize("what", THROWN)
def test_a_disk_thrown_with_spin(what: str, e: float, name: str) -> None:
    (v, omega), mu = THROWN[what], 0.3
    fall = math.sqrt(2 * 0.5 / G)
    times = np.array([0.0, 0.2, 0.4])  # it lands at 0.32 s
    scene = incline(WHEEL, touching("wheel", mu, restitution=e))
    run = moved(TUNED[name], scene, launched(v, omega, height=0.5), times, STEP)
    *_, vx, vy, after = run.states["wheel"][-1]
    slip = v + RADIUS * omega  # an impulse of 1 N s/kg changes it by 3 m/s
    impulse = -math.copysign(min(abs(slip) / 3, mu * (1 + e) * G * fall), slip)
    near = SPUN[name]
    assert abs(vx - v - impulse) < near.vx
    assert abs(after - omega - 2 * impulse / RADIUS) < near.omega
    assert abs(vy - (e * G * fall - G * (times[-1] - fall))) < near.vy


@pytest.mark.parametrize("name", LANDED)
@pytest.mark.parametrize("step", [1e-3, 1e-4])
def test_a_bar_on_a_hinge_lands_with_its_tip(step: float, name: str) -> None:
    """It stays where its tip meets the floor, and carries half its weight there."""
    rod = bar(name="rod", mass=1.0, length=1.0, points={})
    high = {"O": GroundPoint((0.0, 0.3))}
    hinge = pin("hinge", "ground.O", "rod.start")
    scene = replace(
        machine([rod], [hinge], contacts=[touching("rod", 0.0, point="end")]), points=high
    )
    released, lies = math.radians(20), -math.asin(0.3)
    times = np.arange(0.0, 1.001, 0.02)
    start = (math.cos(released) / 2, 0.3 + math.sin(released) / 2, released, 0.0, 0.0, 0.0)
    wanted = ("touch_end.normal",)
    run = moved(TUNED[name], scene, {"rod": start}, times, step, reactions=wanted)
    falls, _, _ = pivoting(times, 1.0, released)
    lands = int(np.argmax(falls < lies))
    rows = run.states["rod"]
    assert np.abs(rows[:lands, ANGLE] - falls[:lands]).max() < 1e-11
    assert np.abs(rows[lands:, ANGLE] - lies).max() < LANDED[name].angle * step
    assert np.abs(rows[lands:, OMEGA]).max() < LANDED[name].omega * step
    assert run.reactions[wanted[0]][-1] == pytest.approx(G / 2, abs=LANDED[name].normal * step)


@pytest.mark.slow
@pytest.mark.parametrize("name", LANDED)
@pytest.mark.parametrize("points", [2, 4, 6])
def test_a_block_lands_flat_on_several_points_and_lies(points: int, name: str) -> None:
    """Their dampers add up: six, each as strong as one alone, throw it back by 0.7 m/s of 2.4."""
    feet = {f"P{i}": (x, -0.1) for i, x in enumerate(np.linspace(-0.4, 0.4, points).tolist())}
    box = rigid(name="box", mass=2.0, inertia=0.1, points=feet)
    scene = incline(box, *[touching("box", 2.0, point=foot) for foot in feet])
    times, start = np.linspace(0.0, 1.0, 11), {"box": (0.0, 0.4, 0.0, 0.5, 0.0, 0.0)}
    wanted = tuple(f"touch_{foot}.normal" for foot in feet)
    run = moved(TUNED[name], scene, start, times, STEP, reactions=wanted, record=True)  # type: ignore[arg-type]
    assert every(run).states["box"][:, VY].max() < 0.12  # measured 0.042
    _, y, angle, *rates = run.states["box"][-1]
    assert (y, angle) == pytest.approx((0.1, 0.0), abs=5 * STEP)
    assert rates == pytest.approx([0.0] * 3, abs=1e-4)
    assert sum(run.reactions[each][-1] for each in wanted) == pytest.approx(2 * G, abs=1e-3)
