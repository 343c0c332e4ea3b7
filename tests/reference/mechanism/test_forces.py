"""Springs and dampers whose ends may meet, and what acts about a joint."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.multibody_laws import EXACT, balance, lagrangian
from given.otherwise import otherwise
from given.scenes import torsion
from scipy.integrate import solve_ivp

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.forces import action, turning
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve

THROUGH = (
    "scene: {forces: {coil: {spring: [ground.O, ball.center], stiffness: 50, rest_length: 0}}}"
)
TIMES = np.linspace(0.0, 1.0, 26)


@pytest.mark.parametrize("start", [(0.0, 0.0), (0.3, 0.1), (-0.2, 0.7)])
def test_it_swings_through_its_anchor(start: tuple[float, float]):
    """r = r₀ cos ω t + (v₀/ω) sin ω t, ω² = c/m: through the anchor, or around it."""
    x, y = start
    case = scenes.scene("free_particle", THROUGH, m=2, x=x, y=y, vx=3, vy=1)
    mechanism = scenes.mechanism(case)
    found = follow(mechanism, TIMES).y[:, :2]
    known = np.outer(np.cos(5 * TIMES), start) + np.outer(np.sin(5 * TIMES), [3, 1]) / 5
    np.testing.assert_allclose(found, known, atol=1e-13)


@pytest.mark.slow
def test_a_stiff_one_is_followed():
    """1e8 N/m on 2 kg: fifty swings, each in a thousandth of a second."""
    stiff = THROUGH.replace("stiffness: 50", "stiffness: 1.0e+8")
    mechanism = scenes.mechanism(scenes.scene("free_particle", stiff, m=2, x=0.01))
    times = TIMES / 20
    found = follow(mechanism, times).y[:, 0]
    np.testing.assert_allclose(found, 0.01 * np.cos(np.sqrt(5e7) * times), atol=1e-10)


D = 2.0  # N s/m


def ball(gravity: str = "none", more: str = "") -> Case:
    """A ball that starts where the damper's other end is."""
    oil = f"oil: {{damper: [ground.O, ball.center], damping: {D}}}"
    changes = f"scene: {{gravity: {gravity}, forces: {{{oil}{more}}}}}"
    return scenes.scene("free_particle", changes, vx=1, vy=0.5)


def certified(case: Case) -> Any:
    solution = solve(case)
    assert all(check.holds for check in solution.checks)
    return solution.trajectory


def test_what_parts_along_its_way_is_slowed_as_by_any_drag() -> None:
    case = ball()
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


def test_what_falls_on_turns_the_line() -> None:
    """From a ten-thousandth of a second on by a program that knows no meeting.

    Until then Δ = v t + (g − d v) t²/2, to t³ and so to 1e-12 m.
    """
    case = ball("9.81")
    motion = certified(case)
    begin, v = 1e-4, np.array([1.0, 0.5])
    a = np.array([0.0, -9.81]) - D * v
    known = np.concatenate([v * begin + a * begin**2 / 2, v + a * begin])
    later = case.times[1:]
    ran = solve_ivp(
        along, (begin, later[-1]), known, t_eval=later, rtol=1e-11, atol=1e-13, method="DOP853"
    )
    places = motion.states["ball"][1:, :2]
    assert places == pytest.approx(ran.y[:2].T, abs=1e-6)  # ȧ begin²/2 of a speed: 1e-7 m/s


def test_ends_that_stay_together_are_not_held() -> None:
    """A bar on a pin whose two points a damper joins falls as it does without."""
    oil = """
scene: {forces: {oil: {damper: [ground.O, bar.start], damping: 2}}}
allow: {oil.force: 1.0e-3}
"""
    case = scenes.scene("bar_on_pin", oil, angle=0.35)
    motion = certified(case)
    alone = certified(replace(case, scene=replace(case.scene, forces={}), allow={"bar.angle": 1.0}))
    assert motion.states["bar"] == pytest.approx(alone.states["bar"], abs=1e-12)
    assert observe(case.scene, motion, "oil.force") == pytest.approx(0.0, abs=1e-12)


def test_two_that_lie_together_and_are_drawn_apart() -> None:
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
    case = scenes.parsed(text)
    states = certified(case).states
    t, rate = case.times, D / 0.75
    reached = 5.0 / rate  # of each m/s²: F/m_a is 5 m/s², whose way is [0.6, 0.8]
    apart = reached * (t - (1 - np.exp(-rate * t)) / rate)
    assert states["a"][:, :2] - states["b"][:, :2] == pytest.approx(
        np.outer(apart, [0.6, 0.8]), abs=1e-10
    )


def test_a_spring_with_a_length_of_its_own_is_refused_still() -> None:
    """It pushes with all its force, and no way is more its own than another."""
    more = ", coil: {spring: [ground.O, ball.center], stiffness: 90, rest_length: 0.1}"
    with pytest.raises(CaseError, match="coil has no length there"):
        solve(ball(more=more))


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
def test_what_it_does_where_its_ends_meet_is_seen(old: str, new: str) -> None:
    case = ball()
    damper = case.scene.forces["oil"]
    start = np.zeros(2), np.array([1.0, 0.5])
    slowed = scenes.mechanism(case).base.accelerations(0.0, *start)
    assert slowed == pytest.approx(-D * start[1])
    planted = otherwise(action, old, new)
    known = action.ACTIONS[type(damper)]
    with pytest.MonkeyPatch.context() as patch:
        patch.setitem(action.ACTIONS, type(damper), planted.Damped)
        assert scenes.mechanism(case).base.accelerations(0.0, *start) != pytest.approx(slowed)
    assert action.ACTIONS[type(damper)] is known


def built() -> Multibody:
    return scenes.mechanism(scenes.parsed(torsion.ARM)).base


def violated(mode: Multibody) -> float:
    """(2.60) and (2.51) at the start and at times after it."""
    q, v = mode.start()
    return max(max(lagrangian(mode, t, q, v), balance(mode, t, q, v)) for t in (0.0, 0.7, 1.9))


def test_laws_and_signs() -> None:
    """The second part of the elbow is the rod: its turn on the arm is 70°, and rises by 1 rad/s."""
    mode = built()
    assert violated(mode) < EXACT
    q, v = mode.start()
    t = np.pi / 8  # the sine is at its crest
    weights, turn = mode.applied(t, q, v), np.radians([50.0, 50.0])
    knee, oil, drive = -3.0 * turn[0], -0.12 * 1.0, 1.3
    wire, pull = -9.0 * turn[1], 0.8 * t
    about_elbow = knee + oil + drive
    assert weights[2] == pytest.approx(wire + pull + about_elbow, rel=1e-14)  # of the rod
    assert weights[5] == pytest.approx(-about_elbow, rel=1e-14)  # of the arm


@pytest.mark.mutant("torque of a {law} with the wrong sign")
@pytest.mark.parametrize("law", ["torsion", "torsion_damper"])
def test_a_torque_with_the_wrong_sign_is_seen(law: str, monkeypatch: pytest.MonkeyPatch) -> None:
    sound = getattr(action, law)
    monkeypatch.setattr(action, law, lambda *numbers: -sound(*numbers))
    assert violated(built()) > 1e-3


@pytest.mark.mutant("torque about a joint on one of its parts alone")
def test_a_torque_on_one_part_alone_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    sound = turning.Between.couple
    monkeypatch.setattr(turning.Between, "couple", lambda *given: sound(*given)[1:])
    assert violated(built()) > 1e-3
