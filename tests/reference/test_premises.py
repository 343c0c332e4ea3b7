"""What a case takes for granted: that it rolls, moves, and says where it lands."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.refused import refused

from textmech.cases.mistake import CaseError
from textmech.reference.solve import solve

AIMED = """\
scene:
  bodies: {ball: {particle: {mass: 1}}}
  contacts: {touch: {between: [ball, ground.floor], friction: 0.3}}
initial: {ball: {x: 0, y: HEIGHT, vx: 1}}
allow: {ball.y: 1.0e-3}
"""


@pytest.mark.parametrize(("part", "rolls"), [(0.99, False), (1.01, True)])
def test_rolling_is_possible_just_above_what_it_needs(part: float, rolls: bool) -> None:
    """A disk needs tan β / 3: Example 2.1; one per cent less is not enough."""
    mu = part * np.tan(np.pi / 6) / 3
    case = scenes.scene("rolling_wheel", beta="30 deg", mu=float(mu))
    if rolls:
        assert solve(case).holds
    else:
        assert "rolling is not possible" in refused(case).what


@pytest.mark.slow
def test_rolling_needs_enough_friction() -> None:
    """A disk needs tan β / 3: Example 2.1."""
    mistake = refused(scenes.scene("rolling_wheel", beta="30 deg", mu=0.1))
    assert mistake.where == "scene.contacts.touch.ideal"
    assert mistake.text.strip() == '"ideal": "rolling"'
    assert "rolling is not possible with friction 0.1: at t = 0 s it would slip" in mistake.what
    assert f"needs {np.tan(np.pi / 6) / 3:.3g}" in mistake.what
    solve(scenes.scene("rolling_wheel", beta="30 deg", mu=0.2))


def test_the_floor_does_not_pull() -> None:
    """m g / 20 N/s: the wheel is lifted after 0.490 s, seen at the next sample."""
    mistake = refused(scenes.scene("rolling_wheel", up=20))
    assert "the floor would have to pull at t = 0.52 s: wheel leaves it" in mistake.what


def test_what_fails_first_is_told() -> None:
    """On a slope a lifted wheel slips before it leaves the floor."""
    lifted = scenes.scene("rolling_wheel", beta="20 deg", mu=0.2, up=20)
    assert "it would slip" in refused(lifted).what


@pytest.mark.parametrize(
    ("name", "parameters"),
    [("hanging_bar", {}), ("mass_on_spring", {}), ("two_slides", {}), ("rolling_wheel", {"mu": 0})],
)
def test_what_rests_has_to_say_so(name: str, parameters: dict[str, Any]) -> None:
    with pytest.raises(CaseError, match="never moves: it stays") as caught:
        solve(scenes.scene(name, "rests: null", **parameters))
    assert all(mistake.where.startswith("allow.") for mistake in caught.value.mistakes)


def test_a_place_that_is_held_only_trembles() -> None:
    """The cart's height is 0 but for rounding, and rounding is no motion."""
    text = """\
scene:
  points: {O: [0, 0]}
  bodies: {cart: {block: {mass: 2, width: 0.3, height: 0.1}}, rod: {bar: {mass: 0.5, length: 0.6}}}
  joints:
    rail: {slide: [ground.O, cart.center], along: [1, 0]}
    hinge: {pin: [cart.center, rod.start]}
initial: {cart: {x: 0}, rod: {angle: -40 deg}}
allow: {cart.x: 1.0e-3, cart.y: 1.0e-3, cart.vy: 1.0e-3}
"""
    with pytest.raises(CaseError) as caught:
        solve(scenes.parsed(text))
    assert [mistake.where for mistake in caught.value.mistakes] == ["allow.cart.y", "allow.cart.vy"]


@pytest.mark.slow
def test_a_contact_above_the_floor_has_to_say_so() -> None:
    mistake = refused(scenes.scene("standing_bar", y=0.01))
    assert mistake.where == "scene.contacts.tip"
    assert "starts 0.01 m above the floor" in mistake.what
    solve(scenes.scene("standing_bar", y=1e-10, mu=0.5))


@pytest.mark.parametrize(("height", "lands"), [(2.0, True), (20.0, False)])
def test_a_contact_that_has_not_landed_by_the_end_is_no_mistake(
    tmp_path: Path, height: float, lands: bool
) -> None:
    """It falls 4.9 m in the second that is followed."""
    typed = scenes.typed(tmp_path, AIMED.replace("HEIGHT", repr(height)))
    if lands:
        assert "starts 2 m above the floor" in refused(typed).what
    else:
        assert solve(typed).holds


STARTS = {
    "omega: 9": ("omega", 10, "bar_pendulum starts bar with omega = 0 rad/s, the scene with 9:"),
    "vx: 1": ("vx", 10, "bar_pendulum starts bar with vx = 0 m/s, the scene with 1:"),
}
WRITTEN = """\
system: bar_pendulum
parameters: {m: 1.2, l: 0.8, phi0: -40 deg}
scene:
  points: {O: [0, 0]}
  bodies: {bar: {bar: {mass: m, length: l}}}
  joints: {hinge: {pin: [ground.O, bar.start]}}

initial: {bar: {angle: phi0, GIVEN}}
allow: {bar.angle: 1.0e-2}
"""


@pytest.mark.parametrize("given", STARTS)
def test_a_written_system_starts_as_the_scene(tmp_path: Path, given: str) -> None:
    """It has no parameter for a rate, and took no notice of one."""
    field, line, words = STARTS[given]
    mistake = refused(scenes.typed(tmp_path, WRITTEN.replace("GIVEN", given)))
    assert (mistake.where, mistake.line) == (f"initial.bar.{field}", line)
    assert mistake.what.startswith(words)
    assert "leave out `system`" in mistake.what


