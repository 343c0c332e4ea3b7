"""Contacts with planes, of two bodies, and of spokes: what a file makes of them."""

import math
from pathlib import Path

import numpy as np
import pytest
from given.scenes import cases_of, mistakes_of, parsed

from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Scene
from textmech.cases.scene.observe import motion_of, observe
from textmech.cases.scene.pair import FACES, Pair
from textmech.cases.scene.plane import LEVEL, Plane
from textmech.cases.scene.point import Anchor
from textmech.cases.scene.quantity import table
from textmech.cases.scene.shape import spokes
from textmech.cases.trajectory import Array, Trajectory
from textmech.reference.start.assembly import start_poses

# Planes of the ground: what a file makes of them, and what it can get wrong about them.

TEXT = """\
title: A disk in a corner
scene:
  planes: {wall: {at: [2, 0], normal: [-3, 0]}, slope: {at: [0, 1], normal: [-0.6, 0.8]}}
  bodies: {wheel: {disk: {mass: 1.0, radius: 0.5}}}
  contacts:
    low: {between: [wheel, ground.floor], friction: 0.1}
    side: {between: [wheel, ground.wall], friction: 0.1}
    ramp: {between: [wheel, ground.slope], friction: 0.1}
initial: {wheel: {x: 1.5, y: 0.5, vx: -1.0}}
duration: 1.0
samples: 26
allow: {wheel.x: 1.0e-3}
"""


def said(text: str) -> list[tuple[str, str]]:
    return [(m.where, m.what) for m in mistakes_of(text)]


def test_loads() -> None:
    scene = scene_of(TEXT)
    assert [contact.plane for contact in scene.contacts.values()] == [
        LEVEL,
        Plane("wall", (2.0, 0.0), (-1.0, 0.0)),
        Plane("slope", (0.0, 1.0), (-0.6, 0.8)),
    ]


def test_is_observed() -> None:
    """n·(r − r₀) − R, u·v + R ω and its integral, with numbers worked out by hand."""
    scene = scene_of(TEXT)
    rows = np.array([[0.0, 3.0, 0.0, 0.0, 0.0, 0.0], [1.0, 3.5, 0.2, 2.0, -1.0, 4.0]])
    motion = Trajectory(np.array([0.0, 1.0]), {"wheel": rows}, {})
    assert observe(scene, motion, "side.gap") == pytest.approx([1.5, 0.5])
    assert observe(scene, motion, "side.slip") == pytest.approx([0.0, -1.0 + 2.0])
    assert observe(scene, motion, "side.drift") == pytest.approx([0.0, 0.5 + 0.1])
    assert observe(scene, motion, "ramp.gap") == pytest.approx([1.1, -0.6 + 2.0 - 0.5])
    assert observe(scene, motion, "ramp.slip") == pytest.approx([0.0, 1.6 - 0.6 + 2.0])
    assert observe(scene, motion, "ramp.drift") == pytest.approx([0.0, 0.8 + 0.3 + 0.1])


def test_an_unknown_plane() -> None:
    hint = "is 'ground.wal'; did you mean 'ground.wall'?"
    assert said(TEXT.replace("ground.wall]", "ground.wal]")) == [
        ("scene.contacts.side.between.1", f"should be a plane of the ground, {hint}")
    ]


def test_a_mistaken_plane_drags_nothing_along() -> None:
    assert said(TEXT.replace("normal: [-3, 0]", "normal: up")) == [
        ("scene.planes.wall.normal", "should be a list, is text 'up'")
    ]


def test_twice_on_one_plane() -> None:
    assert said(TEXT.replace("ground.slope]", "ground.wall]")) == [
        ("scene.contacts.ramp.between.0", "'wheel' already touches in 'side'")
    ]


def test_the_tangent_has_the_normal_to_its_left() -> None:
    for angle in np.linspace(0.0, math.tau, 7):
        plane = Plane("p", normal=(math.cos(angle), math.sin(angle)))
        (ux, uy), (nx, ny) = plane.along, plane.normal
        assert (-uy, ux) == pytest.approx((nx, ny))


# Contacts of two bodies: what a file makes of them, how they are observed, what can be wrong.

