"""Starts by a distance and a direction from a point of the ground."""

import math
from pathlib import Path

import pytest
from given import scenes

from textmech.cases.case import Case
from textmech.cases.scene.point import GroundPoint
from textmech.reference.solve import solve

HELD = """\
scene:
  gravity: none
  points:
    O: [0.3, -0.2]
    Q: {at: [1, 2], velocity: [0.5, 0]}
    S: {at: [1, 2], moves: {sine: {amplitude: [0.2, -0.4], angular_frequency: 4, phase: 30 deg}}}
    R: {at: [1, 2], moves: {ramp: [0.2, 0.3]}}
    C: {at: [1, 2], moves: {polynomial: {along: [0.6, 0.8], coefficients: [0.5, 0.1]}}}
  bodies: {rod: {bar: {mass: 1.5, length: 0.6}}}
initial: {rod: {from: ground.POINT, length: 50 cm, direction: 210 deg, angle: 1.0, vx: 1, vy: 0}}
allow: {rod.x: 1.0e-3}
"""


STARTS = {
    "O": (0.3, -0.2), "Q": (1.0, 2.0), "S": (1.1, 1.8), "R": (1.0, 2.0), "C": (1.3, 2.4),
}  # fmt: skip


def off(case: Case, at: tuple[float, float]) -> float:
    """How far [m] the start is from where it should be, for a point that starts there."""
    given, way = case.initial["rod"].given, math.radians(210)
    return math.hypot(
        given["x"] - at[0] - 0.5 * math.cos(way), given["y"] - at[1] - 0.5 * math.sin(way)
    )


@pytest.mark.parametrize(("point", "at"), STARTS.items())
def test_the_centre_is_so_far_in_that_direction(
    tmp_path: Path, point: str, at: tuple[float, float]
) -> None:
    """Of a driven point, from where it starts: that of a sine with a phase is not `at`."""
    case = scenes.typed(tmp_path, HELD.replace("POINT", point))
    given = case.initial["rod"].given
    assert off(case, at) < 1e-15
    assert {key: given[key] for key in ("angle", "vx", "vy")} == {"angle": 1.0, "vx": 1.0, "vy": 0}
    assert not {"from", "length", "direction"} & given.keys()


@pytest.mark.mutant("a polar start counted from `at` of a point that moves")
@pytest.mark.parametrize("point", ["S", "C"])
def test_a_start_from_at_is_seen(
    point: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(GroundPoint, "state", lambda self, t: (*self.at, *self.velocity))
    assert off(scenes.typed(tmp_path, HELD.replace("POINT", point)), STARTS[point]) > 0.1


def test_it_starts_there(tmp_path: Path) -> None:
    x, y, angle, *_ = solve(scenes.typed(tmp_path, HELD.replace("POINT", "O"))).trajectory.states[
        "rod"
    ][0]
    assert (x - 0.3, y + 0.2) == pytest.approx((-0.25 * math.sqrt(3), -0.25), abs=1e-15)
    assert angle == 1.0