def test_a_start_that_differs_in_what_follows_names_the_body(tmp_path: Path) -> None:
    """The place of the pin is nowhere in `initial`."""
    text = WRITTEN.replace("O: [0, 0]", "O: [0, 0.1]").replace("GIVEN", "omega: 0")
    mistake = refused(scenes.typed(tmp_path, text))
    assert mistake.where == "initial.bar"
    assert "starts bar with y = -0.257115 m, the scene with -0.157115" in mistake.what


@pytest.mark.slow
def test_a_written_system_has_the_scenes_bodies(tmp_path: Path) -> None:
    text = """\
system: bar_pendulum
parameters: {m: 1.2, l: 0.8, phi0: 24.6 deg}
scene:
  points: {O: [0, 0]}
  bodies: {zed: {bar: {mass: m, length: l}}}
  joints: {hinge: {pin: [ground.O, zed.start]}}
initial: {zed: {angle: phi0}}
allow: {zed.angle: 1.0e-2}
"""
    mistake = refused(scenes.typed(tmp_path, text))
    assert mistake.where == "scene.bodies.zed"
    assert mistake.what == "bar_pendulum has no body 'zed'; its bodies: bar"


LOADED = """\
scene:
  points: {O: [0, 0]}
  bodies: {load: {particle: {mass: 5.0}}}
  joints: {guide: {slide: [ground.O, load.center], along: [0, 1]}}
  forces:
    m: {muscle: [ground.O, load.center], isometric: 1000.0, hill_a: 250.0, hill_b: 0.15,
        series_stiffness: 30000.0, parallel_stiffness: 0.0, rest_length: 0.3,
        contractile_length: LENGTH}
initial: {load: {x: 0, y: -0.3, vy: 0}}
allow: {load.y: 1.0, m.force: 1000.0}
"""


@pytest.mark.slow
@pytest.mark.mutant("a muscle on the other branch of Hill's hyperbola")
def test_a_muscle_is_not_pressed_beyond_its_law(tmp_path: Path) -> None:
    """(F + a)(v + b) = (F₀ + a) b holds for F > −a: 30 kN/m by 9.33 mm are 280 N."""
    end = scenes.tail(0.2, 51)
    assert solve(scenes.typed(tmp_path, LOADED.replace("LENGTH", "0.3"), tail=end)).holds
    text = LOADED.replace("LENGTH", "0.30933333")
    mistake = refused(scenes.typed(tmp_path, text, tail=end))
    assert mistake.where == "scene.forces.m"
    assert mistake.what.startswith("what contracts is pressed by 280 N at 0 s, and Hill's law")


@pytest.mark.slow
@pytest.mark.mutant("a claim that nothing moves, which nobody asks")
def test_what_rests_does_not_move() -> None:
    mistake = refused(scenes.scene("mass_on_spring", "rests: true", y=-0.8288218333333333))
    assert (mistake.where, mistake.what) == ("rests", "dot.y moves by 0.2 m")
    assert solve(scenes.scene("mass_on_spring", "rests: true")).holds


PUSHED = """\
scene:
  space: 3
  bodies: {b: {sphere: {mass: 1.0, radius: 0.1}}}
  contacts: {c: {between: [b, ground.floor], friction: MU, ideal: rolling}}
  forces: {p: {push: b.center, sine: {amplitude: [0.3, 0, 9.807], angular_frequency: 3.0}}}
initial: {b: {x: 0, y: 0, attitude: {axis: [0, 0, 1], angle: 0}, omega: [0, 1, 0]}}
allow: {b.x: 1.0}
"""
TOP = """\
scene:
  space: 3
  bodies:
    b: {rigid: {mass: 1.0, inertia: [0.02, 0.02, 0.004, 0, 0, 0]}, points: {tip: [0, 0, -0.25]}}
  contacts: {c: {between: [b.tip, ground.floor], friction: MU, ideal: pivot}}
initial: {b: {tip: [0, 0, 0], attitude: {axis: [0, 1, 0], angle: 0.3}, omega: [0, 0.5, 0.5]}}
allow: {b.x: 1.0}
"""


@pytest.mark.slow
@pytest.mark.mutant("of a floor that pulls between two steps it is said what friction is enough")
@pytest.mark.parametrize("mu", ["50", "58", "1.0e+5"])
def test_no_friction_is_enough_where_the_floor_would_pull(mu: str, tmp_path: Path) -> None:
    """The push is more than the weight for 0.02 s, and less at every step."""
    case = scenes.typed(tmp_path, PUSHED.replace("MU", mu), tail=scenes.tail(2.0, 3))
    what = "the floor would have to pull at t = 0.524 s: b leaves it"
    assert refused(case).what == what


@pytest.mark.slow
@pytest.mark.mutant("the friction that is enough is that of the steps")
def test_the_friction_that_is_said_to_be_enough_is(tmp_path: Path) -> None:
    """70.28 at 0.3454 s, between two steps, by the motion at 6,001 samples."""
    tail = scenes.tail(0.6, 7)
    what = refused(scenes.typed(tmp_path, TOP.replace("MU", "50"), tail=tail)).what
    needs = what.partition("pivoting all the way needs ")[2]
    assert 70.28 <= float(needs) <= 70.29
    assert solve(scenes.typed(tmp_path, TOP.replace("MU", needs), tail=tail)).holds
