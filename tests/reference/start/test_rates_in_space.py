"""The rates that joints in space are given at the start, read back by matrices alone."""

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest
from given.scenes import typed
from scipy.spatial.transform import Rotation

from textmech.cases.mistake import CaseError
from textmech.reference.mechanism.kinematics.spatial_coordinates import SpatialCoordinates
from textmech.reference.start.assembly import assemble
from textmech.reference.start.closure import Coordinate
from textmech.reference.start.spatial_closure import SpatialClosure
from textmech.reference.system import Array

KNOWN = 1e-12  # rad/s, m/s: all rates are near 1
PAIR = """\
scene:
  space: 3
  points: {O: [0, 0, 0], hook: {at: [0.1, 0.2, 0.3], velocity: [0.3, -0.2, 0.5]}}
  bodies:
    a: {rigid: {mass: 1.0, inertia: [0.2, 0.3, 0.25, 0, 0, 0]}, points: {P: [0.2, 0.1, 0]}}
    b: {rigid: {mass: 1.0, inertia: [0.1, 0.2, 0.15, 0, 0, 0]}, points: {P: [0, 0.1, -0.2]}}
  joints:
    stand: {hinge: [ground.O, a.center], axis: [1, 2, 2]}
    k: {JOINT}
initial: {stand: {angle: 40 deg, omega: 0.7}, k: {GIVEN}}
allow: {a.attitude: 1.0e-3}
"""
BALL = ("ball: [a.P, b.P]", "attitude: {axis: [1, 1, 0], angle: 50 deg}, omega: [0.3, -0.4, 0.9]")
FREEDOMS = "freedoms: {{{}}}, of: [{}]"
TWO = FREEDOMS.format("p: {hinge: [0, 0, 1]}, q: {hinge: [1, 0, 1]}", "a.P, b.P")
THREE = FREEDOMS.format(
    "s: {slide: [1, 0, 1]}, p: {hinge: [0, 0, 1]}, q: {hinge: [0, 1, 0]}, r: {hinge: [1, 0, 0]}",
    "a.P, b.P",
)
ON_HOOK = FREEDOMS.format("s: {slide: [1, 0, 1]}, u: {slide: [0, 1, 0]}", "ground.hook, b.P")


def started(folder: Path, joint: str, given: str) -> dict[str, Array]:
    case = typed(folder, PAIR.replace("JOINT", joint).replace("GIVEN", given))
    poses = SpatialCoordinates(case.scene).poses(*assemble(case))
    return {name: np.array(pose, float) for name, pose in poses.items()}


def spins(poses: dict[str, Array]) -> tuple[Array, Array, Array]:
    """ω of b against a in the axes of a, and both matrices (3, 3)."""
    R = {n: Rotation.from_quat(s[3:7], scalar_first=True).as_matrix() for n, s in poses.items()}
    relative = R["a"].T @ (R["b"] @ poses["b"][10:] - R["a"] @ poses["a"][10:])
    return relative, R["a"], R["b"]


def about(axis: tuple[float, float, float], angle: float) -> Array:
    unit = np.array(axis) / np.linalg.norm(axis)
    return Rotation.from_rotvec(angle * unit).as_matrix()


def two_turns(folder: Path) -> float:
    poses = started(folder, TWO, "p: 0.5, q: -0.8, p_dot: 2.0, q_dot: -1.0")
    skew = np.array([1, 0, 1]) / np.sqrt(2)
    wanted = 2.0 * np.array([0, 0, 1.0]) - 1.0 * about((0, 0, 1), 0.5) @ skew
    return float(np.max(np.abs(spins(poses)[0] - wanted)))


def ball(folder: Path) -> float:
    relative, R_a, R_b = spins(started(folder, *BALL))
    return float(np.max(np.abs(R_b.T @ R_a @ relative - [0.3, -0.4, 0.9])))


def on_hook(folder: Path) -> float:
    """b does not turn: its rate is that of the hook, and both slides'."""
    pose = started(folder, ON_HOOK, "s: 0.2, u: 0.1, s_dot: 0.4, u_dot: -0.6")["b"]
    wanted = np.array([0.3, -0.2, 0.5]) + 0.4 * np.array([1, 0, 1]) / np.sqrt(2)
    return float(np.max(np.abs(pose[7:10] - wanted - [0, -0.6, 0])))


@pytest.mark.parametrize("off", [two_turns, ball, on_hook])
def test_rates_of_a_joint_are_those_of_its_second_part_against_its_first(
    off: object, tmp_path: Path
) -> None:
    assert off(tmp_path) < KNOWN  # type: ignore[operator]


def test_three_turns_and_a_slide_between_moving_parts(tmp_path: Path) -> None:
    given = "s: 0.3, s_dot: 0.8, p: 0.4, q: 0.3, r: -0.6, p_dot: 1.0, q_dot: 0.5, r_dot: -0.7"
    poses = started(tmp_path, THREE, given)
    relative, R_a, R_b = spins(poses)
    z, y, x = np.eye(3)[::-1]
    first = about((0, 0, 1), 0.4)
    wanted = z + 0.5 * first @ y - 0.7 * first @ about((0, 1, 0), 0.3) @ x
    assert np.max(np.abs(relative - wanted)) < KNOWN
    v = {}
    for name, R, P in (("a", R_a, [0.2, 0.1, 0]), ("b", R_b, [0, 0.1, -0.2])):
        pose = poses[name]
        v[name] = pose[7:10] + np.cross(R @ pose[10:], R @ np.array(P))
    slid = R_a @ np.array([1, 0, 1]) / np.sqrt(2)
    turning = np.cross(R_a @ poses["a"][10:], 0.3 * slid)
    assert np.max(np.abs(v["b"] - v["a"] - turning - 0.8 * slid)) < KNOWN


