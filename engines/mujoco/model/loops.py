"""Constraints that close loops: `connect`, or a tendon of held length for a massless rod.

A pin of the plane is one `connect` at the joint's own points: of a hinge's two the second would
hold nothing there that is not held.
"""

import math
from collections.abc import Sequence
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np

from ....cases.scene import GROUND, Anchor, Scene
from ....cases.scene.chain import orthogonal_complement
from ....cases.scene.frame import PLANE, SPACE
from ....cases.scene.joint import Joint
from ....cases.scene.rotation import Vector3
from ....cases.trajectory import Array
from ...engine import Choice
from .contact import HARDEST
from .number_text import section, written
from .tree import called, held_points, local


def add_loops(
    root: ET.Element,
    scene: Scene,
    loops: Sequence[Joint],
    pins: dict[str, str],
    rods: dict[str, str],
) -> None:
    """pins, rods: the attributes that a setting gives each."""
    equality = ET.SubElement(root, "equality")
    for joint in loops:
        if not joint.swings:
            if scene.frame is SPACE:
                _add_sites(root, scene, joint)
            for name, site1, site2 in connections(scene, joint):
                given = {"name": name, "site1": site1, "site2": site2}
                ET.SubElement(equality, "connect", pins, **given)
    for rod in loops:
        if rod.swings:
            # MuJoCo counts from the length at the file's own pose, where all its joints are at 0
            more = (rod.length or 0.0) - math.dist(_at(root, str(rod.a)), _at(root, str(rod.b)))
            poly = written(more, 0, 0, 0, 0)
            held = {"name": rod.name, "tendon1": rod.name, "polycoef": poly}
            ET.SubElement(equality, "tendon", rods, **held)


def connections(scene: Scene, joint: Joint) -> list[tuple[str, str, str]]:
    """Each `connect` that holds a joint: its name, and the sites on the first and second part."""
    if scene.frame is PLANE:
        return [(joint.name, str(joint.a), str(joint.b))]
    names = [f"{joint.name}.{number}" for number in range(held_points(scene, joint) or 0)]
    return [(name, f"{name}.a", f"{name}.b") for name in names]


def _add_sites(root: ET.Element, scene: Scene, joint: Joint) -> None:
    """The sites in space, which are not the joint's own points alone."""
    elements = {element.attrib["name"]: element for element in root.iter("body")}
    (world,) = root.iter("worldbody")
    for number, offset in enumerate(connect_points(scene, joint)):
        for side, anchor in (("a", joint.a), ("b", joint.b)):
            home = str(anchor) if str(anchor) in elements else called(anchor.body)
            at = [x + dx for x, dx in zip(local(scene, anchor), offset, strict=True)]
            name = f"{joint.name}.{number}.{side}"
            ET.SubElement(elements.get(home, world), "site", name=name, pos=written(*at))


def connect_points(scene: Scene, joint: Any) -> list[Vector3]:
    """The points, from each of the joint's own in the axes of both parts, that `connect` holds.

    A hinge's lie on its axis. As far apart as the parts are large, for softness is one of length.
    """
    count = held_points(scene, joint)
    assert count is not None
    turns = [turn.axis for turn in joint.turns] if count == 2 else []
    ways = [*turns, *(u.tolist() for u in orthogonal_complement(turns))]
    reach = max(_reach(scene, joint.a), _reach(scene, joint.b)) or 1.0
    offsets = [(0.0, 0.0, 0.0)]
    for x, y, z in ways[: count - 1]:
        offsets.append((reach * x, reach * y, reach * z))
    return offsets


def _reach(scene: Scene, anchor: Anchor) -> float:
    """How far [m] the body's points are from its centre."""
    points = scene.bodies[anchor.body].points.values() if anchor.body != GROUND else ()
    return max((float(np.linalg.norm(at)) for at in points), default=0.0)


def add_rods(root: ET.Element, loops: Sequence[Joint]) -> None:
    """The tendons that are held."""
    if rods := [joint for joint in loops if joint.swings]:
        for rod in rods:
            spatial = ET.SubElement(section(root, "tendon"), "spatial", name=rod.name)
            for end in (rod.a, rod.b):
                ET.SubElement(spatial, "site", site=str(end))


def _at(root: ET.Element, site: str) -> tuple[float, float]:
    """Where a site is at the file's own pose: bodies stand in bodies, turned about z."""
    parents = {child: parent for parent in root.iter() for child in parent}
    part = next(element for element in root.iter("site") if element.get("name") == site)
    x, y = 0.0, 0.0
    while part.tag != "worldbody":
        dx, dy, _ = map(float, part.get("pos", "0 0 0").split())
        cos, _, _, sin = map(float, part.get("quat", "1 0 0 0").split())
        cos, sin = cos * cos - sin * sin, 2 * cos * sin
        x, y = cos * x - sin * y + dx, sin * x + cos * y + dy
        part = parents[part]
    return x, y


def pulled(force: Array, a: Array, b: Array) -> Array:
    """(N, 3) on the second point of a rod between a and b (N, 3), from what holds it (N, 1)."""
    along = (b - a) / np.linalg.norm(b - a, axis=1, keepdims=True)
    return force * along  # positive where it lengthens the tendon


def recipe() -> list[Choice]:
    """The numbers of rods in loops."""
    return [
        Choice("rod.solref", ["4h", 1.0], "4 h: forces 20 times nearer than with 2 h"),
        Choice("rod.solimp", [HARDEST, HARDEST, 0.001], "the hardest MuJoCo takes: d = 0.9999"),
        Choice(
            "flag.diagexact",
            "enable",
            "or its stiffness is that of the file's own pose, where a rod may have no length",
        ),
    ]
