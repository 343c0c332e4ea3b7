"""Rows that ask what contacts, pairs, ropes and stops do by the file: each sees what answers share.

No scene here has a hand-written system: all answers come from one mechanism, which is mistaken.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.certified import broken

from textmech.cases.fields.friction import Bounds
from textmech.cases.scene.forces.limit import Rope, Stops
from textmech.cases.scene.observe import motion_of
from textmech.cases.trajectory import Trajectory
from textmech.reference.certificate import one_sided_checks
from textmech.reference.certificate.reading import Size
from textmech.reference.mechanism.constraints.constraint import Constraint
from textmech.reference.mechanism.constraints.constraint_terms import FIRST, SECOND, Along, Turning
from textmech.reference.mechanism.modes import blow, element, unilateral
from textmech.reference.mechanism.modes import impact_transition as landing
from textmech.reference.solve import solve

PASSES, TOUCHES = "nothing passes what holds it", "what presses touches"
FRICTION, BLOWS = "friction is the file's", "blows are the file's"
LENGTH, MOVE = "springs act from their length on", "contacts move free bodies by (2.22)"
TWO_STOPS = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {a: {bar: {mass: 1.0, length: 1.0}}, b: {bar: {mass: 0.6, length: 0.7}}}
  joints: {h: {pin: [ground.O, a.start]}, k: {pin: [a.end, b.start]}}
  forces: {f: {stops: k, low: -0.5, high: 0.4, restitution: 0.4}}
initial: {a: {angle: 0.2, omega: 0.5}, b: {angle: 0.3, omega: 3}}
allow: {a.angle: 1.0e-3}
"""
ROPE = """\
scene:
  gravity: none
  bodies:
    a: {rigid: {mass: 1.0, inertia: 0.01}, points: {P: [0.05, 0.02]}}
    b: {rigid: {mass: 2.0, inertia: 0.03}, points: {P: [-0.03, 0.06]}}
  forces: {r: {rope: [a.P, b.P], length: 1.0}}
initial:
  a: {x: 0, y: 0, angle: 0, omega: 1, vx: -1}
  b: {x: 0.7, y: 0.2, angle: 0, omega: -0.5, vx: 1, vy: 0.5}
allow: {a.x: 1.0e-3}
"""
BOUNCE = """\
scene:
  planes: {wall: {at: [1.0, 0], normal: [-1, 0.2]}}
  bodies: {d: {disk: {mass: 1.0, radius: 0.1}}}
  contacts:
    f: {between: [d, ground.floor], friction: 0.2, restitution: 0.5}
    w: {between: [d, ground.wall], friction: 0.3, restitution: 0.6}
events: {l: {f.gap: falls to zero}, m: {w.gap: falls to zero}}
initial: {d: {x: 0, y: 0.6, angle: 0, omega: 8, vx: 3, vy: -1}}
allow: {d.x: 1.0e-3}
"""
ON_A_FACE = """\
scene:
  bodies:
    box: {block: {mass: 3.0, width: 2.0, height: 0.2}}
    d: {disk: {mass: 1.0, radius: 0.1}}
  contacts:
    s: {between: [d, box.top], friction: 0.3}
    f1: {between: [box.lower_left, ground.floor], friction: 0.05}
    f2: {between: [box.lower_right, ground.floor], friction: 0.05}
initial: {box: {x: 0, y: 0.1, angle: 0}, d: {x: -0.5, y: 0.3, angle: 0, omega: 5, vx: 1}}
allow: {d.x: 1.0e-3, box.x: 1.0e-3}
"""
STRIKES = """\
scene:
  gravity: none
  bodies:
    box: {block: {mass: 3.0, width: 0.6, height: 0.8}}
    d: {disk: {mass: 1.0, radius: 0.1}}
  contacts: {s: {between: [d, box.right], friction: 0.3, restitution: 0.2}}
events: {hits: {s.gap: falls to zero}}
initial:
  box: {x: 0, y: 0, angle: 0.1}
  d: {x: 0.9, y: 0.1, angle: 0, omega: 50, vx: -2, vy: 0.3}
allow: {d.x: 1.0e-3, box.x: 1.0e-3}
"""
LOOSE = """\
scene:
  bodies: {b: {particle: {mass: 1.0}}}
  contacts: {c: {between: [b, ground.floor], friction: {static: 0.5, kinetic: 0.2}}}
  forces: {p: {push: b.center, ramp: [9, 0]}}
initial: {b: {x: 0, y: 0}}
allow: {b.x: 1.0e-3}
"""
RAIL = """\
scene:
  points: {O: [0, 0]}
  bodies: {b: {block: {mass: 1.0, width: 0.1, height: 0.1}}}
  joints:
    rail:
      slide: [ground.O, b.center]
      along: [1, 0]
      dry_friction: {kinetic: {forward: 2, backward: 3}, static: {forward: 4, backward: 5}}
  forces: {p: {push: b.center, sine: {amplitude: [6, 0], angular_frequency: 8}}}
initial: {b: {x: 0, vx: 1}}
allow: {b.x: 1.0e-3}
"""
LIFTED = """\
scene:
  gravity: 10.0
  bodies: {b: {particle: {mass: 1.0}}}
  contacts: {f: {between: [b, ground.floor], friction: {static: 0.6, kinetic: 0.5}}}
  forces: {p: {push: b.center, pulse: {amplitude: [2.0, 20.0], from: 0.2, until: 0.4}}}
events: {l: {f.gap: falls to zero}}
initial: {b: {x: 0, y: 0, vx: 0, vy: 0}}
allow: {b.x: 1.0}
"""
HOPS = """\
scene:
  bodies: {d: {disk: {mass: 1.0, radius: 0.2}}}
  contacts: {f: {between: [d, ground.floor], friction: 0, restitution: 0.8}}
events: {lands: {f.gap: falls to zero}}
initial: {d: {x: 0, y: 0.9, angle: 0, vx: 1}}
allow: {d.y: 1.0e-3}
"""
BAND = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {b: {particle: {mass: 1.0}}}
  forces: {s: {spring: [ground.O, b.center], stiffness: 50, rest_length: 0.4, only: tension}}
