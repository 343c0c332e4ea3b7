"""Starts by a distance and a direction from a point of the ground."""

import math
from pathlib import Path

import pytest
from given import scenes

from textmech.reference.solve import solve

HELD = """\
scene:
  gravity: none
  points: {O: [0.3, -0.2], Q: {at: [1, 2], velocity: [0.5, 0]}}
  bodies: {rod: {bar: {mass: 1.5, length: 0.6}}}
initial: {rod: {from: ground.POINT, length: 50 cm, direction: 210 deg, angle: 1.0, vx: 1, vy: 0}}
allow: {rod.x: 1.0e-3}
"""


@pytest.mark.parametrize(("point", "at"), [("O", (0.3, -0.2)), ("Q", (1.0, 2.0))])
def test_the_centre_is_so_far_in_that_direction(
    tmp_path: Path, point: str, at: tuple[float, float]
) -> None:
    """Of a driven point, from where it starts."""
    case = scenes.typed(tmp_path, HELD.replace("POINT", point))
    given = case.initial["rod"].given
    assert given["x"] == pytest.approx(at[0] + 0.5 * math.cos(math.radians(210)), abs=1e-15)
    assert given["y"] == pytest.approx(at[1] + 0.5 * math.sin(math.radians(210)), abs=1e-15)
    assert {key: given[key] for key in ("angle", "vx", "vy")} == {"angle": 1.0, "vx": 1.0, "vy": 0}
    assert not {"from", "length", "direction"} & given.keys()


def test_it_starts_there(tmp_path: Path) -> None:
    x, y, angle, *_ = solve(scenes.typed(tmp_path, HELD.replace("POINT", "O"))).trajectory.states[
        "rod"
    ][0]
    assert (x - 0.3, y + 0.2) == pytest.approx((-0.25 * math.sqrt(3), -0.25), abs=1e-15)
    assert angle == 1.0
