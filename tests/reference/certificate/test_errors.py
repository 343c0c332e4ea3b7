"""What the reference says of its own error: of each observed quantity, and it is true."""

import math
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from given import scenes
from given.laws.certified import stated
from given.laws.refused import refused
from given.machines.examples import only
from given.scenes.claims import claimed

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import at_event, table
from textmech.reference import assumptions
from textmech.reference.certificate import certify, errors, event_time_error, work_error
from textmech.reference.certificate.agreement import Check
from textmech.reference.certificate.errors import EPS, ERROR, SHARE, beyond
from textmech.reference.formalisms import lagrange
from textmech.reference.motion.follow import Change
from textmech.reference.solve import mechanism, solve
from textmech.reference.start import assembly
from textmech.reference.states import answer

Patch = pytest.MonkeyPatch
ASKS = "asks more than can be certified"


def error(case: Case, name: str) -> float:
    return stated(solve(case))[name]


def pendulum(
    angle: str = "24.6 deg", duration: float = 1.0, allow: float = 1e-2, **parameters: float
) -> Case:
    text = f"""\
initial: {{bar: {{angle: {angle}}}}}
duration: {duration}
allow: {{bar.angle: {allow}, hinge.fx: {0.5 * parameters.get("m", 1.2)}}}
"""
    return scenes.scene("pendulum", text, **parameters)


# What is ordinary but fast, small, slow, long or sensitive.
ORDINARY: dict[str, Any] = {
    "from 179 degrees": {"angle": "89 deg", "duration": 10},
    "1 mm, 1 mg": {"l": 1e-3, "m": 1e-6},
    "1 microradian": {"angle": "-90 deg, omega: 1.0e-6", "allow": 1e-8, "duration": 5},
    "1000 km away": {"x": 1e6},
}


@pytest.mark.slow
@pytest.mark.parametrize("name", ORDINARY)
def test_an_ordinary_scene_is_certified(name: str) -> None:
    """Each of them was once refused by a bound that was one number for all motions."""
    assert solve(pendulum(**ORDINARY[name])).holds


@pytest.mark.slow
def test_every_bounded_quantity_has_an_error() -> None:
    for name, case in scenes.SHIPPED.items():
        trajectory, found = scenes.solved(name).trajectory, stated(scenes.solved(name))
        names = {quantity for quantity in case.allow if quantity in table(case.scene)}
        times = {f"{event}.time" for event in case.events} & case.allow.keys()
        states = {name: at for name in case.allow if (at := at_event(name, case.events))}
        assert found.keys() == names | times | states.keys(), name
        for state, at in states.items():  # as everywhere in the motion, and not known better
            size = np.max(np.abs(observe(case.scene, trajectory, at.quantity)))
            assert EPS * size <= found[state] <= 1e-9 * size, (name, state)
        for quantity in names:
            size = np.max(np.abs(observe(case.scene, trajectory, quantity)))
            assert found[quantity] >= EPS * size, (name, quantity)


@pytest.mark.slow
def test_a_bound_that_cannot_be_certified_is_a_mistake_in_its_place() -> None:
    case = replace(pendulum(allow=1e-15), allow={"bar.angle": 1e-15})
    mistake = refused(case)
    assert mistake.where == "allow.bar.angle"
    assert "1e-15 asks more than can be certified: the reference knows this to" in mistake.what
    least = float(mistake.what.split("give at least ")[1].split(",")[0])
    solve(replace(case, allow={"bar.angle": least}))
    with pytest.raises(CaseError):
        solve(replace(case, allow={"bar.angle": least / 3}))
    reach = {"mujoco": {"bar.angle": 1e-15}, "pymunk": {"bar.angle": 1e-6}}
    reaching = replace(case, allow={"bar.angle": 1e-2}, reach=reach)
    assert refused(reaching).where == "reach.mujoco.bar.angle"


