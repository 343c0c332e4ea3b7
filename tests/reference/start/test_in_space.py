"""Starts in space: ways to assemble, what a joint's coordinates tell, rates, and `near`."""

import math
from collections.abc import Callable, Iterator
from dataclasses import replace

import numpy as np
import pytest
from given.scenes import parsed, scene
from scipy.spatial.transform import Rotation

from textmech.cases.mistake import CaseError
from textmech.cases.scene import GROUND, Anchor
from textmech.cases.scene.rotation import about
from textmech.reference.mechanism.kinematics.spatial_coordinates import SpatialCoordinates
from textmech.reference.start import positions
from textmech.reference.start.assembly import assemble, start_poses
from textmech.reference.start.closure import Coordinate
from textmech.reference.start.spatial_closure import SpatialClosure, closes
from textmech.reference.system import Array

Patch = pytest.MonkeyPatch
KNOWN = 1e-12  # rad/s, m/s: all rates are near 1
BODY = (
    "{rigid: {mass: 1.0, inertia: [0.02, 0.03, 0.025, 0, 0, 0]}, "
    "points: {p: [0.2, 0, 0], q: [-0.2, 0, 0]}}"
)
BLOCK = "{block: {mass: 1.0, size: [0.5, 0.1, 0.1]}, points: {s: [-0.25, 0, 0], e: [0.25, 0, 0]}}"


def spatial(rest: str, *, points: str = "O: [0, 0, 0]", body: str = BODY, n: int = 1) -> str:
    """Returns a scene of n bodies a, b, c, with what is written beside them."""
    bodies = ", ".join(f"{name}: {body}" for name in "abc"[:n])
    head = f"scene:\n  space: 3\n  points: {{{points}}}\n  bodies: {{{bodies}}}\n"
    return f"{head}{rest}allow: {{a.x: 1.0e-3}}\n"


def started(text: str) -> Array:
    return assemble(parsed(text))[0]


def refused(text: str) -> str:
    with pytest.raises(CaseError) as caught:
        started(text)
    return str(caught.value)


FREE_LOOP = spatial(
    """\
  joints:
    j1: {hinge: [a.p, b.q], axis: [0, 0, 1]}
    j2: {universal: [b.p, c.q], axes: [[0, 0, 1], [0, 1, 0]]}
    j3: {ball: [c.p, a.q]}
initial: {a: {x: 0, y: 0, z: 0, attitude: {axis: [0, 0, 1], angle: 0}}}
""",
    n=3,
)


@pytest.mark.slow
def test_only_a_loop_closes_and_has_several_ways() -> None:
    """Three bodies in a row, and with the joint that leads back to the first; two islands."""
    loop = parsed(FREE_LOOP).scene
    row = replace(loop, joints={name: loop.joints[name] for name in ("j1", "j2")})
    held = replace(loop.joints["j3"], b=Anchor(GROUND, "O"))
    apart = replace(loop, joints={"j1": loop.joints["j1"], "held": held})
    assert [closes(scene) for scene in (loop, row, apart)] == [True, False, False]
    assert "ways" in refused(FREE_LOOP)


@pytest.mark.mutant("a hinge turned over taken for an assembly")
@pytest.mark.slow
def test_a_hinge_turned_over_is_no_assembly(monkeypatch: Patch) -> None:
    """The rows alone let the rocker stand on its head, too."""
    case = scene("spatial_linkage")
    with pytest.raises(CaseError, match=r"assembled in 2 ways.*near: \{bearing: \{angle:"):
        assemble(case)
    monkeypatch.setattr(SpatialClosure, "is_assembly", lambda self, q: True)
    with pytest.raises(CaseError, match="can be assembled in 4 ways"):
        assemble(case)


def ball_of_turns(q: str, drive: str = "") -> str:
    turns = "p: {hinge: [0, 0, 1]}, q: {hinge: [0, 1, 0]}, r: {hinge: [1, 0, 0]}"
    joints = f"  joints: {{s: {{freedoms: {{{turns}}}, of: [ground.O, a.p]}}}}\n"
    return spatial(f"{joints}{drive}initial: {{s: {{p: 0.1, q: {q}, r: 0.2}}}}\n")


