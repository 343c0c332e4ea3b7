"""A damper whose ends meet: it acts along the way in which they part, and holds nothing still."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.otherwise import otherwise
from scipy.integrate import solve_ivp

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.forces import action
from textmech.reference.solve import solve

D = 2.0  # N s/m
BALL = f"""\
scene:
  gravity: GRAVITY
  points: {{O: [0.3, -0.2]}}
  bodies: {{ball: {{particle: {{mass: 1}}}}}}
  forces: {{oil: {{damper: [ground.O, ball.center], damping: {D}}}MORE}}
initial: {{ball: {{x: 0.3, y: -0.2, vx: 1, vy: 0.5}}}}
allow: {{ball.x: 1.0e-3}}
"""


def ball(folder: Path, gravity: str = "none", more: str = "") -> Case:
    return scenes.typed(folder, BALL.replace("GRAVITY", gravity).replace("MORE", more))


def certified(case: Case) -> Any:
    solution = solve(case)
    assert all(check.holds for check in solution.checks)
    return solution.trajectory


def test_what_parts_along_its_way_is_slowed_as_by_any_drag(tmp_path: Path) -> None:
    case = ball(tmp_path)
    motion = certified(case)
    v = np.outer(np.exp(-D * case.times), [1.0, 0.5])
    assert motion.states["ball"][:, 3:5] == pytest.approx(v, abs=1e-12)
    told = observe(case.scene, motion, "oil.force")
    assert told == pytest.approx(D * np.hypot(*v.T), abs=1e-12)  # and not 0 where they meet


def along(t: float, y: Any) -> list[float]:
    """(2.47) Under gravity, away from where the ends meet: d (u·v) u, u along the line."""
    x, z, vx, vz = y
    size = -D * (x * vx + z * vz) / (x * x + z * z)
    return [vx, vz, size * x, size * z - 9.81]


def test_what_falls_on_turns_the_line(tmp_path: Path) -> None:
    """From a ten-thousandth of a second on by a program that knows no meeting.

    Until then Δ = v t + (g − d v) t²/2, to t³ and so to 1e-12 m.
    """
    case = ball(tmp_path, "9.81")
    motion = certified(case)
    begin, v = 1e-4, np.array([1.0, 0.5])
    a = np.array([0.0, -9.81]) - D * v
    known = np.concatenate([v * begin + a * begin**2 / 2, v + a * begin])
    later = case.times[1:]
    ran = solve_ivp(
        along, (begin, later[-1]), known, t_eval=later, rtol=1e-11, atol=1e-13, method="DOP853"
    )
    places = motion.states["ball"][1:, :2] - [0.3, -0.2]
    assert places == pytest.approx(ran.y[:2].T, abs=1e-6)  # ȧ begin²/2 of a speed: 1e-7 m/s


def test_an_oscillator_passes_its_middle(tmp_path: Path) -> None:
    """m ẍ + d ẋ + c x = 0 in each direction alike: the line is that of the velocity all along."""
    more = ", coil: {spring: [ground.O, ball.center], stiffness: 90, rest_length: 0}"
    case = ball(tmp_path, more=more)
    motion = certified(case)
    w = math.sqrt(90 - D**2 / 4)
    swings = np.exp(-D / 2 * case.times) * np.sin(w * case.times) / w
    assert motion.states["ball"][:, 0] - 0.3 == pytest.approx(swings, abs=1e-10)


def test_ends_that_stay_together_are_not_held(tmp_path: Path) -> None:
    """A bar on a pin whose two points a damper joins falls as it does without."""
    text = """\
scene:
  points: {O: [0.3, 0.1]}
  bodies: {rod: {bar: {mass: 1, length: 1}}}
  joints: {pin: {pin: [ground.O, rod.start]}}
  forces: {oil: {damper: [ground.O, rod.start], damping: 2}}
initial: {rod: {angle: 20 deg}}
allow: {rod.angle: 1.0e-3, oil.force: 1.0e-3}
"""
    case = scenes.typed(tmp_path, text)
    motion = certified(case)
    alone = certified(replace(case, scene=replace(case.scene, forces={}), allow={"rod.angle": 1.0}))
    assert motion.states["rod"] == pytest.approx(alone.states["rod"], abs=1e-12)
    assert observe(case.scene, motion, "oil.force") == pytest.approx(0.0, abs=1e-12)


def test_two_that_lie_together_and_are_drawn_apart(tmp_path: Path) -> None:
    """Their centre moves by the push alone, and what is between them by μ ẍ = F m_b/m − d ẋ."""
    text = f"""\
scene:
  gravity: none
  bodies: {{a: {{particle: {{mass: 1}}}}, b: {{particle: {{mass: 3}}}}}}
  forces:
    oil: {{damper: [a.center, b.center], damping: {D}}}
    pull: {{push: a.center, constant: [3, 4]}}
initial: {{a: {{x: 0.1, y: 0.3, vx: 1, vy: 0}}, b: {{x: 0.1, y: 0.3, vx: 1, vy: 0}}}}
allow: {{a.x: 1.0e-3}}
"""
    case = scenes.typed(tmp_path, text)
    states = certified(case).states
    t, rate = case.times, D / 0.75
    reached = 5.0 / rate  # of each m/s²: F/m_a is 5 m/s², whose way is [0.6, 0.8]
    apart = reached * (t - (1 - np.exp(-rate * t)) / rate)
    assert states["a"][:, :2] - states["b"][:, :2] == pytest.approx(
        np.outer(apart, [0.6, 0.8]), abs=1e-10
    )


def test_a_spring_with_a_length_of_its_own_is_refused_still(tmp_path: Path) -> None:
    """It pushes with all its force, and no way is more its own than another."""
    more = ", coil: {spring: [ground.O, ball.center], stiffness: 90, rest_length: 0.1}"
    with pytest.raises(CaseError, match="coil has no length there"):
        solve(ball(tmp_path, more=more))


@pytest.mark.parametrize(
    ("old", "new"),
    [
        pytest.param(
            "else meeting",
            "else 0.0 * meeting",
            marks=pytest.mark.mutant("a damper whose ends meet does nothing"),
        ),
        pytest.param(
            "zip(d, rate, strict=True)]",
            "zip(d, d, strict=True)]",
            marks=pytest.mark.mutant(
                "a damper whose ends meet acts along its line, which has none"
            ),
        ),
    ],
)
def test_what_it_does_where_its_ends_meet_is_seen(old: str, new: str, tmp_path: Path) -> None:
    case = ball(tmp_path)
    damper = case.scene.forces["oil"]
    start = np.array([0.3, -0.2]), np.array([1.0, 0.5])
    slowed = scenes.mechanism(case).base.accelerations(0.0, *start)
    assert slowed == pytest.approx(-D * start[1])
    planted = otherwise(action, old, new)
    known = action.ACTIONS[type(damper)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(action.ACTIONS, type(damper), planted.Damped)
        assert scenes.mechanism(case).base.accelerations(0.0, *start) != pytest.approx(slowed)
    assert action.ACTIONS[type(damper)] is known
