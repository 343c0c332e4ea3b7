"""Blows at one instant, and starts and ends that two bodies cannot have: what a file is told."""

import numpy as np
import pytest
from given import scenes
from given.laws.refused import refused
from given.otherwise import otherwise

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import OMEGA, VX
from textmech.reference.mechanism.modes import impact, one_instant, unilateral
from textmech.reference.mechanism.modes import impact_transition as landing
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve


def three(changes: str = "", **words: float) -> Case:
    return scenes.scene("three_disks", changes, **words)


BOTH = "scene: {contacts: {second: {between: [c, a]}}}\n"  # a meets both at once
BESIDE = {"y_b": 0.12, "x_c": 0.5, "y_c": -0.12, "m_b": 2.0}


@pytest.mark.parametrize(
    ("changes", "words", "what"),
    [
        ("", {}, "strikes at t = 0.3 s what second touches and passes on"),
        ("", {"e": 1.0}, "strikes at t = 0.3 s what second touches and passes on"),
        (BOTH, BESIDE, "first and second strike at one instant, t = 0.3"),
    ],
)
def test_a_blow_through_two_contacts_at_one_instant_is_refused(
    changes: str, words: dict[str, float], what: str
) -> None:
    mistake = refused(three(changes, **words))
    assert mistake.where == "scene.contacts.first"
    assert what in mistake.what
    assert "leave a gap" in mistake.what


@pytest.mark.slow
@pytest.mark.parametrize(("e", "x_c"), [(0.5, 0.701), (0.0, 0.7)])
def test_blows_one_after_the_other_are_not(e: float, x_c: float) -> None:
    """Where there is a gap, or all go on together, whatever the order."""
    case = three(e=e, x_c=x_c)
    motion = solve(case).trajectory
    assert observe(case.scene, motion, "momentum.x")[-1] == pytest.approx(1.0)
    assert motion.states["c"][-1, VX] > 0.1


@pytest.mark.slow
@pytest.mark.mutant("two blows at one instant that nobody refuses")
def test_a_check_that_is_left_out_lets_the_blow_pass(monkeypatch: pytest.MonkeyPatch) -> None:
    """The mutant: then the answer is one of many, and nobody is told."""
    monkeypatch.setattr(landing, "passed_on", lambda *given: None)
    assert solve(three()).trajectory is not None


@pytest.mark.parametrize(
    ("x_b", "changes", "where", "message"),
    [
        (0.19, "", "initial", "first starts 10 mm in the rim of a"),
        (0.2, "", "initial", "first starts into the rim of a, with 1 m/s"),
        (
            0.5, "events: {strikes: null}", "scene.contacts.first",
            "starts 0.3 m above the rim of a; if it is meant to fall on it",
        ),
    ],
)  # fmt: skip
def test_a_start_that_cannot_be_is_said(x_b: float, changes: str, where: str, message: str) -> None:
    mistake = refused(three(changes, x_b=x_b, x_c=2.0))
    assert mistake.where == where
    assert message in mistake.what


def test_what_slides_off_the_end_of_a_side_is_said() -> None:
    """The reference's side is a line without an end; the block's is not."""
    text = """\
scene:
  bodies:
    lower: {block: {mass: 2, width: 0.8, height: 0.2}}
    dot: {particle: {mass: 1}}
  contacts:
    left: {between: [lower.lower_left, ground.floor], friction: 0.9}
    right: {between: [lower.lower_right, ground.floor], friction: 0.9}
    touch: {between: [dot, lower.top], friction: 0}
initial: {lower: {x: 0, angle: 0, on: [lower_left, lower_right]}, dot: {x: 0, y: 0.2, vx: 1.0}}
allow: {dot.x: 1.0e-2}
"""
    mistake = refused(scenes.parsed(text))
    assert mistake.where == "scene.contacts.touch"
    assert "dot.center has left the top of lower by t = 0.4" in mistake.what


# With which velocities and turn what it strikes leaves it, if nothing is thrown back.
WALL = """
scene:
  gravity: none
  planes: {wall: {at: [0.8, 0], normal: [-1, 0]}}
  contacts:
    l: {between: [b.lower_right, ground.wall]}
    r: {between: [b.upper_right, ground.wall]}
allow: {b.y: null, b.x: 1.0e-3}
"""
SWAPPED = """
scene:
  contacts:
    l: {between: [b.lower_right, ground.floor]}
    r: {between: [b.lower_left, ground.floor]}
"""
FALLS = {"the floor": "", "the floor, swapped": SWAPPED, "a wall": WALL}


def dropped(changes: str = "", until: str = "", **parameters: float) -> Case:
    """A block whose landing is announced."""
    lands = "events: {one: {l.gap: falls to zero}, other: {r.gap: falls to zero}}\n"
    return scenes.scene("block_over_floor", changes + lands + until, **parameters)


def flat(what: str, e: float, mu: float) -> tuple[float, ...]:
    """vx, vy and omega at the end of a block that strikes with two corners at one instant."""
    vx = 2.0 if what == "a wall" else 0.0
    case = dropped(FALLS[what], scenes.tail(0.6, 41), x=0.2, y=0.6, vx=vx, e=e, mu=mu)
    solution = solve(case)
    assert solution.holds
    return tuple(float(x) for x in solution.trajectory.states["b"][-1, VX:])