@pytest.mark.slow
def test_a_chaotic_motion_asks_for_a_shorter_duration() -> None:
    """Two bars that turn over: an error grows tenfold in half a second."""
    text = """\
initial: {upper: {angle: 80 deg}, lower: {angle: 100 deg}}
duration: 25.0
allow: {lower.angle: 1.0e-2}
"""
    with pytest.raises(CaseError) as caught:
        solve(scenes.scene("two_bars", text))
    for mistake in caught.value.mistakes:
        assert mistake.where.startswith("allow.")
        assert "or a shorter duration" in mistake.what


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [-30.0, 80.0])
def test_the_stated_error_is_true(degrees: float) -> None:
    """Against elliptic functions: never more than three times what is stated."""
    case = pendulum(f"{degrees} deg", 10.0)
    solution = solve(case)
    bar = only("bar_pendulum", phi0=math.radians(degrees))
    closed = [bar.closed_form(t) for t in case.times.tolist()]
    angles = np.array([float(state[0][0]) for state in closed if state is not None])
    off = np.max(np.abs(angles - observe(case.scene, solution.trajectory, "bar.angle")))
    assert off <= 3 * stated(solution)["bar.angle"]


@pytest.mark.parametrize("size", [1e-9, 1e6])
def test_momentum_keeps_its_digits(size: float) -> None:
    """A fixed width of 1 m/s lost nine of them beside 1e-9 m/s."""
    mode, q, v = only("four_bar"), np.array([1.2, 0.3, 1.7]), size * np.array([1.0, -2.0, 0.5])
    matrix = lagrange.mass_matrix(mode, 0.0, q)
    np.testing.assert_allclose(lagrange.momentum(mode, 0.0, q, v), matrix @ v, rtol=1e-13)


@pytest.mark.slow
def test_the_share_is_one_per_cent() -> None:
    case = pendulum("80 deg", 10.0)
    asked = partial(replace, case)
    allow = error(case, "bar.angle") / SHARE
    assert solve(asked(allow={"bar.angle": 1.1 * allow})).holds
    with pytest.raises(CaseError, match=ASKS):
        solve(asked(allow={"bar.angle": 0.9 * allow}))


KNOWN = Check(f"{ERROR}bar.angle", 0.5, SHARE, 5e-3, "rad")
LATE = Check("implicit integrator: events", 1e-3, 1e-10)
OTHERWISE = Check("generated events", math.inf, 1e-10)
NEVER = Check(f"{ERROR}turns.time", math.inf, SHARE, math.inf, "s")


@pytest.mark.parametrize(
    ("broken", "told"),
    [
        # A chaotic motion that switches: it is told at `allow`, and no row of events FAILS.
        ([KNOWN, LATE], ["bar.angle"]),
        ([KNOWN, LATE, OTHERWISE, NEVER], ["bar.angle", "turns.time"]),
        # Answers that differ in a motion that is known are no mistake of the case.
        ([LATE], []),
        ([OTHERWISE, NEVER], []),
        ([NEVER], []),
        ([KNOWN, Check("generated motion", 1.0, 1e-9)], []),
        ([KNOWN, LATE, Check("closed form", 1.0, 1e-12)], []),
    ],
)
def test_events_of_a_motion_that_is_not_known_are_no_second_mistake(
    broken: list[Check], told: list[str]
) -> None:
    case = replace(pendulum(), allow={"bar.angle": 1e-2, "turns.time": 1e-3})
    mistakes = beyond(case, broken)
    assert [mistake.where for mistake in mistakes] == [f"allow.{name}" for name in told]
    assert all("a shorter duration" in mistake.what for mistake in mistakes)


# A start beside a dead centre is known less well than the motion from it.


def beside(short: float) -> Case:
    """A crank and its rod, so many metres short of being stretched."""
    text = f"""\
scene: {{gravity: none}}
initial: {{piston: {{x: {0.8 - short!r}, vx: -0.1}}}}
near: {{crank: {{angle: 0.1}}}}
duration: 1.0e-5
samples: 3
"""
    return scenes.scene("slider_crank", text)