FLAT = spatial(
    """\
  contacts: {c: {between: [a, ground.floor], friction: 1.0, ideal: rolling}}
initial: {a: {x: 0, y: 0, attitude: {axis: [1, 0, 0], angle: 0}, omega: [1, 2, 3]}}
""",
    body="{disk: {mass: 1.0, radius: 0.2, axle: [0, 0, 1]}}",
)
SAID = {
    "gimbal lock": (ball_of_turns("90 deg"), "at s.q = 90 deg 'p' and 'r' turn about one axis"),
    "a disk that lies flat": (FLAT, "c: a disk that lies flat has no lowest point"),
    "a drive of one of three turns": (
        ball_of_turns("0.3", "  drive: {s.q_dot: 1.0}\n"),
        "leaves three turns, and of these none can be driven",
    ),
}


@pytest.mark.parametrize("what", SAID)
def test_coordinates_that_tell_nothing_are_named(what: str) -> None:
    assert SAID[what][1] in refused(SAID[what][0])


@pytest.mark.slow
def test_beside_gimbal_lock_they_start() -> None:
    started(ball_of_turns("89 deg"))


SLIDES = spatial(
    "  joints: {guide: {slide: [ground.O, a.center], along: [1, 0, 0]}}\n"
    "initial: {guide: {shift: 0}}\n"
)
# Of those with all its rows closed the first alone is what a slide means.
TURNED = {
    "as it is": ((1, 1, 1), 0.0, True),
    "its axes in a cycle": ((1, 1, 1), 2 * np.pi / 3, False),
    "about its line, half a turn": ((1, 0, 0), np.pi, False),
    "across its line, half a turn": ((0, 1, 0), np.pi, False),
}


def meant(name: str) -> bool:
    """Whether a body turned about an axis is an assembly, as its residual of zero says."""
    axis, angle, _ = TURNED[name]
    q = np.array([0.0, 0.0, 0.0, *about(axis, angle)])
    closure = SpatialClosure(parsed(SLIDES))
    assert float(np.abs(closure.equations(q)[0]).max()) < 1e-15
    return closure.is_assembly(q)


@pytest.mark.mutant("a slide with its axes in a cycle taken for an assembly")
def test_rows_of_right_angles_hold_of_axes_turned_over(monkeypatch: Patch) -> None:
    """Three rows e_i ⊥ e_j hold after half a turn, and after a third of one about (1, 1, 1).

    The cosine of the latter is 0, between 1 and the −1 of half a turn.
    """
    assert {name: meant(name) for name in TURNED} == {name: TURNED[name][2] for name in TURNED}
    monkeypatch.setattr("textmech.reference.start.spatial_closure.ALIKE", -0.5)
    assert meant("its axes in a cycle")
    assert not meant("across its line, half a turn")


# Rates that joints are given, read back by matrices alone.

PAIR = """\
scene:
  space: 3
  points: {{O: [0, 0, 0], hook: {{at: [0.1, 0.2, 0.3], velocity: [0.3, -0.2, 0.5]}}}}
  bodies:
    a: {{rigid: {{mass: 1.0, inertia: [0.2, 0.3, 0.25, 0, 0, 0]}}, points: {{P: [0.2, 0.1, 0]}}}}
    b: {{rigid: {{mass: 1.0, inertia: [0.1, 0.2, 0.15, 0, 0, 0]}}, points: {{P: [0, 0.1, -0.2]}}}}
  joints:
    stand: {{hinge: [ground.O, a.center], axis: [1, 2, 2]}}
    k: {{{joint}}}
initial: {{stand: {{angle: 40 deg, omega: 0.7}}, k: {{{given}}}}}
allow: {{a.attitude: 1.0e-3}}
"""


