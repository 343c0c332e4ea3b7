"""Mechanisms in space from their files alone, against what is known of them in closed form."""

import math

import numpy as np
import pytest
from given import scenes

from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Array

G = 9.80665  # m/s²

pytestmark = pytest.mark.slow  # they take the certified motions


def seen(name: str, *quantities: str) -> list[Array]:
    """Quantities along the certified motion of a case, after its times."""
    found = scenes.solved(name).trajectory
    return [found.times, *(observe(scenes.SHIPPED[name].scene, found, q) for q in quantities)]


def test_a_sphere_rolls_along_a_parabola() -> None:
    """(2.23), (2.27) ẍ = 5/7 g sin α, ẏ stays; the floor holds it back with 2/7 m g sin α."""
    p = scenes.SHIPPED["rolling_sphere"].parameters
    t, x, y, fx = seen("rolling_sphere", "ball.x", "ball.y", "touch.fx")
    slope = G * math.sin(p["alpha"])
    assert np.max(np.abs(x - 5 / 14 * slope * t**2)) < 1e-12  # m, of 1.2
    assert np.max(np.abs(y - p["u"] * p["R"] * t)) < 1e-12
    assert np.max(np.abs(fx + 2 / 7 * p["m"] * slope)) < 1e-12  # N, of 0.8


def test_a_universal_joint_turns_unevenly() -> None:
    """ω₂/ω₁ = cos β/(1 − sin²β sin²φ), φ from where the first arm stands across both shafts."""
    names = ("bearing.angle", "bearing.omega", "driven.omega_1", "energy.total")
    _, angle, one, two, energy = seen("universal_shaft", *names)
    ratio = math.cos(math.pi / 6) / (1 - 0.25 * np.sin(angle) ** 2)
    assert np.max(np.abs(two / one - ratio)) < 1e-12
    assert np.ptp(two / one) > 0.2  # it is uneven
    assert np.max(np.abs(energy - energy[0])) < 1e-12  # J, of 0.3


def test_two_bodies_turn_without_angular_momentum() -> None:
    """After a cycle of the waist the chest stands otherwise; nothing ever turns as a whole."""
    names = [f"momentum.angular_{axis}" for axis in "xyz"]
    t, *momenta, bow, lean = seen("cat_turn", *names, "waist.bow", "waist.lean")
    assert np.max(np.abs(momenta)) < 1e-13  # kg m²/s, of 0.6 in one body
    assert np.max(np.abs(bow - 0.8 * np.sin(5 * t))) < 1e-12
    assert np.max(np.abs(lean - 0.8 * (1 - np.cos(5 * t)))) < 1e-12
    last = scenes.solved("cat_turn").trajectory.states["chest"][-1]
    assert 2 * math.acos(abs(last[3])) > 0.1  # rad
