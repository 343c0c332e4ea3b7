"""MuJoCo's record of every step: the same states as the samples, and cheap."""

from pathlib import Path

import numpy as np
import pytest
from planning import planned

from textmech.cases.load import load
from textmech.engines.mujoco import MuJoCo
from textmech.engines.mujoco.read.record import all_steps
from textmech.reference.generated.mode import Multibody
from textmech.reference.start.assembly import assemble

CASES = [
    case
    for path in sorted((Path(__file__).parents[2] / "cases").glob("*.yaml"))
    for case in load(path)
]


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_record_holds_the_samples(case) -> None:  # type: ignore[no-untyped-def]
    mechanism = Multibody(case.scene, assemble(case))
    start = mechanism.poses(0.0, *mechanism.start())
    step = case.interval / 8
    engine = MuJoCo("tuned")
    plan = planned(engine, case.scene, start)
    motion = engine.run(case.scene, start, case.times[:5], step, plan, reactions=(), record=True)
    assert motion.record is not None
    assert motion.record.phase is not None
    assert motion.record.times == pytest.approx(np.arange(33) * step, abs=1e-15)
    for name, rows in motion.states.items():
        assert motion.record.states[name][::8] == pytest.approx(rows, rel=1e-9, abs=1e-9)


def test_times_are_products() -> None:
    assert all_steps(np.array([0.0, 0.3]), 0.1).tolist() == [0.0, 0.1, 0.2, 0.1 * 3]