def poses(text: str) -> dict[str, Array]:
    case = parsed(text)
    found = SpatialCoordinates(case.scene).poses(*assemble(case))
    return {name: np.array(pose, float) for name, pose in found.items()}


def spins(poses: dict[str, Array]) -> tuple[Array, Array, Array]:
    """ω of b against a in the axes of a, and both matrices (3, 3)."""
    R = {n: Rotation.from_quat(s[3:7], scalar_first=True).as_matrix() for n, s in poses.items()}
    relative = R["a"].T @ (R["b"] @ poses["b"][10:] - R["a"] @ poses["a"][10:])
    return relative, R["a"], R["b"]


def turn(axis: tuple[float, float, float], angle: float) -> Array:
    return Rotation.from_rotvec(angle * np.array(axis) / np.linalg.norm(axis)).as_matrix()


def two_turns() -> float:
    joint = "freedoms: {p: {hinge: [0, 0, 1]}, q: {hinge: [1, 0, 1]}}, of: [a.P, b.P]"
    found = poses(PAIR.format(joint=joint, given="p: 0.5, q: -0.8, p_dot: 2.0, q_dot: -1.0"))
    skew = np.array([1, 0, 1]) / np.sqrt(2)
    wanted = 2.0 * np.array([0, 0, 1.0]) - 1.0 * turn((0, 0, 1), 0.5) @ skew
    return float(np.max(np.abs(spins(found)[0] - wanted)))


def ball() -> float:
    given = "attitude: {axis: [1, 1, 0], angle: 50 deg}, omega: [0.3, -0.4, 0.9]"
    relative, R_a, R_b = spins(poses(PAIR.format(joint="ball: [a.P, b.P]", given=given)))
    return float(np.max(np.abs(R_b.T @ R_a @ relative - [0.3, -0.4, 0.9])))


def on_hook() -> float:
    """b does not turn: its rate is that of the hook, and both slides'."""
    joint = "freedoms: {s: {slide: [1, 0, 1]}, u: {slide: [0, 1, 0]}}, of: [ground.hook, b.P]"
    pose = poses(PAIR.format(joint=joint, given="s: 0.2, u: 0.1, s_dot: 0.4, u_dot: -0.6"))["b"]
    wanted = np.array([0.3, -0.2, 0.5]) + 0.4 * np.array([1, 0, 1]) / np.sqrt(2)
    return float(np.max(np.abs(pose[7:10] - wanted - [0, -0.6, 0])))


@pytest.mark.parametrize("off", [two_turns, ball, on_hook])
def test_rates_of_a_joint_are_those_of_its_second_part_against_its_first(
    off: Callable[[], float],
) -> None:
    assert off() < KNOWN


@pytest.mark.mutant("rates of a joint between moving parts: ω of the first in wrong axes, {off}")
@pytest.mark.parametrize("off", ["two turns", "a ball"])
def test_rates_in_the_axes_of_the_other_part_are_seen(off: str, monkeypatch: Patch) -> None:
    """−R_aᵀ R_b in place of −R_bᵀ R_a."""
    sound = SpatialClosure.relative

    def wrong(self: SpatialClosure, joint: object, q: Array) -> Array:
        rows = sound(self, joint, q)  # type: ignore[arg-type]
        at = self.where.slots["a"].omega
        assert at is not None
        rows[:, at : at + 3] = rows[:, at : at + 3].T
        return rows

    monkeypatch.setattr(SpatialClosure, "relative", wrong)
    assert {"two turns": two_turns, "a ball": ball}[off]() > 0.01


@pytest.mark.mutant("the rate of a slide on a point that moves counted from the ground")
def test_a_rate_against_the_ground_is_seen(monkeypatch: Patch) -> None:
    sound = SpatialClosure.coordinates

    def from_the_ground(*given: object) -> Iterator[Coordinate]:
        return (each._replace(beside=0.0) for each in sound(*given))  # type: ignore[arg-type]

    monkeypatch.setattr(SpatialClosure, "coordinates", from_the_ground)
    assert on_hook() > 0.1


