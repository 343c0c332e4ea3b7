"""Starts that are refused: where, in which words, and that what they advise helps."""

import re

import numpy as np
import pytest
from given.otherwise import otherwise
from given.scenes import parsed, scene

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError, Mistake
from textmech.reference.start import positions, spatial_closure
from textmech.reference.start.assembly import assemble
from textmech.reference.start.spatial_closure import SpatialClosure

Patch = pytest.MonkeyPatch


def all_refused(case: Case) -> list[Mistake]:
    with pytest.raises(CaseError) as error:
        assemble(case)
    return error.value.mistakes


def refused(case: Case) -> Mistake:
    (mistake,) = all_refused(case)
    return mistake


FOUR_BAR = "initial: {crank: {angle: 0}}\nnear: {rocker: {angle: 96 deg}}\n"
WELDED = "scene: {joints: {knee: {pin: null, weld: [upper.end, lower.start], angle: 10 deg}}}\n"
PISTON = "initial: {{piston: {{x: {}}}}}\nnear: {{crank: {{angle: 0}}}}"
# By what is wrong: the scene, what is changed in it, where the mistake is and what of its words.
PLANE: dict[str, tuple[str, str, str, str]] = {
    "two ways": (
        "four_bar", "", "initial",
        r"in 2 ways.*rocker.angle = 95.93 deg or -134.9 deg.*near: {rocker: {angle: 95.93 deg}}",
    ),
    "a gap, shared by three joints": (
        "slider_crank", "initial: {crank: {angle: 0}, piston: {x: 0.83}}", "initial",
        r"cannot be assembled from what is given: (main|\w+_end) stays open by 0.0(1|099)\d* m",
    ),
    "a constraint": (
        "pendulum", "initial: {bar: {angle: 0, x: 0.4, y: 0.01}}", "initial",
        r"^the initial state violates a constraint: hinge stays open by 0.01 m$",
    ),
    "an angle": (
        "two_bars",
        f"{WELDED}initial: {{upper: {{angle: 0, x: 0.25, y: 0}}, lower: {{angle: 15 deg}}}}",
        "initial", "knee stays open by 5 deg",
    ),
    "a point out of reach": (
        "pendulum", "initial: {bar: {angle: null, end: [3, 5]}}", "initial", "cannot be assembled",
    ),
    "a joint too many": (
        "four_bar", f"{FOUR_BAR}scene: {{joints: {{E: {{pin: [ground.Q, rocker.start]}}}}}}",
        "scene.joints.E", "the constraints are not independent",
    ),
    "a weld too many": (
        "four_bar", f"{FOUR_BAR}scene: {{joints: {{E: {{weld: [crank.start, ground.O]}}}}}}",
        "scene.joints.E", "the constraints are not independent",
    ),
    "a flat parallelogram": (
        "parallelogram", "near: null\ninitial: {crank: {angle: 0}, rocker: {angle: 0}}",
        "scene.joints.D", "in this position",
    ),
    "rates": (
        "pendulum", "initial: {bar: {angle: 0, omega: 1, vy: 0.3}}", "initial",
        "the rates violate hinge",
    ),
    "an open place": (
        "two_bars", "initial: {upper: {angle: 0}}", "initial",
        "^1 more needed: lower.y, lower.angle are not determined",
    ),
    "an open rate": (
        "two_bars", "initial: {upper: {angle: 0, omega: 2}, lower: {angle: 0}}", "initial",
        "^1 more needed: lower.vy, lower.omega are not determined",
    ),
    "a joint's angle beside its bodies'": (
        "two_bars", "initial: {hip: {angle: 0}, knee: {angle: 20 deg}, lower: {angle: 0}}",
        "initial", "from what is given: knee.angle stays open by 20 deg",
    ),
    "a joint's rate beside its body's": (
        "two_bars",
        "initial: {hip: {angle: 0, omega: 1}, upper: {omega: 2}, knee: {angle: 0, omega: 0}}",
        "initial", "the rates violate",
    ),
    # It determines the crank's angle, but no rate.
    "a dead centre": ("slider_crank", PISTON.format("0.8"), "initial", "dead centre.*crank.angle"),
    "beside it": (
        "slider_crank", PISTON.format("0.79999999999"), "initial", "a dead centre.*crank.angle",
    ),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("what", PLANE)
def test_what_is_wrong_in_the_plane_is_said(what: str) -> None:
    name, changes, where, words = PLANE[what]
    mistake = refused(scene(name, changes))
    assert mistake.where == where
    assert mistake.text.strip().strip('"').startswith(where.rpartition(".")[2])
    assert re.search(words, mistake.what)


@pytest.mark.parametrize(
    ("body", "rest", "words"),
    [
        ("{rigid: {mass: 1, inertia: 0.1}}", "initial: {b: {vx: 1}}",
         "3 more needed: b.x, b.y, b.angle"),
        # But for a disk, which looks the same however it is turned.
        ("{rigid: {mass: 1, inertia: 0.05, radius: 0.25}}",
         "  contacts: {touch: {between: [b, ground.floor], friction: 0.5, ideal: rolling}}\n"
         "initial: {b: {x: 1}}", "b.angle is not determined"),
    ],
    ids=["free", "rolling"],
)  # fmt: skip
def test_what_a_body_lacks_is_named(body: str, rest: str, words: str) -> None:
    text = f"scene:\n  bodies: {{b: {body}}}\n{rest}\nallow: {{b.x: 1.0e-2}}\n"
    assert words in refused(parsed(text)).what


# In space.

BODY = (
    "{rigid: {mass: 1.0, inertia: [0.02, 0.03, 0.025, 0, 0, 0]}, "
    "points: {p: [0.2, 0, 0], q: [-0.2, 0, 0]}}"
)
FREE = f"""\
scene:
  space: 3
  points: {{O: [0, 0, 0]}}
  bodies: {{a: {BODY}, b: {BODY}}}
  joints:
    j2: {{hinge: [a.p, b.q], axis: [0, 1, 0]}}
"""
PAIR = f"{FREE}    j1: {{hinge: [ground.O, a.q], axis: [0, 0, 1]}}\n"
SLIDER = """\
scene:
  space: 3
  points: {O: [0, 0, 0]}
  bodies:
    a: {bar: {mass: 1.0, length: 0.3}}
    rod: {bar: {mass: 1.0, length: 0.5}}
    piston: {particle: {mass: 1.0}}
  joints:
    motor: {hinge: [ground.O, a.start], axis: [0, 0, 1]}
    big_end: {universal: [a.end, rod.start], axes: [[0, 0, 1], [0, 1, 0]]}
    rail: {slide: [ground.O, piston.center], along: [1, 0, 0]}
    small_end: {ball: [rod.end, piston.center]}
"""
SPATIAL_FOUR_BAR = """\
scene:
  space: 3
  points: {O: [0, 0, 0], Q: [0.9, 0, 0]}
  bodies:
    a: {bar: {mass: 1.0, length: 0.3}}
    b: {bar: {mass: 1.0, length: 0.8}}
    c: {bar: {mass: 1.0, length: 0.6}}
  joints:
    A: {hinge: [ground.O, a.start], axis: [0, 0, 1]}
    B: {hinge: [a.end, b.start], axis: [0, 0, 1]}
    C: {hinge: [b.end, c.end], axis: [0, 0, 1]}
    D: {hinge: [ground.Q, c.start], axis: [0, 0, 1]}
initial: {A: {angle: 0}}
near: {D: {angle: 96 deg}}
"""


def spatial(text: str) -> Case:
    return parsed(f"{text}allow: {{a.x: 1.0e-3}}\n")


OPEN = "the mechanism cannot be assembled from what is given: "
REPEATED = "the constraints are not independent"
DEAD = f"{SLIDER}initial: {{rail: {{shift: 0.79999999999}}}}\nnear: {{motor: {{angle: 1 deg}}}}\n"
SPACE: dict[str, tuple[str, str, str]] = {
    "coordinates that contradict each other": (
        f"{PAIR}initial: {{j1: {{angle: 30 deg}}, j2: {{angle: 0}}, "
        "a: {attitude: {axis: [0, 0, 1], angle: 40 deg}}}\n",
        "initial", f"{OPEN}j1.angle stays open by 10 deg",
    ),
    "a point out of reach": (  # 0.03 m: 0.83 of 0.8, shared by four equations
        f"{SLIDER}initial: {{rail: {{shift: 0.83}}}}\nnear: {{motor: {{angle: 0}}}}\n",
        "initial", f"{OPEN}small_end stays open by 0.0075 m",
    ),
    "an open coordinate": (
        f"{PAIR}initial: {{j1: {{angle: 0}}}}\n",
        "initial", "1 more needed: j2.angle is not determined by what is given and the constraints",
    ),
    "rates that contradict each other": (
        f"{PAIR}initial: {{j1: {{angle: 0, omega: 1}}, j2: {{angle: 0}}, a: {{vx: 2}}}}\n",
        "initial", "the rates violate j1: no motion satisfies all that is given",
    ),
    "open rates": (
        f"{FREE}initial: {{j2: {{angle: 0, omega: 1}}, "
        "a: {x: 0, y: 0, z: 0, attitude: {axis: [0, 0, 1], angle: 0}}}\n",
        "initial", "6 more needed: a.vx, a.vy, a.vz, a.omega_1",
    ),
    "a dead centre": (
        DEAD, "initial", "the mechanism stands at a dead centre, where what is given hardly "
        "determines motor.angle, small_end.attitude; give one of these instead",
    ),
    "a hinge too many": (SPATIAL_FOUR_BAR, "scene.joints.D", REPEATED),
    "a blade twice": (
        f"{PAIR}  constraints: {{blade: {{edge: b.p, along: [1, 0, 0]}}, "
        "again: {edge: b.p, along: [1, 0, 0]}}\ninitial: {j1: {angle: 0}, j2: {angle: 0.2}}\n",
        "scene.constraints.again", REPEATED,
    ),
    "a drive too many": (
        f"{SLIDER}  drive: {{motor.omega: 1.0, rail.shift_dot: 0.0}}\n"
        "initial: {motor: {angle: 30 deg}}\nnear: {rail: {shift: 0.7}}\n",
        "scene.drive.rail.shift_dot", REPEATED,
    ),
}  # fmt: skip
HELPS = {
    "a hinge too many": "holds less (a ball, a universal joint)",
    "a blade twice": "leave it out",
}


@pytest.mark.slow
@pytest.mark.parametrize("what", SPACE)
def test_what_is_wrong_in_space_is_said(what: str) -> None:
    text, where, words = SPACE[what]
    mistake = refused(spatial(text))
    assert mistake.where == where
    assert mistake.what.startswith(words)
    assert HELPS.get(what, "") in mistake.what


@pytest.mark.slow
@pytest.mark.mutant("a start at a dead centre that nobody refuses")
def test_a_dead_centre_is_not_missed(monkeypatch: Patch) -> None:
    """Without the question Newton's method stops where the crank is 1e-5 rad off."""
    assemble(spatial(DEAD.replace("0.79999999999", "0.79").replace("1 deg", "10 deg")))
    monkeypatch.setattr(positions, "DEAD", 1e-9)
    assemble(spatial(DEAD))


@pytest.mark.slow
def test_an_attitude_that_three_turns_cannot_make() -> None:
    turns = "{{p: {{hinge: [0, 0, 1]}}, q: {{hinge: {}}}, r: {{hinge: {}}}}}"
    skew, square = (
        turns.format("[0.1, 0, 1]", "[0, 0.1, 1]"),
        turns.format("[1, 0, 0]", "[0, 1, 0]"),
    )
    lying = "initial: {a: {attitude: {axis: [1, 0, 0], angle: 90 deg}}}\n"

    def case(freedoms: str, start: str) -> Case:
        text = f"scene:\n  space: 3\n  points: {{O: [0, 0, 0]}}\n  bodies: {{a: {BODY}}}\n"
        return spatial(
            f"{text}  joints: {{s: {{freedoms: {freedoms}, of: [ground.O, a.center]}}}}\n{start}"
        )

    mistake = refused(case(skew, lying))
    assert mistake.where == "initial"
    assert "the turns 'p', 'q', 'r' of s cannot make the attitude" in mistake.what
    assemble(case(skew, "initial: {s: {p: 0.3, q: -0.4, r: 2.0}}\n"))
    assemble(case(square, lying))


CROSS = f"""\
scene:
  space: 3
  points: {{O: [0, 0, 0]}}
  bodies: {{a: {BODY}}}
  joints: {{cross: {{universal: [ground.O, a.q], axes: [[0, 0, 1], [0, 1, 0]]}}}}
initial: {{a: {{p: [0.24, 0.32, 0]}}}}
"""
SEVERAL = {
    "rail.shift = ": f"{SLIDER}initial: {{motor: {{angle: 30 deg}}}}\n",
    "a.attitude = {axis: ": CROSS,
}


@pytest.mark.slow
@pytest.mark.parametrize("told", SEVERAL)
def test_ways_are_told_and_the_advice_helps(told: str) -> None:
    words = refused(spatial(SEVERAL[told])).what
    assert told in words
    (advice,) = re.findall("for instance (near: .*)$", words)
    assemble(spatial(f"{SEVERAL[told]}{advice}\n"))


TWO = f"""\
scene:
  space: 3
  points: {{O: [0, 0, 0]}}
  bodies: {{a: {BODY}, b: {BODY}}}
"""


@pytest.mark.parametrize("rate", ["", ", vx: 1"])
def test_a_mechanism_without_a_rate_rests_beside_one_that_turns(rate: str) -> None:
    """As in the plane; and of one of whose rates some are given the others are 0."""
    hub = "  joints: {hub: {hinge: [ground.O, a.q], axis: [0, 0, 1]}}\n"
    place = f"x: 2, y: 0, z: 0, attitude: {{axis: [1, 0, 0], angle: 0}}{rate}"
    start = f"initial: {{hub: {{angle: 0, omega: 1}}, b: {{{place}}}}}\n"
    _, v = assemble(spatial(f"{TWO}{hub}{start}"))
    assert v[-6:].tolist() == [1.0 if rate else 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
    assert np.any(v[:6])


@pytest.mark.mutant("the attitude of a body named where its place is open")
def test_of_two_free_bodies_only_what_is_open_is_named(monkeypatch: Patch) -> None:
    turned = "attitude: {axis: [0, 0, 1], angle: 0.3}"
    a, b = f"x: 0, y: 0, z: 0, {turned}, omega: [1, 0, 0]", f"y: 1, z: 0, {turned}"
    case = spatial(f"{TWO}initial: {{a: {{{a}}}, b: {{{b}}}}}\n")
    told = refused(case).what
    assert "b.x" in told
    assert "attitude" not in told
    other = otherwise(spatial_closure, '"vx": "x", ', "").SpatialClosure
    monkeypatch.setattr(SpatialClosure, "_open_places", other._open_places)
    assert "b.attitude" in refused(case).what


AXLE = """\
scene:
  space: 3
  bodies:
    cart:
      rigid: {mass: 2, inertia: [0.02, 0.03, 0.04, 0, 0, 0]}
      points: {l: [0, 0.2, 0], r: [0, -0.2, 0], c: [-0.3, 0, -0.05]}
    left: {disk: {mass: 0.3, radius: 0.1, axle: [0, 1, 0]}}
    right: {disk: {mass: 0.3, radius: 0.1, axle: [0, 1, 0]}}
    caster: {sphere: {mass: 0.2, radius: 0.05}}
  joints:
    l: {hinge: [cart.l, left.center], axis: [0, 1, 0]}
    r: {hinge: [cart.r, right.center], axis: [0, 1, 0]}
    c: {ball: [cart.c, caster.center]}
  contacts:
    fl: {between: [left, ground.floor], friction: 1, ideal: rolling}
    fr: {between: [right, ground.floor], friction: 1, ideal: rolling}
    fb: {between: [caster, ground.floor], friction: 1, ideal: rolling}
"""
ONE_WHEEL = "".join(row for row in AXLE.splitlines(True) if "fr:" not in row)
PLACED = "cart: {x: 0, y: 0}"
TURNED = f"{PLACED}, l: {{angle: 0}}, r: {{angle: 0}}"


def carted(text: str, start: str) -> Case:
    return parsed(f"{text}initial: {{{start}}}\nallow: {{cart.x: 1.0e-2}}\n")


@pytest.mark.parametrize(
    ("start", "lacking"),
    [
        ("cart: {x: 0, y: 0, vx: 1}", "3 more needed: l.angle, r.angle, cart.attitude "),
        (TURNED, "1 more needed: cart.attitude "),
    ],
)
def test_two_wheels_on_an_axle_are_told_their_reason_first_and_all_that_lacks(
    start: str, lacking: str
) -> None:
    """Neither is held by fewer words once more is given, so it is not asked for to no end."""
    reason, more = (mistake.what for mistake in all_refused(carted(AXLE, start)))
    assert reason.startswith("the constraints are not independent")
    assert more.startswith(lacking)


def test_what_is_named_is_enough() -> None:
    """Of one wheel nothing is held twice: each name that is given takes its part of the number."""
    needed = {
        PLACED: "4 more needed: l.angle, r.angle, cart.attitude are",
        TURNED: "2 more needed: cart.attitude is",
    }
    for start, expected in needed.items():
        assert refused(carted(ONE_WHEEL, start)).what.startswith(expected)
    upright = "y: 0, attitude: {axis: [0, 0, 1], angle: 0}"
    assemble(carted(ONE_WHEEL, TURNED.replace("y: 0", upright)))


@pytest.mark.mutant(
    "of an open start in space only the joints' coordinates are named",
    "what is held twice is told once all is given",
)
def test_what_lacks_and_why_is_seen(monkeypatch: Patch) -> None:
    """A body that a joint holds may be what lacks; and the reason comes first."""
    with monkeypatch.context() as planted:
        planted.setattr(SpatialClosure, "_open_places", lambda closure, loose, small: {})
        assert "cart.attitude" not in refused(carted(ONE_WHEEL, PLACED)).what
    monkeypatch.setattr(positions, "_repeated", lambda closure, q, loose: None)
    assert "not independent" not in refused(carted(AXLE, PLACED)).what
