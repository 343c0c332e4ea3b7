"""Ropes in the generated mechanism: impacts against momenta worked out here, and bad starts."""

import math
from pathlib import Path

import numpy as np
import pytest
from given import ropes, scenes

from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.modes import unilateral
from textmech.reference.solve import Solution, solve

END = scenes.tail(1.0, 26)


def solved(tmp_path: Path, text: str) -> Solution:
    found = solve(scenes.typed(tmp_path, text, tail=END))
    assert found.holds
    return found


@pytest.mark.slow
def test_two_balls_thrown_apart_go_on_about_their_centre(tmp_path: Path) -> None:
    """What is left along the rope is the centre's velocity; across it each keeps its own."""
    case = scenes.typed(tmp_path, ropes.PAIR, tail=END)
    motion = solve(case).trajectory
    # (½ + 2 t)² + ¼ t² = 1, both in m, the one seen from the other
    t = (-2 + math.sqrt(4 + 4 * 4.25 * 0.75)) / (2 * 4.25)
    assert motion.switches.tolist() == pytest.approx([t], abs=1e-13)
    n = np.array([0.5 + 2 * t, -0.5 * t])
    lost = 2 / 3 * float(n @ (2.0, -0.5)) * n  # the impulse, by the reduced mass of 2/3 kg
    after = {"one": np.array([-1.0, 0.5]) + lost, "two": np.array([1.0, 0.0]) - lost / 2}
    apart = after["two"] - after["one"]
    omega = (n[0] * apart[1] - n[1] * apart[0]) / 1.0**2
    force = observe(case.scene, motion, "rope.force")[-1]
    assert force == pytest.approx(2 / 3 * omega**2, abs=1e-12)  # m ω² L, of the reduced mass
    centre = (after["one"] + 2 * after["two"]) / 3
    end = (motion.states["one"][-1] + 2 * motion.states["two"][-1]) / 3
    assert end[3:5] == pytest.approx(centre, abs=1e-13)


@pytest.mark.slow
def test_a_bar_is_stopped_at_once(tmp_path: Path) -> None:
    """Pin and rope leave it nothing; the rope's moment about the pin is the weight's."""
    case = scenes.typed(tmp_path, ropes.HELD, tail=END)
    motion = solve(case).trajectory
    (x, _, angle, *rates), force = motion.states["bar"][-1], motion.reactions["rope.force"][-1]
    assert rates == pytest.approx([0.0, 0.0, 0.0], abs=1e-12)
    end = 0.8 * np.array([math.cos(angle), math.sin(angle)])
    pull = (np.array([0.0, 0.5]) - end) / 1.1
    moment = force * float(end[0] * pull[1] - end[1] * pull[0])
    assert moment == pytest.approx(9.80665 * x, abs=1e-12)
    assert np.linalg.norm(end - (0.0, 0.5)) == pytest.approx(1.1, abs=1e-12)


@pytest.mark.slow
def test_a_hook_that_moves_takes_along_what_it_catches(tmp_path: Path) -> None:
    """Along the rope its end then has the hook's velocity; the rope slackens, and it drifts on."""
    case = scenes.typed(tmp_path, ropes.TOWED, tail=END)
    motion = solve(case).trajectory
    (t,) = motion.switches
    n = np.array([0.5 * t, -0.2]) / 0.3  # to the hook, from the end 0.2 m above where it began
    lever = -0.4 * n[0]  # r × n, r = (0, 0.4)
    impulse = 0.5 * n[0] / (1 / 1.0 + lever**2 / (1.0 * 0.8**2 / 12))
    known = [*(impulse * n), impulse * lever / (1.0 * 0.8**2 / 12)]
    assert motion.states["sled"][-1, 3:] == pytest.approx(known, abs=1e-12)


@pytest.mark.slow
def test_every_scene_is_certified(tmp_path: Path) -> None:
    for text in ropes.EVERY.values():
        solved(tmp_path, text)


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        ("x: 0.5, y: 0,", "x: 1.2, y: 0,", "rope starts 200 mm longer than it is"),
        ("x: 0.5, y: 0,", "x: 1.0, y: 0,", "rope starts taut, and with its ends parting by 2 m/s"),
    ],
)
def test_starts_that_no_rope_allows(tmp_path: Path, old: str, new: str, what: str) -> None:
    with pytest.raises(CaseError) as told:
        solve(scenes.typed(tmp_path, ropes.PAIR.replace(old, new), tail=END))
    (mistake,) = told.value.mistakes
    assert mistake.where == "initial"
    assert mistake.what == what


