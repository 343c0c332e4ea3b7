"""A block at rest breaks loose where static friction is kinetic friction, wherever it stands."""

import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from given import scenes

from textmech.reference.integrators import march
from textmech.reference.integrators.dop853 import DOP853
from textmech.reference.mechanism.modes import element
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.motion.follow import Followed, follow
from textmech.reference.motion.mode_onset import Early
from textmech.reference.motion.stuck import Stuck
from textmech.reference.motion.zeno import ZenoError
from textmech.reference.system import System
from textmech.reference.systems.friction.anisotropic_drift import AnisotropicDrift
from textmech.reference.systems.friction.dynamometer import Dynamometer
from textmech.reference.systems.friction.growing_force import GrowingForce

SLIDE = """\
scene:
  gravity: none
  points: {O: [0, 0], hook: {at: [5, 0], velocity: [1, 0]}}
  bodies: {block: {particle: {mass: 1}}}
  joints: {guide: {slide: [ground.O, block.center], along: [1, 0], dry_friction: {FRICTION}}}
  forces: {PULL}
initial: {block: {x: START, vx: 0}}
allow: {block.x: 1.0e-3}
"""
FLOOR = """\
scene:
  bodies: {block: {particle: {mass: 1}}}
  contacts: {touch: {between: [block, ground.floor], friction: 0.3}}
  forces: {PULL}
initial: {block: {x: START, y: 0, vx: 0, vy: 0}}
allow: {block.x: 1.0e-3}
"""
RAMP = "pull: {push: block.center, ramp: [1, 0]}"
SPRING = "pull: {spring: [block.center, ground.hook], stiffness: 2, rest_length: 5}"
TIMES = np.linspace(0.0, 6.0, 25)
SCENES = {
    "slide": (SLIDE, "kinetic: 3", RAMP),
    "slide 3.0001": (SLIDE, "static: 3.0001, kinetic: 3", RAMP),
    "spring": (SLIDE, "kinetic: 3", SPRING),
    "floor": (FLOOR, "", RAMP),
}


def moved(tmp_path: Path, name: str, start: float) -> tuple[PlanarMechanism, Followed]:
    text, friction, pull = SCENES[name]
    text = text.replace("FRICTION", friction).replace("PULL", pull).replace("START", str(start))
    mechanism = scenes.mechanism(scenes.typed(tmp_path, text))
    return mechanism, follow(mechanism, TIMES)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["slide", "slide 3.0001", "floor"])
@pytest.mark.parametrize("start", [0.0, 0.1])
def test_from_anywhere_it_is_the_same_motion(tmp_path: Path, name: str, start: float):
    """x = (t³ − t₀³)/6 − (t − t₀) t₀²/2 − (F − t₀)(t − t₀)²/2 from t₀ = F_s on."""
    _, found = moved(tmp_path, name, start)
    static, kinetic = (3.0001, 3.0) if "3.0001" in name else (3.0, 3.0)
    if name == "floor":
        static = kinetic = 0.3 * 9.80665
    tau = np.maximum(TIMES - static, 0.0)
    known = tau**3 / 6 + (static - kinetic) * tau**2 / 2
    np.testing.assert_allclose(found.y[:, 0] - start, known, rtol=1e-13, atol=1e-13)
    assert len(found.changes) == 1


WEAK = "tow: {push: block.center, constant: [MOST, 0]}, pull: {push: block.center, ramp: [RATE, 0]}"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["slide", "floor"])
@pytest.mark.parametrize("rate", [0.1, 1e-3, 1e-5])
def test_a_weak_ramp_breaks_it_loose_when_it_should(tmp_path: Path, name: str, rate: float):
    """x = rate τ³/6 from 0.31 s on, where the force is the bound but for its rounding."""
    text, friction, _ = SCENES[name]
    bound = 3.0 if name == "slide" else 0.3 * 9.80665
    pull = WEAK.replace("MOST", repr(bound - rate * 0.31)).replace("RATE", f"{rate:.1e}")
    text = text.replace("FRICTION", friction).replace("PULL", pull).replace("START", "0.0")
    times = np.linspace(0.0, 1.0, 26)
    found = follow(scenes.mechanism(scenes.typed(tmp_path, text)), times)
    rounding = 4 * np.spacing(bound)  # N: of the force, the bound, and both of their sums
    known = rate * np.maximum(times - 0.31, 0.0) ** 3 / 6
    np.testing.assert_allclose(found.y[:, 0], known, rtol=0, atol=rounding)
    (slips,) = found.changes
    assert slips.time == pytest.approx(0.31, abs=1e-12 + rounding / rate)


