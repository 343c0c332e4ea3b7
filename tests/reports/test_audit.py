"""The audit: whether an engine has the numbers of the scene."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from textmech.cases.case import Case
from textmech.cases.scene import (
    Anchor,
    Body,
    Bounds,
    Contact,
    DryFriction,
    GroundPoint,
    Scene,
    planar_joint,
)
from textmech.cases.trajectory import Trajectory
from textmech.reports.compare.judge.compare import Outcome, compare
from textmech.reports.compare.trial.audit import expected
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.data.row import AGREES, FAILS

Make = Callable[..., Trial]


def row(outcome: Outcome, quantity: str = "ball.x") -> Any:
    return next(row for row in outcome.rows if row.quantity == quantity)


@pytest.mark.mutant("an engine with {number} kg for 2 kg")
@pytest.mark.parametrize("number", [2.1, 2.0 + 1e-11, float("nan")])
def test_the_audit_sees_other_physics(trial: Make, number: float) -> None:
    assert row(compare(trial()), "audit").verdict == AGREES
    found = row(compare(trial(numbers={"ball.mass": number})), "audit")
    assert found.verdict == FAILS
    assert "ball.mass" in found.because


@pytest.mark.parametrize("late", [-9.81, 0.0, 1e300])
def test_a_number_that_is_none_stays_the_worst(trial: Make, late: float) -> None:
    """What is read after it, good or bad, does not take its place."""
    numbers = {"ball.mass": 2.1, "gravity.x": float("nan"), "gravity.y": late}
    found = row(compare(trial(numbers=numbers)), "audit")
    assert (found.verdict, found.error) == (FAILS, np.inf)
    assert "gravity.x is nan" in found.because


def test_a_small_number_is_compared_with_itself(trial: Make, moving: Case) -> None:
    """5 % off a nanogram is 5 %, whatever the scale of the rest."""
    light = replace(moving.scene.bodies["ball"], mass=1e-12)
    case = replace(moving, scene=replace(moving.scene, bodies={"ball": light}))
    found = row(compare(trial(case=case, numbers={"ball.mass": 1.05e-12})), "audit")
    assert (found.verdict, found.error) == (FAILS, pytest.approx(0.05))


def test_rounding_is_no_number_of_the_audit(trial: Make) -> None:
    """The last bit of a product is another one on another machine."""
    found = row(compare(trial(numbers={"ball.mass": 2.0 + 4e-16})), "audit")
    assert (found.verdict, found.error, found.because) == (AGREES, 0.0, "1 numbers read back")


def test_the_audit_reads_dry_friction_back() -> None:
    friction = DryFriction(static=Bounds(6.0, 7.0), kinetic=Bounds(3.0, 4.0))
    box = Body("box", "particle", 1.0, (), {"center": (0.0, 0.0)})
    rail = planar_joint("rail", "slide", Anchor("ground", "O"), Anchor("box", "center"))
    scene = Scene(
        (0.0, 0.0),
        {"O": GroundPoint((0.0, 0.0))},
        {"box": box},
        {"rail": replace(rail, dry_friction=friction)},
        {"touch": Contact("touch", Anchor("box", "center"), 0.5, 0.4)},
        {},
    )
    start = Trajectory(np.zeros(1), {"box": np.zeros((1, 6))}, {})
    numbers = expected(scene, start)
    assert (numbers["rail.friction_forward"], numbers["rail.friction_backward"]) == (3.0, 4.0)
    assert numbers["touch.friction"] == 0.4