@pytest.mark.slow
def test_a_taut_rope_that_need_not_pull_begins_slack(tmp_path: Path) -> None:
    """Its ends neither part nor near: what pushes them together leaves it slack."""
    pushed = ropes.PAIR.replace("vx: -1.0, vy: 0.5", "vx: 0, vy: 0").replace("vx: 1.0", "vx: 0")
    pushed = (
        pushed.replace("x: 0.5", "x: 1.0")
        .replace("length: 1.0}}", "length: 1.0}, hand: {push: one.center, constant: [1, 0]}}")
        .replace(", two.y: 1.0e-2", "")
    )
    found = solved(tmp_path, pushed)
    assert np.all(found.trajectory.reactions["rope.force"] == 0.0)


@pytest.mark.slow
@pytest.mark.mutant("a rope that throws back what it catches")
def test_an_impact_that_throws_back_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A planted restitution: the hand-written ball swings on, and this one comes back."""
    made = unilateral.Roped.__init__
    monkeypatch.setattr(
        unilateral.Roped, "__init__", lambda self, **given: made(self, **given, restitution=0.5)
    )
    assert not solve(scenes.SHIPPED["ball_on_rope.caught"]).holds


@pytest.mark.slow
@pytest.mark.mutant("a limit that nothing keeps, taken for the end of the motion")
def test_a_rope_and_a_stop_that_strike_in_turn_pile_up(tmp_path: Path) -> None:
    """While the bar still flies to its stop the rope's blows have no limit to go on from.

    They are refused where rounding no longer tells which of both strikes; with a limit taken for
    one they go on to a blow of the rope.
    """
    text = """\
scene:
  points: {O: [0, 1.2]}
  bodies: {bar: {bar: {mass: 1.1, length: 0.32}}, p: {particle: {mass: 2.8}}}
  joints: {hinge: {pin: [ground.O, bar.start]}}
  forces:
    R: {rope: [bar.end, p.center], length: 0.196}
    E: {stops: hinge, low: -0.1, high: 0.24, restitution: 0.8}
initial: {bar: {angle: -0.02, omega: -2.92}, p: {x: 0.239, y: 1.09, vx: 0.65, vy: -0.78}}
allow: {bar.angle: 1.0e-1, p.x: 1.0e-1, p.y: 1.0e-1}
"""
    assert solve(scenes.typed(tmp_path, text, tail=scenes.tail(0.09, 10))).holds
    with pytest.raises(
        CaseError, match=r"E\.low strikes at t = 0.09722 s what R touches and passes on"
    ):
        solve(scenes.typed(tmp_path, text, tail=scenes.tail(0.52, 27)))


@pytest.mark.slow
def test_a_rope_that_is_let_go_is_not_taut_at_once(tmp_path: Path) -> None:
    """A bar rocks under two ropes, ever faster; between two blows one is slack for some 10 us.

    Its gap is no more than rounding at first, which is no end of it.
    """
    text = """\
scene:
  points: {A: [-0.204, 1.0], B: [0.183, 1.0]}
  bodies:
    b: {rigid: {mass: 1.4, inertia: 0.2834}, points: {L: [-0.324, 0.082], R: [0.303, 0.082]}}
  forces:
    l: {rope: [ground.A, b.L], length: 0.5142}
    r: {rope: [ground.B, b.R], length: 0.5142}
initial: {b: {x: 0, y: 0.445, angle: -0.021, vx: 0.34, vy: 0.23, omega: -0.13}}
allow: {b.x: 1.0e-2, b.y: 1.0e-2, b.angle: 1.0e-2}
"""
    for samples in (19, 31, 39):
        motion = solve(scenes.typed(tmp_path, text, tail=scenes.tail(0.76, samples)))
        assert motion.holds
        before, last = motion.trajectory.switches[-2:]
        assert 1e-7 < last - before < 1e-5
