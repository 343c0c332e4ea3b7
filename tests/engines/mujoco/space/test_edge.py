"""Blades in space, which MuJoCo holds by our law: closed forms, the reference, and refusals."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.engine_space import attitude, rigid, spatial, state
from given.planning import SHIPPED, TUNED, moved, refused, ways
from scipy.integrate import quad

from textmech.cases.scene import Anchor
from textmech.cases.scene.constraint import Edge
from textmech.cases.scene.contact import spatial_contact
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.rotation import about, product, turned
from textmech.cases.trajectory import Array
from textmech.engines.engine import Start
from textmech.reference.solve import solve

M, SPEED, SPIN = 1.7, 0.6, 2.5
AXIS = np.array([0.36, 0.48, 0.8])  # about which a ball of inertia turns evenly
FIRST = np.array(attitude([0.9, 0.1, -0.3, 0.2]))
ALONG = (0.8, 0.0, 0.6)
BALL = rigid("ball", M, (0.02, 0.02, 0.02), radius=0.1)
BLADE = Edge("blade", Anchor("ball", "center"), ALONG, kept=True, frame=SPACE)
TIMES = np.linspace(0.0, 0.6, 4)

OFF_CENTRE = """\
scene:
  space: 3
  gravity: [0.7, -0.4, -9.0]
  bodies:
    hand:
      rigid: {mass: 0.9, inertia: [0.02, 0.035, 0.04, 0.003, -0.001, 0.002]}
      points: {P: [0.13, 0.02, -0.05], Q: [-0.1, 0.08, 0.03]}
    tool: {rigid: {mass: 0.5, inertia: [0.004, 0.006, 0.005, 0, 0, 0]}, points: {in: [0, 0, 0.1]}}
  joints: {wrist: {ball: [hand.Q, tool.in]}}
  constraints: {blade: {edge: hand.P, along: [0.8, 0.36, 0.48]%s}}
initial:
  hand:
    {P: [0, 0, 0.4], attitude: {axis: [1, 2, 3], angle: 40 deg}, omega: [0.8, -1.1, 1.6], vx: 0.3%s}
  wrist: {attitude: {axis: [1, 0, 0], angle: 20 deg}, omega: [1, -2, 0.5]}
allow: {hand.x: 1.0e-2, blade.force: 1.0, wrist.fz: 1.0}
"""


def shadow(t: float) -> Array:
    """(2,) the heading at a time: the ball turns evenly about an axis of the ground."""
    long = turned(product(np.array(about(tuple(AXIS), SPIN * t)), FIRST), ALONG)
    return long[:2] / np.linalg.norm(long[:2])


def turning(t: float, by: float = 1e-5) -> float:
    """How fast the heading turns [rad/s], by differences."""
    (x, y), (u, v) = shadow(t - by), shadow(t + by)
    return float(np.arctan2(x * v - y * u, x * u + y * v)) / (2 * by)


def scene(blade: Edge = BLADE, **more: object):  # type: ignore[no-untyped-def]
    found = spatial([BALL], gravity=(0.0, 0.0, -2.0), **more)  # type: ignore[arg-type]
    return replace(found, constraints={blade.name: blade})


def begun() -> Start:
    velocity = np.append(SPEED * shadow(0.0), 0.0)
    spin = turned(FIRST * (1, -1, -1, -1), SPIN * AXIS)
    return {"ball": state((0.0, 0.0, 0.3), FIRST, velocity, spin)}


@pytest.mark.slow
def test_a_ball_that_turns_evenly_is_led_by_its_blade() -> None:
    """A blade at the centre exerts no moment and does no work: m u ψ̇ to its left, m g upward.

    Reached: 1e-12 m and 2e-9 N.
    """
    names = ("blade.force", "blade.normal")
    found = moved(TUNED["mujoco"], scene(), begun(), TIMES, 1e-3, realised="law", reactions=names)
    for k, t in enumerate(TIMES):
        place = [SPEED * quad(lambda s, i=i: shadow(s)[i], 0, t, epsabs=1e-13)[0] for i in (0, 1)]
        assert np.max(np.abs(found.states["ball"][k, :3] - [*place, 0.3])) < 3e-11
        assert abs(found.reactions["blade.force"][k] - M * SPEED * turning(t)) < 1e-7
    assert np.max(np.abs(found.reactions["blade.normal"] - 2.0 * M)) < 1e-10


@pytest.mark.slow
@pytest.mark.parametrize("words", [(", height: kept", ""), ("", ", vz: 0.2")])
def test_a_blade_off_the_centre_moves_and_holds_as_the_reference(
    words: tuple[str, str], tmp_path: Path
) -> None:
    """Reached: 2e-10 m, rad and their rates, of 8 rad/s; 3e-10 N."""
    case = scenes.typed(tmp_path, OFF_CENTRE % words, tail=scenes.tail(0.4, 6))
    known = solve(case).trajectory
    start: Start = {body: tuple(rows[0].tolist()) for body, rows in known.states.items()}
    wanted = tuple(name for name in known.reactions if name.split(".")[0] in ("blade", "wrist"))
    found = moved(
        TUNED["mujoco"], case.scene, start, case.times, 2.5e-4, realised="law", reactions=wanted
    )
    for body, rows in known.states.items():
        assert np.max(np.abs(found.states[body] - rows)) < 1e-9
    assert set(found.reactions) == set(wanted)
    for quantity, forces in found.reactions.items():
        assert np.max(np.abs(forces - known.reactions[quantity])) < 2e-9, quantity


def test_natively_there_is_no_blade() -> None:
    assert ways(TUNED["mujoco"], scene(), begun()) == ("native", "law")
    assert ways(SHIPPED["mujoco"], scene(), begun()) == ("native",)
    for setting in (TUNED, SHIPPED):
        said = refused(setting["mujoco"], scene())
        assert said is not None
        assert said.startswith("engine: ")


def test_a_blade_beside_what_gives_way_is_refused() -> None:
    rolls = spatial_contact("touch", Anchor("ball", "center"), 1.0, rim=False)
    said = refused(TUNED["mujoco"], scene(contacts=[rolls]))
    assert said is not None
    assert said.startswith("adapter: blade beside touch")
