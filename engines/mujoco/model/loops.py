"""Constraints that close loops: `connect` for a pin, a tendon of held length for a massless rod."""

import math
from collections.abc import Sequence
from xml.etree import ElementTree as ET

import numpy as np

from ....cases.scene.joint import Joint
from ....cases.trajectory import Array
from ...engine import Choice
from .contact import HARDEST
from .number_text import written


def add_loops(
    root: ET.Element, loops: Sequence[Joint], pins: dict[str, str], rods: dict[str, str]
) -> None:
    """pins, rods: the attributes that a setting gives each."""
    equality = ET.SubElement(root, "equality")
    for joint in loops:
        if not joint.swings:
            ends = {"site1": str(joint.a), "site2": str(joint.b)}
            ET.SubElement(equality, "connect", pins, name=joint.name, **ends)
    for rod in loops:
        if rod.swings:
            # MuJoCo counts from the length at the file's own pose, where all its joints are at 0
            more = (rod.length or 0.0) - math.dist(_at(root, str(rod.a)), _at(root, str(rod.b)))
            poly = written(more, 0, 0, 0, 0)
            held = {"name": rod.name, "tendon1": rod.name, "polycoef": poly}
            ET.SubElement(equality, "tendon", rods, **held)


def add_rods(root: ET.Element, loops: Sequence[Joint]) -> None:
    """The tendons that are held."""
    if rods := [joint for joint in loops if joint.swings]:
        found = root.find("tendon")
        tendons = ET.SubElement(root, "tendon") if found is None else found
        for rod in rods:
            spatial = ET.SubElement(tendons, "spatial", name=rod.name)
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
    """(N, 2) on the second point of a rod between a and b (N, 2), from what holds it (N, 1)."""
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
