"""A force that jumps where a mode ends has done nothing in it: its last row has what was before."""

from pathlib import Path

import numpy as np
import pytest
from given.scenes import typed

from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import AtEvent, Side
from textmech.reference.solve import solve
from textmech.reports.compare.events.states import reference_states
from textmech.reports.compare.events.times import reference_events

LIFTED = """\
scene:
  bodies: {b: {particle: {mass: 1}}}
  contacts: {c: {between: [b, ground.floor], friction: 0.5}}
  forces: {p: {push: b.center, step: {amplitude: [0, 20], at: 0.73}}}
initial: {b: {x: 0, y: 0}}
events: {up: {c.normal: falls to zero}, go: {b.vy: leaves zero}}
allow: {b.y: 0.01, go.c.normal.before: 0.1}
"""
PUSHED = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {b: {particle: {mass: 2}}}
  joints:
    r: {slide: [ground.O, b.center], along: [1, 0], dry_friction: {static: 6, kinetic: 3}}
  forces: {p: {push: b.center, step: {amplitude: [15, 0], at: 0.73}}}
initial: {b: {x: 0}}
events: {go: {r.slip: leaves zero}}
allow: {b.x: 1.0e-3, go.r.friction.before: 0.1, go.r.friction.after: 0.1}
"""


@pytest.mark.slow
@pytest.mark.mutant("a force that jumps at a corner has acted in the mode that it ends")
def test_what_lifts_at_a_corner_has_pressed_until_then(tmp_path: Path) -> None:
    case = typed(tmp_path, LIFTED)
    record = solve(case).trajectory.record
    assert record is not None
    normal = observe(case.scene, record, "c.normal")
    assert set(normal.tolist()) == {9.80665, 0.0}  # and nothing of 9.81 − 20
    assert reference_events(case.scene, record, case.events["go"]).tolist() == [0.73]
    assert not len(reference_events(case.scene, record, case.events["up"]))


@pytest.mark.slow
@pytest.mark.parametrize(("side", "friction"), [("before", 0.0), ("after", -3.0)])
def test_what_breaks_loose_at_a_corner_was_not_pushed_before(
    side: Side, friction: float, tmp_path: Path
) -> None:
    case = typed(tmp_path, PUSHED)
    record = solve(case).trajectory.record
    assert record is not None
    at = AtEvent("go", "r.friction", side)
    (found,) = reference_states(case, record, at, np.array([0.73]))
    assert found == pytest.approx(friction, abs=1e-12)
