"""A torque between two bodies: an actuator at one body's site, against the site of the other."""

from collections.abc import Iterator, Mapping
from xml.etree import ElementTree as ET

import numpy as np

from ...cases.scene.forces.couple import Couple
from ...cases.scene.point import CENTER, Anchor
from ...cases.trajectory import Array
from .written import written


def write_couple(sections: Mapping[str, ET.Element], force: Couple) -> None:
    """MuJoCo turns the second body against the first, about the first's z: in the plane, z."""
    sites = {"site": f"{force.second}.{CENTER}", "refsite": f"{force.first}.{CENTER}"}
    gear = written(0, 0, 0, 0, 0, *force.signal.amplitude)
    given = {"name": force.name, **sites, "gear": gear}
    element = ET.SubElement(sections["actuator"], "general", given)
    if force.signal.law == "ramp":
        element.set("dyntype", "integrator")


def couple_outer(force: Couple, size: Array, gear: Array) -> Iterator[tuple[Anchor, Array, Array]]:
    """The torque (N,) on each body."""
    for body, way in ((force.first, -1.0), (force.second, 1.0)):
        yield Anchor(body, CENTER), np.zeros((len(size), 2)), way * size * gear[5]
