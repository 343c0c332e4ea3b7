"""A block at rest breaks loose where it should, wherever it stands and however shortly it slips."""

import math
from dataclasses import replace
from typing import Any

import mpmath
import numpy as np
import pytest
from given import scenes

from textmech.cases.case import Case
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import AtEvent, Side
from textmech.reference.integrators import march
from textmech.reference.integrators.dop853 import DOP853
from textmech.reference.mechanism.modes import element
from textmech.reference.motion import follow as following
from textmech.reference.motion.follow import Change, follow
from textmech.reference.motion.mode_onset import Early
from textmech.reference.motion.stuck import Stuck
from textmech.reference.motion.zeno import ZenoError
from textmech.reference.solve import mechanism, solve
from textmech.reference.system import System
from textmech.reference.systems.friction.anisotropic_drift import AnisotropicDrift
from textmech.reference.systems.friction.dynamometer import Dynamometer
from textmech.reference.systems.friction.growing_force import GrowingForce
from textmech.reports.compare.events.states import reference_states
from textmech.reports.compare.events.times import reference_events

Patch = pytest.MonkeyPatch
SLIDE, FLOOR = "dry_slide", "block_on_floor"
G = 9.80665  # m/s²
TIMES = np.linspace(0.0, 6.0, 25)


def pushed(name: str, *forces: str, more: str = "", **parameters: Any) -> Case:
    """A block that is pushed by these laws, and what else is said of it."""
    entries = ", ".join(f"p{k}: {{push: block.center, {f}}}" for k, f in enumerate(forces))
    return scenes.scene(name, f"scene: {{forces: {{{entries}}}}}\n{more}", **parameters)


def sine(most: float, omega: float, phase: float = 0.0) -> str:
    wave = f"amplitude: [{most!r}, 0], angular_frequency: {omega!r}, phase: {phase!r} rad"
    return f"sine: {{{wave}}}"


def changes(case: Case, times: np.ndarray) -> tuple[Change, ...]:
    return follow(scenes.mechanism(case), times).changes


@pytest.mark.slow
@pytest.mark.parametrize("start", [0.0, 0.1])
@pytest.mark.parametrize(
    ("name", "parameters"), [(SLIDE, {}), (SLIDE, {"static": 3.0001}), (FLOOR, {})]
)
def test_from_anywhere_it_is_the_same_motion(
    name: str, parameters: dict[str, Any], start: float
) -> None:
    """x = (t³ − t₀³)/6 − (t − t₀) t₀²/2 − (F − t₀)(t − t₀)²/2 from t₀ = F_s on."""
    case = pushed(name, "ramp: [1, 0]", x=start, **parameters)
    found = follow(scenes.mechanism(case), TIMES)
    kinetic = 3.0 if name == SLIDE else 0.3 * G
    static = parameters.get("static", kinetic)
    tau = np.maximum(TIMES - static, 0.0)
    known = tau**3 / 6 + (static - kinetic) * tau**2 / 2
    np.testing.assert_allclose(found.y[:, 0] - start, known, rtol=1e-13, atol=1e-13)
    assert len(found.changes) == 1


@pytest.mark.slow
@pytest.mark.parametrize("name", [SLIDE, FLOOR])
@pytest.mark.parametrize("rate", [0.1, 1e-5])
def test_a_weak_ramp_breaks_it_loose_when_it_should(name: str, rate: float) -> None:
    """x = rate τ³/6 from 0.31 s on, where the force is the bound but for its rounding."""
    bound = 3.0 if name == SLIDE else 0.3 * G
    case = pushed(name, f"constant: [{bound - rate * 0.31!r}, 0]", f"ramp: [{rate:.1e}, 0]")
    times = np.linspace(0.0, 1.0, 26)
    found = follow(scenes.mechanism(case), times)
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
@pytest.mark.parametrize("excess", [1e-6, 1e-10])
@pytest.mark.parametrize(("omega", "samples", "start"), [(5, 101, 0.1), (5, 3, 0)])
def test_slips_are_counted_however_short(
    omega: float, samples: int, start: float, excess: float
) -> None:
    """The later slips begin where an earlier one ended: a place of 1e-17 m is not rest at zero."""
    most = 3 * (1 + excess)
    case = pushed(SLIDE, sine(most, omega), x=start)
    found = [c.time for c in changes(case, np.linspace(0.0, 2.0, samples))]
    known = slips(most, 3, omega, 2.0)
    assert len(found) == len(known)
    # Of the push, by its sine and by its product; the difference of what is as large is exact.
    assert np.all(np.abs(np.subtract(found, known)) <= within(3.0, omega, excess, 1, len(known)))


