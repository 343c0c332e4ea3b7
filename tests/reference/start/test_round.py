"""Round bodies on whose attitude nothing depends: no angle is asked of them, and none is missed."""

from pathlib import Path

import numpy as np
import pytest
from given.scenes import tail, typed

from textmech.reference.solve import solve

CRADLE = """\
scene:
  points: {A: [0, 0], B: [0.1, 0], C: [0.2, 0]}
  bodies:
    a: {disk: {mass: 1, radius: 0.049}}
    b: {disk: {mass: 1, radius: 0.049}}
    c: {disk: {mass: 1, radius: 0.049}}
  joints:
    ra: {distance: [ground.A, a.center], length: 0.5}
    rb: {distance: [ground.B, b.center], length: 0.5}
    rc: {distance: [ground.C, c.center], length: 0.5}
  contacts:
    ab: {between: [b, a], friction: 0, restitution: 1}
    bc: {between: [c, b], friction: 0, restitution: 1}
initial:
  a: {x: -0.3, y: -0.4}
  b: {x: 0.1, y: -0.5}
  c: {x: 0.2, y: -0.5}
events: {first: {ab.gap: falls to zero}, second: {bc.gap: falls to zero}}
allow: {c.x: 1.0e-3}
"""


@pytest.mark.slow
def test_newtons_cradle_of_disks_on_rods(tmp_path: Path) -> None:
    """No angle is given, and none matters: they stay 0, and the last disk takes all that is left.

    Rods of one length, of which each hangs 2 mm off the next: the line of the first blow leaves
    the horizontal by an angle ε of at most 0.01, and of the speed a part below ε² is lost to it.
    """
    solution = solve(typed(tmp_path, CRADLE, tail=tail(0.9, 91)))
    assert all(check.holds for check in solution.checks)
    states = solution.trajectory.states
    assert all(np.all(state[:, [2, 5]] == 0.0) for state in states.values())
    highest = float(np.max(states["c"][:, 1]))
    assert -0.4 - 0.1 * 0.01**2 - 9.8 * 0.005**2 / 2 < highest < -0.4  # and half a sample of a fall
    energy = sum(
        0.5 * s[:, 3] ** 2 + 0.5 * s[:, 4] ** 2 + 9.80665 * s[:, 1] for s in states.values()
    )
    assert np.ptp(energy) < 1e-9
