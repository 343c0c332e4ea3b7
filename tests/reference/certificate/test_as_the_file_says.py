"""Rows that ask the states of the bodies what the file says: each sees what all answers share.

Every mistake here is planted in what the hand-written systems, the mechanism and the engines' start
have in common, so that no answer differs from another; the certificate refuses it all the same.
"""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.certified import broken, certified
from given.scenes.laws_in_time import LAWS

from textmech.cases.case import Case
from textmech.cases.fields.signal import Signal
from textmech.cases.scene.point import GroundPoint
from textmech.reference.certificate.file_checks import integral
from textmech.reference.mechanism.constraints import joint_constraints as permanent
from textmech.reference.mechanism.constraints.constraint_terms import FIRST, SECOND, Given, Turn
from textmech.reference.mechanism.forces import action
from textmech.reference.mechanism.kinematics.frame import Vec
from textmech.reference.mechanism.kinematics.kinematics import Kinematics
from textmech.reference.start import assembly
from textmech.reference.start import positions as start_positions
from textmech.reference.start.closure import Closure
from textmech.reference.start.planar_closure import PlanarClosure
from textmech.reference.start.spatial_closure import SpatialClosure

DRIVES, POINTS, FORCES = (
    f"{what} their laws" for what in ("drives follow", "driven points follow", "forces follow")
)
JOINTS, SLIPS = "joints hold", "nothing slips"
STARTS, NEAR = "starts as it is given", "starts near what is said"
SOLID = "rigid: {mass: 1.3, inertia: [0.2, 0.3, 0.25, 0, 0.02, 0]}"
IN_SPACE = f"""\
scene:
  space: 3
  points: {{O: [0, 0, 0], hook: {{at: [0.5, 0.4, 0.3], velocity: [0.1, -0.2, 0.3]}}}}
  bodies:
    a: {{{SOLID}, points: {{P: [0.1, 0.2, 0.3]}}}}
    b: {{{SOLID}, points: {{P: [-0.2, 0.1, 0]}}}}
    hung: {{{SOLID}, points: {{P: [0, 0, 0.4]}}}}
    sled: {{{SOLID}, points: {{P: [0.1, 0, 0]}}}}
  joints:
    stand: {{hinge: [ground.O, a.center], axis: [1, 2, 2]}}
    turns: {{freedoms: {{p: {{hinge: [0, 0, 1]}}, q: {{hinge: [1, 0, 1]}}}}, of: [a.P, b.P]}}
    neck: {{ball: [ground.hook, hung.P]}}
    table:
      freedoms: {{s: {{slide: [1, 0, 0]}}, u: {{slide: [1, 1, 0]}}, yaw: {{hinge: [0, 0, 1]}}}}
      of: [ground.O, sled.center]
  forces:
    hand: {{push: b.center, sine: {{amplitude: [0.3, 0.1, -0.2], angular_frequency: 3.0}}}}
    twist: {{torque: hung, constant: [0.1, 0, 0.1]}}
    engine: {{motor: turns.q, ramp: 0.5}}
  drive:
    turns.p_dot: {{polynomial: {{coefficients: [0.4, 0.3, -0.5]}}}}
    table.s_dot: {{table: {{times: [0, 0.3], values: [0.2, -0.4]}}}}
initial:
  stand: {{angle: 0.2, omega: 1.0}}
  turns: {{p: 0.3, q: -0.5, q_dot: 0.7}}
  neck: {{attitude: {{axis: [1, 1, 0], angle: 20 deg}}, omega: [0.3, -0.4, 0.9]}}
  table: {{s: 0.1, u: -0.3, u_dot: 0.2, yaw: 0.4, yaw_dot: -0.3}}
allow: {{b.attitude: 1.0}}
"""
IN_PLANE = """\
scene:
  points:
    O: [0, 0]
    hook:
      at: [0.5, 0.4]
      moves: {sine: {amplitude: [0.1, -0.2], angular_frequency: 4.0, phase: 90 deg}}
  bodies:
    a: {bar: {mass: 1.2, length: 0.6}}
    b: {bar: {mass: 1.0, length: 0.5}}
    bob: {particle: {mass: 0.4}}
    sled: {rigid: {mass: 1.5, inertia: 0.2}, points: {P: [0.1, 0]}}
  joints: {hip: {pin: [ground.O, a.start]}, knee: {pin: [a.end, b.start]}}
  constraints: {blade: {edge: sled.P, along: [0.6, 0.8], speed: {ramp: 0.4}}}
  forces:
    coil: {spring: [ground.hook, bob.center], stiffness: 20.0, rest_length: 0.2}
    hand: {push: b.end, ramp: [0.5, 0.1]}
    apart: {couple: [a, b], sine: {amplitude: 0.3, angular_frequency: 3.0, phase: 20 deg}}
    engine: {motor: knee, constant: 0.1}
  drive: {hip.omega: {polynomial: {coefficients: [0.4, 0.3]}}}
initial:
  hip: {angle: 400 deg}
  knee: {angle: 0.5, omega: -0.3}
  bob: {from: ground.hook, length: 0.5, direction: 250 deg, vx: 0.1, vy: 0}
  sled: {P: [0.3, 0.2], angle: 0.3, omega: 0.5}
allow: {b.angle: 1.0}
"""