initial: {b: {x: 0.1, y: 0.2, vx: 2}}
allow: {b.x: 1.0e-3}
"""
SLIDES = """\
scene:
  points: {O: [0, 2]}
  bodies: {d: {disk: {mass: 1.0, radius: 0.2}, points: {P: [0.1, 0.05]}}}
  contacts: {f: {between: [d, ground.floor], friction: 0.2}}
  forces:
    p: {push: d.center, sine: {amplitude: [0.3, 0.2], angular_frequency: 7}}
    s: {spring: [ground.O, d.P], stiffness: 2, rest_length: 1}
initial: {d: {x: 0, y: 0.2, angle: 0, omega: 90, vx: 4}}
allow: {d.x: 1.0e-3}
"""
SCENES = {
    "a disk that hops": HOPS, "a band": BAND, "a disk that slides": SLIDES,
    "a pulse that lifts": LIFTED,
    "stops between two bodies": TWO_STOPS, "a rope": ROPE,
    "a disk that bounces": BOUNCE, "a disk on a face": ON_A_FACE, "a blow on a face": STRIKES,
    "what breaks loose": LOOSE, "a rail that rubs": RAIL,
}  # fmt: skip


def checks(name: str) -> dict[str, Any]:
    return {c.name: c for c in solve(scenes.parsed(SCENES[name])).checks}


@pytest.mark.slow
@pytest.mark.parametrize("name", SCENES)
def test_what_is_sound_holds(name: str) -> None:
    found = checks(name)
    assert {FRICTION, PASSES, LENGTH} & found.keys()
    assert broken(found.values()) == set()


def with_row(constraint: Constraint, row: Any) -> Constraint:
    return replace(constraint, rows=(row,))


def arm_of(limit: Callable[..., Any], factor: float, extra: float) -> Callable[..., Any]:
    """The limit, whose row takes the first body's turn so many times, and so much of the second."""

    def wrong(*given: Any) -> Any:
        made = limit(*given)
        first, *rest = made.normal.rows[0]
        rest = [replace(term, axis=factor * getattr(term, "axis", 1.0)) for term in rest]
        more = [Turning(SECOND, extra)] if extra else []
        return replace(made, normal=with_row(made.normal, (first, *rest, *more)))

    return wrong