@pytest.mark.mutant("rates of a joint between moving parts: ω of the first in wrong axes, {off}")
@pytest.mark.parametrize("off", ["two turns", "a ball"])
def test_rates_in_the_axes_of_the_other_part_are_seen(
    off: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """−R_aᵀ R_b in place of −R_bᵀ R_a."""
    sound = SpatialClosure.relative

    def wrong(self: SpatialClosure, joint: object, q: Array) -> Array:
        rows = sound(self, joint, q)  # type: ignore[arg-type]
        at = self.where.slots["a"].omega
        assert at is not None
        rows[:, at : at + 3] = rows[:, at : at + 3].T
        return rows

    monkeypatch.setattr(SpatialClosure, "relative", wrong)
    assert {"two turns": two_turns, "a ball": ball}[off](tmp_path) > 0.01


@pytest.mark.mutant("the rate of a slide on a point that moves counted from the ground")
def test_a_rate_against_the_ground_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sound = SpatialClosure.coordinates

    def from_the_ground(*given: object) -> Iterator[Coordinate]:
        return (each._replace(beside=0.0) for each in sound(*given))  # type: ignore[arg-type]

    monkeypatch.setattr(SpatialClosure, "coordinates", from_the_ground)
    assert on_hook(tmp_path) > 0.1


CARRIED = """\
scene:
  space: 3
  gravity: none
  bodies: {a: {sphere: {mass: 1.0, radius: 0.1}}, b: {sphere: {mass: 1.0, radius: 0.1}}}
  joints: {q: {JOINT}}
initial: {a: {x: 0, y: 0, z: 0, attitude: {axis: [0, 0, 1], angle: 0}, RATE}, q: {PLACE}}
allow: {a.x: 1.0e-3}
"""


@pytest.mark.mutant("what is carried stands still where the rows allow it")
@pytest.mark.parametrize(
    ("joint", "rate", "place", "field", "wanted"),
    [
        ("hinge: [a.center, b.center], axis: [0, 0, 1]", "omega: [0, 0, 3]", "angle: 0.5", 12, 3.0),
        ("slide: [a.center, b.center], along: [1, 0, 0]", "vx: 1.5", "shift: 0.5", 7, 1.5),
    ],
)
def test_a_joint_whose_rate_nobody_gives_carries_along(
    joint: str, rate: str, place: str, field: int, wanted: float, tmp_path: Path
) -> None:
    """Where the axis is the one about which the first part turns, the second could stand still."""
    text = CARRIED.replace("JOINT", joint).replace("RATE", rate).replace("PLACE", place)
    case = typed(tmp_path, text)
    poses = SpatialCoordinates(case.scene).poses(*assemble(case))
    assert poses["b"][field] == pytest.approx(wanted, abs=KNOWN)


LOOP = """\
scene:
  space: 3
  points: {O: [0, 0, 0], Q: {at: [0.9, 0, 0.3], velocity: [VELOCITY]}}
  bodies:
    b1: {block: {mass: 1.0, size: [0.5, 0.1, 0.1]}, points: {s: [-0.25, 0, 0], e: [0.25, 0, 0]}}
    b2: {block: {mass: 1.0, size: [0.5, 0.1, 0.1]}, points: {s: [-0.25, 0, 0], e: [0.25, 0, 0]}}
    b3: {block: {mass: 1.0, size: [0.5, 0.1, 0.1]}, points: {s: [-0.25, 0, 0], e: [0.25, 0, 0]}}
  joints: {JOINTS}
initial: {q1: {angle: 1.2GIVEN}}
near: {q2: {angle: -1.0}, q3: {angle: -0.8}}
allow: {b1.x: 1.0e-3}
"""
LINKS = (
    "q1: {hinge: [ground.O, b1.s], axis: [0, -1, 0]}",
    "q2: {hinge: [b1.e, b2.s], axis: [0, -1, 0]}",
    "q3: {hinge: [b2.e, b3.s], axis: [0, -1, 0]}",
    "end: {freedoms: {u: {slide: [0, 1, 0]}, g: {hinge: [1, 0, 0]}, h: {hinge: [0, 1, 0]}, "
    "k: {hinge: [1, 0, 0]}}, of: [ground.Q, b3.e]}",
)


def loop(folder: Path, velocity: str, given: str, joints: tuple[str, ...]) -> Array:
    """v of a loop of one freedom."""
    text = LOOP.replace("VELOCITY", velocity).replace("GIVEN", given)
    case = typed(folder, text.replace("JOINTS", ", ".join(joints)))
    return assemble(case)[1]


@pytest.mark.slow
@pytest.mark.mutant("joints' rates that are left, 0 one by one in the order of the file")
@pytest.mark.parametrize("joints", [LINKS, LINKS[::-1]])
def test_rates_that_cannot_all_be_zero_are_asked_for(
    joints: tuple[str, ...], tmp_path: Path
) -> None:
    """The loop's end is carried along: whichever joint rests, another turns."""
    with pytest.raises(CaseError, match=r"1 more needed: .*q.\.omega"):
        loop(tmp_path, "0.3, 0, 0.2", "", joints)


@pytest.mark.slow
def test_a_loop_moves_the_same_in_any_order_of_its_joints(tmp_path: Path) -> None:
    still = loop(tmp_path, "0, 0, 0", "", LINKS)
    assert not still.any()
    one, other = (loop(tmp_path, "0.3, 0, 0.2", ", omega: 0.7", j) for j in (LINKS, LINKS[::-1]))
    assert one == pytest.approx(other, abs=KNOWN)
    assert np.max(np.abs(one)) > 0.5
