"""The sleigh's two sets of velocities tell one motion; its limits are those of the book."""

import math

import numpy as np
import pytest
from given.examples import PARAMETERS, only
from given.sleigh_by_speeds import SleighBySpeeds, random_state

from textmech.reference.motion.follow import follow
from textmech.reference.system import Only
from textmech.reference.systems.rolling.sleigh import Sleigh

SLEIGH = Sleigh(**PARAMETERS["sleigh"])


def test_the_accelerations_are_those_of_the_speeds() -> None:
    """q̈ = Ṅ v + N v̇."""
    by_speeds = SleighBySpeeds(SLEIGH)
    random = np.random.default_rng(3)
    for _ in range(20):
        q, v = random_state(random)
        q_dot, v_dot = by_speeds.rates(0.0, q, v), by_speeds.accelerations(0.0, q, v)
        h = 1e-30
        turned = by_speeds.rates(0.0, q + 1j * h * q_dot, v + 1j * h * v_dot)
        found = SLEIGH.accelerations(0.0, q, q_dot)
        np.testing.assert_allclose(found, np.imag(turned) / h, rtol=1e-13, atol=1e-13)


def test_it_turns_round_when_it_glides_backward() -> None:
    """u → V with the centre of mass ahead, and on the way it turns by up to π k/a."""
    backward = only("sleigh", v0=-0.8, w0=0.3)
    times = np.array([0.0, 10.0])
    _, _, theta, vx, vy, omega = follow(Only(backward), times).y[-1]
    k = math.sqrt(0.09 / 1.7 + 0.35**2)
    V = math.hypot(0.8, k * 0.3)
    assert abs(vx * math.cos(theta) + vy * math.sin(theta) - V) < 1e-6
    assert abs(omega) < 1e-4
    assert math.pi * k / 0.35 * 0.9 < theta < math.pi * k / 0.35


def test_a_blade_under_the_centre_is_no_sleigh() -> None:
    with pytest.raises(ValueError, match="knife edge"):
        Sleigh(1.0, 1.0, 0.0, 1.0, 1.0)