def ends_at(limit: Callable[..., Any], factor: float) -> Callable[..., Any]:
    def wrong(*given: Any) -> Any:
        made = limit(*given)
        return replace(made, normal=replace(made.normal, held=(factor * made.normal.held[0],)))

    return wrong


def slips_along(pair: Any, where: Any) -> Constraint:
    made = ALONG(pair, where)
    line, own, other = made.rows[0]
    return with_row(made, (line, Turning(SECOND, 1.001 * getattr(own, "axis", 1.0)), other))


def tilted(contact: Any, where: Any) -> Constraint:
    x, y = contact.plane.normal
    return with_row(NORMAL(contact, where), (Along(FIRST, (x, 1.001 * y)),))


def moved(contact: Any, where: Any) -> Constraint:
    made = NORMAL(contact, where)
    return replace(made, held=(made.held[0] * (1 + 1e-4),))  # type: ignore[index]


def static(factor: float) -> Callable[..., Any]:
    def margins(self: Any, forces: Any) -> tuple[float, float]:
        bound, tangent = (forces[f"{self.name}.{name}"] for name in ("normal", "tangent"))
        bound *= factor * self.static
        return bound + tangent, bound - tangent

    return margins


def other_way(self: Any, forces: Any) -> tuple[float, float]:
    turned = Bounds(self.friction.static.backward, self.friction.static.forward)
    friction = replace(self.friction, static=turned)
    return MARGINS(replace(self, friction=friction), forces)


def acts_later(self: Any, t: float, q: Any) -> float:
    return SLACK(self, t, q) - self.way * 1e-4 * self.spring.rest_length


def rubs(tilt: float, lever: float) -> Callable[..., Any]:
    """Friction along another line, or with another lever about the centre of a disk."""

    def wrong(contact: Any, where: Any) -> Constraint:
        made = TANGENT(contact, where)
        (x, y), (nx, ny) = contact.plane.along, contact.plane.normal
        row: Any = made.rows[0]
        along, turns = row
        line = replace(along, u=(x + tilt * nx, y + tilt * ny))
        return with_row(made, (line, replace(turns, axis=lever * turns.axis)))

    return wrong


def bounces(*given: Any, **named: Any) -> Any:
    touching, met = MEETINGS(*given, **named)
    return touching, [replace(m, after=1.0001 * m.after) for m in met]


