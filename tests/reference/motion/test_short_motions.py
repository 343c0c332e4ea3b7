"""Motions of picoseconds and microseconds: an instant is as small a part of them as of a second."""

from pathlib import Path

import numpy as np
import pytest
from given.scenes import typed

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.reference import system
from textmech.reference.formalisms import lagrange
from textmech.reference.motion import event_location, follow
from textmech.reference.solve import Solution, solve

STOPS = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {b: {particle: {mass: 1.0e-26}}}
  joints: {rail: {slide: [ground.O, b.center], along: [1, 0], dry_friction: {kinetic: 2.0e-12}}}
initial: {rail: {shift: 0, speed: 100.0}}
allow: {b.x: 1.0e-13, b.vx: 0.1}
"""
FALLS = """\
scene:
  gravity: GRAVITY
  bodies: {b: {particle: {mass: 1.0e-20}}}
  contacts: {c: {between: [b, ground.floor], friction: 0.0, restitution: KEPT}}
initial: {b: {x: 0, y: HEIGHT, vx: 0, vy: 0}}
events: {lands: {c.gap: falls to zero}}
allow: {b.y: 1.0e-5, b.vy: 10.0}
"""


def short(tmp_path: Path, text: str, duration: float) -> Case:
    return typed(tmp_path, text, tail=f"duration: {duration}\nsamples: 11\n")


def falling(tmp_path: Path, height: float, time: float, kept: float, duration: float) -> Case:
    """What falls that high in that time, and keeps so much of its speed."""
    gravity = 2 * height / time**2
    words = {"GRAVITY": gravity, "KEPT": kept, "HEIGHT": height}
    text = FALLS
    for word, number in words.items():
        text = text.replace(word, f"{number:.17g}")
    return short(tmp_path, text, duration)


def certified(solution: Solution, name: str) -> float:
    (check,) = [c for c in solution.checks if c.name == f"error of {name}"]
    assert check.certified is not None
    return check.certified


@pytest.mark.slow
@pytest.mark.mutant("what happens within a picosecond behind the last sample is its, however short")
def test_what_would_stop_after_the_end_has_not_stopped(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """v = 100 − 2e14 t m/s, which is 20 m/s after 0.4 ps."""
    case = short(tmp_path, STOPS, 4e-13)
    assert solve(case).trajectory.states["b"][-1, 3] == pytest.approx(20.0, rel=1e-12)
    monkeypatch.setattr(follow, "instant", lambda _: system.TOGETHER)
    assert solve(case).trajectory.states["b"][-1, 3] == 0.0


@pytest.mark.slow
def test_what_lands_within_a_picosecond_rebounds(tmp_path: Path) -> None:
    """It falls for 0.4516 ps, and rises with 0.2324 of its speed for 0.2324 of twice that."""
    fall, kept = 4.51601e-13, 0.2324
    case = falling(tmp_path, 1e-9, fall, kept, 6e-13)
    change = solve(case).trajectory.switches
    assert change[0] == pytest.approx(fall, rel=1e-12)
    t = case.times
    up = t > fall
    g = 2e-9 / fall**2
    s = t - fall
    wanted = np.where(up, kept * g * fall * s - g * s**2 / 2, 1e-9 - g * t**2 / 2)
    y = solve(case).trajectory.states["b"][:, 1]
    assert y == pytest.approx(wanted, abs=1e-21)


@pytest.mark.slow
@pytest.mark.mutant("a root is asked for to a femtosecond, of a microsecond too")
@pytest.mark.parametrize("fall", [1e-3, 1e-5, 1e-6])
def test_what_is_stated_of_a_short_motion_holds(
    fall: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A ball of 1 mm, once down and up again, by closed form: within four times what is stated."""
    kept, height = 0.8, 1e-3
    case = falling(tmp_path, height, fall, kept, 1.73 * fall)

    def off() -> float:
        solution = solve(case)
        assert all(check.holds for check in solution.checks)
        s = case.times[-1] - fall
        g = 2 * height / fall**2
        wanted = kept * g * fall * s - g * s**2 / 2
        y = float(solution.trajectory.states["b"][-1, 1])
        return abs(y - wanted) / certified(solution, "b.y")

    assert off() < 10  # an ulp of the largest height in each of some numbers
    if fall == 1e-5:
        monkeypatch.setattr(event_location, "ROOT", 1e-3 / case.duration)
        failing = {check.name for check in solve(case).checks if not check.holds}
        assert "nothing passes what holds it" in failing


