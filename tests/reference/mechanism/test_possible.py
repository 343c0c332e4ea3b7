"""What a generated mechanism says of modes that contradict contact or friction."""

import math
from pathlib import Path

import numpy as np
import pytest
from given import scenes
from scipy.integrate import quad

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Anchor, Contact, Scene, shape
from textmech.reference.mechanism.modes import mechanism
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve

STANDS, UP = (0.0, 0.25, 0.0), 9.81


def said(mode: str, q: tuple[float, ...], v: tuple[float, ...], *, gravity: tuple[float, float]):
    """Of a disk on the floor, R = 0.25 m, μ = 0.4, in a mode."""
    disk = shape.disk(name="wheel", mass=1.3, radius=0.25, points={})
    touch = Contact("touch", Anchor("wheel", "center"), 0.4, 0.4)
    scene = Scene(gravity, {}, {"wheel": disk}, {}, {"touch": touch}, {})
    disks = PlanarMechanism(scene, (np.array(STANDS), np.zeros(3)), 0.25)
    built = disks.built
    names = {s: built.name((s,)) for s in ("open", "slides +", "slides -", "sticks")}
    return disks.possible(names[mode], 0.0, np.array(q), np.array(v))


@pytest.mark.parametrize("mode", ["sticks", "slides +", "slides -"])
def test_a_floor_does_not_pull(mode: str):
    v = {"sticks": 0.0, "slides +": 1.0, "slides -": -1.0}[mode]
    pulled = said(mode, STANDS, (v, 0.0, 0.0), gravity=(0.0, UP))
    assert pulled == "the floor would have to pull at touch"
    assert said(mode, STANDS, (v, 0.0, 0.0), gravity=(0.0, -UP)) is None
    assert said("open", STANDS, (v, 0.0, 0.0), gravity=(0.0, UP)) is None


def test_a_rim_stays_above_the_floor():
    sunk = (0.0, 0.25 - 1e-6, 0.0)
    assert said("open", sunk, (0.0, 0.0, 0.0), gravity=(0.0, -UP)) == "touch is in the floor"


@pytest.mark.parametrize(("slope", "slips"), [(1.19, False), (1.21, True)])
@pytest.mark.parametrize("way", [1, -1])
def test_a_disk_rolls_on_slopes_up_to_three_mu(slope: float, slips: bool, way: int):
    """Friction is a third of the drive, and at most 0.4 of the weight across."""
    words = said("sticks", STANDS, (0.0, 0.0, 0.0), gravity=(way * slope * UP, -UP))
    assert words == ("touch would have to slip" if slips else None)


@pytest.mark.parametrize(("mode", "way"), [("slides +", 1.0), ("slides -", -1.0)])
def test_a_mode_slides_its_own_way(mode: str, way: float):
    """(2.16) the slip is ẋ + R ω."""
    assert said(mode, STANDS, (way, 0.0, 0.0), gravity=(0.0, -UP)) is None
    other = said(mode, STANDS, (way, 0.0, -5.0 * way), gravity=(0.0, -UP))
    assert other == "touch slides the other way"


@pytest.mark.parametrize("gravity", [(0.0, -UP), (3.0, -UP)])
@pytest.mark.parametrize(("mode", "way"), [("slides +", 1.0), ("slides -", -1.0)])
def test_rounding_at_rest_slides_no_way(mode: str, way: float, gravity: tuple[float, float]):
    """All that moves is rounding, which is no size; a real slip is one, however slow."""
    for speed in (1e-17, 1e-32, 1e-64):
        assert said(mode, STANDS, (-way * speed, 0.0, 0.1 * speed), gravity=gravity) is None
    slow = said(mode, STANDS, (-way * 1e-9, 0.0, 0.0), gravity=gravity)
    assert slow == "touch slides the other way"


BROKEN_LOOSE = """\
scene:
  gravity: none
  points: {O: [0, 0], Q: [0, 1]}
  bodies: {a: {particle: {mass: 1}}, b: {particle: {mass: 2}}}
  joints:
    R: {slide: [ground.O, a.center], along: [1, 0], dry_friction: {static: 6, kinetic: 3}}
    S: {slide: [ground.Q, b.center], along: [1, 0]}
    d: {distance: [a.center, b.center], length: 1.25}
  forces: {p: {push: b.center, ramp: [10, 0]}}
initial: {a: {x: 0}, b: {x: 0.75}}
allow: {a.x: 1.0e-3}
"""

CORNERED = """\
scene:
  planes: {wall: {at: [50, 0], normal: [-1, 0]}}
  bodies: {wheel: {disk: {mass: 800, radius: 3}}}
  contacts:
    floor: {between: [wheel, ground.floor], friction: 0.5}
    wall: {between: [wheel, ground.wall], friction: 0.5}
initial: {wheel: {x: 0, y: 10, angle: 0, vx: 20}}
events: {lands: {floor.gap: falls to zero}, hits: {wall.gap: falls to zero}}
allow: {wheel.x: 5.0e-2}
"""


@pytest.mark.slow
def test_a_slide_breaks_loose_on_a_sample(tmp_path: Path):
    """The ramp reaches 6 N at 0.6 s; then x⃛ = 10/3, ẍ = 1 at first."""
    case = scenes.typed(tmp_path, BROKEN_LOOSE, tail=scenes.tail(2.0, 51))
    found = solve(case)
    assert found.holds
    t = np.maximum(case.times - 0.6, 0.0)
    known = t**2 / 2 + 10 / 18 * t**3
    np.testing.assert_allclose(found.trajectory.states["a"][:, 0], known, atol=1e-13)


