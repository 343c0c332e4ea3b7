"""Friction that falls with the speed (2.90), in a slide and about a pin, in both engines."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.planning import CASES, TUNED, begun, moved

from textmech.cases.scene import DryFriction
from textmech.cases.trajectory import ANGLE, Array, X
from textmech.engines.engine import Realised, Start
from textmech.engines.law import braking
from textmech.engines.mujoco.callbacks import friction as of_mujoco
from textmech.reference.solve import solve

STEP = 1e-3  # s
WAYS: list[tuple[str, Realised]] = [("mujoco", "law"), ("pymunk", "law")]
# m at this step. A law holds its force over a step, at the speed in the middle: of second order.
# Measured 2.2e-6 and 1.6e-6.
DRAWN = {("mujoco", "law"): 6e-6, ("pymunk", "law"): 5e-6}


def far(engine: str, way: Realised, name: str = "stribeck_drive") -> float:
    """m from the certified motion."""
    scene, start = begun(name)
    run = moved(TUNED[engine], scene, start, CASES[name].times, STEP, realised=way)
    exact = scenes.solved(name).trajectory.states["block"]
    return float(np.max(np.abs(run.states["block"] - exact)[:, X]))


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "way"), WAYS)
def test_it_sticks_and_slips(engine: str, way: Realised) -> None:
    assert far(engine, way) < DRAWN[engine, way]


@pytest.mark.slow
@pytest.mark.mutant("falling friction by the speed of the step's start")
def test_mutant_speed_of_the_step_s_start(monkeypatch: pytest.MonkeyPatch) -> None:
    def first(self: Any, sense: int, speed: float) -> float:
        return braking(self.friction, sense, self.speed)

    monkeypatch.setattr(of_mujoco.Slide, "brakes", first)
    assert far("mujoco", "law") > 10 * DRAWN["mujoco", "law"]


ROTOR = """\
scene:
  points: {O: [0, 0]}
  bodies: {disk: {disk: {mass: 2.0, radius: 0.5}}}
  joints:
    axle:
      pin: [ground.O, disk.center]
      dry_friction: {static: 0.8, kinetic: 0.4, stribeck: {speed: 1.5 rad/s}}
initial: {disk: {angle: 0, omega: 4.0}}
allow: {disk.angle: 1.0e-2}
"""


def spun_down(times: Array) -> Array:
    """(N,) ω: e^{ω/ω_s} = (e^{ω₀/ω_s} + D/M) e^{−M t/(J ω_s)} − D/M, D = M_s − M, until it is 1."""
    J, rest, falls, of = 0.25, 0.4, 0.4, 1.5
    grown = (np.exp(4.0 / of) + falls / rest) * np.exp(-rest * times / (J * of)) - falls / rest
    return of * np.log(np.maximum(grown, 1.0))


# rad/s: of a rotor that nothing else turns the mean over a step is right to h²; 2.9e-7.
SPUN = {("mujoco", "law"): 1e-6, ("pymunk", "law"): 1e-6}


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "way"), WAYS)
def test_a_rotor_spins_down(engine: str, way: Realised, tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, ROTOR, tail=scenes.tail(3.0, 31))
    solution = solve(case)
    states = solution.trajectory.states["disk"]
    exact = spun_down(case.times)
    assert exact[0] == 4.0
    assert exact[-1] == 0.0
    np.testing.assert_allclose(states[:, ANGLE + 3], exact, rtol=0, atol=1e-12)
    start: Start = {"disk": tuple(states[0].tolist())}  # type: ignore[dict-item]
    run = moved(TUNED[engine], case.scene, start, case.times, STEP, realised=way)
    assert np.max(np.abs(run.states["disk"][:, ANGLE + 3] - exact)) < SPUN[engine, way]


def test_braking_falls_towards_the_kinetic_friction() -> None:
    law = CASES["stribeck_drive"].scene.joints["guide"].dry_friction
    assert isinstance(law, DryFriction)
    forces = [braking(law, 1, speed) for speed in (0.0, 0.5, 50.0)]
    assert forces == pytest.approx([6.0, 3.0 + 3.0 / np.e, 3.0])
