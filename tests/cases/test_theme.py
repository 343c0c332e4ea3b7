"""Themes are told from the scene alone: some cases, as a person would sort them."""

from dataclasses import replace

import pytest
from given import scenes
from given.otherwise import otherwise

from textmech.cases import theme
from textmech.cases.case import Case
from textmech.cases.theme import THEMES, themes


@pytest.fixture
def shipped() -> list[Case]:
    """All shipped cases."""
    return [*scenes.EVERY.values()]


@pytest.mark.parametrize(
    ("name", "about"),
    [
        ("bar_pendulum", {"pins"}),
        ("double_pendulum", {"pins"}),
        ("four_bar", {"loops"}),
        ("slider_crank", {"loops", "springs", "driven"}),
        ("rolling_wheel.downhill", {"rolling", "driven"}),
        ("sliding_block.braking", {"friction"}),
        ("bouncing_disk.elastic", {"friction", "impacts"}),
        ("rimless_wheel", {"friction", "impacts"}),
        ("growing_force", {"friction", "driven"}),
        ("sleigh.spin", {"rolling"}),
        ("falling_drag", {"drag"}),
        ("spatial_four_bar", {"loops", "space"}),
        ("heavy_top.cusp", {"pins", "space"}),
        ("robot_states", {"space", "states"}),
        ("muscle_load", {"springs"}),
    ],
)
def test_a_case_is_about(name: str, about: set[str], shipped: list[Case]) -> None:
    (case,) = [case for case in shipped if case.name == name]
    assert set(themes(case)) == about


def test_every_case_is_about_something_that_has_a_meaning(shipped: list[Case]) -> None:
    for case in shipped:
        assert set(themes(case)) & (set(THEMES) - {"driven", "space"}), case.name


@pytest.mark.mutant("every contact is one with friction")
@pytest.mark.parametrize(
    ("friction", "about"), [(0.0, {"impacts"}), (0.3, {"impacts", "friction"})]
)
def test_a_smooth_contact_has_no_friction(
    friction: float, about: set[str], shipped: list[Case]
) -> None:
    (case,) = [case for case in shipped if case.name == "bouncing_disk.elastic"]
    ((name, contact),) = case.scene.contacts.items()
    other = replace(contact, static=friction, kinetic=friction)
    smooth = replace(case, scene=replace(case.scene, contacts={name: other}))
    assert set(themes(smooth)) == about
    blind = otherwise(theme, "c.switches and c.static > 0.0", "c.switches")
    assert set(blind.themes(smooth)) == {"impacts", "friction"}