@pytest.mark.slow
def test_a_wheel_comes_to_rest_in_a_corner(tmp_path: Path):
    assert solve(scenes.typed(tmp_path, CORNERED, tail=scenes.tail(6.0, 61))).holds


@pytest.mark.slow
@pytest.mark.mutant("the way of a slide that breaks loose taken for the other one")
def test_a_way_taken_for_the_other_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    """The slide stops as it starts: whether that ends in a check or in a refusal, rounding says."""
    other = {1: -1, -1: 1, 0: 0}
    sound = mechanism.sign
    case = scenes.typed(tmp_path, BROKEN_LOOSE, tail=scenes.tail(0.64, 17))
    assert seen_wrong(case) == []
    monkeypatch.setattr(mechanism, "sign", lambda state: other[sound(state)])
    assert seen_wrong(case)


def seen_wrong(case: Case) -> list[str]:
    """The checks that a case does not hold, or what it is refused for."""
    try:
        return [check.name for check in solve(case).checks if not check.holds]
    except CaseError as refused:
        return [mistake.what for mistake in refused.mistakes]


LADDER = """\
scene:
  planes: {wall: {at: [0, 0], normal: [1, 0]}}
  bodies: {rod: {bar: {mass: 1.5, length: 0.9}}}
  contacts:
    CONTACTS
  forces:
    p: {push: rod.center, sine: {amplitude: [10, -2], angular_frequency: 17, phase: 1.9}}
initial: {rod: {angle: -0.71, on: [end, start]}}
allow: {rod.angle: 1.0e-2}
"""
ENDS = [
    "foot: {between: [rod.end, ground.floor], friction: 0.37}",
    "top: {between: [rod.start, ground.wall], friction: 0.46}",
]


def phases(tmp_path: Path, ends: list[str]) -> list[tuple[float, dict[str, str]]]:
    """When the ladder goes on otherwise, and what each end does then."""
    text = LADDER.replace("CONTACTS", "\n    ".join(ends))
    made = scenes.mechanism(scenes.typed(tmp_path, text))
    assert isinstance(made, PlanarMechanism)
    names = [e.name for e in made.elements]
    return [
        (change.time, dict(zip(names, made.built.states[change.mode_after], strict=True)))
        for change in follow(made, np.linspace(0.0, 0.5, 11)).changes
    ]


@pytest.mark.slow
def test_a_ladder_rests_at_both_ends_in_whatever_order_they_are_told(tmp_path: Path):
    """Both stop at one instant: none goes on to rub at rest, and rubs as nothing says how."""
    one, other = phases(tmp_path, ENDS), phases(tmp_path, ENDS[::-1])
    assert [states for _, states in one] == [states for _, states in other]
    assert [t for t, _ in one] == pytest.approx([t for t, _ in other], abs=1e-12)
    assert one[0][1] == {"foot": "sticks", "top": "sticks"}


@pytest.mark.slow
@pytest.mark.mutant("what stops at the instant of another goes on to slide, at rest")
def test_one_end_of_a_ladder_rests_alone(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(PlanarMechanism, "_stops_too", lambda *_: None)
    with pytest.raises(AssertionError):
        test_a_ladder_rests_at_both_ends_in_whatever_order_they_are_told(tmp_path)


# A stop's gap is an angle: what is none of it does not hang on the scene's size.


STRUCK = """\
scene:
  gravity: 9.8
  points: {O: [0, 0]}
  bodies: {b: {bar: {mass: 1.0e-9, length: LENGTH}}}
  joints: {h: {pin: [ground.O, b.start]}}
  forces: {s: {stops: h, low: -60 deg, restitution: 0.5}}
initial: {b: {angle: 10 deg}}
allow: {b.angle: 0.01}
"""


def falling(low: float, high: float) -> float:
    """√(l/g) in which a bar falls from rest at one angle to another: ω² = 3 (sin φ₀ − sin φ)."""

    def slowness(s: float) -> float:  # φ = φ₀ − s², which has no pole at rest
        return 2 * s / math.sqrt(3 * (math.sin(high) - math.sin(high - s * s)))

    return float(quad(slowness, 0.0, math.sqrt(high - low), epsabs=1e-13)[0])


@pytest.mark.slow
@pytest.mark.mutant("the gap of a stop is small against a length")
@pytest.mark.parametrize("length", [6.0e-7, 6.0e-5, 0.6, 600.0])
def test_a_bar_of_any_length_bounces_on_its_stop(length: float, tmp_path: Path) -> None:
    unit = math.sqrt(length / 9.8)
    case = scenes.typed(
        tmp_path, STRUCK.replace("LENGTH", repr(length)), tail=scenes.tail(4.8 * unit, 11)
    )
    found = solve(case)
    assert [check for check in found.checks if not check.holds] == []
    low, high = math.radians(-60), math.radians(10)
    back = math.asin(math.sin(low) + 0.25 * (math.sin(high) - math.sin(low)))  # at half the rate
    first = falling(low, high)
    strikes = [first, first + 2 * falling(low, back)]
    assert np.max(np.abs(found.trajectory.switches[:2] / unit - strikes)) < 1e-9  # of quadrature
