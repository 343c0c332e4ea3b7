"""A pin in a slot in both engines, against the certified reference."""

from pathlib import Path

import numpy as np
import pytest

from textmech.cases.load import load
from textmech.cases.observe import observe
from textmech.cases.scene import Scene
from textmech.cases.trajectory import ANGLE, Array, Trajectory
from textmech.engines.engine import Engine, Plan, Start
from textmech.engines.mujoco import MuJoCo
from textmech.engines.pymunk import Pymunk
from textmech.reference.solve import solve

HEAD = "title: A slot\nsource: {equations: ['2.60']}\n"
TAIL = """\
allow: {rod.angle: 1.0e-2}
duration: 1.0
samples: 11
step: {mujoco: 1.0e-3, pymunk: 1.0e-3}
"""
ROD = "rod: {bar: {mass: 1.2, length: 0.8}, points: {P: [0.1, 0.05]}}"
SCENES = {
    "a rod in a slot of the ground": f"""\
scene:
  points: {{O: [0.1, 0]}}
  bodies: {{{ROD}}}
  joints: {{guide: {{slot: [ground.O, rod.start], along: [0.8, 0.6]}}}}
initial: {{rod: {{start: [0.26, 0.12], angle: 0.3, omega: 1.5, vx: 0.4}}}}
""",
    "a slotted rod over a fixed pin": f"""\
scene:
  points: {{O: [0.1, 0]}}
  bodies: {{{ROD}}}
  joints: {{guide: {{slot: [rod.P, ground.O], along: [1, 0]}}}}
initial: {{rod: {{P: [0.1, 0], angle: 0.3, omega: 1.5, vx: 0.4}}}}
""",
    "a rod in the slot of an arm": f"""\
scene:
  points: {{O: [0.1, 0]}}
  bodies: {{arm: {{bar: {{mass: 0.9, length: 1.1}}}}, {ROD}}}
  joints:
    hinge: {{pin: [ground.O, arm.start]}}
    guide: {{slot: [arm.end, rod.start], along: [0.6, 0.8]}}
initial: {{arm: {{angle: -0.4, omega: 1.0}}, rod: {{x: 1.5, angle: 0.5, vx: 0.3, omega: -2}}}}
""",
}


def solved(scene: str, tmp_path: Path) -> tuple[Scene, Start, np.ndarray, np.ndarray]:
    """The scene, its start, the times, and the reference's angles of the rod."""
    path = tmp_path / "slot.yaml"
    path.write_text(HEAD + scene + TAIL)
    (case,) = load(path)
    motion = solve(case).trajectory
    start = {name: tuple(rows[0].tolist()) for name, rows in motion.states.items()}
    return case.scene, start, case.times, motion.states["rod"][:, ANGLE]  # type: ignore[return-value]


def run(
    engine: Engine, scene: Scene, start: Start, times: Array, h: float, **more: bool
) -> Trajectory:
    """Natively, at the step h."""
    plan, *_ = engine.plans(scene, start)
    assert isinstance(plan, Plan)
    return engine.run(scene, start, times, h, plan, reactions=(), **{"record": False, **more})


@pytest.mark.parametrize("name", SCENES)
def test_mujoco_builds_a_slot(name: str, tmp_path: Path) -> None:
    """A slide and a hinge of one body, to the error of RK4."""
    scene, start, times, angles = solved(SCENES[name], tmp_path)
    mujoco = run(MuJoCo("tuned"), scene, start, times, 1e-3)
    assert np.abs(mujoco.states["rod"][:, ANGLE] - angles).max() < 1e-8
    assert np.abs(observe(scene, mujoco, "guide.gap")).max() < 1e-12


@pytest.mark.parametrize("name", list(SCENES)[:2])
def test_pymunk_builds_a_slot(name: str, tmp_path: Path) -> None:
    """A groove without a gear. Beside turning centres it is oblique to K: of first order.

    Between two bodies that turn (the third scene) pymunk's projection feeds energy in, and no
    number of sweeps or smaller step helps: a row says `diverged`.
    """
    scene, start, times, angles = solved(SCENES[name], tmp_path)
    plan, *_ = Pymunk("tuned").plans(scene, start)
    assert isinstance(plan, Plan)
    assert plan.held == (1, 2)
    errors = []
    for h in (1e-3, 5e-4):
        motion = run(Pymunk("tuned"), scene, start, times, h)
        errors.append(np.abs(motion.states["rod"][:, ANGLE] - angles).max())
    assert errors[0] < 2e-2
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.02)


def test_a_record_of_every_step_reads_the_slot_too(tmp_path: Path) -> None:
    scene, start, times, _ = solved(SCENES["a slotted rod over a fixed pin"], tmp_path)
    motion = run(MuJoCo("tuned"), scene, start, times, 1e-3, record=True)
    assert motion.record is not None
    np.testing.assert_allclose(motion.record.states["rod"][::100], motion.states["rod"], atol=1e-12)
