"""Feet that stand one after the other, as MJCF: pins to the floor, of which the driver moves the
sites and says which are active."""

from collections.abc import Mapping
from xml.etree import ElementTree as ET

from ...cases.scene import Scene
from ..engine import Start
from ..stride import strode
from .contact import lies, place
from .written import written


def add_pins(root: ET.Element, scene: Scene, start: Start, attributes: Mapping[str, str]) -> None:
    """A `connect` for each foot, with the contact's name; those that lie on the floor stand."""
    world = root.find("worldbody")
    feet = strode(scene)
    if world is None or not feet:
        return
    equality = root.find("equality")
    equality = ET.SubElement(root, "equality") if equality is None else equality
    for name, foot in feet.items():
        stands = lies(scene, foot, start)
        at = place(scene, foot.at, start) if stands else (0.0, 0.0)
        ET.SubElement(world, "site", name=name, pos=written(*at, 0))
        ET.SubElement(
            equality, "connect", dict(attributes),
            name=name, site1=name, site2=str(foot.at), active="true" if stands else "false",
        )  # fmt: skip
