"""Motions of picoseconds and microseconds: an instant is as small a part of them as of a second."""

import numpy as np
import pytest
from given.laws.certified import broken, stated
from given.scenes import parsed, scene

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.reference import system
from textmech.reference.formalisms import lagrange
from textmech.reference.motion import event_location, follow
from textmech.reference.solve import solve

Patch = pytest.MonkeyPatch


def short(duration: float) -> str:
    return f"duration: {duration}\nsamples: 11\n"


def falling(height: float, time: float, kept: float, duration: float) -> Case:
    """What falls that high in that time, and keeps so much of its speed."""
    text = f"""\
scene:
  gravity: {2 * height / time**2:.17g}
  bodies: {{b: {{particle: {{mass: 1.0e-20}}}}}}
  contacts: {{c: {{between: [b, ground.floor], friction: 0.0, restitution: {kept:.17g}}}}}
initial: {{b: {{x: 0, y: {height:.17g}, vx: 0, vy: 0}}}}
events: {{lands: {{c.gap: falls to zero}}}}
allow: {{b.y: 1.0e-5, b.vy: 10.0}}
"""
    return parsed(text, tail=short(duration))


@pytest.mark.slow
@pytest.mark.mutant("what happens within a picosecond behind the last sample is its, however short")
def test_what_would_stop_after_the_end_has_not_stopped(monkeypatch: Patch) -> None:
    """v = 100 − 2e14 t m/s, which is 20 m/s after 0.4 ps."""
    parameters = {"m": 1e-26, "static": 2e-12, "kinetic": 2e-12, "vx": 100.0}
    allow = "allow: {block.x: 1.0e-13, block.vx: 0.1}\n"
    case = scene("dry_slide", f"{short(4e-13)}{allow}", **parameters)
    assert solve(case).trajectory.states["block"][-1, 3] == pytest.approx(20.0, rel=1e-12)
    monkeypatch.setattr(follow, "instant", lambda _: system.TOGETHER)
    assert solve(case).trajectory.states["block"][-1, 3] == 0.0


@pytest.mark.slow
def test_what_lands_within_a_picosecond_rebounds() -> None:
    """It falls for 0.4516 ps, and rises with 0.2324 of its speed for 0.2324 of twice that."""
    fall, kept = 4.51601e-13, 0.2324
    case = falling(1e-9, fall, kept, 6e-13)
    motion = solve(case).trajectory
    assert motion.switches[0] == pytest.approx(fall, rel=1e-12)
    g, t = 2e-9 / fall**2, case.times
    s = t - fall
    wanted = np.where(s > 0, kept * g * fall * s - g * s**2 / 2, 1e-9 - g * t**2 / 2)
    assert motion.states["b"][:, 1] == pytest.approx(wanted, abs=1e-21)


@pytest.mark.slow
@pytest.mark.mutant("a root is asked for to a femtosecond, of a microsecond too")
@pytest.mark.parametrize("fall", [1e-5, 1e-6])
def test_what_is_stated_of_a_short_motion_holds(fall: float, monkeypatch: Patch) -> None:
    """A ball of 1 mm, once down and up again, by closed form: within ten times what is stated."""
    kept, height = 0.8, 1e-3
    case = falling(height, fall, kept, 1.73 * fall)
    solution = solve(case)
    assert solution.holds
    s, g = case.times[-1] - fall, 2 * height / fall**2
    wanted = kept * g * fall * s - g * s**2 / 2
    off = abs(float(solution.trajectory.states["b"][-1, 1]) - wanted)
    assert off < 10 * stated(solution)["b.y"]  # an ulp of the largest height in some numbers
    if fall == 1e-5:
        monkeypatch.setattr(event_location, "ROOT", 1e-3 / case.duration)
        assert "nothing passes what holds it" in broken(solve(case))


def test_a_place_far_from_the_origin_is_known_as_well_as_the_other_coordinate() -> None:
    text = """\
scene:
  points: {O: [1024.0, 0]}
  bodies: {b: {particle: {mass: 1.0}}}
  joints: {rail: {slide: [ground.O, b.center], along: [1.0, 0.3]}}
initial: {rail: {shift: 0.3, speed: 0.2}}
allow: {b.y: 1.0e-6}
"""
    case = parsed(text)
    solution = solve(case)
    part, t = 0.3 / np.sqrt(1.09), case.times
    wanted = part * (0.3 + 0.2 * t - 9.80665 * part * t**2 / 2)
    off = float(np.max(np.abs(solution.trajectory.states["b"][:, 1] - wanted)))
    assert 1e-14 < off < 4 * stated(solution)["b.y"]  # an ulp of y is 1e-16


def test_a_direction_far_away_is_as_it_is_given() -> None:
    text = """\
scene:
  points: {O: [6371.0e+3, 0]}
  bodies: {b: {particle: {mass: 1.0}}}
  joints: {rail: {distance: [ground.O, b.center], length: 0.5}}
initial: {b: {from: ground.O, length: 0.5, direction: -0.5, vx: 0.1}}
allow: {b.y: 1.0e-3}
"""
    assert solve(parsed(text)).holds


@pytest.mark.slow
@pytest.mark.mutant("a corner beside a sample is the sample")
@pytest.mark.parametrize("at", ["0.333333333333", "0.3333333333333333", "0.33333333333333337"])
def test_a_corner_beside_a_sample_is_itself(at: str, monkeypatch: Patch) -> None:
    text = f"""\
scene:
  gravity: none
  points: {{O: [0, 0]}}
  bodies: {{b: {{particle: {{mass: 1.0}}}}}}
  joints: {{rail: {{slide: [ground.O, b.center], along: [1, 0]}}}}
  forces: {{p: {{push: b.center, step: {{amplitude: [8.0, 0], at: {at}}}}}}}
initial: {{b: {{x: 0}}}}
allow: {{b.x: 1.0e-3}}
"""
    case = parsed(text, tail="duration: 1.0\nsamples: 31\n")
    pushed = 4 * np.clip(case.times - float(at), 0.0, None) ** 2

    def off() -> float:
        return float(np.max(np.abs(solve(case).trajectory.states["b"][:, 0] - pushed)))

    assert off() < 1e-14
    if at == "0.333333333333":
        monkeypatch.setattr(follow, "ALIKE", 1e5)
        assert off() > 1e-12


@pytest.mark.mutant("what turns slowly beside what is driven has no inertia")
def test_a_molecule_turns_on_a_tip_that_moves(monkeypatch: Patch) -> None:
    text = """\
scene:
  gravity: none
  points: {k: {at: [0, 0], velocity: [100.0, 0]}}
  bodies: {b: {bar: {mass: 1.0e-26, length: 3.0e-10}}}
  joints: {j: {pin: [ground.k, b.start]}}
initial: {b: {angle: 0.3, omega: 1.0e+12}}
allow: {b.angle: 1.0e-3}
"""
    case = parsed(text, tail=short(3e-12))
    solution = solve(case)
    assert solution.holds
    turned = solution.trajectory.states["b"][:, 2]
    assert turned == pytest.approx(0.3 + 1e12 * case.times, rel=1e-12)
    monkeypatch.setattr(lagrange, "LARGER", 1)
    with pytest.raises(CaseError):
        solve(case)
