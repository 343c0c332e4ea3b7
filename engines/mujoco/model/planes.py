"""Planes of the ground and what touches them, as MuJoCo's geoms, pairs and sensors."""

from collections.abc import Callable, Mapping
from typing import Any
from xml.etree import ElementTree as ET

from ....cases.scene import GROUND, Contact, Scene
from ....cases.scene.frame import PLANE
from ....cases.scene.pair import Pair
from .number_text import lifted, written

Soft = Callable[[str], Mapping[str, str]]
"""By a contact's name, the attributes of its pair."""

POINT = 1e-12  # m, radius of a point that touches: too small to be an arm or a gap
THIN = 1e-6  # m, half the thickness of a disk in space: an ellipsoid, which touches in one point


def touching(scene: Scene) -> dict[str, Contact]:
    """The contacts with MuJoCo's planes: every point that may touch but feet, which are pinned."""
    return {name: contact for name, contact in scene.touching.items() if contact.ahead_of is None}


def met(scene: Scene) -> list[Contact | Pair]:
    """The contacts that MuJoCo has as its own: on planes, and of two bodies."""
    return [*touching(scene).values(), *scene.pairs.values()]


def add_planes(world: ET.Element, scene: Scene) -> None:
    """The planes that are touched; in space there is the floor z = 0 alone."""
    for contact in {contact.on: contact for contact in touching(scene).values()}.values():
        placed: dict[str, str] = {}  # where MuJoCo has a plane by itself
        if scene.frame is PLANE:
            plane = contact.plane
            placed["zaxis"] = written(*lifted(plane.normal))
            placed |= {"pos": written(*lifted(plane.at))} if any(plane.at) else {}
        ET.SubElement(
            world, "geom", placed, name=grounded(contact.on), type="plane", size="0 0 1",
            contype="0", conaffinity="0",
        )  # fmt: skip


def add_geom(element: ET.Element, scene: Scene, contact: Contact) -> None:
    """A disk's rim, a sphere, or a point."""
    body = scene.bodies[contact.body]
    shape = _in_plane if scene.frame is PLANE else _in_space
    ET.SubElement(
        element, "geom", shape(body, contact), name=contact.name, contype="0", conaffinity="0",
        pos=written(*lifted(body.points[contact.at.point])),
    )  # fmt: skip


def _in_plane(body: Any, contact: Contact) -> dict[str, str]:
    return {"type": "sphere", "size": written(POINT if body.radius is None else body.radius)}


def _in_space(body: Any, contact: Any) -> dict[str, str]:
    """A disk as thin as an ideal one, or a sphere; of a pivot one as small as a point."""
    if contact.ideal == "pivot":
        return {"type": "sphere", "size": written(THIN)}
    if not contact.rim:
        return {"type": "sphere", "size": written(body.radius)}
    size = written(body.radius, body.radius, THIN)
    return {"type": "ellipsoid", "size": size, "zaxis": written(*body.axle)}


def add_contacts(contacts: ET.Element, scene: Scene, soft: Soft) -> None:
    """The contacts with planes, as pairs; soft: what each gives way with."""
    for contact in touching(scene).values():
        # A pair takes one coefficient; two geoms would take the larger of theirs.
        ET.SubElement(
            contacts, "pair", dict(soft(contact.name)),
            name=contact.name, geom1=grounded(contact.on), geom2=contact.name,
            condim=dimensions(contact.friction),
            friction=written(contact.friction, contact.friction, 0, 0, 0),
        )  # fmt: skip


def add_sensors(sensors: ET.Element, scene: Scene) -> None:
    """The plane's force on each, along the ground's axes."""
    for name, contact in touching(scene).items():
        ET.SubElement(
            sensors, "contact", geom1=grounded(contact.on), geom2=name, data="force", num="1",
            reduce="netforce",
        )  # fmt: skip


def dimensions(friction: float) -> str:
    """The `condim` of a contact: 1 if it is smooth, for MuJoCo knows no coefficient below 1e-5."""
    return "3" if friction else "1"


def grounded(plane: str) -> str:
    """The name of a plane's geom, which no contact can have."""
    return f"{GROUND}.{plane}"
