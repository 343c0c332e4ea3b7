"""Case → certified motion."""

from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.reference.motion.follow import follow
from textmech.reference.solve import reactions_of, solve


@pytest.mark.slow
def test_a_hand_written_motion_is_the_generated_one() -> None:
    """Of every shipped case, whatever its certificate asks of it."""
    for name, case in scenes.SHIPPED.items():
        solution = scenes.solved(name)
        assert solution.system == (case.system or "generated"), name
        found = {check.name: check.difference for check in solution.checks}
        for check in ("generated motion", "generated accelerations"):
            assert (check in found) == (case.system is not None), name
            assert found.get(check, 0.0) < 1e-9, name


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "parameters"),
    [("hanging_bar", {}), ("mass_on_spring", {}), ("two_slides", {}), ("rolling_wheel", {"mu": 0})],
)
def test_what_rests_is_certified(name: str, parameters: dict[str, Any]) -> None:
    """At rest only rounding moves: no check may be relative to that."""
    solution = solve(scenes.scene(name, "rests: true", **parameters))
    assert [check for check in solution.checks if not check.holds] == []


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["pin", "weld"])
def test_a_particle_at_the_end_of_a_bar(kind: str) -> None:
    text = f"""\
scene:
  bodies: {{dot: {{particle: {{mass: 2}}}}}}
  joints: {{tip: {{{kind}: [bar.end, dot.center]}}}}
initial: {{bar: {{angle: -30 deg}}}}
rests: null
"""
    solution = solve(scenes.scene("hanging_bar", text))
    assert solution.holds
    # (2.34) about O, at rest: J = ⅓ m l² + M l², moment −(½ m + M) g l cos φ
    J = 1.2 * 0.8**2 / 3 + 2 * 0.8**2
    alpha = -(0.6 + 2) * 9.80665 * 0.8 * np.cos(np.pi / 6) / J
    assert solution.trajectory.reactions["tip.fx"][0] == pytest.approx(2 * 0.8 * alpha * 0.5)


def test_a_phase_of_the_second_answer_alone_has_no_reactions() -> None:
    """Two integrators may find another count of phases: the certificate then says so."""
    case = scenes.SHIPPED["growing_force"]
    generated = scenes.mechanism(case)
    found = follow(generated, case.times)
    beside = reactions_of(generated, found, found)
    poses = generated.base.poses(0.0, *generated.start()[1:])
    assert beside(len(found.phases) - 1, 0.0, poses)
    assert beside(len(found.phases), 0.0, poses) == {}