ON_EACH_OTHER = """\
title: A disk and a block on each other
scene:
  bodies:
    disk: {disk: {mass: 1.0, radius: 0.5}}
    other: {disk: {mass: 1.0, radius: 0.2}}
    box: {block: {mass: 1.0, width: 4.0, height: 2.0}}
    rod: {bar: {mass: 1.0, length: 1.0}}
    wheel: {spokes: {number: 6, length: 0.3, mass: 1.0, inertia: 0.1}}
  contacts:
    rims: {between: [other, disk], friction: 0.1, restitution: 0.7}
    lies: {between: [disk, box.top], friction: {static: 0.3, kinetic: 0.2}}
    stands: {between: [rod.end, box.left], friction: 0}
initial: {disk: {x: 0, y: 1.5, angle: 0}, box: {x: 0, y: 0, angle: 0}}
duration: 1.0
samples: 26
allow: {disk.x: 1.0e-3, lies.normal: 1.0}
"""


def scene_of(text: str) -> Scene:
    return cases_of(text)[0].scene


def test_pairs_load() -> None:
    scene = scene_of(ON_EACH_OTHER)
    assert not scene.contacts
    assert list(scene.pairs.values()) == [
        Pair("rims", Anchor("other", "center"), "disk", None, 0.1, 0.1, 0.7),
        Pair("lies", Anchor("disk", "center"), "box", "top", 0.3, 0.2),
        Pair("stands", Anchor("rod", "end"), "box", "left", 0.0, 0.0),
    ]
    assert [pair.on for pair in scene.pairs.values()] == [
        "rim of disk",
        "top of box",
        "left of box",
    ]


def moved(**bodies: list[float]) -> Trajectory:
    """One row of each body; what is not given rests far away."""
    names = ("disk", "other", "box", "rod", "wheel")
    far = {name: [50.0, 0.0, 0.0, 0.0, 0.0, 0.0] for name in names}
    rows = {name: np.array([row], float) for name, row in (far | bodies).items()}
    return Trajectory(np.zeros(1), rows, {})


def seen(scene: Scene, motion: Trajectory, *quantities: str) -> list[float]:
    return [float(observe(scene, motion, quantity)[0]) for quantity in quantities]


def test_rims_are_observed() -> None:
    """Centres 5 apart along (3, 4)/5; along is (4, −3)/5: 2·0.8 + 0.2·3 + 0.5·4 and a push of 5."""
    scene = scene_of(ON_EACH_OTHER)
    motion = moved(disk=[1, -2, 1.0, 0, 0, 4.0], other=[4, 2, 0, 2.0, 0, 3.0])
    gap, slip = seen(scene, motion, "rims.gap", "rims.slip")
    assert gap == pytest.approx(5 - 0.7)
    # where both are nearest, 4.8 from the first centre, which turns with 4 rad/s
    assert slip == pytest.approx(2 * 0.8 + 0.2 * 3 + 4.8 * 4)


def test_a_side_that_turns_is_observed() -> None:
    """The box turned by 90°: its top faces −x, 1 m to the left, and along it is +y."""
    scene = scene_of(ON_EACH_OTHER)
    box = [0.0, 0.0, math.pi / 2, 0.0, 0.5, 2.0]
    motion = moved(disk=[-1.7, 0.3, 0, 0.4, 0.7, 6.0], box=box)
    gap, slip = seen(scene, motion, "lies.gap", "lies.slip")
    assert gap == pytest.approx(0.2)
    # at (−1.2, 0.3) the disk moves with 0.7 + 0.5·6 along y, the box with 0.5 − 1.2·2
    assert slip == pytest.approx(0.7 + 3.0 - (0.5 - 2.4))
    parts = scene.pairs["lies"]

    growth = parts.slip_and_gap_rate(motion_of(scene, motion))[1]
    # apart along −x: −0.4 of the disk, and the box there moves with −2·0.3 along x
    assert growth == pytest.approx([-0.4 - 2 * 0.3])


def test_faces_are_the_sides() -> None:
    """Each normal points out of the middle, and the ends lie along the side, left of it first."""
    body = scene_of(ON_EACH_OTHER).bodies["box"]
    for face in FACES.values():
        one, two = (np.array(body.points[end]) for end in face.ends)
        assert one @ face.normal == two @ face.normal > 0
        way: Array = (two - one) / np.linalg.norm(two - one)
        np.testing.assert_allclose(way, face.along)


