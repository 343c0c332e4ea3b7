"""Two coefficients of friction on a floor that carries less and less, or more and more."""

import numpy as np
import pytest
from given.engine_scenes import BLOCK, G, incline, thrown, touching
from given.planning import NAMES, TUNED, moved

from textmech.cases.scene import Anchor, Push, Scene, Signal
from textmech.cases.trajectory import Array, X

STATIC, KINETIC, F, P = 0.6, 0.4, 6.0, 5.003  # N, and N/s up: it slips inside a step
AT = Anchor("block", "center")


def lifted(way: int) -> Scene:
    scene = incline(BLOCK, touching("block", KINETIC, static=STATIC))
    pushes = (
        Push("along", AT, Signal("constant", (way * F, 0.0))),
        Push("up", AT, Signal("ramp", (0.0, P))),
    )
    forces = {push.name: push for push in pushes}
    return Scene(scene.gravity, {}, scene.bodies, {}, scene.contacts, forces)


def slid(times: Array) -> Array:
    """μ_s (m g − p t₀) = F; then m ẍ = F − μ_k (m g − p t), from rest at t₀."""
    m = BLOCK.mass
    begins = (m * G - F / STATIC) / P
    tau = np.maximum(times - begins, 0.0)
    first = F - KINETIC * F / STATIC
    return (first * tau**2 / 2 + KINETIC * P * tau**3 / 6) / m


# m, of second order: measured 1.7e-7 and 2.8e-7. With the bound of now it slips a step late: 5e-4
# and 3e-4; braked by the normal force of the step's start it is 8e-5 off in MuJoCo.
NEAR = {"mujoco": 5e-7, "pymunk": 8e-7}


@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize("name", NAMES)
def test_a_block_slips_when_its_bound_has_fallen(name: str, way: int) -> None:
    times, step = np.linspace(0.0, 1.0, 11), 1e-3
    run = moved(TUNED[name], lifted(way), thrown(0.0), times, step, realised="law")
    error = np.abs(way * run.states["block"][:, X] - slid(times)).max()
    assert error < NEAR[name]


DOWN, ALONG = 3.007, 9.0  # N/s


def pressed(way: int) -> Scene:
    """Drawn along harder and harder, and pressed down, too."""
    scene = incline(BLOCK, touching("block", KINETIC, static=STATIC))
    push = Push("rope", AT, Signal("ramp", (way * ALONG, -DOWN)))
    return Scene(scene.gravity, {}, scene.bodies, {}, scene.contacts, {"rope": push})


def drawn(times: Array) -> Array:
    """μ_s (m g + q t₀) = b t₀; then m ẍ = b t − μ_k (m g + q t), from rest at t₀."""
    m = BLOCK.mass
    begins = STATIC * m * G / (ALONG - STATIC * DOWN)
    tau = np.maximum(times - begins, 0.0)
    first = (STATIC - KINETIC) * (m * G + DOWN * begins)
    return (first * tau**2 / 2 + (ALONG - KINETIC * DOWN) * tau**3 / 6) / m


# m, of second order: measured 3.3e-8 and 2.8e-7. Where a bound that grows is taken to fall, it
# slips a step too early: 5e-4.
PRESSED = {"mujoco": 1e-7, "pymunk": 8e-7}


@pytest.mark.parametrize("way", [1, -1])
@pytest.mark.parametrize("name", NAMES)
def test_a_block_slips_when_its_bound_has_been_overtaken(name: str, way: int) -> None:
    times, step = np.linspace(0.0, 1.6, 17), 1e-3
    run = moved(TUNED[name], pressed(way), thrown(0.0), times, step, realised="law")
    error = np.abs(way * run.states["block"][:, X] - drawn(times)).max()
    assert error < PRESSED[name]