@pytest.mark.mutant("what is carried stands still where the rows allow it")
@pytest.mark.parametrize(
    ("joint", "rate", "place", "field", "wanted"),
    [
        ("hinge: [a.center, b.center], axis: [0, 0, 1]", "omega: [0, 0, 3]", "angle: 0.5", 12, 3.0),
        ("slide: [a.center, b.center], along: [1, 0, 0]", "vx: 1.5", "shift: 0.5", 7, 1.5),
    ],
)
def test_a_joint_whose_rate_nobody_gives_carries_along(
    joint: str, rate: str, place: str, field: int, wanted: float
) -> None:
    """Where the axis is the one about which the first part turns, the second could stand still."""
    at = f"x: 0, y: 0, z: 0, attitude: {{axis: [0, 0, 1], angle: 0}}, {rate}"
    rest = f"  joints: {{q: {{{joint}}}}}\ninitial: {{a: {{{at}}}, q: {{{place}}}}}\n"
    assert poses(spatial(rest, n=2))["b"][field] == pytest.approx(wanted, abs=KNOWN)


CLOSED = (
    "freedoms: {u: {slide: [0, 1, 0]}, g: {hinge: [1, 0, 0]}, h: {hinge: [0, 1, 0]}, "
    "k: {hinge: [1, 0, 0]}}"
)
LINKS = (
    "q1: {hinge: [ground.O, a.s], axis: [0, -1, 0]}",
    "q2: {hinge: [a.e, b.s], axis: [0, -1, 0]}",
    "q3: {hinge: [b.e, c.s], axis: [0, -1, 0]}",
    f"end: {{{CLOSED}, of: [ground.Q, c.e]}}",
)


def loop(velocity: str, given: str, joints: tuple[str, ...]) -> Array:
    """v of a loop of one freedom."""
    rest = f"""\
  joints: {{{", ".join(joints)}}}
initial: {{q1: {{angle: 1.2{given}}}}}
near: {{q2: {{angle: -1.0}}, q3: {{angle: -0.8}}}}
"""
    points = f"O: [0, 0, 0], Q: {{at: [0.9, 0, 0.3], velocity: [{velocity}]}}"
    return assemble(parsed(spatial(rest, points=points, body=BLOCK, n=3)))[1]


@pytest.mark.slow
@pytest.mark.mutant("joints' rates that are left, 0 one by one in the order of the file")
def test_rates_that_cannot_all_be_zero_are_asked_for() -> None:
    """The loop's end is carried along: whichever joint rests, another turns."""
    for joints in (LINKS, LINKS[::-1]):
        with pytest.raises(CaseError, match=r"1 more needed: .*q.\.omega"):
            loop("0.3, 0, 0.2", "", joints)
    assert not loop("0, 0, 0", "", LINKS).any()
    one, other = (loop("0.3, 0, 0.2", ", omega: 0.7", j) for j in (LINKS, LINKS[::-1]))
    assert one == pytest.approx(other, abs=KNOWN)
    assert np.max(np.abs(one)) > 0.5


# `near`: the nearest of all ways.


def rocker(crank: int, near: str) -> float:
    """[deg] of the bearing, which turns about an axis in the ground's xz plane."""
    case = scene("spatial_linkage", f"near: {{{near}}}", crank=f"{crank} deg")
    w, *axis = start_poses(case)["rocker"][3:7]
    return math.degrees(2 * math.atan2(np.dot(axis, [0.6, 0, 0.8]), w)) % 360


@pytest.mark.slow
@pytest.mark.parametrize(("crank", "one", "other"), [(80, 57.1, 157.1), (240, 163.9, 104.6)])
def test_the_way_that_near_says_is_taken_in_space(crank: int, one: float, other: float) -> None:
    """With Newton's first root every one of these was missed."""
    for angle, off in ((one, 0.0), (other, 0.0), (one, 6.0), (other, -6.0)):
        found = rocker(crank, f"bearing: {{angle: {angle + off} deg}}")
        assert found == pytest.approx(angle, abs=0.06)  # as it is typed