def test_the_end_of_a_side_is_known() -> None:

    scene = scene_of(ON_EACH_OTHER)
    for x, beyond in ((1.9, False), (2.0, False), (2.1, True), (-2.1, True)):
        motion = moved(disk=[x, 1.5, 0, 0, 0, 0], box=[0.0] * 6)
        assert scene.pairs["lies"].beyond(motion_of(scene, motion)).tolist() == [beyond]


@pytest.mark.parametrize(
    ("old", "new", "where", "what"),
    [
        (
            "[disk, box.top]", "[disk, box]", "lies.between.1",
            "'box' is a block and is touched on a side: box.top, box.bottom, box.left, box.right",
        ),
        (
            "[disk, box.top]", "[disk, box.lid]", "lies.between.1",
            "'box' is a block and is touched on a side: box.top, box.bottom, box.left, box.right",
        ),
        (
            "[disk, box.top]", "[box, disk]", "lies.between.0",
            "'box' is a block and touches with one point: box.lower_left, box.lower_right, "
            "box.upper_left, box.upper_right",
        ),
        (
            "[disk, box.top]", "[disk, rod.end]", "lies.between.1",
            "'rod' is a bar and has no rim and no side: touched are disks, blocks, and planes of "
            "the ground",
        ),
        (
            "[disk, box.top]", "[wheel, box.top]", "lies.between.0",
            "'wheel' has spokes, which touch planes of the ground only",
        ),
        (
            "[disk, box.top]", "[disk, other]", "lies.between",
            "disk and other already touch in 'rims'",
        ),
        (
            "[disk, box.top]", "[disk, bx.top]", "lies.between.1",
            "unknown body 'bx'; did you mean 'box'?",
        ),
        ("friction: 0}", "friction: 0, ideal: pivot}", "stands.ideal",
         "is for a plane of the ground: two bodies roll, slip and part as friction says"),
    ],
)  # fmt: skip
def test_a_mistake_is_told(old: str, new: str, where: str, what: str) -> None:
    with pytest.raises(CaseError) as caught:
        scene_of(ON_EACH_OTHER.replace(old, new))
    (mistake,) = caught.value.mistakes
    assert (mistake.where, mistake.what) == (f"scene.contacts.{where}", what)


def test_a_name_is_one_parts() -> None:
    """A pair's too."""
    with pytest.raises(CaseError) as caught:
        scene_of(ON_EACH_OTHER.replace("rims: {b", "rod: {b"))
    assert "'rod' already names one of the bodies" in [m.what for m in caught.value.mistakes]


# Spokes and their tips: where they are, what they may do, and how a start stands on one.

L, J = 0.3, 0.09
SCENE = """\
scene:
  bodies: {{wheel: {{spokes: {{number: 6, length: 0.3, mass: 2, inertia: 0.09}}{points}}}}}
  contacts: {{feet: {{between: [{at}, ground.floor], friction: 1{ideal}}}}}
initial: {{wheel: {{{start}}}}}
allow: {{wheel.x: 1.0e-3}}
"""
SOUND = {
    "points": "",
    "at": "wheel",
    "ideal": ", ideal: pivot",
    "start": "x: 0, angle: 0, on: tip1, omega: -2",
}


def test_tips_stand_on_a_circle_counter_clockwise() -> None:
    body = spokes(name="wheel", number=6, length=L, mass=2.0, inertia=J, points={"P": (0.1, 0.0)})
    tips = np.array([body.points[tip] for tip in body.tips])
    assert np.hypot(*tips.T) == pytest.approx(L)
    turns = np.unwrap(np.arctan2(tips[:, 1], tips[:, 0]))
    assert np.diff(turns) == pytest.approx(math.tau / 6)
    assert tips[0] == pytest.approx((-L / 2, -L * math.cos(math.pi / 6)))
    assert tips[1] == pytest.approx((L / 2, -L * math.cos(math.pi / 6)))
    assert (body.moment, body.points["P"]) == (J, (0.1, 0.0))


