"""What touches a floor and rubs on it: modes that contradict, points that share a slip."""

import itertools
import math

import numpy as np
import pytest
from given import scenes
from given.laws.refused import refused
from scipy.integrate import quad

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Anchor, Contact, Scene, shape
from textmech.reference import refusal
from textmech.reference.mechanism.modes import mechanism
from textmech.reference.mechanism.modes.element import State
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.mechanism.modes.shared_friction import ways
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


@pytest.mark.slow
def test_a_slide_breaks_loose_on_a_sample():
    """The ramp reaches 6 N at 0.6 s; then x⃛ = 10/3, ẍ = 1 at first."""
    case = scenes.parsed(BROKEN_LOOSE, tail=scenes.tail(2.0, 51))
    found = solve(case)
    assert found.holds
    t = np.maximum(case.times - 0.6, 0.0)
    known = t**2 / 2 + 10 / 18 * t**3
    np.testing.assert_allclose(found.trajectory.states["a"][:, 0], known, atol=1e-13)


@pytest.mark.slow
@pytest.mark.mutant("the way of a slide that breaks loose taken for the other one")
def test_a_way_taken_for_the_other_is_seen(monkeypatch: pytest.MonkeyPatch):
    """The slide stops as it starts: whether that ends in a check or in a refusal, rounding says."""
    other = {1: -1, -1: 1, 0: 0}
    sound = mechanism.sign
    case = scenes.parsed(BROKEN_LOOSE, tail=scenes.tail(0.64, 17))
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
  contacts: {CONTACTS}
  forces:
    p: {push: rod.center, sine: {amplitude: [10, -2], angular_frequency: 17, phase: 1.9}}