ALONG, NORMAL, SIGN = unilateral.pair_tangent, element.normal, blow.sign
SLACK, TANGENT = unilateral.OneSided.slack, element.tangent
ROPED, STOPPED, MARGINS = unilateral.roped, unilateral.stopped, element.Sliding.margins
MEETINGS = landing._meetings
LIMITS = unilateral.LIMITS
MISTAKES: dict[str, tuple[Callable[[pytest.MonkeyPatch], object], list[str], set[str]]] = {
    "a stop's moment on the first body is another": (
        lambda patch: patch.setitem(LIMITS, Stops, arm_of(STOPPED, 1.001, 0.0)),
        ["stops between two bodies"], {PASSES},
    ),
    "a stop stands elsewhere": (
        lambda patch: patch.setitem(LIMITS, Stops, ends_at(STOPPED, 1.0001)),
        ["stops between two bodies"], {PASSES},
    ),
    "a rope pulls beside its line": (
        lambda patch: patch.setitem(LIMITS, Rope, arm_of(ROPED, 1.0, 1e-4)), ["a rope"], {PASSES},
    ),
    "a rope is longer": (
        lambda patch: patch.setitem(LIMITS, Rope, ends_at(ROPED, 1.0001)), ["a rope"], {PASSES},
    ),
    "a rim on a face slips elsewhere": (
        lambda patch: patch.setattr(unilateral, "pair_tangent", slips_along),
        ["a disk on a face"], {FRICTION},
    ),
    "a blow rubs by another coefficient": (
        lambda patch: patch.setattr(blow, "sign", lambda state: 1.001 * SIGN(state)),
        ["a disk that bounces", "a blow on a face"], {BLOWS},
    ),
    "a blow throws more back": (
        lambda patch: patch.setattr(landing, "_meetings", bounces),
        ["a disk that bounces", "stops between two bodies"], {BLOWS},
    ),
    "a plane is tilted": (
        lambda patch: patch.setattr(element, "normal", tilted), ["a disk that bounces"], {PASSES},
    ),
    "a plane stands elsewhere": (
        lambda patch: patch.setattr(element, "normal", moved), ["a disk that bounces"], {PASSES},
    ),
    "what hops turns back above the floor": (
        lambda patch: patch.setattr(element, "normal", moved), ["a disk that hops"], {BLOWS},
    ),
    "a band pulls from another length on": (
        lambda patch: patch.setattr(unilateral.OneSided, "slack", acts_later), ["a band"], {LENGTH},
    ),
    "friction is not along the plane": (
        lambda patch: patch.setattr(element, "tangent", rubs(1e-6, 1.0)),
        ["a disk that slides"], {MOVE},
    ),
    "friction has another lever": (
        lambda patch: patch.setattr(element, "tangent", rubs(0.0, 1.000001)),
        ["a disk that slides"], {MOVE},
    ),
    "what sticks lets go later": (
        lambda patch: patch.setattr(element.Touching, "margins", static(1.001)),
        ["what breaks loose"], {FRICTION},
    ),
    "what sticks lets go earlier": (
        lambda patch: patch.setattr(element.Touching, "margins", static(0.999)),
        ["what breaks loose"], {FRICTION},
    ),
    "static friction the other way": (
        lambda patch: patch.setattr(element.Sliding, "margins", other_way),
        ["a rail that rubs"], {FRICTION},
    ),
}  # fmt: skip


@pytest.mark.parametrize(("jump", "errors"), [(0.0, []), (1e-15, []), (3e-6, [1e-6])])
def test_what_rounding_leaves_of_a_speed_is_no_blow(jump: float, errors: list[float]) -> None:
    """Above the floor, where a velocity has nothing to jump for."""
    scene = scenes.parsed(SCENES["a disk that bounces"]).scene
    before, after = np.array([[[0.0, 0.6, 0.0, vx, -1.0, 8.0]] for vx in (3.0, 3.0 + jump)])
    inner = {"muscle": np.zeros((1, 1))}  # which jumps by no blow
    motions = [
        motion_of(scene, Trajectory(np.zeros(1), {"d": row} | inner, {})) for row in (before, after)
    ]
    size = Size(1.0, 1.0, 3.0, 8.0)
    blow_of = one_sided_checks._Blow(scene, motions[0], motions[1], size, ends=False)
    assert [*blow_of.errors([*one_sided_checks.sides(scene)])] == pytest.approx(errors)


@pytest.mark.slow
@pytest.mark.mutant("{mistake}, in all answers alike")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_what_all_answers_share_is_seen(mistake: str, monkeypatch: pytest.MonkeyPatch) -> None:
    plant, names, seen = MISTAKES[mistake]
    plant(monkeypatch)
    for name in names:
        failing = broken(checks(name).values())
        assert seen <= failing, (name, failing)
