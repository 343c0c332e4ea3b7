"""MuJoCo's ways of running: every shipped scene has one, and never two of one name."""

from collections import Counter

import pytest
from given.scenes import SHIPPED

from textmech.engines.engine import Realised
from textmech.engines.mujoco.adapter import plans


def named(name: str) -> Counter[Realised]:
    """How many ways of each name there are for the scene."""
    scene = SHIPPED[name].scene
    return Counter(way.realised for way in plans.WAYS if way.applies(scene))


def test_every_scene_has_a_way_and_no_two_of_one_name() -> None:
    for name in SHIPPED:
        assert named(name), name
        assert max(named(name).values()) == 1, name


def test_each_way_is_one_for_some_shipped_scene() -> None:
    scenes = [case.scene for case in SHIPPED.values()]
    for way in plans.WAYS:
        assert any(map(way.applies, scenes)), way


@pytest.mark.mutant("a driver for corners of springs where dry friction switches")
def test_two_ways_of_one_name_are_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(plans, "has_corners", lambda scene: True)
    assert [name for name in SHIPPED if max(named(name).values()) > 1]
