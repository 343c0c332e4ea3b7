"""Contacts of two bodies: what a file makes of them, how they are observed, what can be wrong."""

import math
from pathlib import Path

import numpy as np
import pytest

from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Scene
from textmech.cases.scene.observe import motion_of, observe
from textmech.cases.scene.pair import FACES, Pair
from textmech.cases.scene.point import Anchor
from textmech.cases.trajectory import Array, Trajectory

TEXT = """\
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


def scene_of(tmp_path: Path, text: str = TEXT) -> Scene:
    path = tmp_path / "pairs.yaml"
    path.write_text(text)
    return load(path)[0].scene


def test_loads(tmp_path: Path) -> None:
    scene = scene_of(tmp_path)
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


def test_rims_are_observed(tmp_path: Path) -> None:
    """Centres 5 apart along (3, 4)/5; along is (4, −3)/5: 2·0.8 + 0.2·3 + 0.5·4 and a push of 5."""
    scene = scene_of(tmp_path)
    motion = moved(disk=[1, -2, 1.0, 0, 0, 4.0], other=[4, 2, 0, 2.0, 0, 3.0])
    gap, slip = seen(scene, motion, "rims.gap", "rims.slip")
    assert gap == pytest.approx(5 - 0.7)
    # where both are nearest, 4.8 from the first centre, which turns with 4 rad/s
    assert slip == pytest.approx(2 * 0.8 + 0.2 * 3 + 4.8 * 4)


def test_a_side_that_turns_is_observed(tmp_path: Path) -> None:
    """The box turned by 90°: its top faces −x, 1 m to the left, and along it is +y."""
    scene = scene_of(tmp_path)
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


def test_faces_are_the_sides(tmp_path: Path) -> None:
    """Each normal points out of the middle, and the ends lie along the side, left of it first."""
    body = scene_of(tmp_path).bodies["box"]
    for face in FACES.values():
        one, two = (np.array(body.points[end]) for end in face.ends)
        assert one @ face.normal == two @ face.normal > 0
        way: Array = (two - one) / np.linalg.norm(two - one)
        np.testing.assert_allclose(way, face.along)


def test_the_end_of_a_side_is_known(tmp_path: Path) -> None:

    scene = scene_of(tmp_path)
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
def test_a_mistake_is_told(old: str, new: str, where: str, what: str, tmp_path: Path) -> None:
    with pytest.raises(CaseError) as caught:
        scene_of(tmp_path, TEXT.replace(old, new))
    (mistake,) = caught.value.mistakes
    assert (mistake.where, mistake.what) == (f"scene.contacts.{where}", what)


def test_a_name_is_one_parts(tmp_path: Path) -> None:
    """A pair's too."""
    with pytest.raises(CaseError) as caught:
        scene_of(tmp_path, TEXT.replace("rims: {b", "rod: {b"))
    assert "'rod' already names one of the bodies" in [m.what for m in caught.value.mistakes]
