"""What an engine leaves out of a scene is said by its native plan, and by no other."""

from dataclasses import replace

import pytest

from textmech.cases.find import shipped
from textmech.cases.load import load
from textmech.engines import make
from textmech.engines.engine import Plan
from textmech.engines.law import one_number
from textmech.reports.compare.trial.start import assembled


@pytest.mark.parametrize("name", ["mujoco", "pymunk"])
@pytest.mark.parametrize("case", ["growing_force", "anisotropic_drift", "growing_force_smooth"])
def test_friction_with_several_numbers_is_named_natively(name: str, case: str) -> None:
    (scene,) = load(shipped()[case])
    found = make(name, "tuned").plans(scene.scene, assembled(scene))
    words = {way.realised: way.simplified for way in found if isinstance(way, Plan)}
    assert words.pop("native") == "one number for friction: guide, where there are several"
    assert set(words.values()) == {""}


def test_one_coefficient_is_nothing_left_out() -> None:
    case = load(shipped()["sliding_block"])[0]
    assert one_number(case.scene) == ""
    contact = replace(case.scene.contacts["touch"], static=0.9, kinetic=0.4)
    scene = replace(case.scene, contacts={"touch": contact})
    assert one_number(scene) == "one number for friction: touch by its kinetic 0.4 (static 0.9)"