def slips(most: float, friction: Any, omega: float, end: float) -> list[float]:
    """When a force of most sin ω t slips against friction, and when it rests again [s].

    It slips from a time d before each peak; v = most (sin ω τ + sin ω d)/ω − friction (τ + d) is
    zero again at about 2 d behind it. With 40 digits: 16 leave less of v than a mode does.
    """
    with mpmath.workdps(40):
        push, w = mpmath.mpf(most) / friction, mpmath.mpf(omega)
        d = mpmath.acos(1 / push) / w
        v = lambda tau: push * (mpmath.sin(w * tau) + mpmath.sin(w * d)) / w - (tau + d)  # noqa: E731
        rests = mpmath.findroot(v, (d, 3 * d), solver="anderson", tol=1e-60)
        peaks = [(k + 0.5) * mpmath.pi / w for k in range(math.ceil(omega * end / math.pi - 0.5))]
        return [float(peak + after) for peak in peaks for after in (-d, rests)]


def within(friction: float, omega: float, excess: float, rounded: float, n: int) -> list[float]:
    """How far n of these times may be off [s], by so many ulp of friction in each force.

    A slip by those, over how fast the push passes friction: F ω √(2 excess). A stop by twice as
    much, were they the same all along: they leave a speed for 3 d, and it falls by 3 F excess.
    But a slip is one step, which adds up its forces with weights, some of which are negative.
    """
    slip = rounded * np.spacing(friction) / (friction * omega * math.sqrt(2 * excess))
    stop = 2 * float(np.abs(DOP853.b).sum()) * slip
    return [1e-12 + late for late in (slip, stop)] * (n // 2)


@pytest.mark.slow
@pytest.mark.parametrize("excess", [1e-6, 1e-8, 1e-10])
@pytest.mark.parametrize(("omega", "samples", "start"), [(3, 6, 0), (5, 101, 0.1), (5, 3, 0)])
def test_slips_are_counted_however_short(
    tmp_path: Path, omega: float, samples: int, start: float, excess: float
):
    """The later slips begin where an earlier one ended: a place of 1e-17 m is not rest at zero."""
    most = 3 * (1 + excess)
    push = f"push: {{push: block.center, sine: {{amplitude: [{most!r}, 0], "
    text = SLIDE.replace("FRICTION", "kinetic: 3").replace("START", str(start))
    text = text.replace("PULL", push + f"angular_frequency: {omega}}}}}")
    times = np.linspace(0.0, 2.0, samples)
    found = [c.time for c in follow(scenes.mechanism(scenes.typed(tmp_path, text)), times).changes]
    known = slips(most, 3, omega, 2.0)
    assert len(found) == len(known)
    # Of the push, by its sine and by its product; the difference of what is as large is exact.
    assert np.all(np.abs(np.subtract(found, known)) <= within(3.0, omega, excess, 1, len(known)))


STACK = """\
scene:
  bodies: {low: {block: {mass: 2.1, width: 10, height: 0.2}}, up: BODY}
  contacts: {a: {between: [low.lower_left, ground.floor], friction: 5},
             b: {between: [low.lower_right, ground.floor], friction: 5}, CONTACTS}
  forces: {push: {push: up.center, sine: {amplitude: [MOST, 0], angular_frequency: 4.3}}}
initial: {low: {x: 0.1, y: 0.1, angle: 0}, up: {x: 0, y: HEIGHT, vx: 0, vy: 0}}
allow: {up.x: 1.0e-3}
"""
ON_TOP = {
    "particle": ("{particle: {mass: 0.93}}", "c: {between: [up, low.top], friction: 0.37}", "0.2"),
    "block": (
        "{block: {mass: 0.93, width: 0.4, height: 0.1}}",
        "c: {between: [up.lower_left, low.top], friction: 0.37},"
        "d: {between: [up.lower_right, low.top], friction: 0.37}",
        "0.25, angle: 0",
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("excess", [1e-6, 1e-8, 1e-10])
@pytest.mark.parametrize("name", ON_TOP)
def test_slips_of_what_stands_on_a_block_are_counted_too(
    tmp_path: Path, name: str, excess: float
) -> None:
    """Its friction is that of a normal force, which all rows give together."""
    body, contacts, height = ON_TOP[name]
    friction = 0.37 * 0.93 * 9.80665
    most = friction * (1 + excess)
    text = STACK.replace("BODY", body).replace("CONTACTS", contacts).replace("HEIGHT", height)
    case = scenes.typed(tmp_path, text.replace("MOST", repr(most)))
    found = [c.time for c in follow(scenes.mechanism(case), np.linspace(0.0, 2.0, 6)).changes]
    with mpmath.workdps(40):
        known = slips(most, mpmath.mpf(0.37) * mpmath.mpf(0.93) * mpmath.mpf(9.80665), 4.3, 2.0)
    assert len(found) == len(known)
    room = within(friction, 4.3, excess, 4, len(known))  # ulp: measured 2.4, of the whole force
    assert np.all(np.abs(np.subtract(found, known)) <= room)


@pytest.mark.slow
@pytest.mark.mutant("friction of what slides larger by a hundred of its roundings")
def test_friction_that_is_hardly_larger_is_seen_in_a_short_slip(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = element.Touching.coulomb

    def larger(self: Any, state: Any) -> Any:
        return [replace(law, factor=law.factor * (1 + 2e-14)) for law in sound(self, state)]

    monkeypatch.setattr(element.Touching, "coulomb", larger)
    with pytest.raises(AssertionError):
        test_slips_of_what_stands_on_a_block_are_counted_too(tmp_path, "block", 1e-8)


# Phases at which a force that is above friction by 1e-8 of it passes friction, about.
AT_BOUND = (math.asin(1.0 / (1.0 + 1e-8)) + np.arange(-2000, 2000) * 1e-12).tolist()


CLOCK = "a first step shorter than an ulp of the time"
LEAP = "a rounding that the shortest of steps does not see"
SIGN = "a speed that has the wrong sign by rounding, at first"
CREEP = "a first step that sees nothing but rounding"
AGAIN = {  # a scene, mass, friction, a sine's amplitude, frequency and phase, the end, samples
    CLOCK: (
        SLIDE, "0.5963534737096239", "static: 1.4585736856695222, kinetic: 1.4522767199911273",
        1.4587917264899888, 10.548419051921188, 0.0, 1.9082279576994505, 6,
    ),
    "a rounding as loud as what begins from zero, after a step": (
        FLOOR, "2.997564705809844", "0.07860690712319751",
        2.3107664939252817, 9.86639278279836, 0.7819065326608694, 1.532678376153763, 101,
    ),
    LEAP: (
        SLIDE, "1.4029633665812846", "kinetic: 3.7686232298388864",
        3.7686232302312295, 2.7851606784255187, 1.3212706719596934, 5.608668769600543, 101,
    ),
    SIGN: (
        SLIDE, "0.014067030101609701", "kinetic: 5.853087422550988",
        5.8530874246622835, 19.245285512699287, 2.069285336328778, 1.2686566344384145, 101,
    ),
    CREEP: (
        SLIDE, "0.01813715894142108",
        "static: 0.34770983113384557, kinetic: 0.34767678995901496",
        0.3477098833763602, 24.910182154226344, 0.0, 0.8399243952906374, 3,
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", AGAIN)
def test_a_slip_is_followed_as_often_as_it_comes_back(tmp_path: Path, name: str):
    """A sine just above friction: each half of its period has the slip of the one before."""
    scene, mass, friction, most, omega, phase, end, samples = AGAIN[name]
    sine = f"{{amplitude: [{most!r}, 0], angular_frequency: {omega!r}, phase: {phase!r}}}"
    text = scene.replace("mass: 1", f"mass: {mass}").replace("START", "0")
    text = text.replace("FRICTION", friction).replace("friction: 0.3", f"friction: {friction}")
    text = text.replace("PULL", f"push: {{push: block.center, sine: {sine}}}")
    times = np.linspace(0.0, end, samples)
    found = follow(scenes.mechanism(scenes.typed(tmp_path, text)), times).changes
    first = np.ceil(phase / np.pi - 0.5)  # peak; an even one pushes forward
    peaks = np.arange(((first + 0.5) * np.pi - phase) / omega, end, np.pi / omega)
    joint = "guide" if scene is SLIDE else "touch"
    ways = [f"{joint} {way}" for way in ("slides +", "sticks", "slides -", "sticks")]
    ways = ways[2 * int(first % 2) :] + ways * len(peaks)
    assert [c.mode_after for c in found] == ways[: 2 * len(peaks)]
    late = 1e-9  # s: what is 1e-10 above friction has its rounding of 1e-16 for some 1e-11 s
    both = np.array([c.time for c in found]).reshape(-1, 2)
    np.testing.assert_allclose(np.diff(both, axis=0), np.pi / omega, rtol=0, atol=late)


@pytest.mark.slow
@pytest.mark.mutant("the rounding of a slope is heard beyond the first step only of rest at zero")
def test_short_slips_are_missed_within_a_first_step(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    sound = march._Walker._listen

    def within(walker: march._Walker, h: float) -> None:
        walker.begun = walker.begun or bool(walker.peak.any())
        walker.quiet = walker.quiet and not walker.begun
        sound(walker, h)

    monkeypatch.setattr(march._Walker, "_listen", within)
    with pytest.raises((AssertionError, Stuck)):
        test_a_slip_is_followed_as_often_as_it_comes_back(tmp_path, LEAP)


@pytest.mark.slow
@pytest.mark.mutant("what the shortest of steps does not see is not listened to")
def test_what_the_shortest_steps_do_not_see_ends_the_motion(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    monkeypatch.setattr(march._Walker, "start", lambda walker: None)
    with pytest.raises(Stuck, match="underflows"):
        test_a_slip_is_followed_as_often_as_it_comes_back(tmp_path, LEAP)


@pytest.mark.slow
@pytest.mark.mutant("a first step shorter than the clock can tell, which is not listened to")
def test_a_first_step_within_the_leaps_of_the_clock_gets_nowhere(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """Either of the two is enough here."""
    monkeypatch.setattr(march._Walker, "start", lambda walker: None)
    test_a_slip_is_followed_as_often_as_it_comes_back(tmp_path, CLOCK)
    monkeypatch.setattr(march, "TICKS", 0)
    with pytest.raises(Stuck):
        test_a_slip_is_followed_as_often_as_it_comes_back(tmp_path, CLOCK)


@pytest.mark.slow
@pytest.mark.mutant("a mode ends at once where its guard falls by rounding")
def test_a_speed_of_rounding_that_counts_is_a_stop(tmp_path: Path, monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(Early, "rounding", lambda *given: None)
    with pytest.raises((AssertionError, ZenoError)):  # it stops where it does not, or without end
        test_a_slip_is_followed_as_often_as_it_comes_back(tmp_path, SIGN)


@pytest.mark.slow
@pytest.mark.mutant("a first step that is short is not listened to before it is taken")
def test_a_first_step_that_is_not_listened_to_creeps(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    sound = march._Walker._listen

    def deaf(walker: march._Walker, h: float) -> None:
        """A later step hears it too, and makes up for it."""
        walker.quiet = walker.quiet and not walker.begun
        sound(walker, h)

    monkeypatch.setattr(march._Walker, "start", lambda walker: None)
    test_a_slip_is_followed_as_often_as_it_comes_back(tmp_path, CREEP)
    monkeypatch.setattr(march._Walker, "_listen", deaf)
    with pytest.raises(Stuck, match="shrink"):
        test_a_slip_is_followed_as_often_as_it_comes_back(tmp_path, CREEP)


@pytest.mark.parametrize("samples", [3, 31])
def test_what_starts_at_the_bound_slips_at_once(tmp_path: Path, samples: int):
    """A force that is 3 N at first, more for 2.8e-4 s, and less: all that within a first step."""
    most, bound = 3.0 * (1.0 + 1e-8), 3.0
    phase = next(p for p in AT_BOUND if most * math.sin(p) == bound)
    sine = f"{{amplitude: [{most!r}, 0], angular_frequency: 1, phase: {phase!r}}}"
    text = SLIDE.replace("FRICTION", "kinetic: 3").replace("START", "0")
    text = text.replace("PULL", f"push: {{push: block.center, sine: {sine}}}")
    times = np.linspace(0.0, 2.0, samples)
    found = follow(scenes.mechanism(scenes.typed(tmp_path, text)), times).changes
    assert [c.mode_after for c in found] == ["guide slides +", "guide sticks"]
    # v = a (cos φ − cos(τ + φ)) − 3 τ is zero again at 3 d, where d = √(2e-8) s before the peak.
    assert [c.time for c in found] == pytest.approx([0.0, 3 * math.sqrt(2e-8)], rel=0, abs=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize("start", [0.0, 0.1])
def test_a_spring_pulls_it_loose(tmp_path: Path, start: float):
    """(2.98) with F_s = F: x = u τ − (u/ω) sin ω τ, and v only touches zero at ω τ = 2 π."""
    _, found = moved(tmp_path, "spring", start)
    omega, tau = np.sqrt(2.0), np.maximum(TIMES - 1.5 - start, 0.0)
    np.testing.assert_allclose(found.y[:, 0] - start, tau - np.sin(omega * tau) / omega, atol=1e-12)
    assert [c.name for c in found.changes] == ["guide slips"]


@pytest.mark.parametrize(
    "system",
    [
        GrowingForce(m=1, b=1, F_minus=3, F_plus=3, Fs_minus=3, Fs_plus=3),
        Dynamometer(m=1, c=2, u=2, F_minus=3, F_plus=3, Fs_minus=3, Fs_plus=3),
        AnisotropicDrift(m=1, A=4.5, w=6, F_minus=3, F_plus=2, Fs_minus=3, Fs_plus=2),
    ],
)
def test_hand_written_systems_break_loose(system: System):
    found = follow(system, TIMES)
    assert len(found.changes) >= 1
    for t, y in zip(TIMES.tolist(), found.y, strict=True):
        closed = system.closed_form(t)
        if closed is not None:
            np.testing.assert_allclose(y, np.concatenate(closed), rtol=1e-12, atol=1e-12)
