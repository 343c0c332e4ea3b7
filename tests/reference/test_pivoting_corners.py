"""A block that stands on one of two corners that only pivot: the other one carries nothing."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.laws.refused import refused

from textmech.cases.mistake import CaseError
from textmech.reference.solve import solve

ROCKS = """\
scene:
  bodies: {{b: {{block: {{mass: 2, width: 0.5, height: 1}}}}}}
  contacts:
    l: {{between: [b.lower_left, ground.floor], friction: {mu}{ideal}}}
    r: {{between: [b.lower_right, ground.floor], friction: {mu}{ideal}}}
initial: {{b: {{lower_left: [0, 0], angle: 0.1, omega: 0}}}}
allow: {{b.angle: 1.0e-3, l.normal: 1.0e-1}}
"""
TAIL = scenes.tail(0.15, 11)


def rocks(mu: float = 0.9, ideal: str = ", ideal: pivot") -> str:
    return ROCKS.format(mu=mu, ideal=ideal)


@pytest.mark.slow
def test_the_corner_in_the_air_has_nothing_to_pull(tmp_path: Path) -> None:
    found = solve(scenes.typed(tmp_path, rocks(), tail=TAIL))
    assert found.holds
    free = solve(scenes.typed(tmp_path, rocks(ideal=""), tail=TAIL)).trajectory
    assert found.trajectory.states["b"] == pytest.approx(free.states["b"], abs=1e-12)
    assert np.all(found.trajectory.reactions["r.normal"] == 0.0)


def test_with_too_little_friction_it_would_slip(tmp_path: Path) -> None:
    mistake = refused(scenes.typed(tmp_path, rocks(mu=0.1), tail=TAIL))
    assert mistake.where == "scene.contacts.l.ideal"
    assert "pivoting is not possible with friction 0.1" in mistake.what


@pytest.mark.mutant("a block in the air taken for one on a corner")
def test_a_block_that_leaves_the_floor_with_both_is_told(tmp_path: Path) -> None:
    """It stands over its corner, and a hand lifts it with more than its weight after 49 ms."""
    lifted = rocks().replace("angle: 0.1", "angle: 26.56505117707799 deg")
    lifted = lifted.replace(
        "initial", "  forces: {hand: {push: b.center, ramp: [0, 400]}}\ninitial"
    )
    with pytest.raises(CaseError) as caught:
        solve(scenes.typed(tmp_path, lifted, tail=TAIL))
    told = {mistake.where: mistake.what for mistake in caught.value.mistakes}
    assert set(told) == {"scene.contacts.l.ideal", "scene.contacts.r.ideal"}
    assert all("the floor would have to pull at t = 0.049 s" in what for what in told.values())
