"""Feet that strike only ahead of each other, generated from the scene, against the one by hand."""

from dataclasses import replace

import numpy as np
import pytest
from given import scenes
from given.scenes import SHIPPED

from textmech.cases.mistake import CaseError
from textmech.reference.mechanism.modes import element
from textmech.reference.mechanism.modes.mechanism import BadStart
from textmech.reference.mechanism.modes.mode_selection import Undetermined
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve
from textmech.reference.systems import written

CASE = SHIPPED["compass_walker"]


@pytest.mark.slow
def test_it_strikes_when_the_one_by_hand_does() -> None:
    own = written("compass_walker", CASE.parameters)
    found, known = follow(scenes.mechanism(CASE), CASE.times), follow(own, CASE.times)
    assert [change.name for change in found.changes] == 3 * ["right_foot lands", "left_foot lands"]
    times = [[change.time for change in each.changes] for each in (found, known)]
    assert times[0] == pytest.approx(times[1], abs=1e-12)
    assert found.phases[1] == "left_foot open, right_foot sticks"


@pytest.mark.mutant("a swinging foot that strikes midway")
def test_a_foot_that_does_not_pass_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Midway it would strike the floor, with the standing one beside it."""
    monkeypatch.setattr(element.Element, "behind", lambda self, t, q, size: 0.0)
    try:
        changes = follow(scenes.mechanism(CASE), CASE.times).changes
    except (Undetermined, BadStart):
        return
    assert [round(change.time, 2) for change in changes] != [0.89, 1.79]


@pytest.mark.slow
def test_a_foot_is_not_in_the_floor_where_it_passes() -> None:
    mechanism = scenes.mechanism(CASE)
    found = follow(mechanism, np.linspace(0.0, 0.85, 41))
    feet = [mechanism.elements[k].normal for k in (0, 1)]
    low = [min(part.f(0.0, y[:8].tolist())[0] for part in feet if part) for y in found.y]
    assert min(low) < -1e-4  # m: 0.3 mm deep
    for t, y in zip(np.linspace(0.0, 0.85, 41), found.y, strict=True):
        assert mechanism.possible(found.phases[0], t, *np.split(y, 2)) is None


@pytest.mark.slow
def test_both_feet_in_the_air_are_no_walk() -> None:
    """The standing leg so fast that it leaves the floor at once."""
    left = CASE.initial["left"]
    fast = replace(left, given={**left.given, "omega": -6.0})
    flying = replace(CASE, system=None, initial={**CASE.initial, "left": fast}, duration=0.02)
    with pytest.raises(CaseError, match="the floor would have to pull at t = 0 s: left leaves it"):
        solve(flying)


@pytest.mark.slow
def test_a_walker_slips_where_friction_is_little() -> None:
    contacts = CASE.scene.contacts.items()
    feet = {name: replace(foot, static=0.01, kinetic=0.01) for name, foot in contacts}
    with pytest.raises(CaseError, match="would slip"):
        solve(replace(CASE, system=None, scene=replace(CASE.scene, contacts=feet)))
