"""Themes are told from the scene alone: some cases, as a person would sort them."""

import pytest

from textmech.reports.page.theme import THEMES, themes
from textmech.reports.selection import choose_cases


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
def test_a_case_is_about(name: str, about: set[str]) -> None:
    (case,) = choose_cases([name])
    assert set(themes(case)) == about


@pytest.mark.whole
def test_every_case_is_about_something_that_has_a_meaning() -> None:
    for case in choose_cases([]):
        assert set(themes(case)) & (set(THEMES) - {"driven", "space"}), case.name
