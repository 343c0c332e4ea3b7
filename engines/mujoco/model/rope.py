"""Ropes: tendons that may not be longer than their range, each with a sensor of what holds it."""

from collections.abc import Mapping
from xml.etree import ElementTree as ET

import mujoco

from ....cases.scene import Scene
from ....cases.scene.forces.rope import Rope
from ....cases.trajectory import Array
from ...engine import Choice
from .contact import HARDEST
from .number_text import written


def write_rope(sections: Mapping[str, ET.Element], rope: Rope) -> None:
    """A tendon between the two ends, whose range ends at the rope's length."""
    given = {"name": rope.name, "limited": "true", "range": written(0.0, rope.length)}
    spatial = ET.SubElement(sections["tendon"], "spatial", given)
    for end in (rope.a, rope.b):
        ET.SubElement(spatial, "site", site=str(end))


def finish_ropes(root: ET.Element, scene: Scene, soft: dict[str, str]) -> None:
    """A setting's numbers for the limits, and their sensors behind those of contacts."""
    names = [rope.name for rope in scene.ropes()]
    if not names:
        return
    found = root.find("sensor")
    sensors = ET.SubElement(root, "sensor") if found is None else found
    for spatial in root.iter("spatial"):
        if spatial.get("name") in names:
            spatial.attrib.update(soft)
    for name in names:
        ET.SubElement(sensors, "tendonlimitfrc", name=name, tendon=name)


def rope_length(model: mujoco.MjModel, rope: Rope) -> dict[str, float]:
    """Where its range ends."""
    return {"length": model.tendon_range[model.tendon(rope.name).id, 1]}


def tension(model: mujoco.MjModel, rope: str, sensed: Array) -> Array:
    """(N,) what pulls its ends together, from the sensors' rows (N, ·)."""
    return sensed[:, model.sensor(rope).adr[0]]


def recipe() -> list[Choice]:
    """The limits' numbers: they must neither throw back what they catch nor give way for long."""
    because = (
        "k = 0.05/h², b = 1.8/h: what it catches is not thrown back, and on a circle it is "
        "v² h²/(0.05 L) too long; RK4 bears 2.8/h"
    )
    return [
        Choice("rope.solreflimit", ["-0.05/h2", "-1.8/h"], because),
        Choice("rope.solimplimit", [HARDEST, HARDEST, 0.001], "the hardest MuJoCo takes"),
        Choice(
            "flag.diagexact",
            "enable",
            "or k and b are those of a mean inertia at the file's own pose, not at the rope's",
        ),
    ]
