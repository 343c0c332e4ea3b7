"""The force of a slide: with its dry friction, and without what an oil of its own exerts."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.planning import TUNED

from textmech.cases.scene.observe import observe
from textmech.engines.engine import Refusal
from textmech.engines.mujoco.read import reaction
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

HELD = """\
scene:
  points: {O: [0, 0]}
  bodies: {b: {block: {mass: 2.0, width: 0.1, height: 0.1}}}
  joints: {rail: {slide: [ground.O, b.center], along: [0.8, 0.6]DRY}}
  forces: {push: {push: b.center, constant: [25.0, 0]}OIL}
initial: {b: {x: 0, y: 0, vx: 0.8, vy: 0.6}}
allow: {b.x: 1.0e-3, rail.force: 1.0e-2}
"""
CARRIED = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies:
    arm: {bar: {mass: 1.0, length: 1.0}}
    bead: {block: {mass: 0.5, width: 0.1, height: 0.1}}
  joints:
    hinge: {pin: [ground.O, arm.start]}
    rail: {slide: [arm.center, bead.center], along: [1, 0]}
  forces: {oil: {viscous: rail, coefficient: 0.6, exponent: 1}}
initial: {arm: {angle: 0, omega: 2.0}, bead: {x: 0.6}}
allow: {arm.angle: 1.0e-3, rail.force: 1.0e-2}
"""
DRY = ", dry_friction: {kinetic: 3.0}"
OIL = ", oil: {viscous: rail, coefficient: 3.0, exponent: EXPONENT}"


def held(dry: str = "", oil: str = "") -> str:
    return HELD.replace("DRY", dry).replace("OIL", oil)


SCENES = {
    "dry": held(DRY),
    "viscous": held(oil=OIL.replace("EXPONENT", "1")),
    "by the square": held(oil=OIL.replace("EXPONENT", "2")),
    "by a power of our law": held(oil=OIL.replace("EXPONENT", "1.5")),
    "carried": CARRIED,
}
NEAR = {"mujoco": 1e-4, "pymunk": 2e-2}  # N, of some 20 N at 2e-4 s
STEP = 2e-4  # s


def off(name: str, what: str, tmp_path: Path) -> dict[str, float]:
    """By the way in which the engine runs it [N], where its force is read."""
    case = scenes.typed(tmp_path, SCENES[what], tail=scenes.tail(0.4, 21))
    motion = solve(case).trajectory
    start, found = first(motion), {}
    for plan in TUNED[name].plans(case.scene, start):
        if isinstance(plan, Refusal) or "rail.force" in plan.withheld:
            continue
        run = TUNED[name].run(case.scene, start, case.times, STEP, plan, reactions=("rail.force",))
        wanted, got = (observe(case.scene, t, "rail.force") for t in (motion, run))
        found[plan.realised] = float(np.max(np.abs(got - wanted)))
    return found


@pytest.mark.slow
@pytest.mark.parametrize("name", NEAR)
@pytest.mark.parametrize("what", SCENES)
def test_engines_read_the_force_of_the_book(name: str, what: str, tmp_path: Path) -> None:
    found = off(name, what, tmp_path)
    assert found
    assert max(found.values()) < NEAR[name]


@pytest.mark.slow
@pytest.mark.mutant("a joint's damping read as its force")
@pytest.mark.parametrize("what", ["viscous", "carried"])
def test_damping_that_is_read_as_its_force_is_seen(
    what: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reaction, "damped", lambda scene, joint: [])
    assert off("mujoco", what, tmp_path)["native"] > 0.05