def of_the_crank(case: Case) -> tuple[float, float]:
    """By how much its first angle is off, and what the reference says of that [rad]."""
    found = solve(case)
    assert found.holds
    with mpmath.workdps(40):
        x, l, L = mpmath.mpf(case.initial["piston"].given["x"]), mpmath.mpf(0.2), mpmath.mpf(0.6)
        true = mpmath.acos((l * l + x * x - L * L) / (2 * l * x))  # by the law of cosines
        first = observe(case.scene, found.trajectory, "crank.angle")[0]
        return float(abs(mpmath.mpf(float(first)) - true)), stated(found)["crank.angle"]


@pytest.mark.slow
@pytest.mark.mutant("the error of an ill-conditioned start is nobody's")
@pytest.mark.parametrize("digits", [6, 8])
def test_what_a_start_is_known_to_is_stated(digits: int, monkeypatch: Patch) -> None:
    case = beside(10.0**-digits)
    off, may = of_the_crank(case)
    assert off <= may < 1e-8
    assert may > 1e-13 / math.sqrt(10.0 ** -(digits - 5))
    monkeypatch.setattr(assembly, "ILL", 0.0)
    assert of_the_crank(case)[1] < 1e-15
    assert mechanism(beside(0.1)).beside is None  # a sound start costs no second motion


# Errors are those of the quantity, and not of rounding that it does not have.


@pytest.mark.slow
@pytest.mark.mutant("what turns round where friction has a root is as blurred as what stops there")
def test_what_turns_round_is_known_better_than_what_stops(monkeypatch: Patch) -> None:
    """0.44450132 s by scipy's DOP853; the formula for a stop says 1.3 s."""
    text = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {b: {particle: {mass: 1}}}
  joints: {r: {slide: [ground.O, b.center], along: [1, 0]}}
  forces:
    leg: {spring: [ground.O, b.center], stiffness: 50, rest_length: 0.4}
    v: {viscous: r, coefficient: 0.5, exponent: 0.9}
initial: {b: {x: 0.8}}
events: {z: {r.speed: rises to zero}, m: {b.x: {falls to: 0.5}}}
allow: {b.x: 0.01, z.time: 1.0e-3, m.time: 1.0e-3}
"""
    case = scenes.parsed(text, tail=scenes.tail(0.8, 24))
    assert error(case, "z.time") < 1e-6
    assert error(case, "m.time") < 1e-8
    monkeypatch.setattr(certify, "_rests", lambda change: True)
    with pytest.raises(CaseError, match=ASKS):
        solve(case)


@pytest.mark.mutant("a slide whose name ends another's goes on as that does")
def test_who_stops_is_told_by_his_whole_name() -> None:
    state = np.zeros(2)

    def rests(after: str) -> bool:
        return certify._rests(Change("r stops", 1, 0.1, "", after, state, state))

    assert rests("r sticks, tr slides +")
    assert not rests("tr sticks, r slides -")


@pytest.mark.slow
@pytest.mark.mutant("the noise of a law with a root is told from rest")
def test_what_is_pushed_again_stops_at_a_time_that_is_known(monkeypatch: Patch) -> None:
    """The second stop is 1.3e-7 s off an integration by quarters of the steps."""
    text = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {b: {particle: {mass: 2}}}
  joints: {rail: {slide: [ground.O, b.center], along: [1, 0]}}
  forces:
    oil: {viscous: rail, coefficient: 3.0, exponent: 0.5}
    p: {push: b.center, pulse: {amplitude: [4, 0], from: 1.5, until: 2.0}}
initial: {rail: {shift: 0, speed: 1}}
events: {stops: {rail.speed: stays zero}}
allow: {b.x: 1.0e-3, stops.time: 1.0e-3}
"""
    case = scenes.parsed(text, tail=scenes.tail(4.0, 41))
    assert 1e-9 < error(case, "stops.time") < 1e-5
    monkeypatch.setattr(event_time_error, "FIRST", 0)
    with pytest.raises(CaseError, match=ASKS):
        solve(case)


