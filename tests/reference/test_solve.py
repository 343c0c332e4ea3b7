"""Case → certified motion, and what is refused on the way."""

import time
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError, Mistake
from textmech.reference.solve import solve

WHEEL = """\
scene:
  points: {hook: [0, 1]}
  incline: BETA
  bodies: {wheel: {disk: {mass: 1, radius: 0.25}}}
  contacts: {touch: {between: [wheel, ground.floor], friction: MU, ideal: rolling}}
  forces: {lift: {push: wheel.center, ramp: [0, UP]}}
initial: {wheel: {x: 0, angle: 0}}
allow: {wheel.x: 1.0e-2}
"""
PARALLELOGRAM = """\
scene:
  points: {O: [0, 0], Q: [0.9, 0]}
  bodies:
    crank: {bar: {mass: 1, length: 0.3}}
    coupler: {bar: {mass: 1, length: 0.9}}
    rocker: {bar: {mass: 1, length: 0.3}}
  joints:
    A: {pin: [ground.O, crank.start]}
    B: {pin: [crank.end, coupler.start]}
    C: {pin: [coupler.end, rocker.end]}
    D: {pin: [ground.Q, rocker.start]}
initial: {crank: {angle: 70 deg}}
near: {rocker: {angle: 70 deg}}
allow: {crank.angle: 1.0e-2}
"""
SPRING = """\
scene:
  points: {O: [0, 0]}
  bodies: {dot: {particle: {mass: 0.7}}}
  forces: {coil: {spring: [ground.O, dot.center], stiffness: 3, rest_length: 0.5}}
initial: {dot: {x: 0, y: START}}
allow: {dot.y: 1.0e-2}
"""
CART = """\
scene:
  points: {O: [0, 0]}
  bodies: {cart: {block: {mass: 2, width: 0.3, height: 0.1}}, rod: {bar: {mass: 0.5, length: 0.6}}}
  joints:
    rail: {slide: [ground.O, cart.center], along: [1, 0]}
    hinge: {pin: [cart.center, rod.start]}
initial: {cart: {x: 0}, rod: {angle: -40 deg}}
allow: {cart.x: 1.0e-3, cart.y: 1.0e-3, cart.vy: 1.0e-3}
"""
AT_REST = {
    "hanging bar": """\
scene:
  points: {O: [0, 0]}
  bodies: {bar: {bar: {mass: 1.2, length: 0.8}}}
  joints: {hinge: {pin: [ground.O, bar.start]}}
initial: {bar: {angle: -90 deg}}
allow: {bar.angle: 1.0e-2}
""",
    "hanging mass": """\
scene:
  points: {O: [0, 0]}
  bodies: {dot: {particle: {mass: 0.7}}}
  joints: {guide: {slide: [ground.O, dot.center], along: [0, 1]}}
  forces: {coil: {spring: [ground.O, dot.center], stiffness: 30, rest_length: 0.5}}
initial: {dot: {y: -0.7288218333333333}}
allow: {dot.y: 1.0e-2, guide.torque: 1.0e-3}
""",
    "wheel without friction": WHEEL.replace("BETA", "0").replace("MU", "0").replace("UP", "0"),
}


def refused(case: Case) -> Mistake:
    with pytest.raises(CaseError) as error:
        solve(case)
    (mistake,) = error.value.mistakes
    return mistake


@pytest.mark.parametrize("name", scenes.SHIPPED)
def test_shipped_case_is_certified(name: str) -> None:
    solution = solve(scenes.SHIPPED[name])
    assert solution.holds
    assert solution.system == (scenes.SHIPPED[name].system or "generated")


@pytest.mark.parametrize(("part", "rolls"), [(0.99, False), (1.01, True)])
def test_rolling_is_possible_just_above_what_it_needs(
    tmp_path: Path, part: float, rolls: bool
) -> None:
    """A disk needs tan β / 3: Example 2.1; one per cent less is not enough."""
    mu = part * np.tan(np.pi / 6) / 3
    text = WHEEL.replace("BETA", "30 deg").replace("MU", repr(float(mu))).replace("UP", "0")
    case = scenes.typed(tmp_path, text)
    if rolls:
        assert solve(case).holds
    else:
        assert "rolling is not possible" in refused(case).what


def test_rolling_needs_enough_friction(tmp_path: Path) -> None:
    """A disk needs tan β / 3: Example 2.1."""
    text = WHEEL.replace("BETA", "30 deg").replace("MU", "0.1").replace("UP", "0")
    mistake = refused(scenes.typed(tmp_path, text))
    assert mistake.where == "scene.contacts.touch.ideal"
    assert mistake.line == 7
    assert "rolling is not possible with friction 0.1: at t = 0 s it would slip" in mistake.what
    assert f"needs {np.tan(np.pi / 6) / 3:.3g}" in mistake.what
    solve(scenes.typed(tmp_path, text.replace("friction: 0.1", "friction: 0.2")))


def test_the_floor_does_not_pull(tmp_path: Path) -> None:
    """m g / 20 N/s: the wheel is lifted after 0.490 s, seen at the next sample."""
    text = WHEEL.replace("BETA", "0").replace("MU", "0.5").replace("UP", "20")
    mistake = refused(scenes.typed(tmp_path, text))
    assert "the floor would have to pull at t = 0.52 s: the disk leaves it" in mistake.what