def checks(case: Case | str) -> dict[str, Any]:
    """All rows by name."""
    case = scenes.parsed(case, tail=scenes.tail(0.6, 7)) if isinstance(case, str) else case
    return {check.name: check for check in certified(case)}


@pytest.mark.slow
@pytest.mark.parametrize("text", [IN_PLANE, IN_SPACE], ids=["plane", "space"])
def test_what_is_sound_holds(text: str) -> None:
    found = checks(text)
    assert found.keys() >= {DRIVES, POINTS, FORCES, JOINTS, STARTS}
    assert broken(found.values()) == set()


@pytest.mark.parametrize("law", LAWS)
def test_the_quadrature_of_every_law(law: str) -> None:
    """Beside samples of its own, and with corners between them."""
    text = (
        "scene:\n  points: {O: [0, 0]}\n  bodies: {b: {rigid: {mass: 1, inertia: 1}}}\n"
        f"  forces: {{f: {{torque: b, {law}: {LAWS[law].words}}}}}\n"
        "initial: {b: {x: 0, y: 0, angle: 0}}\nallow: {b.omega: 1.0}\n"
    )
    (force,) = scenes.parsed(text).scene.signals()
    times = np.linspace(0.0, 2.1, 9)
    wanted = [LAWS[law].times(1, t) for t in times]
    assert integral(force.signal, times)[:, 0] == pytest.approx(wanted, abs=1e-14)


def test_the_quadrature_of_a_fast_sine() -> None:
    """The sum of 15 000 pieces of 7e-4 each: a hundred roundings of the largest at most."""
    w, times = 3e3, np.array([0.0, 0.1, 5.0])
    found = integral(Signal("sine", (2.0,), w, 0.3), times)[:, 0]
    assert found == pytest.approx(2.0 / w * (np.cos(0.3) - np.cos(w * times + 0.3)), abs=1e-14)


EDGED, DRIVEN = permanent.edged, Kinematics._driven
RELATIVE, UNTURNED = SpatialClosure.relative, permanent._unturned


def else_a_sine(given: Given, k: Kinematics, ends: Any) -> Any:
    """As the first words for drives in space had it."""
    sine = replace(given.law, law="sine", angular_frequency=given.law.angular_frequency or 1.0)
    return GIVEN(replace(given, law=sine), k, ends)


GIVEN = Given.row


def larger_rate(given: Given, k: Kinematics, ends: Any) -> Any:
    """By one in a thousand."""
    return GIVEN(given, k, ends) * 1.001


def larger(loads: Any) -> Any:
    """What a force exerts, by one in a thousand."""
    more = lambda x: None if x is None else x * 1.001  # noqa: E731
    return lambda *given: [(part, more(F), more(M)) for part, F, M in loads(*given)]


def driven(place: float, rate: float) -> Any:
    """A moving point that is so much farther off, or so much faster."""

    def point_of(k: Kinematics, point: Any) -> Any:
        at = DRIVEN(k, point)
        away = at.r - Vec(point.at)
        return replace(at, r=Vec(point.at) + away * place, r_dot=at.r_dot * rate)

    return point_of


def right_angled_drive(joint: Any, freedom: Any) -> Turn:
    axes = [turn.axis for turn in joint.turns]
    return Turn(FIRST, SECOND, axes[0], axes[-1], (1.0, 0.0))


def other_axes(self: Any, joint: Any, q: Any) -> Any:
    """ω of the first part in the axes of the wrong one."""
    rows = RELATIVE(self, joint, q)
    at = self.where.slots["a"].omega
    rows[:, at : at + 3] = rows[:, at : at + 3].T
    return rows


