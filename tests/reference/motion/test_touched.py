"""What comes to zero and turns back: where rounding says whether it happens, it is refused."""

import math
from pathlib import Path

import mpmath
import pytest
from given import scenes
from given.refused import refused

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.reference import assumptions
from textmech.reference.mechanism.modes import element, mechanism
from textmech.reference.solve import solve

W = math.sqrt(40.0)  # rad/s
WALL = """\
scene:
  gravity: none
  points: {O: [0, 0], hook: [1, 0]}
  planes: {wall: {at: [PLACE, 0], normal: [-1, 0]}}
  bodies: {block: {particle: {mass: 1}}}
  joints: {guide: {slide: [ground.O, block.center], along: [1, 0]}}
  contacts: {touch: {between: [block, ground.wall], friction: 0, restitution: 0.5}}
  forces: {coil: {spring: [block.center, ground.hook], stiffness: 40, rest_length: 1}}
initial: {block: {x: -0.1, vx: 0}}
EVENTS
allow: {block.x: 1.0e-3}
"""
NAMED = "events: {lands: {touch.gap: falls to zero}}"
DRY = """\
scene:
  gravity: none
  points: {O: [0, 0], hook: {at: [0.5, 0], velocity: [U, 0]}}
  bodies: {block: {particle: {mass: 1}}}
  joints:
    guide: {slide: [ground.O, block.center], along: [1, 0],
            dry_friction: {static: STATIC, kinetic: 3.0}}
  forces: {coil: {spring: [block.center, ground.hook], stiffness: 40, rest_length: 0.45}}
initial: {block: {x: 0, vx: 0}}
EVENTS
allow: {block.x: 1.0e-3}
"""
HELD = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {block: {particle: {mass: 1}}}
  joints:
    guide: {slide: [ground.O, block.center], along: [1, 0],
            dry_friction: {static: 3.3, kinetic: 3.0}}
  forces: {push: {push: block.center, sine: {amplitude: [MOST, 0], angular_frequency: 3}}}