EACH = [("the floor", 0.0), ("the floor, swapped", 0.3), ("a wall", 0.3)]


@pytest.mark.slow
@pytest.mark.parametrize(("what", "mu"), EACH)
def test_what_falls_flat_without_bouncing_stays_flat(what: str, mu: float) -> None:
    """Both corners strike in one blow: one after the other would turn it, as the file has them."""
    assert flat(what, 0.0, mu) == pytest.approx((0.0, 0.0, 0.0), abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize(("what", "mu"), EACH)
def test_two_corners_that_bounce_at_one_instant_do_as_one(what: str, mu: float) -> None:
    """A symmetry exchanges them: what falls 0.5 m flat leaves with half of its speed, unturned."""
    vx, vy, omega = flat(what, 0.5, mu)
    assert omega == pytest.approx(0.0, abs=1e-12)
    if what == "a wall":
        assert (vx, vy) == pytest.approx((-1.0, 0.0), abs=1e-12)
    else:
        struck = (2 * 9.80665 * 0.5) ** 0.5
        left = 0.6 - struck / 9.80665
        assert (vx, vy) == pytest.approx((0.0, 0.5 * struck - 9.80665 * left), abs=1e-9)


def test_what_slides_as_it_falls_flat_and_bounces_is_refused() -> None:
    """The friction of one corner turns the block onto the other, or off it: no mirror image."""
    case = dropped(until=scenes.tail(0.6, 41), x=-1.0, y=0.6, vx=1.0, e=0.5, mu=0.3)
    assert "it differs by the order" in refused(case).what


@pytest.mark.slow
def test_bounces_of_two_corners_pile_up_and_it_lies_flat() -> None:
    """Each bounce takes half of the time of the one before: t (1 + 2 (1/2 + 1/4 + …)) = 3 t."""
    case = dropped(until=scenes.tail(1.2, 49), y=0.6, e=0.5)
    solution = solve(case)
    assert solution.holds
    begun = (2 * 0.5 / 9.80665) ** 0.5
    states = solution.trajectory.states["b"]
    assert states[-1, [1, 2, 4, 5]] == pytest.approx([0.1, 0, 0, 0], abs=1e-12)
    lies = case.times > 3 * begun
    assert np.ptp(states[lies, 1]) < 1e-12
    assert np.max(states[case.times < 3 * begun, 1]) > 0.1 + 1e-3


@pytest.mark.parametrize("mu", [0.0, 0.3])
@pytest.mark.slow
def test_a_disk_that_meets_two_at_once_is_slowed_by_both(mu: float) -> None:
    """Each takes J along its normal at the angle ψ: J = (1 + e) v cos ψ/(1 + 2 cos² ψ), of 1 kg.

    With friction T along the tangent beside it, μ J or what stops the slip at both rims.
    """
    solution = solve(three(BOTH, **{**BESIDE, "m_b": 1.0}, mu=mu))
    assert solution.holds
    a, b, c = (solution.trajectory.states[name][-1] for name in "abc")
    sin, cos, e = 0.6, 0.8, 0.5
    if not mu:
        J = (1 + e) * cos / (1 + 2 * cos**2)
        assert a[VX:] == pytest.approx([1 - 2 * J * cos, 0, 0], abs=1e-12)
        assert b[VX:] == pytest.approx([J * cos, J * sin, 0], abs=1e-12)
    assert c[VX:] == pytest.approx(b[VX:] * [1, -1, -1], abs=1e-12)
    assert a[VX] + 2 * b[VX] == pytest.approx(1.0, abs=1e-12)
    opens = (b[VX] - a[VX]) * cos + b[VX + 1] * sin
    assert opens == pytest.approx(e * cos, abs=1e-12)
    slip = (b[VX] - a[VX]) * -sin + b[VX + 1] * cos - 0.1 * b[OMEGA]  # of b's rim against a's
    J = b[VX] * cos + b[VX + 1] * sin
    T = -b[VX] * sin + b[VX + 1] * cos
    assert abs(T) <= mu * J + 1e-12
    assert abs(slip) < 1e-12 or abs(abs(T) - mu * J) < 1e-12


@pytest.mark.mutant("a blow at one instant that all contacts take at once, whatever the order")
def test_a_blow_that_is_not_asked_in_turn_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    every = one_instant._Problem.struck
    monkeypatch.setattr(
        one_instant._Problem,
        "in_turn",
        lambda self, groups, v: every(self, [k for group in groups for k in group], v),
    )
    solve(three())  # which would be refused


@pytest.mark.mutant("what a symmetry exchanges is asked one after the other")
def test_a_symmetry_that_is_not_seen_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(one_instant._Problem, "_symmetries", lambda self, struck, v: iter(()))
    with pytest.raises(CaseError, match="it differs by the order"):
        solve(dropped(until=scenes.tail(0.5, 11), y=0.6, e=0.5))


@pytest.mark.slow
@pytest.mark.mutant(
    "two corners that strike at one instant, one after the other in the file's order"
)
def test_one_after_the_other_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(landing, "strikes_too", lambda *_: False)
    with pytest.raises(AssertionError):
        test_what_falls_flat_without_bouncing_stays_flat("a wall", 0.0)


@pytest.mark.slow
@pytest.mark.parametrize("first", "ab")
def test_two_ropes_that_come_taut_at_one_instant_hold_it_on_their_axis(first: str) -> None:
    each = {k: f"{k}: {{rope: [ground.{k.upper()}, ball.center], length: 0.5}}" for k in "ab"}
    forces = ", ".join([each.pop(first), *each.values()])
    changes = f"""
scene: {{gravity: 9.80665, points: {{A: [-0.3, 1.0], B: [0.3, 1.0]}}, forces: {{{forces}}}}}
events: {{one: {{a.gap: falls to zero}}, other: {{b.gap: falls to zero}}}}
allow: {{ball.x: null, ball.y: 1.0e-3}}
"""
    solution = solve(scenes.scene("free_particle", changes, y=1.0))
    assert solution.holds
    x, y, *_, vx, vy, _ = solution.trajectory.states["ball"][-1]
    assert (x, y, vx, vy) == pytest.approx((0.0, 0.6, 0.0, 0.0), abs=1e-12)


def tall() -> Case:
    return dropped(until=scenes.tail(0.12, 11), m=3.0, w=0.24, h=0.38, y=0.24, vx=-2.0, mu=0.8)


def test_a_tall_block_that_falls_flat_as_it_moves_may_be_stopped_by_one_corner() -> None:
    """It strikes with u = √(2 g 0.05 m). Its left corner alone takes N = 3.85 N s, and slides.

    With r = (−0.12, −0.19) m, J = m (w² + h²)/12: ω = (r_x N − r_y μ N)/J, and the corner's
    −u + N/m + r_x ω is 0. The other corner would have to be pulled.
    """
    case = tall()
    assert solve(case).holds
    (strike,) = follow(scenes.mechanism(case), case.times).changes
    m, mu, x, y = 3.0, 0.8, -0.12, -0.19
    J, u = m * (0.24**2 + 0.38**2) / 12, (2 * 9.80665 * 0.05) ** 0.5
    turned = (x - y * mu) / J  # per N s
    N = u / (1 / m + x * turned)
    assert abs(N - 3.85) < 0.01
    assert strike.after[3:] == pytest.approx([-2.0 + mu * N / m, -u + N / m, N * turned], abs=1e-9)
    assert N / m - u - x * N * turned > 0.1  # it rises


@pytest.mark.mutant("what strikes at the instant of another cannot be thrown up by it")
def test_that_both_corners_have_to_hold_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    blind = otherwise(impact, "alone = len(meetings) == 1", "alone = True")
    monkeypatch.setattr(impact, "_choices", blind._choices)
    with pytest.raises(CaseError, match="no impulse satisfies the friction law"):
        solve(tall())


LEG = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {a: {bar: {mass: 1.0, length: 1.0}}, b: {bar: {mass: 1.0, length: 1.0}}}
  joints: {h: {pin: [ground.O, a.start]}, k: {pin: [a.end, b.start]}}
  forces:
    e: {stops: h, low: -2 deg, restitution: 0.3}
    f: {stops: k, low: 0 deg}
    q: {torque: b, constant: PRESS}
initial: {a: {angle: 0.2, omega: -1}, b: {angle: 0.2, omega: -1}}
allow: {a.angle: 1.0e-3}
"""
PRESSED = ["0.0", "-1.0e-12", "-1.0e-6"]  # N m: bars in line, by rounding or by a force


@pytest.mark.slow
@pytest.mark.mutant("a stop between two bodies taken for one on the ground, which holds a blow")
@pytest.mark.mutant("a stop that touches without a force, asked before a blow whether it closes")
@pytest.mark.parametrize("press", PRESSED)
def test_a_stop_that_touches_is_struck_at_the_same_instant(
    press: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of one blow 0.3 rad/s are left, of one after the other 0.2147: rounding chose."""
    case = scenes.parsed(LEG.replace("PRESS", press), tail=scenes.tail(0.4, 21))
    mistake = refused(case)
    assert mistake.where == "scene.forces.e"
    assert "e.low strikes at t = 0.2349 s what f.low touches and passes on" in mistake.what
    monkeypatch.setattr(unilateral, "_both_bodies", lambda a, b: False)
    monkeypatch.setattr(landing, "_touches", lambda *given: False)
    rates = {"0.0": 0.214687, "-1.0e-12": 0.3, "-1.0e-6": 0.3}
    assert solve(case).trajectory.states["a"][-1, 5] == pytest.approx(rates[press], abs=1e-5)


@pytest.mark.slow
def test_stops_that_throw_nothing_back_are_one_blow() -> None:
    text = LEG.replace("PRESS", "0.0").replace(", restitution: 0.3", "")
    assert solve(scenes.parsed(text, tail=scenes.tail(0.4, 21))).holds
