"""Case → certified motion."""

from pathlib import Path

import pytest
from given import scenes
from given.typed_scenes import AT_REST

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
@pytest.mark.parametrize("name", AT_REST)
def test_what_rests_is_certified(tmp_path: Path, name: str) -> None:
    """At rest only rounding moves: no check may be relative to that."""
    solution = solve(scenes.typed(tmp_path, f"rests: true\n{AT_REST[name]}"))
    assert [check for check in solution.checks if not check.holds] == []


def test_a_phase_of_the_second_answer_alone_has_no_reactions() -> None:
    """Two integrators may find another count of phases: the certificate then says so."""
    case = scenes.SHIPPED["growing_force"]
    generated = scenes.mechanism(case)
    found = follow(generated, case.times)
    beside = reactions_of(generated, found, found)
    poses = generated.base.poses(0.0, *generated.start()[1:])
    assert beside(len(found.phases) - 1, 0.0, poses)
    assert beside(len(found.phases), 0.0, poses) == {}
