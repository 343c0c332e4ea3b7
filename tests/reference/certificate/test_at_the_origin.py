"""What differences are relative to: a body that rests at the origin, and masses far apart."""

from pathlib import Path

import pytest
from given.scenes import typed

from textmech.reference.certificate import laws
from textmech.reference.solve import solve

RESTS = """\
scene:
  space: 3
  points: {O: [0, 0, 0], Q: [1, 0, 0]}
  bodies:
    b: {sphere: {mass: 1.5, radius: 0.3}}
    rod: {block: {mass: 1, size: [0.5, 0.1, 0.1]}, points: {P: [0.25, 0, 0]}}
  joints:
    j: {universal: [ground.O, b.center], axes: [[0, 0.6, 0.8], [1, 0, 0]]}
    q: {hinge: [ground.Q, rod.P], axis: [0, 1, 0]}
initial:
  b: {attitude: [{axis: [0, 0.6, 0.8], angle: -0.945}, {axis: [1, 0, 0], angle: 0.935}],
      omega: [0, 0, 0]}
  q: {angle: 0}
allow: {rod.z: 1.0}
"""


@pytest.mark.slow
def test_a_body_that_rests_at_the_origin_has_a_size(tmp_path: Path) -> None:
    """Its place is no length, but what holds it could have power over that of its points."""
    solution = solve(typed(tmp_path, RESTS))
    assert [check.name for check in solution.checks if not check.holds] == []


HEAVY = """\
scene:
  space: 3
  points: {O: [0, 0, 0]}
  bodies:
    a: {rigid: {mass: 1.0, inertia: [0.03, 0.035, 0.04, 0, 0, 0]},
        points: {i: [-0.2, 0, 0.1], o: [0.3, 0.1, 0]}}
    b: {sphere: {mass: MASS, radius: 0.2}}
  joints:
    q1: {hinge: [ground.O, a.i], axis: [0, 1, 0.3]}
    q2: {hinge: [a.o, b.center], axis: [1, 1, 0.3]}
initial: {q1: {angle: 0.3, omega: 1}, q2: {angle: 7.0, omega: -2}}
duration: 0.48
samples: 13
allow: {q1.angle: 1.0, q2.angle: 1.0}
"""


@pytest.mark.slow
@pytest.mark.parametrize("mass", ["1.0e3", "1.0e4", "1.0e5", "1.0e6"])
def test_heavy_on_light_is_certified_as_far_as_rounding_lets(mass: str, tmp_path: Path) -> None:
    solution = solve(typed(tmp_path, HEAVY.replace("MASS", mass), tail=""))
    checks = {check.name: check for check in solution.checks}
    assert all(check.holds for check in checks.values())
    bound = checks["accelerations by Lagrange with multipliers (2.60)"].bound
    assert bound == (laws.LAW if mass == "1.0e3" else pytest.approx(1e-15 * float(mass)))