@pytest.mark.mutant("what moves little is still, far from the origin")
@pytest.mark.parametrize("at", [0.0, 2000.0])
def test_where_a_scene_stands_is_no_motion(at: float) -> None:
    text = f"""\
scene:
  gravity: none
  bodies: {{b: {{particle: {{mass: 1}}}}, c: {{particle: {{mass: 1}}}}}}
  forces: {{s: {{spring: [b.center, c.center], stiffness: 10, rest_length: 1}}}}
initial: {{b: {{x: {at}, y: 0, vx: 3.0e-6}}, c: {{x: {at + 1}, y: 0}}}}
allow: {{b.x: 1.0e-8, s.force: 1.0e-7}}
"""
    motion = solve(scenes.parsed(text, tail=scenes.tail(1.0, 11))).trajectory
    w, t = np.sqrt(20.0), motion.times  # both against each other: x = v (t/2 + sin(w t)/(2 w))
    wanted = np.ptp(3e-6 * (t + np.sin(w * t) / w) / 2)
    assert np.ptp(motion.states["b"][:, 0]) == pytest.approx(wanted, rel=1e-6)


@pytest.mark.slow
@pytest.mark.mutant("a reaction that is none is known to twelve digits of its rounding")
def test_a_reaction_that_is_none_is_known_to_what_stands_beside_it(monkeypatch: Patch) -> None:
    """A hinge along y bears no moment about it: 1e-24 N m are left of the others' 1."""
    text = """\
scene:
  space: 3
  points: {O: [0, 0, 0], Q: [0.5, 0.1, 0]}
  bodies:
    crank: {bar: {mass: 0.5, length: 0.2}}
    rod:
      rigid: {mass: 0.7, inertia: [1.0e-4, 5.0e-3, 5.0e-3, 0, 0, 0]}
      points: {s: [-0.2, 0, 0], e: [0.2, 0, 0]}
    piston: {block: {mass: 0.4, size: [0.05, 0.05, 0.05]}}
  joints:
    q: {hinge: [ground.O, crank.start], axis: [0, 1, 0]}
    b: {ball: [crank.end, rod.s]}
    u: {universal: [rod.e, piston.center], axes: [[0, 1, 0], [0, 0, 1]]}
    g: {slide: [ground.Q, piston.center], along: [1, 0, 0]}
initial: {q: {angle: 40 deg, omega: 10}}
near: {g: {shift: 0.05}}
allow: {q.my: 1.0e-3}
"""
    case = scenes.parsed(text, tail=scenes.tail(0.2, 11))
    assert error(case, "q.my") > 1e-18
    with pytest.raises(CaseError, match=ASKS):
        solve(replace(case, allow={"q.my": 1e-30}))
    monkeypatch.setattr(errors, "_peers", lambda case, motion, name: iter(()))
    assert error(case, "q.my") < 1e-20


@pytest.mark.mutant("a place that cancels is known to its own rounding")
def test_a_sum_is_known_to_its_terms(tmp_path: Path, monkeypatch: Patch) -> None:
    """a.x = L (1 − cos q) of L = 10⁶ m is 5.8e-11 m off, and some 1e-6 m."""
    text = """\
title: A body that hangs far from its hinge, which is as far from the origin
scene:
  space: 3
  points: {O: [1.0e+6, 0, 0]}
  bodies:
    a:
      rigid: {mass: 1.0, inertia: [0.05, 0.04, 0.03, 0, 0, 0]}
      points: {P: [1.0e+6, 0, 0]}
  joints: {j: {hinge: [ground.O, a.P], axis: [0, 0, 1]}}
states: {random: 5, seed: 1, q: [-1.0e-6, 1.0e-6], q_dot: [-2, 2]}
allow: {a.x: 1.0e-6, a.y: 1.0e-3}
"""
    case = claimed(tmp_path, text)
    assert case.states is not None
    q = case.states.drawn(case.scene)["j.angle"][:, 0]
    x = solve(case).trajectory.states["a"][:, 0]
    off = np.max(np.abs(x - 2e6 * np.sin(q / 2) ** 2))
    assert 1e-12 < off <= error(case, "a.x")
    bold = claimed(tmp_path, text.replace("a.x: 1.0e-6", "a.x: 1.0e-12"))
    with pytest.raises(CaseError, match=r"give at least 4e-07\n"):
        solve(bold)
    monkeypatch.setattr(answer, "_rounding_answers", lambda case: {})
    assert error(bold, "a.x") < 1e-2 * off