initial: {rod: {angle: -0.71, on: [end, start]}}
allow: {rod.angle: 1.0e-2}
"""
ENDS = [
    "foot: {between: [rod.end, ground.floor], friction: 0.37}",
    "top: {between: [rod.start, ground.wall], friction: 0.46}",
]


def phases(ends: list[str]) -> list[tuple[float, dict[str, str]]]:
    """When the ladder goes on otherwise, and what each end does then."""
    made = scenes.mechanism(scenes.parsed(LADDER.replace("CONTACTS", ", ".join(ends))))
    assert isinstance(made, PlanarMechanism)
    names = [e.name for e in made.elements]
    return [
        (change.time, dict(zip(names, made.built.states[change.mode_after], strict=True)))
        for change in follow(made, np.linspace(0.0, 0.5, 11)).changes
    ]


@pytest.mark.slow
def test_a_ladder_rests_at_both_ends_in_whatever_order_they_are_told():
    """Both stop at one instant: none goes on to rub at rest, and rubs as nothing says how."""
    one, other = phases(ENDS), phases(ENDS[::-1])
    assert [states for _, states in one] == [states for _, states in other]
    assert [t for t, _ in one] == pytest.approx([t for t, _ in other], abs=1e-12)
    assert one[0][1] == {"foot": "sticks", "top": "sticks"}


@pytest.mark.slow
@pytest.mark.mutant("what stops at the instant of another goes on to slide, at rest")
def test_one_end_of_a_ladder_rests_alone(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(PlanarMechanism, "_stops_too", lambda *_: None)
    with pytest.raises(AssertionError):
        test_a_ladder_rests_at_both_ends_in_whatever_order_they_are_told()


# A stop's gap is an angle: what is none of it does not hang on the scene's size.


def falling(low: float, high: float) -> float:
    """√(l/g) in which a bar falls from rest at one angle to another: ω² = 3 (sin φ₀ − sin φ)."""

    def slowness(s: float) -> float:  # φ = φ₀ − s², which has no pole at rest
        return 2 * s / math.sqrt(3 * (math.sin(high) - math.sin(high - s * s)))

    return float(quad(slowness, 0.0, math.sqrt(high - low), epsabs=1e-13)[0])


@pytest.mark.slow
@pytest.mark.mutant("the gap of a stop is small against a length")
@pytest.mark.parametrize("length", [6.0e-7, 600.0])
def test_a_bar_of_any_length_bounces_on_its_stop(length: float) -> None:
    unit = math.sqrt(length / 9.8)
    stop = "s: {stops: hinge, low: -60 deg, restitution: 0.5}"
    changes = f"scene: {{gravity: 9.8, forces: {{{stop}}}}}\n{scenes.tail(4.8 * unit, 11)}"
    case = scenes.scene("bar_on_pin", changes, m=1e-9, l=length, angle=math.radians(10))
    found = solve(case)
    assert [check for check in found.checks if not check.holds] == []
    low, high = math.radians(-60), math.radians(10)
    back = math.asin(math.sin(low) + 0.25 * (math.sin(high) - math.sin(low)))  # at half the rate
    first = falling(low, high)
    strikes = [first, first + 2 * falling(low, back)]
    assert np.max(np.abs(found.trajectory.switches[:2] / unit - strikes)) < 1e-9  # of quadrature


G = 9.80665


def lying(pull: str, asked: str = "", **changed: float) -> Case:
    """A bar that lies on both its ends, and is pulled."""
    changes = f"scene: {{forces: {{pull: {{push: bar.center, {pull}}}}}}}\n{asked}"
    return scenes.scene("bar_over_floor", changes, **changed)


def changes(case: Case) -> list[tuple[float, str]]:
    """When the mode changes, and what comes then."""
    found = follow(scenes.mechanism(case), case.times)
    return [(change.time, change.mode_after) for change in found.changes]


@pytest.mark.parametrize(("a", "b", "vx"), [(0.3, 0.3, 1.0), (0.5, 0.1, -1.0), (0.1, 0.5, 1.0)])
def test_both_stop_at_once(a: float, b: float, vx: float):
    """At |v| / (μ g), μ their mean; and then one holds what the other leaves."""
    ((t, mode),) = changes(lying("constant: [0, 0]", mu_a=a, mu_b=b, vx=vx))
    assert t == pytest.approx(1 / (0.3 * G), abs=1e-12)
    assert mode == "a sticks, b sticks"


@pytest.mark.slow
@pytest.mark.parametrize(("a", "b", "way"), [(0.1, 0.1, 1), (0.17, 0.03, -1)])
def test_both_break_loose_at_the_sum(a: float, b: float, way: int):
    """(2.89) At 10 t = (μ_a + μ_b) m g/2, and not where the first has all that it can bear."""
    ((t, mode),) = changes(lying(f"ramp: [{10 * way}, 0]", mu_a=a, mu_b=b))
    sign = "+" if way > 0 else "-"
    assert (mode, t) == (f"a slides {sign}, b slides {sign}", pytest.approx(0.01 * G, abs=1e-12))


def test_a_force_to_and_fro_below_the_sum_moves_nothing():
    shake = "sine: {amplitude: [2.9, 0], angular_frequency: 20}"
    assert changes(lying(shake, mu_a=0.5, mu_b=0.1)) == []


@pytest.mark.parametrize(("push", "a"), [(5.0, 5 - 0.3 * G), (2.0, 0.0)])
def test_from_rest_the_sum_decides(push: float, a: float):
    case = lying(f"constant: [{push}, 0]")
    x = follow(scenes.mechanism(case), case.times).y[:, 0]
    np.testing.assert_allclose(x - 0.5, a * case.times**2 / 2, atol=1e-13)


@pytest.mark.slow
def test_a_bar_that_falls_flat_rests():
    lands = "events: {lands: {b.gap: falls to zero}}\nallow: {bar.x: null, bar.y: 0.1, a.normal: 1}"
    case = scenes.scene("bar_over_floor", lands, mu_a=0.6, mu_b=0.6, angle=math.radians(10))
    solution = solve(case)
    assert [check for check in solution.checks if not check.holds] == []
    normal = solution.trajectory.reactions["a.normal"]
    assert normal[-1] == pytest.approx(G / 2, abs=1e-12)


def test_what_is_not_determined_cannot_be_asked_for():
    mistake = refused(lying("constant: [1, 0]", "allow: {b.tangent: 1.0e-3}\n", vx=1.0))
    assert mistake.where == "allow.b.tangent"
    normal = (
        G / 2
    )  # of each corner, and 0.3 of it most: of the sum 1 N one has what the other lacks
    low, high = 1 - 0.3 * normal, 0.3 * normal
    assert f"b.tangent: anything from {-high:.4g} to {-low:.4g} N" in mistake.what


@pytest.mark.slow
def test_while_both_slide_their_frictions_are_known():
    case = lying("constant: [5, 0]", "allow: {b.tangent: 1.0e-3}\n", mu_b=0.1)
    forces = solve(case).trajectory.reactions
    np.testing.assert_allclose(forces["a.tangent"], -0.15 * G, atol=1e-12)
    np.testing.assert_allclose(forces["b.tangent"], -0.05 * G, atol=1e-12)


TIP = "    g0: {between: [b0.end, ground.floor], friction: 0.5}\n"


def feet(count: int) -> str:
    """Bars joined into a line that lies on the floor, each with a foot."""
    ends = [f"    j{i}: {{pin: [b{i}.end, b{i + 1}.start]}}" for i in range(count - 1)]
    rub = [
        f"    f{i}: {{between: [b{i}.start, ground.floor], friction: 0.5}}" for i in range(count)
    ]
    bars = [f"    b{i}: {{bar: {{mass: 1.0, length: 1.0}}}}" for i in range(count)]
    start = ["b0: {x: 0.5, y: 0, angle: 0}", *(f"b{i}: {{angle: 0}}" for i in range(1, count))]
    lines = ["scene:", "  bodies:", *bars, "  joints:", *ends, "  contacts:", *rub]
    return "\n".join([*lines, f"initial: {{{', '.join(start)}}}", "allow: {b0.x: 1.0e-2}\n"])


@pytest.mark.slow
def test_what_is_not_at_its_bound_stays():
    """Two bars in a line break loose where 100 t = μ 2 m g; a block beside them bears its 1 N."""
    rub = "    c: {between: [dot, ground.floor], friction: 0.5}\n"
    text = feet(2).replace("  joints:", "    dot: {particle: {mass: 1.0}}\n  joints:")
    text = text.replace("  contacts:\n", f"  contacts:\n{TIP.replace('b0', 'b1')}{rub}")
    pushes = "pull: {push: b0.center, ramp: [100, 0]}, push: {push: dot.center, constant: [1, 0]}"
    text = text.replace("initial: {", f"  forces: {{{pushes}}}\ninitial: {{dot: {{x: 3, y: 0}}, ")
    case = scenes.parsed(text, tail=scenes.tail(0.12, 3))
    assert scenes.mechanism(case).start()[0].endswith("8 rows hold all")  # of two frictions a sum
    mode = "g0 slides +, c sticks, f0 slides +, f1 slides +"
    assert changes(case) == [(pytest.approx(G / 100, abs=1e-12), mode)]


@pytest.mark.slow
def test_very_many_contacts_are_named(monkeypatch: pytest.MonkeyPatch):
    """4⁹ ways to stick, slide and open, of 2 ms each: 9 minutes, and 4¹² 9 hours."""
    monkeypatch.setattr(refusal, "LIMIT", 2.0)
    for count in (9, 12):
        case = scenes.parsed(feet(count), tail=scenes.tail(0.2, 6))
        mistake = refused(case)
        assert mistake.where == "scene.contacts"
        assert f"{count} elements of bodies that hang together" in mistake.what
        assert f"(f0, f1, f2, f3, f4, f5 and {count - 6} more)" in mistake.what
        assert "what touches and rubs may go on in very many ways" in mistake.what
        assert "--allow-long" in mistake.what


@pytest.mark.mutant("what a body has closed on a plane sticks here and slides there")
def test_ways_are_those_in_which_what_a_body_has_closed_does_alike():
    """Two points of one bar and a foot of another: in the order in which all would be tried."""
    text = feet(2).replace("  contacts:\n", f"  contacts:\n{TIP}")
    elements = scenes.mechanism(scenes.parsed(text, tail=scenes.tail(0.2, 6))).elements
    choices: list[tuple[State, ...]] = [("sticks", "slides +", "slides -", "open")] * 3

    def alike(states: tuple[State, ...]) -> bool:
        rubbing = {e.together: s for e, s in zip(elements, states, strict=True) if s != "open"}
        pairs = zip(elements, states, strict=True)
        return all(s == "open" or s == rubbing[e.together] for e, s in pairs)

    all_of_them = [states for states in itertools.product(*choices) if alike(states)]
    assert [*ways(elements, choices)] == all_of_them
    assert len(all_of_them) == 40
    assert [*ways([], [])] == [()]
