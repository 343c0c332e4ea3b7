"""What comes to zero and turns back: where rounding says whether it happens, it is refused."""

import math

import mpmath
import pytest
from given.laws.certified import stated
from given.laws.refused import refused
from given.scenes import parsed, scene, tail

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.reference import assumptions
from textmech.reference.mechanism.modes import element, mechanism
from textmech.reference.solve import solve

Patch = pytest.MonkeyPatch
W = math.sqrt(40.0)  # rad/s
NAMED = "events: {lands: {touch.gap: falls to zero}}\n"
RESTS = "events: {rests: {guide.slip: stays zero}}\n"


def until(end: float, samples: int) -> str:
    return f"duration: {end!r}\nsamples: {samples}\n"


def wall(deep: float, samples: int, events: str = NAMED) -> Case:
    """A block that swings out by 0.1 m, with a wall so deep [m] in its way."""
    text = f"""\
scene:
  gravity: none
  points: {{O: [0, 0], hook: [1, 0]}}
  planes: {{wall: {{at: [{0.1 - deep!r}, 0], normal: [-1, 0]}}}}
  bodies: {{block: {{particle: {{mass: 1}}}}}}
  joints: {{guide: {{slide: [ground.O, block.center], along: [1, 0]}}}}
  contacts: {{touch: {{between: [block, ground.wall], friction: 0, restitution: 0.5}}}}
  forces: {{coil: {{spring: [block.center, ground.hook], stiffness: 40, rest_length: 1}}}}
initial: {{block: {{x: -0.1, vx: 0}}}}
{events}allow: {{block.x: 1.0e-3}}
"""
    return parsed(text, tail=tail(1.5 * math.pi / W, samples))


@pytest.mark.slow
@pytest.mark.parametrize(("deep", "samples"), [(1e-7, 4), (1e-11, 101)])
def test_what_is_struck_is_struck_at_any_samples(deep: float, samples: int) -> None:
    """x = −0.1 cos ω t strikes with v, and x = w cos ω τ − ½ (v/ω) sin ω τ afterwards."""
    found = solve(wall(deep, samples))
    with mpmath.workdps(40):
        omega, w, end = mpmath.sqrt(40), mpmath.mpf(0.1 - deep), mpmath.mpf(1.5 * math.pi / W)
        strikes = mpmath.acos(-w / mpmath.mpf(0.1)) / omega
        fast = mpmath.sin(omega * strikes) / 10
        tau = omega * (end - strikes)
        x = float(w * mpmath.cos(tau) - fast * mpmath.sin(tau) / 2)
    assert found.holds
    assert found.trajectory.switches.tolist() == pytest.approx([float(strikes)], abs=1e-10)
    assert abs(found.trajectory.states["block"][-1, 0] - x) <= 2 * stated(found)["block.x"]


@pytest.mark.slow
@pytest.mark.mutant("what only just reaches a wall taken for what does not")
@pytest.mark.parametrize(
    ("deep", "samples", "events"), [(1e-15, 4, ""), (1e-15, 101, NAMED), (0.0, 4, NAMED)]
)
def test_what_only_just_reaches_a_wall_is_refused(
    deep: float, samples: int, events: str, monkeypatch: Patch
) -> None:
    """At 1e-15 m it has 1e-7 m/s: by half of that its motion is another, struck or not."""
    mistake = refused(wall(deep, samples, events))
    assert mistake.where == "scene.contacts.touch"
    assert "whether touch lands at t = 0.496729 s is rounding" in mistake.what
    monkeypatch.setattr(assumptions, "_grazes", lambda case, touched: [])
    if samples == 4:
        assert solve(wall(1e-15, samples)).holds


def dry(dip: float, samples: int, events: str) -> Case:
    """A block on a spring that is pulled, whose slip dips below zero by so much of its rate u.

    v = u (1 − cos ω τ) + a ω sin ω τ with a = (F_s − F)/c: down to −(a ω)²/(2 u) before ω τ = 2 π.
    """
    u = 0.14
    static = 3.0 + 40.0 * u / W * math.sqrt(2 * dip)
    begins = (static - 40.0 * 0.05) / 40.0 / u
    text = f"""\
scene:
  points: {{hook: {{at: [0.5, 0], velocity: [{u}, 0]}}}}
  forces: {{coil: {{spring: [block.center, ground.hook], stiffness: 40, rest_length: 0.45}}}}
{events}{until(begins + 7.0 / W, samples)}"""
    return scene("dry_slide", text, static=static)


