"""Ropes: tendons that may not be longer than their range, each with a sensor of what holds it."""

from collections.abc import Mapping
from xml.etree import ElementTree as ET

import mujoco

from ....cases.scene.forces.rope import Rope
from ....cases.trajectory import Array
from ...engine import Choice
from .contact import HARDEST
from .number_text import Softness, written


def write_rope(sections: Mapping[str, ET.Element], rope: Rope) -> None:
    """A tendon between the two ends, whose range ends at the rope's length."""
    given = {"name": rope.name, "limited": "true", "range": written(0.0, rope.length)}
    spatial = ET.SubElement(sections["tendon"], "spatial", given)
    for end in (rope.a, rope.b):
        ET.SubElement(spatial, "site", site=str(end))


def finish_rope(root: ET.Element, sensors: ET.Element, rope: Rope, soft: Softness) -> None:
    """A setting's numbers for the limit, and its sensor."""
    (spatial,) = (each for each in root.iter("spatial") if each.get("name") == rope.name)
    spatial.attrib.update(soft)
    ET.SubElement(sensors, "tendonlimitfrc", name=rope.name, tendon=rope.name)


def rope_length(model: mujoco.MjModel, rope: Rope) -> dict[str, float]:
    """Where its range ends."""
    return {"length": model.tendon_range[model.tendon(rope.name).id, 1]}


def tension(model: mujoco.MjModel, rope: Rope, side: str, sensed: Array) -> Array:
    """(N,) what pulls its ends together, from the sensors' rows (N, ·)."""
    return sensed[:, model.sensor(rope.name).adr[0]]


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