# Work that samples cannot tell: of what is short, in step with them, or of a blow.


@pytest.mark.slow
@pytest.mark.mutant("work that is none is halved for nobody's bar")
def test_work_that_is_none_costs_nothing(monkeypatch: Patch) -> None:
    text = """\
scene:
  forces: {t: {push: bar.start, sine: {amplitude: [-1.2, -1.1], angular_frequency: 7.7}}}
initial: {bar: {angle: 0.4, omega: 3}}
duration: 0.4
samples: 11
allow: {bar.angle: null, hinge.fx: null, t.work: 1.0e-3, bar.x: 1.0}
"""
    asked = list[int]()
    states = work_error._states

    def counted(answer: Any, parts: Any) -> Any:
        asked.append(1)
        if len(asked) > 3:
            raise RuntimeError("halved again")
        return states(answer, parts)

    monkeypatch.setattr(work_error, "_states", counted)
    case = scenes.scene("pendulum", text, l=0.3, m=1.6)
    assert error(case, "t.work") < 1e-12
    assert len(asked) == 1
    monkeypatch.setattr(work_error, "NOBODY", 0.0)
    with pytest.raises(RuntimeError, match="halved again"):
        solve(case)


BUFFER = (
    "scene: {{forces: {{buffer: {{spring: [cart.center, ball.center], stiffness: {}, "
    "rest_length: 0.2, only: compression}}}}}}\n"
)


def pushed(periods: float) -> Case:
    """A push of so many periods between two samples, which does no work in whole ones."""
    text = f"""\
scene:
  gravity: none
  bodies: {{b: {{particle: {{mass: 1.0}}}}}}
  forces:
    p:
      push: b.center
      sine: {{amplitude: [100, 0], angular_frequency: {math.tau * periods / 0.04!r}, phase: 0.7}}
initial: {{b: {{x: 0, y: 0, vx: 1, vy: 0}}}}
duration: 0.4
samples: 11
allow: {{b.x: 1.0e-2, p.work: 1.0e-2}}
"""
    return scenes.parsed(text, tail="")


def turned() -> Case:
    """A push on a bar that turns in step with the samples."""
    text = f"""\
scene:
  gravity: none
  points: {{O: [0, 0]}}
  bodies: {{b: {{bar: {{mass: 1, length: 0.2}}}}}}
  joints: {{h: {{pin: [ground.O, b.center]}}}}
  forces: {{p: {{push: b.end, constant: [3, 0]}}}}
  drive: {{h.omega: {80 * math.pi!r}}}
initial: {{b: {{angle: 0.7}}}}
duration: 1.0
samples: 11
allow: {{b.end.y: 1.0e-2, p.work: 1.0e-2}}
"""
    return scenes.parsed(text, tail="")


@pytest.mark.slow
@pytest.mark.mutant("a sum over samples that is held against no integral")
def test_work_that_samples_miss_is_not_certified(monkeypatch: Patch) -> None:
    """A buffer that acts for 10 ms between samples 40 ms apart; a period in step with them."""
    assert solve(pushed(0.005)).holds
    for case in (scenes.scene("driven_cart", BUFFER.format(5e4)), pushed(1), pushed(8), turned()):
        with pytest.raises(CaseError, match=ASKS):
            solve(case)
    monkeypatch.setattr(certify, "work_errors", lambda *_: {})
    assert solve(turned()).holds


# A zigzag of a drive, or of a heavy cart, hides what a buffer takes between two samples.
MOVES: dict[str, tuple[str, dict[str, float]]] = {
    "zigzag": (
        "table: {times: [0, 0.2, 0.4, 0.6, 0.8, 1], values: [1, 1.2, 1, 1.2, 1, 1.2]}",
        {"x": 0.685},
    ),
    "heavy": ("sine: {amplitude: 1, angular_frequency: 6.28, phase: 0.5}", {"x": 0.43, "m": 1e3}),
}


