"""The compass walker's limit cycle, its multipliers, and its limit on light feet."""

import math
from functools import cache

import numpy as np
import pytest
from given.walkers import DOWN, ENTRIES, SLOPE, UP, WALKER, Legs, begun, returned

from textmech.reference.motion.cycle import Cycle, cycle, derivative
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array
from textmech.reference.systems.walkers.compass_walker import CompassWalker


def stepped(walker: CompassWalker, x: Array) -> Array:
    return returned(begun(walker, x), ENTRIES, until=1.6)[0]


@cache
def found() -> Cycle:
    return cycle(lambda x: stepped(WALKER, x), np.array([0.2135, 0.8617, 0.6753]))


@pytest.mark.slow
def test_limit_cycle_closes_and_is_stable():
    """Its place and multipliers are this computation's; both legs walk alike."""
    assert found().error < 1e-14
    assert found().stable
    assert found().state == pytest.approx([0.21348174188, 0.86165388774, 0.67530270322], abs=1e-10)
    sizes = np.abs(found().multipliers)
    assert sizes == pytest.approx([0.345484939, 0.345484939, 0.194436579], abs=2e-9)
    coarser = derivative(lambda x: stepped(WALKER, x), found().state, part=5e-4)
    values = np.sort_complex(np.linalg.eigvals(coarser))
    assert values == pytest.approx(np.sort_complex(found().multipliers), abs=1e-10)
    a0, walker = float(found().state[0]), begun(WALKER, found().state)
    strikes = follow(walker, np.linspace(0.0, 5.5, 3)).events
    assert len(strikes) == 6
    step = 2 * math.sin(a0)  # m
    assert [s.after[0] for s in strikes] == pytest.approx([k * step for k in range(1, 7)], abs=1e-9)
    assert np.diff([s.time for s in strikes]) == pytest.approx(strikes[0].time, abs=1e-9)


@pytest.mark.slow
def test_a_step_loses_in_the_strike_what_the_slope_gives():
    """T + U before and after, over one step of the cycle."""
    a0, walker = float(found().state[0]), begun(WALKER, found().state)
    (strike,) = follow(walker, np.array([0.0, 1.0])).events
    kinetic = [
        walker.modes[mode].T(0.0, *np.split(y, 2))
        for mode, y in (("left stands", strike.before), ("right stands", strike.after))
    ]
    fall = 20.0 * 9.80665 * 2 * math.sin(a0) * math.sin(DOWN)
    assert kinetic[0] - kinetic[1] == pytest.approx(fall, rel=1e-10)


@pytest.mark.slow
def test_on_light_feet_it_comes_to_the_simplest_walker():
    """m/M → 0 with the legs' mass in the feet: an error of m/M, extrapolated to 0."""
    published = np.array([0.200310900544287, 0.199832473004977])
    places, beta = [], 2e-4
    g = 9.80665
    for m in (beta, beta / 2):
        x = np.array([*published, published[1] * math.cos(0.4)])
        feet = Legs(1.0, m, g, SLOPE, 1.0, UP, UP, 0.0, 0.0, g, 0.0)

        def step(y: Array, feet: CompassWalker = feet) -> Array:
            return returned(begun(feet, y), ENTRIES)[0]

        places.append(cycle(step, x).state[:2])
    assert np.abs(places[0] - published).max() < 10 * beta
    assert 2 * places[1] - places[0] == pytest.approx(published, abs=20 * beta**2)
