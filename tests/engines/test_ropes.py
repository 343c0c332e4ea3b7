"""Ropes in every engine: against the reference, in the script, and beside what is not built."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import ropes, scenes
from given.planning import TUNED, moved

from textmech.cases.case import Case
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Trajectory
from textmech.engines.engine import Start
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

END = scenes.tail(1.0, 26)
STEP = 1e-4
AWAY = 0.03  # s: from what comes taut; a soft limit needs 4 ms to come to what it carries
# m and rad, N; measured: MuJoCo's own throws back up to 1.5 % of what it catches, 7.5e-3 m later,
# pymunk's up to 1 %.
REACHED = {"mujoco": (2e-2, 0.1), "pymunk": (2e-2, 0.2)}


def known(tmp_path: Path, name: str) -> tuple[Case, Trajectory, Start]:
    case = scenes.typed(tmp_path, ropes.EVERY[name], tail=END)
    motion = solve(case).trajectory
    return case, motion, first(motion)


def off(case: Case, motion: Trajectory, found: Trajectory, forces: tuple[str, ...]) -> Any:
    """How far places are, and forces."""
    away = np.min(np.abs(case.times[:, None] - motion.switches), axis=1) > AWAY
    places = [np.abs(found.states[b] - rows)[away, :3].max() for b, rows in motion.states.items()]
    pulls = [
        np.abs(found.reactions[name] - observe(case.scene, motion, name))[away].max()
        for name in forces
    ]
    return max(places), max(pulls)


@pytest.mark.slow
@pytest.mark.parametrize("name", ropes.EVERY)
@pytest.mark.parametrize("engine", REACHED)
def test_engines_move_as_the_reference(engine: str, name: str, tmp_path: Path) -> None:
    case, motion, start = known(tmp_path, name)
    forces = tuple(quantity for quantity in case.allow if quantity.endswith("force"))
    found = moved(TUNED[engine], case.scene, start, case.times, STEP, reactions=forces)
    places, pulls = off(case, motion, found, forces)
    assert places < REACHED[engine][0]
    if name != "pair":  # a pull of 0.04 N, which their own ropes lose to what they throw back
        assert pulls < REACHED[engine][1]


@pytest.mark.slow
def test_a_rope_that_swings_pulls_rightly_from_the_start() -> None:
    """Without the stretch with which it begins, MuJoCo's limit would not pull at all at t = 0."""
    case = scenes.SHIPPED["ball_on_rope.let_go"]
    motion = scenes.solved(case.name).trajectory
    found = moved(
        TUNED["mujoco"], case.scene, first(motion), case.times, STEP, reactions=("rope.force",)
    )
    (begins,) = motion.reactions["rope.force"][:1]
    assert begins == pytest.approx(0.6 * (9.80665 + 6.3**2), rel=1e-12)
    assert found.reactions["rope.force"][0] == pytest.approx(begins, abs=0.2)


HANGS = """\
scene:
  points: {O: [0, 1]}
  bodies: {a: {particle: {mass: 2}}}
  forces:
    r: {rope: [ground.O, a.center], length: 1}
    p: {push: a.center, sine: {amplitude: [0.1, 0], angular_frequency: 3}}
initial: {a: {x: 0, y: 0}}
allow: {a.x: 1.0e-3, r.force: 0.1}
"""


@pytest.mark.slow
@pytest.mark.parametrize("engine", TUNED)
def test_what_hangs_at_rest_is_held_from_the_first_sample_on(engine: str, tmp_path: Path) -> None:
    """A limit that is just met pulls nothing in MuJoCo."""
    case = scenes.typed(tmp_path, HANGS, tail=END)
    motion = solve(case).trajectory
    found = moved(
        TUNED[engine], case.scene, first(motion), case.times, STEP, reactions=("r.force",)
    )
    assert motion.reactions["r.force"][0] == pytest.approx(2 * 9.80665, rel=1e-12)
    assert found.reactions["r.force"] == pytest.approx(motion.reactions["r.force"], abs=0.02)


COARSE = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {ball: {particle: {mass: 1}}}
  forces: {rope: {rope: [ground.O, ball.center], length: 1}}
initial: {ball: {x: BEGIN, y: 0, vx: 2, vy: 0}}
allow: {ball.x: 1.0e-2}
"""


@pytest.mark.slow
def test_what_a_coarse_step_catches_is_hardly_thrown_back(tmp_path: Path) -> None:
    """pymunk finds a rope too long by up to v h, and takes it back at the rate r: v h r."""
    begins = (0.5, 0.5004, 0.5009, 0.5014, 0.5019)  # wherever in a step it comes taut
    for begin in begins:
        text = COARSE.replace("BEGIN", str(begin))
        case = scenes.typed(tmp_path, text, tail=scenes.tail(0.5, 6))
        start = first(solve(case).trajectory)
        found = moved(TUNED["pymunk"], case.scene, start, case.times, 1e-3)
        speed = found.states["ball"][-1, 3]
        assert abs(speed) < 0.05 * 2.0  # with 150/s at any step: up to 0.15