@pytest.mark.slow
@pytest.mark.parametrize("how", MOVES)
def test_a_short_contact_beside_a_power_that_moves_is_seen(how: str) -> None:
    """The only source of energy is the drive: its work is what the whole has more at the end."""
    law, parameters = MOVES[how]
    text = BUFFER.format(2e6).replace("scene: {", f"scene: {{drive: {{rail.speed: {{{law}}}}}, ")
    mistake = refused(scenes.scene("driven_cart", text, **parameters))
    assert mistake.where == "allow.rail.work"
    assert ASKS in mistake.what


def passes(high: float, begin: float) -> Case:
    """A cart that passes the foot of a damper, so high above it."""
    text = f"""\
scene:
  gravity: none
  points: {{O: [0, 0], A: [0, {high!r}]}}
  bodies: {{cart: {{particle: {{mass: 1.0}}}}}}
  joints: {{rail: {{slide: [ground.A, cart.center], along: [1, 0]}}}}
  forces: {{oil: {{damper: [ground.O, cart.center], damping: 2.0}}}}
  drive: {{rail.speed: 1.0}}
initial: {{rail: {{shift: {begin!r}}}}}
duration: 2.0
samples: 21
allow: {{cart.x: 1.0e-3, oil.work: 100.0, rail.work: 100.0}}
"""
    return scenes.parsed(text, tail="")


@pytest.mark.slow
@pytest.mark.parametrize(
    ("high", "begin"), [(1e-2, -1.0111), (1e-4, -0.95), (1e-5, -1.03), (1e-5, -0.95)]
)
def test_what_a_driven_motion_does_not_feel_is_counted(high: float, begin: float) -> None:
    """W = −d v (x − h atan(x/h)): the error that is stated is the true one."""
    case = passes(high, begin)
    solution = solve(case)
    low, top = (x - high * math.atan(x / high) for x in (begin, begin + 2.0))
    off = abs(float(observe(case.scene, solution.trajectory, "oil.work")[-1]) + 2.0 * (top - low))
    assert off <= stated(solution)["oil.work"] <= 1.5 * off + 1e-9


@pytest.mark.slow
@pytest.mark.mutant("an integral over whole steps, which feel no force that does not move them")
def test_steps_are_halved(monkeypatch: Patch) -> None:
    """Else much more would be stated than is off."""
    monkeypatch.setattr(work_error, "FINE", math.inf)
    assert error(passes(1e-4, -1.03), "oil.work") > 5 * 6.3e-4  # what is off: -4 + 1e-4 π, nearly


@pytest.mark.parametrize("k", range(0, 24, 2))
def test_the_nodes_integrate_powers(k: int) -> None:
    """∫ tᵏ over (−1, 1) = 2/(k + 1), by seven nodes up to t¹³."""
    powers = work_error.NODES**k
    assert powers @ work_error.FIFTEEN == pytest.approx(2 / (k + 1), rel=1e-15 * (k + 4))
    fewer = powers[1::2] @ work_error.SEVEN
    assert (abs(fewer * (k + 1) / 2 - 1) < 1e-14) == (k < 14)


@pytest.mark.slow
@pytest.mark.mutant("a drive that works through a blow")
def test_work_of_a_drive_through_a_blow_is_refused(monkeypatch: Patch) -> None:
    """J v = 0.5 (1 + 0.5) 1.5 · 1 = 1.125 J, in no time: as a sum over power it is 0."""
    text = """\
scene: {contacts: {knock: {between: [cart, ball], friction: 0, restitution: 0.5}}}
events: {strikes: {knock.gap: falls to zero}}
"""
    case = scenes.scene("driven_cart", text)
    mistake = refused(case)
    assert mistake.where == "allow.rail.work"
    assert "something strikes at 0.34 s" in mistake.what
    monkeypatch.setattr(assumptions, "_blow_work", lambda *_: [])
    assert solve(case).trajectory.times[-1] == 1.0
