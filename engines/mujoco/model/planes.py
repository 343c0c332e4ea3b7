"""Planes of the ground and what touches them, as MuJoCo's geoms, pairs and sensors."""

from collections.abc import Callable, Mapping
from xml.etree import ElementTree as ET

from ....cases.scene import GROUND, Contact, Scene
from ....cases.scene.pair import Pair
from ....cases.scene.plane import Plane
from .number_text import written

Soft = Callable[[str], Mapping[str, str]]
"""By a contact's name, the attributes of its pair."""

POINT = 1e-12  # m, radius of a point that touches: too small to be an arm or a gap


def touching(scene: Scene) -> dict[str, Contact]:
    """The contacts with MuJoCo's planes: every point that may touch but feet, which are pinned."""
    return {name: one for name, one in scene.touching.items() if one.ahead_of is None}


def met(scene: Scene) -> list[Contact | Pair]:
    """The contacts that MuJoCo has as its own: on planes, and of two bodies."""
    return [*touching(scene).values(), *scene.pairs.values()]


def add_planes(world: ET.Element, scene: Scene) -> None:
    """The planes that are touched."""
    for plane in dict.fromkeys(contact.plane for contact in touching(scene).values()):
        at = {"pos": written(*plane.at, 0)} if any(plane.at) else {}
        ET.SubElement(
            world, "geom", at, name=grounded(plane), type="plane", size="0 0 1",
            zaxis=written(*plane.normal, 0), contype="0", conaffinity="0",
        )  # fmt: skip


def add_geom(element: ET.Element, scene: Scene, contact: Contact) -> None:
    """A disk's rim, or a point."""
    radius = scene.bodies[contact.body].radius
    at = scene.bodies[contact.body].points[contact.at.point]
    ET.SubElement(
        element, "geom", name=contact.name, type="sphere", pos=written(*at, 0),
        size=written(POINT if radius is None else radius), contype="0", conaffinity="0",
    )  # fmt: skip


def add_contacts(contacts: ET.Element, scene: Scene, soft: Soft) -> None:
    """The contacts with planes, as pairs; soft: what each gives way with."""
    for contact in touching(scene).values():
        # A pair takes one coefficient; two geoms would take the larger of theirs.
        ET.SubElement(
            contacts, "pair", dict(soft(contact.name)),
            name=contact.name, geom1=grounded(contact.plane), geom2=contact.name,
            condim=dimensions(contact.friction),
            friction=written(contact.friction, contact.friction, 0, 0, 0),
        )  # fmt: skip


def add_sensors(sensors: ET.Element, scene: Scene) -> None:
    """The plane's force on each, along the ground's axes."""
    for name, contact in touching(scene).items():
        ET.SubElement(
            sensors, "contact", geom1=grounded(contact.plane), geom2=name, data="force", num="1",
            reduce="netforce",
        )  # fmt: skip


def dimensions(friction: float) -> str:
    """The `condim` of a contact: 1 if it is smooth, for MuJoCo knows no coefficient below 1e-5."""
    return "3" if friction else "1"


def grounded(plane: Plane) -> str:
    """The name of its geom, which no contact can have."""
    return f"{GROUND}.{plane.name}"
