"""Errors that are stated are those of the quantity, and not of rounding that it does not have."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given.claims import claimed
from given.scenes import tail, typed

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.reference.certificate import certify, errors, event_time_error, work_error
from textmech.reference.certificate.agreement import Check
from textmech.reference.motion.follow import Change
from textmech.reference.solve import solve
from textmech.reference.states import answer

TURNS = """\
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
AGAIN = """\
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
PINNED = """\
scene:
  points: {O: [0, 0]}
  bodies: {b: {bar: {mass: 1.6, length: 0.3}}}
  joints: {w: {pin: [ground.O, b.start]}}
  forces: {t: {push: b.start, sine: {amplitude: [-1.2, -1.1], angular_frequency: 7.7}}}
initial: {b: {angle: 0.4, omega: 3}}
allow: {t.work: 1.0e-3, b.x: 1.0}
"""
FAR = """\
scene:
  gravity: none
  bodies: {b: {particle: {mass: 1}}, c: {particle: {mass: 1}}}
  forces: {s: {spring: [b.center, c.center], stiffness: 10, rest_length: 1}}
initial: {b: {x: AT, y: 0, vx: 3.0e-6}, c: {x: BESIDE, y: 0}}
allow: {b.x: 1.0e-8, s.force: 1.0e-7}
"""


def error(case: Case, name: str) -> float:
    found = solve(case)
    (check,) = (check for check in found.checks if check.name == f"error of {name}")
    assert isinstance(check, Check)
    assert check.certified is not None
    return check.certified


@pytest.mark.slow
@pytest.mark.mutant("what turns round where friction has a root is as blurred as what stops there")
def test_what_turns_round_is_known_better_than_what_stops(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """0.44450132 s by scipy's DOP853; the formula for a stop says 1.3 s."""
    case = typed(tmp_path, TURNS, tail=tail(0.8, 24))
    assert error(case, "z.time") < 1e-6
    assert error(case, "m.time") < 1e-8
    monkeypatch.setattr(certify, "_rests", lambda change: True)
    with pytest.raises(CaseError, match="asks more than can be certified"):
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
def test_what_is_pushed_again_stops_at_a_time_that_is_known(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The second stop is 1.3e-7 s off an integration by quarters of the steps."""
    case = typed(tmp_path, AGAIN, tail=tail(4.0, 41))
    assert 1e-9 < error(case, "stops.time") < 1e-5
    monkeypatch.setattr(event_time_error, "FIRST", 0)
    with pytest.raises(CaseError, match="asks more than can be certified"):
        solve(case)


@pytest.mark.slow
@pytest.mark.mutant("work that is none is halved for nobody's bar")
def test_work_that_is_none_costs_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[int] = []
    states = work_error._states

    def counted(answer: Any, parts: Any) -> Any:
        asked.append(1)
        if len(asked) > 3:
            raise RuntimeError("halved again")
        return states(answer, parts)

    monkeypatch.setattr(work_error, "_states", counted)
    case = typed(tmp_path, PINNED, tail=tail(0.4, 11))
    assert error(case, "t.work") < 1e-12
    assert len(asked) == 1
    monkeypatch.setattr(work_error, "NOBODY", 0.0)
    with pytest.raises(RuntimeError, match="halved again"):
        solve(case)


@pytest.mark.mutant("what moves little is still, far from the origin")
@pytest.mark.parametrize("at", [0.0, 2000.0])
def test_where_a_scene_stands_is_no_motion(at: float, tmp_path: Path) -> None:
    text = FAR.replace("AT", repr(at)).replace("BESIDE", repr(at + 1))
    found = solve(typed(tmp_path, text, tail=tail(1.0, 11)))
    moved = np.ptp(found.trajectory.states["b"][:, 0])
    w = np.sqrt(20.0)  # of both against each other: x = v (t/2 + sin(w t)/(2 w))
    times = found.trajectory.times
    assert moved == pytest.approx(np.ptp(3e-6 * (times + np.sin(w * times) / w) / 2), rel=1e-6)


CANCELS = """\
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


IDLE = """\
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
allow: {q.my: BAR}
"""


@pytest.mark.slow
@pytest.mark.mutant("a reaction that is none is known to twelve digits of its rounding")
def test_a_reaction_that_is_none_is_known_to_what_stands_beside_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A hinge along y bears no moment about it: 1e-24 N m are left of the others' 1."""
    case = typed(tmp_path, IDLE.replace("BAR", "1.0e-3"), tail=tail(0.2, 11))
    assert error(case, "q.my") > 1e-18
    bold = typed(tmp_path, IDLE.replace("BAR", "1.0e-30"), tail=tail(0.2, 11))
    with pytest.raises(CaseError, match="asks more than can be certified"):
        solve(bold)
    monkeypatch.setattr(errors, "_beside", lambda case, motion, name: iter(()))
    assert error(case, "q.my") < 1e-20


@pytest.mark.mutant("a place that cancels is known to its own rounding")
def test_a_sum_is_known_to_its_terms(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """a.x = L (1 − cos q) of L = 10⁶ m is 5.8e-11 m off, and some 1e-6 m."""
    case = claimed(tmp_path, CANCELS)
    assert case.states is not None
    q = case.states.drawn(case.scene)["j.angle"][:, 0]
    x = solve(case).trajectory.states["a"][:, 0]
    off = np.max(np.abs(x - 2e6 * np.sin(q / 2) ** 2))
    assert 1e-12 < off <= error(case, "a.x")
    bold = claimed(tmp_path, CANCELS.replace("a.x: 1.0e-6", "a.x: 1.0e-12"))
    with pytest.raises(CaseError, match=r"give at least 4e-07\n"):
        solve(bold)
    monkeypatch.setattr(answer, "_rounded", lambda case: {})
    assert error(bold, "a.x") < 1e-2 * off