def test_a_start_stands_on_a_tip_that_does_not_move() -> None:
    """y = l cos α, and v = ω × r from the tip at (l sin α, 0)."""
    case = parsed(SCENE.format(**SOUND))
    height = L * math.cos(math.pi / 6)
    wanted = (0.0, height, 0.0, 2 * height, 2 * L / 2, -2.0)
    assert start_poses(case)["wheel"] == pytest.approx(wanted, abs=1e-15)


def test_gap_and_slip_are_of_the_lowest_tips() -> None:
    """Turned by 10° about tip1 the next one is l sin 10° − … above the floor; and slip of tip1."""
    scene = parsed(SCENE.format(**SOUND)).scene
    turn, half = math.radians(10), math.pi / 6
    x, y = L * math.sin(half) - L * math.sin(half - turn), L * math.cos(half - turn)
    states = {"wheel": np.array([[x, y, -turn, 0.5, 0.0, -2.0], [x, y, 0.0, 0.5, 0.0, 0.0]])}
    motion = Trajectory(np.array([0.0, 1.0]), states, {})
    gap, slip = (observe(scene, motion, f"feet.{field}") for field in ("gap", "slip"))
    assert gap[0] == pytest.approx(y - L * math.cos(half + turn), rel=1e-12)
    assert slip == pytest.approx([0.5 - 2.0 * y, 0.5])
    assert not any(name.startswith("feet.") and "drift" in name for name in table(scene))


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"ideal": ""}, "'wheel' has spokes, which only pivot here: write `ideal: pivot`"),
        ({"at": "wheel.tip1"}, "'wheel' touches with its tips: write 'wheel'"),
        ({"points": ", points: {tip5: [0, 0]}"}, "the name 'tip5' is taken"),
        ({"start": "x: 0, on: tip6, omega: -2"}, "body 'wheel' has no point 'tip6'"),
    ],
)
def test_what_spokes_cannot_is_said(changed: dict[str, str], words: str) -> None:
    with pytest.raises(CaseError) as caught:
        parsed(SCENE.format(**{**SOUND, **changed}))
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("start", "words"),
    [
        ("x: 0, angle: 0, on: tip1, vx: 1, omega: -2", "`on` says that"),
        ("x: 0, angle: 0, y: 1, on: tip1", "stays open by"),
        ("angle: 0, on: tip1", "wheel.x is not determined"),
    ],
)
def test_a_start_that_cannot_be_is_said(start: str, words: str) -> None:
    case = parsed(SCENE.format(**{**SOUND, "start": start}))
    with pytest.raises(CaseError, match=words):
        start_poses(case)


def test_spokes_are_a_whole_number(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    scene = SCENE.format(**SOUND).replace("number: 6", "number: n")
    path.write_text(f"title: x\nparameters: {{n: 8.4}}\n{scene}duration: 1\nsamples: 3\n")
    with pytest.raises(CaseError, match=r"from 3 to 100, is 8.4 \(n\)"):
        load(path)


FEET = """\
scene:
  bodies: {{a: {{bar: {{mass: 1, length: 1}}}}, b: {{bar: {{mass: 1, length: 1}}}}}}
  joints: {{hip: {{pin: [a.end, b.end]}}}}
  contacts:
    one: {{between: [a.start, ground.floor], friction: 1, ideal: pivot, ahead_of: {one}}}
    two: {{between: [b.start, ground.floor], friction: 1, ideal: pivot{two}}}
initial: {{a: {{start: [0, 0], on: start, angle: 100 deg}}, b: {{angle: 80 deg}}}}
allow: {{a.angle: 1.0e-3}}
"""


@pytest.mark.parametrize(
    ("one", "two", "words"),
    [
        ("b.start", "", "'b.start' should be the other foot, with a contact ahead of this one"),
        ("b.end", ", ahead_of: a.start", "'b.end' should be the other foot"),
        ("b.stop", ", ahead_of: a.start", "body 'b' has no point 'stop'"),
        ("c.start", ", ahead_of: a.start", "unknown body 'c'"),
    ],
)
def test_feet_are_two(one: str, two: str, words: str) -> None:
    with pytest.raises(CaseError) as caught:
        parsed(FEET.format(one=one, two=two))
    assert words in str(caught.value)
    parsed(FEET.format(one="b.start", two=", ahead_of: a.start"))