@pytest.mark.slow
@pytest.mark.parametrize("samples", [9, 78])
def test_a_stop_that_rounding_hides_is_not_counted(samples: int) -> None:
    """Where static friction is kinetic friction, a touch is only a question.

    There it goes on at once, stopped or not, and whether it stops is asked or is not.
    """
    for events in ("", RESTS):
        mistake = refused(dry(1e-15, samples, events))
        assert mistake.where == "scene.joints.guide"
        assert "whether guide stops at t = " in mistake.what
    assert solve(dry(0.0, samples, "")).holds
    assert refused(dry(0.0, samples, RESTS)).where == "events.rests"


@pytest.mark.slow
def test_a_stop_as_short_as_it_can_be_told_is_counted() -> None:
    found = solve(dry(1e-7, 9, RESTS))
    assert found.holds
    assert len(found.trajectory.switches) == 3  # it slips, rests and slips again


def held(excess: float, samples: int) -> Case:
    """A block that a sine pushes, at its most by so much of what holds it more than that."""
    push = f"sine: {{amplitude: [{3.3 * (1 + excess)!r}, 0], angular_frequency: 3}}"
    text = f"scene: {{forces: {{push: {{push: block.center, {push}}}}}}}\n{until(1.5, samples)}"
    return scene("dry_slide", text, static=3.3)


@pytest.mark.slow
@pytest.mark.mutant("a push that only just holds taken for one that holds")
@pytest.mark.parametrize(("excess", "samples"), [(0.0, 4), (1e-14, 26)])
def test_what_is_pushed_to_just_what_holds_it_is_refused(
    excess: float, samples: int, monkeypatch: Patch
) -> None:
    """It rests, or slips by 4.6 mm."""
    mistake = refused(held(excess, samples))
    assert mistake.where == "scene.joints.guide"
    assert "whether guide slips at t = 0.523599 s is rounding" in mistake.what
    monkeypatch.setattr(element.Sliding, "yields", False)  # it rests, it says then
    with pytest.raises(AssertionError):
        assert refused(held(excess, samples)) == mistake


@pytest.mark.slow
def test_what_is_pushed_a_little_harder_slips() -> None:
    found = solve(held(1e-9, 4))
    assert found.holds
    assert len(found.trajectory.switches) == 2
    assert found.trajectory.states["block"][-1, 0] == pytest.approx(4.6318980e-3, rel=1e-7)


BESIDE = """\
scene:
  gravity: none
  planes: {{wall: {{at: [0, 0], normal: [-{sin!r}, {cos!r}]}}}}
  bodies: {{block: {{block: {{mass: 2, width: 0.8, height: 0.4}}}}}}
  contacts:
    l: {{between: [block.lower_left, ground.wall], friction: 0}}
    r: {{between: [block.lower_right, ground.wall], friction: 0}}
initial: {{block: {{x: {x!r}, y: {y!r}, angle: {turn!r}, vx: {cos!r}, vy: {sin!r}}}}}
allow: {{block.x: 1.0e-3}}
"""
TURNS = (0.1, 0.5, 0.7, 0.9)  # rad: in which of them rounding lets a corner land is the processor's


def beside(turn: float, samples: int) -> Case:
    """A block that flies along a turned plane, which it touches all along."""
    cos, sin = math.cos(turn), math.sin(turn)
    x, y = 2.7 * cos - 0.2 * sin, 2.7 * sin + 0.2 * cos
    return parsed(BESIDE.format(turn=turn, cos=cos, sin=sin, x=x, y=y), tail=tail(2.0, samples))


def fly_beside(samples: int) -> None:
    for turn in TURNS:
        solution = solve(beside(turn, samples))
        assert solution.holds
        assert len(solution.trajectory.switches) == 0


@pytest.mark.slow
@pytest.mark.mutant("a gap of rounding all along taken for one that comes to zero and turns back")
def test_what_flies_along_a_plane_without_a_force_neither_lands_nor_touches(
    monkeypatch: Patch,
) -> None:
    for samples in (3, 41):
        fly_beside(samples)
    monkeypatch.setattr(mechanism, "ROUNDS", 0.0)
    with pytest.raises(CaseError, match=r"is rounding|evaluations and needs|of what it was"):
        fly_beside(5)