def right_angled(joint: Any) -> Any:
    """Two axes held at right angles, whatever they are."""
    return ((u, w, 0.0) for u, w, _ in UNTURNED(joint))


def along_for_across(edge: Any, where: Any) -> Any:
    return EDGED(replace(edge, along=edge.across), where)


# What is planted, in which scene, and the row that sees it.
WRONG: dict[str, tuple[Any, str, Any, str, str]] = {
    "a drive in space that follows a sine instead": (
        Given, "row", else_a_sine, IN_SPACE, DRIVES,
    ),
    "the dual of a driven shift is its own axis": (
        permanent, "_dual", lambda joint, freedom: freedom.axis, IN_SPACE, DRIVES,
    ),
    "two skew turns driven as right-angled ones": (
        permanent, "turning", right_angled_drive, IN_SPACE, DRIVES,
    ),
    "a push in space that is larger": (
        action.Pushed, "loads", larger(action.Pushed.loads), IN_SPACE, FORCES,
    ),
    "a torque in space that is larger": (
        action.Torqued, "loads", larger(action.Torqued.loads), IN_SPACE, FORCES,
    ),
    "a motor in space that is stronger": (
        action.Driven, "loads", larger(action.Driven.loads), IN_SPACE, FORCES,
    ),
    "rates between moving parts in the axes of the wrong part": (
        SpatialClosure, "relative", other_axes, IN_SPACE, STARTS,
    ),
    "two skew axes of a joint held at right angles": (
        permanent, "_unturned", right_angled, IN_SPACE, JOINTS,
    ),
    "a rate in the plane that is larger than its law": (
        Given, "row", larger_rate, IN_PLANE, DRIVES,
    ),
    "a push in the plane that is larger than its law": (
        action.Pushed, "loads", larger(action.Pushed.loads), IN_PLANE, FORCES,
    ),
    "a couple in the plane that is larger than its law": (
        action.Coupled, "loads", larger(action.Coupled.loads), IN_PLANE, FORCES,
    ),
    "a moving point farther off than its law": (
        Kinematics, "_driven", driven(1.001, 1.0), IN_PLANE, POINTS,
    ),
    "a moving point that is faster than its law": (
        Kinematics, "_driven", driven(1.0, 1.001), IN_PLANE, POINTS,
    ),
    "a blade that is free across and held along": (
        permanent, "edged", along_for_across, IN_PLANE, SLIPS,
    ),
    "a start measured from where a moving point is not": (
        GroundPoint, "state", lambda self, t: (*self.at, *self.velocity), IN_PLANE, STARTS,
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.mutant("shared by all answers: {what}")
@pytest.mark.parametrize("what", WRONG)
def test_what_all_answers_share_is_seen(what: str, monkeypatch: pytest.MonkeyPatch) -> None:
    room, name, planted, text, row = WRONG[what]
    monkeypatch.setattr(room, name, planted)
    assert not checks(text)[row].holds


@pytest.mark.slow
@pytest.mark.mutant("a start on another turn than the file's")
def test_a_start_on_another_turn_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Sines and cosines are the same, and all answers are, too."""
    sound = start_positions.positions

    def turned(closure: PlanarClosure) -> Any:
        return sound(closure) - math.tau * closure.turning

    monkeypatch.setattr(assembly, "positions", turned)
    assert not checks(IN_PLANE)[STARTS].holds


@pytest.mark.slow
@pytest.mark.mutant("of two ways to assemble the farther one from `near`")
def test_the_other_way_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    text = "initial: {lower: {end: [0.2, 0]}}\nnear: {upper: {angle: 60 deg}}\n"
    elbow = scenes.scene("two_bars", text)
    assert checks(elbow)[NEAR].difference < 0.2
    sound = Closure.distance
    monkeypatch.setattr(Closure, "distance", lambda self, q: 3.0 - sound(self, q))
    monkeypatch.setattr(start_positions, "FAR", math.inf)
    assert not checks(elbow)[NEAR].holds


@pytest.mark.mutant("in space the first way to assemble in place of the nearest")
@pytest.mark.slow
def test_the_first_way_in_space_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    near = "near: {bearing: {angle: 157.1 deg}}\nduration: 0.6\nsamples: 7\n"
    linkage = scenes.scene("spatial_linkage", near, crank="80 deg")
    assert checks(linkage)[NEAR].difference < 0.01
    monkeypatch.setattr(start_positions, "nearest_ways", lambda closure, ways: ways[:1])
    monkeypatch.setattr(start_positions, "FAR", math.inf)
    assert not checks(linkage)[NEAR].holds