initial: {block: {x: 0, vx: 0}}
allow: {block.x: 1.0e-3}
"""
RESTS = "events: {rests: {guide.slip: stays zero}}"


def wall(tmp_path: Path, deep: float, samples: int, events: str = NAMED) -> Case:
    """A block that swings out by 0.1 m, with a wall so deep [m] in its way."""
    text = WALL.replace("PLACE", repr(0.1 - deep)).replace("EVENTS", events)
    return scenes.typed(tmp_path, text, tail=scenes.tail(1.5 * math.pi / W, samples))


@pytest.mark.slow
@pytest.mark.parametrize("samples", [4, 101])
@pytest.mark.parametrize("deep", [1e-7, 1e-11])
def test_what_is_struck_is_struck_at_any_samples(tmp_path: Path, deep: float, samples: int) -> None:
    """x = −0.1 cos ω t strikes with v, and x = w cos ω τ − ½ (v/ω) sin ω τ afterwards."""
    found = solve(wall(tmp_path, deep, samples))
    with mpmath.workdps(40):
        omega, w, end = mpmath.sqrt(40), mpmath.mpf(0.1 - deep), mpmath.mpf(1.5 * math.pi / W)
        strikes = mpmath.acos(-w / mpmath.mpf(0.1)) / omega
        fast = mpmath.sin(omega * strikes) / 10
        tau = omega * (end - strikes)
        x = float(w * mpmath.cos(tau) - fast * mpmath.sin(tau) / 2)
    (stated,) = (c.certified for c in found.checks if c.name == "error of block.x")
    assert found.holds
    assert found.trajectory.switches.tolist() == pytest.approx([float(strikes)], abs=1e-10)
    assert stated is not None
    assert abs(found.trajectory.states["block"][-1, 0] - x) <= 2 * stated


@pytest.mark.slow
@pytest.mark.parametrize("samples", [4, 101])
@pytest.mark.parametrize("deep", [1e-15, 0.0])
@pytest.mark.parametrize("events", ["", NAMED])
def test_what_only_just_reaches_a_wall_is_refused(
    tmp_path: Path, deep: float, samples: int, events: str
) -> None:
    """At 1e-15 m it has 1e-7 m/s: by half of that its motion is another, struck or not."""
    mistake = refused(wall(tmp_path, deep, samples, events))
    assert mistake.where == "scene.contacts.touch"
    assert "whether touch lands at t = 0.496729 s is rounding" in mistake.what


@pytest.mark.slow
@pytest.mark.mutant("what only just reaches a wall taken for what does not")
def test_a_wall_that_is_only_just_reached_and_passed_over_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(assumptions, "_grazes", lambda case, touched: [])
    assert solve(wall(tmp_path, 1e-15, 4)).holds
    with pytest.raises(pytest.fail.Exception):
        test_what_only_just_reaches_a_wall_is_refused(tmp_path, 1e-15, 4, NAMED)


def dry(tmp_path: Path, dip: float, samples: int, events: str) -> Case:
    """A block on a spring that is pulled, whose slip dips below zero by so much of its rate u.

    v = u (1 − cos ω τ) + a ω sin ω τ with a = (F_s − F)/c: down to −(a ω)²/(2 u) before ω τ = 2 π.
    """
    u = 0.14
    static = 3.0 + 40.0 * u / W * math.sqrt(2 * dip)
    begins = (static - 40.0 * 0.05) / 40.0 / u
    text = DRY.replace("STATIC", repr(static)).replace("U", repr(u)).replace("EVENTS", events)
    return scenes.typed(tmp_path, text, tail=scenes.tail(begins + 7.0 / W, samples))


@pytest.mark.slow
@pytest.mark.parametrize("samples", [9, 78])
def test_a_stop_that_rounding_hides_is_not_counted(tmp_path: Path, samples: int) -> None:
    for events in ("", RESTS):
        mistake = refused(dry(tmp_path, 1e-15, samples, events))
        assert mistake.where == "scene.joints.guide"
        assert "whether guide stops at t = " in mistake.what


@pytest.mark.slow
@pytest.mark.parametrize("samples", [9, 78])
def test_where_static_friction_is_kinetic_a_touch_is_only_a_question(
    tmp_path: Path, samples: int
) -> None:
    """It goes on at once, stopped or not, and whether it stops is asked or is not."""
    assert solve(dry(tmp_path, 0.0, samples, "")).holds
    mistake = refused(dry(tmp_path, 0.0, samples, RESTS))
    assert mistake.where == "events.rests"


@pytest.mark.slow
@pytest.mark.parametrize("samples", [9, 78])
def test_a_stop_as_short_as_it_can_be_told_is_counted(tmp_path: Path, samples: int) -> None:
    found = solve(dry(tmp_path, 1e-7, samples, RESTS))
    assert found.holds
    assert len(found.trajectory.switches) == 3  # it slips, rests and slips again


def held(tmp_path: Path, excess: float, samples: int) -> Case:
    """A block that a sine pushes, at its most by so much of what holds it more than that."""
    text = HELD.replace("MOST", repr(3.3 * (1 + excess)))
    return scenes.typed(tmp_path, text, tail=scenes.tail(1.5, samples))


@pytest.mark.slow
@pytest.mark.parametrize("samples", [4, 26])
@pytest.mark.parametrize("excess", [0.0, 1e-14])
def test_what_is_pushed_to_just_what_holds_it_is_refused(
    tmp_path: Path, excess: float, samples: int
) -> None:
    """It rests, or slips by 4.6 mm."""
    mistake = refused(held(tmp_path, excess, samples))
    assert mistake.where == "scene.joints.guide"
    assert "whether guide slips at t = 0.523599 s is rounding" in mistake.what


@pytest.mark.slow
@pytest.mark.parametrize("samples", [4, 26])
def test_what_is_pushed_a_little_harder_slips(tmp_path: Path, samples: int) -> None:
    found = solve(held(tmp_path, 1e-9, samples))
    assert found.holds
    assert len(found.trajectory.switches) == 2
    assert found.trajectory.states["block"][-1, 0] == pytest.approx(4.6318980e-3, rel=1e-7)


@pytest.mark.slow
@pytest.mark.mutant("a push that only just holds taken for one that holds")
def test_a_push_that_only_just_holds_and_is_passed_over_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(element.Sliding, "yields", False)
    with pytest.raises(AssertionError):  # it rests, it says then
        test_what_is_pushed_to_just_what_holds_it_is_refused(tmp_path, 1e-14, 26)


# Without gravity a block flies along beside a plane that is turned by 2.5 rad, and touches it.
BESIDE = """\
scene:
  gravity: none
  planes: {wall: {at: [0, 0], normal: [-0.5984721441039565, -0.8011436155469337]}}
  bodies: {block: {block: {mass: 2, width: 0.8, height: 0.4}}}
  contacts:
    l: {between: [block.lower_left, ground.wall], friction: 0}
    r: {between: [block.lower_right, ground.wall], friction: 0}
initial:
  block: {x: -2.2827821907975125, y: 1.4556460659712962, angle: 2.5,
          vx: -1.1135896256102378, vy: 0.8318762803044996}
allow: {block.x: 1.0e-3}
"""


def beside(folder: Path, samples: int) -> Case:
    return scenes.typed(folder, BESIDE, tail=scenes.tail(2.0, samples))


@pytest.mark.slow
@pytest.mark.parametrize("samples", [3, 5, 41])
def test_what_flies_along_a_plane_without_a_force_neither_lands_nor_touches(
    tmp_path: Path, samples: int
) -> None:
    solution = solve(beside(tmp_path, samples))
    assert solution.holds
    assert len(solution.trajectory.switches) == 0


@pytest.mark.slow
@pytest.mark.mutant("a gap of rounding all along taken for one that comes to zero and turns back")
def test_a_gap_of_rounding_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mechanism, "ROUNDS", 0.0)
    case = beside(tmp_path, 5)
    with pytest.raises(CaseError, match=r"is rounding|evaluations and needs"):
        solve(case)