STACK = """\
scene:
  bodies: {{low: {{block: {{mass: 2.1, width: 10, height: 0.2}}}}, up: {body}}}
  contacts: {{a: {{between: [low.lower_left, ground.floor], friction: 5}},
             b: {{between: [low.lower_right, ground.floor], friction: 5}}, {contacts}}}
  forces: {{push: {{push: up.center, sine: {{amplitude: [{most!r}, 0], angular_frequency: 4.3}}}}}}
initial: {{low: {{x: 0.1, y: 0.1, angle: 0}}, up: {{x: 0, y: {height}, vx: 0, vy: 0}}}}
allow: {{up.x: 1.0e-3}}
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
@pytest.mark.parametrize(("name", "excess"), [("particle", 1e-10), ("block", 1e-6)])
def test_slips_of_what_stands_on_a_block_are_counted_too(name: str, excess: float) -> None:
    """Its friction is that of a normal force, which all rows give together."""
    body, contacts, height = ON_TOP[name]
    friction = 0.37 * 0.93 * G
    most = friction * (1 + excess)
    text = STACK.format(body=body, contacts=contacts, height=height, most=most)
    found = [c.time for c in changes(scenes.parsed(text), np.linspace(0.0, 2.0, 6))]
    with mpmath.workdps(40):
        known = slips(most, mpmath.mpf(0.37) * mpmath.mpf(0.93) * mpmath.mpf(G), 4.3, 2.0)
    assert len(found) == len(known)
    room = within(friction, 4.3, excess, 4, len(known))  # ulp: measured 2.4, of the whole force
    assert np.all(np.abs(np.subtract(found, known)) <= room)


@pytest.mark.slow
@pytest.mark.mutant("friction of what slides larger by a hundred of its roundings")
def test_friction_that_is_hardly_larger_is_seen_in_a_short_slip(monkeypatch: Patch) -> None:
    sound = element.Touching.coulomb

    def larger(self: Any, state: Any) -> Any:
        return [replace(law, factor=law.factor * (1 + 2e-14)) for law in sound(self, state)]

    monkeypatch.setattr(element.Touching, "coulomb", larger)
    with pytest.raises(AssertionError):
        test_slips_of_what_stands_on_a_block_are_counted_too("block", 1e-8)


CLOCK = "a first step shorter than an ulp of the time"
LEAP = "a rounding that the shortest of steps does not see"
SIGN = "a speed that has the wrong sign by rounding, at first"
CREEP = "a first step that sees nothing but rounding"
AGAIN: dict[str, tuple[str, dict[str, Any], tuple[float, float, float], float, int]] = {
    # a scene, its parameters, a sine's amplitude, frequency and phase, the end, samples
    CLOCK: (
        SLIDE,
        {"m": 0.5963534737096239, "static": 1.4585736856695222, "kinetic": 1.4522767199911273},
        (1.4587917264899888, 10.548419051921188, 0.0), 1.9082279576994505, 6,
    ),
    "a rounding as loud as what begins from zero, after a step": (
        FLOOR, {"m": 2.997564705809844, "mu": 0.07860690712319751},
        (2.3107664939252817, 9.86639278279836, 0.7819065326608694), 1.532678376153763, 101,
    ),
    LEAP: (
        SLIDE,
        {"m": 1.4029633665812846, "static": 3.7686232298388864, "kinetic": 3.7686232298388864},
        (3.7686232302312295, 2.7851606784255187, 1.3212706719596934), 5.608668769600543, 101,
    ),
    SIGN: (
        SLIDE,
        {"m": 0.014067030101609701, "static": 5.853087422550988, "kinetic": 5.853087422550988},
        (5.8530874246622835, 19.245285512699287, 2.069285336328778), 1.2686566344384145, 101,
    ),
    CREEP: (
        SLIDE,
        {"m": 0.01813715894142108, "static": 0.34770983113384557, "kinetic": 0.34767678995901496},
        (0.3477098833763602, 24.910182154226344, 0.0), 0.8399243952906374, 3,
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("name", AGAIN)
def test_a_slip_is_followed_as_often_as_it_comes_back(name: str) -> None:
    slips_of_each_period(name)


def slips_of_each_period(name: str, faster: float = 1.0) -> None:
    """A sine just above friction: each half of its period has the slip of the one before."""
    scene, parameters, (most, omega, phase), end, samples = AGAIN[name]
    omega *= faster
    case = pushed(scene, sine(most, omega, phase), **parameters)
    found = changes(case, np.linspace(0.0, end, samples))
    first = np.ceil(phase / np.pi - 0.5)  # peak; an even one pushes forward
    peaks = np.arange(((first + 0.5) * np.pi - phase) / omega, end, np.pi / omega)
    joint = "guide" if scene is SLIDE else "touch"
    ways = [f"{joint} {way}" for way in ("slides +", "sticks", "slides -", "sticks")]
    ways = ways[2 * int(first % 2) :] + ways * len(peaks)
    assert [c.mode_after for c in found] == ways[: 2 * len(peaks)]
    late = 1e-9  # s: what is 1e-10 above friction has its rounding of 1e-16 for some 1e-11 s
    both = np.array([c.time for c in found]).reshape(-1, 2)
    np.testing.assert_allclose(np.diff(both, axis=0), np.pi / omega, rtol=0, atol=late)


def slips_at_several_frequencies(name: str) -> None:
    """In which of them rounding speaks is the processor's."""
    for k in range(24):
        slips_of_each_period(name, 1 + 7e-4 * k)