@pytest.mark.mutant("in space the first way that is found in place of the nearest")
@pytest.mark.slow
def test_the_first_way_that_is_found_is_seen(monkeypatch: Patch) -> None:
    monkeypatch.setattr(positions, "nearest_ways", lambda closure, ways: ways[:1])
    monkeypatch.setattr(positions, "FAR", math.inf)
    assert rocker(80, "bearing: {angle: 157.1 deg}") == pytest.approx(57.1, abs=0.06)


@pytest.mark.slow
def test_what_does_not_decide_is_refused_in_space() -> None:
    with pytest.raises(CaseError, match=r"can be assembled in 2 ways: bearing\.angle"):
        rocker(80, "motor: {angle: 80 deg}")
    with pytest.raises(CaseError) as caught:
        rocker(80, "bearing: {angle: -70 deg}")
    (mistake,) = caught.value.mistakes
    assert mistake.where == "near.bearing.angle"
    assert "cannot be assembled near this: bearing.angle is " in mistake.what


@pytest.mark.slow
def test_a_chain_that_a_body_holds_may_have_two_ways() -> None:
    """A rod by its x alone is up or down, though nothing closes a loop."""
    rest = "  joints: {q: {hinge: [ground.O, a.start], axis: [0, -1, 0]}}\ninitial: {a: {x: 0.3}}\n"
    body = "{bar: {mass: 1.0, length: 1.0}}"
    with pytest.raises(CaseError, match=r"can be assembled in 2 ways: q\.angle"):
        start_poses(parsed(spatial(rest, body=body)))
    for z in (0.1, -0.4):
        pose = start_poses(parsed(spatial(f"{rest}near: {{a: {{z: {z}}}}}\n", body=body)))["a"]
        assert pose[2] == pytest.approx(math.copysign(0.4, z), abs=1e-12)


BETA = math.acos(0.8)  # of two equal links that reach 0.8 of their length: q1 = ±β, q2 = ∓2β


def two_links(first: float, second: float, place: float = 0.0) -> list[float]:
    """Returns the pose of the first of two links to a point 0.8 m away, near those angles."""
    joints = f"{', '.join(LINKS[:2])}, end: {{{CLOSED}, of: [ground.Q, b.e]}}"
    near = f"near: {{q1: {{angle: {first!r}}}, q2: {{angle: {second!r}}}}}\n"
    points = f"O: [{place}, 0, 0], Q: [{place + 0.8}, 0, 0]"
    rest = f"  joints: {{{joints}}}\ninitial: {{}}\n{near}"
    return [*start_poses(parsed(spatial(rest, points=points, body=BLOCK, n=2)))["a"]]


@pytest.mark.slow
@pytest.mark.mutant("in space all starts of the search are what is near")
@pytest.mark.parametrize(("first", "second"), [(0.0, 0.1), (-0.4, -0.3), (0.9, 0.2), (-1.5, 0.0)])
def test_near_that_names_every_turn_is_a_guess_all_the_same(first: float, second: float) -> None:
    """Of all that it says the worst counts; at (0, 0), straight, Newton finds no way at all."""
    off = {sign: max(abs(first - sign * BETA), abs(second + 2 * sign * BETA)) for sign in (1, -1)}
    w, _, y, _ = two_links(first, second)[3:7]
    nearest = min(off, key=off.__getitem__)
    assert -2 * math.atan2(y, w) == pytest.approx(nearest * BETA, abs=1e-9)


@pytest.mark.slow
def test_in_the_middle_of_all_turns_it_decides_nothing() -> None:
    with pytest.raises(CaseError, match="can be assembled in 2 ways"):
        two_links(0.0, 0.0)


def test_far_from_the_origin_rounding_is_a_place() -> None:
    """At 10 km a place has twelve digits of a metre, and the loop is closed to that."""
    assert two_links(0.6, -1.2, 10000.0)[0] == pytest.approx(10000.2, abs=1e-10)
