"""Dry friction of a generated pin: a moment about it, against motions written out by hand."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from given import rubbing, scenes
from given.rubbing import HELD, HUNG

from textmech.cases.case import Case
from textmech.reference.mechanism.constraints import contact
from textmech.reference.mechanism.constraints.constraint import Constraint
from textmech.reference.mechanism.constraints.constraint_terms import FIRST, SECOND, Turning
from textmech.reference.mechanism.modes import element
from textmech.reference.motion.follow import Followed, follow

END = scenes.tail(3.0, 31)
# rad: the half swings typed in the test are nudged off their turning points by 1e-6 s.
NEAR = 1e-9


def followed(tmp_path: Path, text: str) -> tuple[Case, Followed]:
    case = scenes.typed(tmp_path, text, tail=END)
    return case, follow(scenes.mechanism(case), case.times)


@pytest.mark.slow
@pytest.mark.parametrize("ends", [HUNG, HELD])
def test_a_bar_swings_to_rest(tmp_path: Path, ends: str) -> None:
    case, found = followed(tmp_path, rubbing.swinging(ends, 1.0, 1.4))
    exact = rubbing.swung(case.times, 1.0, 1.4)
    assert np.max(np.abs(found.y[:, 2] - exact)) < NEAR
    assert found.modes[-1] == "hinge sticks"
    assert abs(np.ptp(exact)) > 1.0


@pytest.mark.parametrize("parts", ["a.center, b.center", "b.center, a.center"])
def test_a_clutch_couples(tmp_path: Path, parts: str) -> None:
    case, found = followed(tmp_path, rubbing.CLUTCH.replace("PARTS", parts))
    for column, angle in zip((2, 5), rubbing.coupled(case.times), strict=True):
        np.testing.assert_allclose(found.y[:, column], angle, rtol=0, atol=1e-12)
    assert found.modes[0] != found.modes[-1] == "clutch sticks"


@pytest.mark.mutant("a pin that brakes the sum of both turns")
def test_mutant_pin_that_brakes_the_sum_of_both_turns(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = contact.at_rest

    def wrong(joint, where) -> Constraint:  # type: ignore[no-untyped-def]
        return replace(sound(joint, where), rows=((Turning(SECOND), Turning(FIRST, 1.0)),))

    monkeypatch.setattr(element, "at_rest", wrong)
    case, found = followed(tmp_path, rubbing.CLUTCH.replace("PARTS", "a.center, b.center"))
    assert np.max(np.abs(found.y[:, 5] - rubbing.coupled(case.times)[1])) > 0.1


@pytest.mark.slow
@pytest.mark.mutant("dry friction of a pin, forward and backward exchanged")
def test_mutant_friction_of_the_other_way(tmp_path: Path) -> None:
    case, found = followed(tmp_path, rubbing.swinging(HUNG, 1.4, 1.0))
    assert np.max(np.abs(found.y[:, 2] - rubbing.swung(case.times, 1.0, 1.4))) > 1e-2