LISTEN = march._Walker._listen
NOTHING = (march._Walker, "start", lambda walker: None)


def _within(walker: march._Walker, h: float) -> None:
    walker.begun = walker.begun or bool(walker.peak.any())
    walker.quiet = walker.quiet and not walker.begun
    LISTEN(walker, h)


def _deaf(walker: march._Walker, h: float) -> None:
    walker.quiet = walker.quiet and not walker.begun
    LISTEN(walker, h)


# Of each mistake: the motion, what is planted (before the last nothing comes of it), how it ends.
UNHEARD: dict[str, tuple[str, list[tuple[Any, str, Any]], Any, str]] = {
    "the rounding of a slope is heard beyond the first step only of rest at zero": (
        LEAP, [(march._Walker, "_listen", _within)], (AssertionError, Stuck), "",
    ),
    "what the shortest of steps does not see is not listened to": (
        LEAP, [NOTHING], Stuck, "underflows",
    ),
    # Either of the two is enough here.
    "a first step shorter than the clock can tell, which is not listened to": (
        CLOCK, [NOTHING, (march, "TICKS", 0)], Stuck, "",
    ),
    # It stops where it does not, or without end.
    "a mode ends at once where its guard falls by rounding": (
        SIGN, [(Early, "rounding", lambda *given: None)], (AssertionError, ZenoError), "",
    ),
    # A later step hears it too, and makes up for it.
    "a first step that is short is not listened to before it is taken": (
        CREEP, [NOTHING, (march._Walker, "_listen", _deaf)], Stuck, "shrink",
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.mutant("{mistake}")
@pytest.mark.parametrize("mistake", UNHEARD)
def test_what_is_not_listened_to_is_seen(mistake: str, monkeypatch: Patch) -> None:
    name, planted, ends, words = UNHEARD[mistake]
    *before, last = planted
    for plant in before:
        monkeypatch.setattr(*plant)
        slips_of_each_period(name)
    monkeypatch.setattr(*last)
    with pytest.raises(ends, match=words or None):
        slips_at_several_frequencies(name)


@pytest.mark.parametrize("samples", [3, 31])
def test_what_starts_at_the_bound_slips_at_once(samples: int) -> None:
    """A force that is 3 N at first, more for 2.8e-4 s, and less: all that within a first step."""
    most, bound = 3.0 * (1.0 + 1e-8), 3.0
    near = math.asin(1.0 / (1.0 + 1e-8)) + np.arange(-2000, 2000) * 1e-12
    phase = next(p for p in near.tolist() if most * math.sin(p) == bound)
    found = changes(pushed(SLIDE, sine(most, 1.0, phase)), np.linspace(0.0, 2.0, samples))
    assert [c.mode_after for c in found] == ["guide slides +", "guide sticks"]
    # v = a (cos φ − cos(τ + φ)) − 3 τ is zero again at 3 d, where d = √(2e-8) s before the peak.
    assert [c.time for c in found] == pytest.approx([0.0, 3 * math.sqrt(2e-8)], rel=0, abs=1e-9)


@pytest.mark.slow
def test_a_spring_pulls_it_loose() -> None:
    """(2.98) with F_s = F: x = u τ − (u/ω) sin ω τ, and v only touches zero at ω τ = 2 π."""
    text = """\
scene:
  points: {hook: {at: [5, 0], velocity: [1, 0]}}
  forces: {pull: {spring: [block.center, ground.hook], stiffness: 2, rest_length: 5}}
"""
    found = follow(scenes.mechanism(scenes.scene(SLIDE, text, x=0.1)), TIMES)
    omega, tau = np.sqrt(2.0), np.maximum(TIMES - 1.5 - 0.1, 0.0)
    np.testing.assert_allclose(found.y[:, 0] - 0.1, tau - np.sin(omega * tau) / omega, atol=1e-12)
    assert [c.name for c in found.changes] == ["guide slips"]


@pytest.mark.parametrize(
    "system",
    [
        GrowingForce(m=1, b=1, F_minus=3, F_plus=3, Fs_minus=3, Fs_plus=3),
        Dynamometer(m=1, c=2, u=2, F_minus=3, F_plus=3, Fs_minus=3, Fs_plus=3),
        AnisotropicDrift(m=1, A=4.5, w=6, F_minus=3, F_plus=2, Fs_minus=3, Fs_plus=2),
    ],
)
def test_hand_written_systems_break_loose(system: System) -> None:
    found = follow(system, TIMES)
    assert len(found.changes) >= 1
    for t, y in zip(TIMES.tolist(), found.y, strict=True):
        closed = system.closed_form(t)
        if closed is not None:
            np.testing.assert_allclose(y, np.concatenate(closed), rtol=1e-12, atol=1e-12)


# What begins on a sample, or just before one: there is no size yet, and no step leads there.


def set_off(early: float, samples: int, ramp: float = -1.0) -> Case:
    """A ramp of 1 N/s sets it off at 3 s, or so much earlier [s]."""
    more = f"duration: 6\nsamples: {samples}\nallow: {{block.vx: 0.01}}"
    return pushed(FLOOR, f"ramp: [{ramp}, 0]", more=more, mu=(3.0 - early) / G)


@pytest.mark.slow
@pytest.mark.parametrize("early", [0.0, 6.7e-16, 3e-14, -2e-13, 1e-11, 1e-7])
@pytest.mark.parametrize(("samples", "ramp"), [(61, -1.0), (5, 1.0)])
def test_a_block_that_is_set_off_at_a_sample(early: float, samples: int, ramp: float) -> None:
    """(2.88) v̇ = b (t − t₀) − μ g + b t₀: x = b (t − t₀)³/6."""
    case = set_off(early, samples, ramp)
    found = solve(case)
    assert found.holds
    after = np.maximum(0.0, case.times - (3.0 - early))
    x, _, _, vx, _, _ = found.trajectory.states["block"].T
    np.testing.assert_allclose(x, ramp * after**3 / 6, atol=1e-12)
    np.testing.assert_allclose(vx, ramp * after**2 / 2, atol=1e-12)


@pytest.mark.mutant("a step from an event to the sample that comes at once")
def test_a_step_of_rounding_is_no_step(monkeypatch: Patch) -> None:
    case = set_off(3e-14, 5)
    monkeypatch.setattr(following, "on_sample", lambda t, samples: t)
    with pytest.raises(Stuck):
        follow(mechanism(case), case.times)


# A force that jumps where a mode ends has done nothing in it: its last row has what was before.


@pytest.mark.slow
@pytest.mark.mutant("a force that jumps at a corner has acted in the mode that it ends")
def test_what_lifts_at_a_corner_has_pressed_until_then() -> None:
    more = """\
events: {up: {touch.normal: falls to zero}, go: {block.vy: leaves zero}}
allow: {block.x: null, block.y: 0.01, go.touch.normal.before: 0.1}
"""
    case = pushed(FLOOR, "step: {amplitude: [0, 20], at: 0.73}", more=more)
    record = solve(case).trajectory.record
    assert record is not None
    normal = observe(case.scene, record, "touch.normal")
    assert set(normal.tolist()) == {G, 0.0}  # and nothing of 9.81 − 20
    assert reference_events(case.scene, record, case.events["go"]).tolist() == [0.73]
    assert not len(reference_events(case.scene, record, case.events["up"]))


@pytest.mark.slow
@pytest.mark.parametrize(("side", "friction"), [("before", 0.0), ("after", -3.0)])
def test_what_breaks_loose_at_a_corner_was_not_pushed_before(side: Side, friction: float) -> None:
    more = """\
events: {go: {guide.slip: leaves zero}}
allow: {go.guide.friction.before: 0.1, go.guide.friction.after: 0.1}
"""
    case = pushed(SLIDE, "step: {amplitude: [15, 0], at: 0.73}", more=more, m=2, static=6)
    record = solve(case).trajectory.record
    assert record is not None
    at = AtEvent("go", "guide.friction", side)
    (found,) = reference_states(case, record, at, np.array([0.73]))
    assert found == pytest.approx(friction, abs=1e-12)
