"""A disk that falls on the floor is thrown back with e of its speed, when it lands."""

import math
from dataclasses import dataclass

import numpy as np
import pytest
from given.engine_scenes import RADIUS, WHEEL, G, incline, launched, touching
from given.planning import NAMES, TUNED, every, moved

from textmech.cases.observe import observe
from textmech.cases.trajectory import VY, Y

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
