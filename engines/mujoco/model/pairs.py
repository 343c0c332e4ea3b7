"""Two bodies that touch, as MuJoCo's geoms, pairs and sensors."""

from xml.etree import ElementTree as ET

import numpy as np

from ....cases.scene import Scene
from ....cases.scene.pair import Pair
from ....cases.trajectory import Array
from .number_text import written
from .planes import POINT, Soft, dimensions, touching

NUMBERS = 9  # of a pair's sensor: its force in the axes of the contact, the normal, the tangent
DEEP = 1.0  # m, half a block's size along z: a point is nearer to its faces


def add_geoms(element: ET.Element, scene: Scene, body: str) -> None:
    """Add geoms for what touches on the body, and for what is touched: a sphere, a point, a box."""
    for pair in scene.pairs.values():
        if pair.body == body:
            at = scene.bodies[body].points[pair.at.point]
            _geom(element, pair.name, "sphere", written(pair.radius(scene.bodies) or POINT), at)
        elif pair.touched == body and pair.face is None:
            _geom(element, touched(pair), "sphere", written(pair.reach(scene.bodies)))
        elif pair.touched == body:
            width, height = scene.bodies[body].size or (0.0, 0.0)
            _geom(element, touched(pair), "box", written(width / 2, height / 2, DEEP))


def _geom(
    element: ET.Element, name: str, kind: str, size: str, at: tuple[float, float] = (0.0, 0.0)
) -> None:
    ET.SubElement(
        element, "geom", name=name, type=kind, size=size, pos=written(*at, 0), contype="0",
        conaffinity="0",
    )  # fmt: skip


def add_pairs(contacts: ET.Element, scene: Scene, soft: Soft) -> None:
    """The pairs."""
    for pair in scene.pairs.values():
        ET.SubElement(
            contacts, "pair", dict(soft(pair.name)),
            name=pair.name, geom1=touched(pair), geom2=pair.name, condim=dimensions(pair.friction),
            friction=written(pair.friction, pair.friction, 0, 0, 0),
        )  # fmt: skip


def add_pair_sensors(sensors: ET.Element, scene: Scene) -> None:
    """Add sensors of each pair's force; the normal and the tangent, in whose axes it is, turn."""
    for pair in scene.pairs.values():
        ET.SubElement(
            sensors, "contact", geom1=touched(pair), geom2=pair.name, data="force normal tangent",
            num="1", reduce="maxforce",
        )  # fmt: skip


def pair_force(scene: Scene, name: str, felt: Array) -> Array:
    """`touch.normal` or `touch.tangent` (N,) on what touches, from the sensors' rows."""
    part, _, field = name.rpartition(".")
    first = 3 * len(touching(scene)) + NUMBERS * list(scene.pairs).index(part)
    force, normal, tangent = np.split(felt[:, first : first + NUMBERS], 3, axis=1)
    if field == "normal":
        return force[:, 0].copy()
    along = np.stack([normal[:, 1], -normal[:, 0]], axis=1)
    beside = np.cross(normal, tangent)[:, :2]
    both = force[:, 1:2] * tangent[:, :2] + force[:, 2:] * beside
    return np.sum(both * along, axis=1)


def touched(pair: Pair) -> str:
    """The name of the geom that is touched, which no contact can have."""
    return f"{pair.name}.on"