def test_what_fails_first_is_told(tmp_path: Path) -> None:
    """On a slope a lifted wheel slips before it leaves the floor."""
    text = WHEEL.replace("BETA", "20 deg").replace("MU", "0.2").replace("UP", "20")
    assert "it would slip" in refused(scenes.typed(tmp_path, text)).what


def test_a_flat_parallelogram_ends_the_motion(tmp_path: Path) -> None:
    """There it can go on as a parallelogram or crossed: reported soon, and with the time.

    Until then ½ J α̇² = 2 m g a (sin α₀ − sin α), J = (2/3 + 1) m a², so that t = ∫ dα/α̇.
    """
    begin = time.process_time()
    mistake = refused(scenes.typed(tmp_path, PARALLELOGRAM))
    assert time.process_time() - begin < 2.0  # the integrators alone would creep on for minutes
    J, weight = 2 * 0.3**2 / 3 + 0.3**2, 2 * 9.80665 * 0.3  # two cranks, one coupler of 1 kg
    # α = α₀ − s², by Gauss: the integrand is then smooth at the start
    s, weights = np.polynomial.legendre.leggauss(40)
    half = np.sqrt(np.radians(70)) / 2
    s, weights = half * (s + 1), half * weights
    fallen = np.sin(np.radians(70)) - np.sin(np.radians(70) - s**2)
    t = np.sum(weights * 2 * s / np.sqrt(2 * weight * fallen / J))
    assert mistake.where == "duration"
    told = float(mistake.what.split("t = ")[1].split(" s")[0])
    assert told == pytest.approx(t, abs=2e-4)  # four digits, and it stops a little before
    assert "what D holds is held by the others already" in mistake.what


def test_a_spring_without_length(tmp_path: Path) -> None:
    mistake = refused(scenes.typed(tmp_path, SPRING.replace("START", "0")))
    assert mistake.where == "duration"
    assert "beyond t = 0 s: coil has no length there, and so no direction" in mistake.what


def test_a_spring_that_loses_its_length_on_the_way(tmp_path: Path) -> None:
    """It would push backwards beyond its anchor: λ = λ₀ + 1.5 cos(√(c/m) t) m is zero there."""
    text = SPRING.replace("START", "-2").replace("scene:\n", "scene:\n  gravity: none\n")
    mistake = refused(scenes.typed(tmp_path, text))
    assert mistake.where == "duration"
    t = np.arccos(-0.5 / 1.5) / np.sqrt(3 / 0.7)
    assert f"beyond t = {t:.4g} s: coil has no length there" in mistake.what


def test_a_rhombus_that_folds_flat_ends_the_motion() -> None:
    """Its own coordinates know no constraint; the generated answer stops where it lies flat."""
    rhombus = scenes.SHIPPED["rhombus"]
    soft = {name: replace(f, stiffness=1e-3) for name, f in rhombus.scene.forces.items()}  # type: ignore[call-overload]
    case = replace(
        rhombus,
        scene=replace(rhombus.scene, forces=soft),
        parameters={**rhombus.parameters, "c": 1e-3},
    )
    mistake = refused(case)
    assert mistake.where == "duration"
    assert "diagonal has no length there" in mistake.what


@pytest.mark.parametrize("name", AT_REST)
def test_what_rests_is_certified(tmp_path: Path, name: str) -> None:
    """At rest only rounding moves: no check may be relative to that."""
    solution = solve(scenes.typed(tmp_path, f"rests: true\n{AT_REST[name]}"))
    assert [check for check in solution.checks if not check.holds] == []


@pytest.mark.parametrize("name", AT_REST)
def test_what_rests_has_to_say_so(tmp_path: Path, name: str) -> None:
    with pytest.raises(CaseError, match="never moves: it stays") as caught:
        solve(scenes.typed(tmp_path, AT_REST[name]))
    assert all(mistake.where.startswith("allow.") for mistake in caught.value.mistakes)


def test_a_place_that_is_held_only_trembles(tmp_path: Path) -> None:
    """The cart's height is 0 but for rounding, and rounding is no motion."""
    with pytest.raises(CaseError) as caught:
        solve(scenes.typed(tmp_path, CART))
    assert [mistake.where for mistake in caught.value.mistakes] == ["allow.cart.y", "allow.cart.vy"]


@pytest.mark.parametrize("kind", ["pin", "weld"])
def test_a_particle_at_the_end_of_a_bar(tmp_path: Path, kind: str) -> None:
    text = AT_REST["hanging bar"].replace("bodies: {", "bodies: {dot: {particle: {mass: 2}}, ")
    text = text.replace("joints: {", f"joints: {{tip: {{{kind}: [bar.end, dot.center]}}, ")
    solution = solve(scenes.typed(tmp_path, text.replace("-90 deg", "-30 deg")))
    assert solution.holds
    # (2.34) about O, at rest: J = ⅓ m l² + M l², moment −(½ m + M) g l cos φ
    J = 1.2 * 0.8**2 / 3 + 2 * 0.8**2
    alpha = -(0.6 + 2) * 9.80665 * 0.8 * np.cos(np.pi / 6) / J
    assert solution.trajectory.reactions["tip.fx"][0] == pytest.approx(2 * 0.8 * alpha * 0.5)
