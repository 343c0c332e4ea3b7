"""What the answers to public questions say in a formula, the certified motion does."""

from math import pi, tan
from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.cases.case import Case
from textmech.cases.find import questions
from textmech.cases.load import load
from textmech.reference.solve import solve

G = 9.80665  # m/s²
EXACT = 1e-9  # both are closed forms: rounding, and what an integrator leaves


def test_a_belt_carries_what_has_slipped_for_its_speed_over_the_friction() -> None:
    p = scenes.EVERY["moving_belt"].parameters
    motion = scenes.solved("moving_belt").trajectory
    after = p["v"] / (p["mu"] * G)
    assert motion.switches == pytest.approx([after], rel=EXACT)
    x, *_, vx, _, _ = motion.states["parcel"][-1]
    assert vx == pytest.approx(p["v"], rel=EXACT)
    assert x == pytest.approx(p["v"] * (motion.times[-1] - after / 2), rel=EXACT)


def test_a_ball_thrown_without_spin_rolls_at_five_sevenths_of_its_speed() -> None:
    case = scenes.EVERY["bowling_ball"]
    p = case.parameters
    assert p["J"] == pytest.approx(2 / 5 * p["m"] * p["R"] ** 2, rel=EXACT)
    motion = scenes.solved("bowling_ball").trajectory
    assert motion.switches == pytest.approx([2 * p["v0"] / (7 * p["mu"] * G)], rel=EXACT)
    *_, vx, _, omega = motion.states["ball"][-1]
    assert vx == pytest.approx(5 / 7 * p["v0"], rel=EXACT)
    assert omega == pytest.approx(-vx / p["R"], rel=EXACT)


def ladder(mu: float, tmp_path: Path) -> Case:
    """The ladder that slides, with another friction at its foot."""
    path = tmp_path / "ladder.yaml"
    text = questions()["leaning_ladder"].read_text(encoding="utf-8")
    assert text.count("below: {parameters: {mu: 0.27}}") == 1
    rests = ", rests: true" if mu > LEAST else ""
    text = text.replace(
        "below: {parameters: {mu: 0.27}}", f"below: {{parameters: {{mu: {mu}}}{rests}}}"
    )
    path.write_text(text, encoding="utf-8")
    return load(path)[1]


LEAST = 1 / tan(pi / 3) / 2  # half the cotangent of 60 deg


@pytest.mark.parametrize(("mu", "moves"), [(LEAST * (1 - 1e-3), True), (LEAST * (1 + 1e-3), False)])
def test_a_ladder_needs_half_the_cotangent_of_its_slope(
    mu: float, moves: bool, tmp_path: Path
) -> None:
    foot = solve(ladder(mu, tmp_path)).trajectory.states["ladder"][:, 0]
    assert (np.ptp(foot) > 1e-4) == moves  # m


def test_a_pendulum_in_pixels_swings_as_in_metres() -> None:
    metres, pixels = (
        scenes.solved(f"pendulum_in_pixels.{unit}").trajectory.states["bar"]
        for unit in ("metres", "pixels")
    )
    assert pixels[:, 2] == pytest.approx(metres[:, 2], abs=1e-9)  # rad
    assert pixels[:, :2] == pytest.approx(100 * metres[:, :2], abs=1e-7)  # px