BEAD = """\
scene:
  points: {O: [1024.0, 0]}
  bodies: {b: {particle: {mass: 1.0}}}
  joints: {rail: {slide: [ground.O, b.center], along: [1.0, 0.3]}}
initial: {rail: {shift: 0.3, speed: 0.2}}
allow: {b.y: 1.0e-6}
"""


def test_a_place_is_known_as_well_as_the_other_coordinate(tmp_path: Path) -> None:
    case = typed(tmp_path, BEAD)
    solution = solve(case)
    part = 0.3 / np.sqrt(1.09)
    t = case.times
    wanted = part * (0.3 + 0.2 * t - 9.80665 * part * t**2 / 2)
    off = float(np.max(np.abs(solution.trajectory.states["b"][:, 1] - wanted)))
    assert off > 1e-14  # an ulp of y is 1e-16
    assert off < 4 * certified(solution, "b.y")


@pytest.mark.parametrize("x", [262144.0, 6371e3])
def test_a_direction_far_away_is_as_it_is_given(x: float, tmp_path: Path) -> None:
    case = typed(
        tmp_path,
        f"""\
scene:
  points: {{O: [{x}, 0]}}
  bodies: {{b: {{particle: {{mass: 1.0}}}}}}
  joints: {{rail: {{distance: [ground.O, b.center], length: 0.5}}}}
initial: {{b: {{from: ground.O, length: 0.5, direction: -0.5, vx: 0.1}}}}
allow: {{b.y: 1.0e-3}}
""",
    )
    assert all(check.holds for check in solve(case).checks)


CART = """\
scene:
  points: {O: [0, 0]}
  bodies: {b: {particle: {mass: 1.0}}}
  joints: {rail: {slide: [ground.O, b.center], along: [1, 0]}}
  forces: {p: {push: b.center, step: {amplitude: [8.0, 0], at: AT}}}
initial: {b: {x: 0}}
allow: {b.x: 1.0e-3}
"""


@pytest.mark.slow
@pytest.mark.mutant("a corner beside a sample is the sample")
@pytest.mark.parametrize("at", ["0.333333333333", "0.3333333333333333", "0.33333333333333337"])
def test_a_corner_beside_a_sample_is_itself(
    at: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = typed(tmp_path, CART.replace("AT", at), tail="duration: 1.0\nsamples: 31\n")
    pushed = 4 * np.clip(case.times - float(at), 0.0, None) ** 2

    def off() -> float:
        return float(np.max(np.abs(solve(case).trajectory.states["b"][:, 0] - pushed)))

    assert off() < 1e-14
    if at == "0.333333333333":
        monkeypatch.setattr(follow, "ALIKE", 1e5)
        assert off() > 1e-12


MOLECULE = """\
scene:
  gravity: none
  points: {k: {at: [0, 0], velocity: [100.0, 0]}}
  bodies: {b: {bar: {mass: 1.0e-26, length: 3.0e-10}}}
  joints: {j: {pin: [ground.k, b.start]}}
initial: {b: {angle: 0.3, omega: 1.0e+12}}
allow: {b.angle: 1.0e-3}
"""


@pytest.mark.mutant("what turns slowly beside what is driven has no inertia")
def test_a_molecule_turns_on_a_tip_that_moves(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = short(tmp_path, MOLECULE, 3e-12)
    solution = solve(case)
    assert all(check.holds for check in solution.checks)
    found = solution.trajectory.states["b"][:, 2]
    assert found == pytest.approx(0.3 + 1e12 * case.times, rel=1e-12)
    monkeypatch.setattr(lagrange, "LARGER", 1)
    with pytest.raises(CaseError):
        solve(case)
