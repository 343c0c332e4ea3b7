"""Stops of a joint's turn: the range of MuJoCo's joint, with sensors of what holds it there."""

import math
from collections.abc import Mapping
from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from ...cases.scene import Scene
from ...cases.stops import Stops
from ...cases.trajectory import Array
from ..engine import Choice
from .contact import HARDEST, damping_ratio
from .hinge import Hinge, hinge
from .written import written

NEVER = 1e6  # rad: where no turn ends
BEAT = 0.05  # h times the frequency of a stop that throws back
RISE = 10.0  # 1/s: what is stopped comes back to the stop within a fifth of a second


def write_stops(sections: Mapping[str, ET.Element], stops: Stops, about: Hinge) -> None:
    """The range, as MuJoCo counts the angle."""
    assert about.element is not None
    ends = sorted(about.way * at for at in _ends(stops))
    about.element.set("limited", "true")
    about.element.set("range", written(*map(math.degrees, ends)))


def _ends(stops: Stops) -> tuple[float, float]:
    low = -NEVER if stops.low is None else stops.low
    return low, NEVER if stops.high is None else stops.high


def finish_stops(root: ET.Element, scene: Scene, soft: dict[str, str]) -> None:
    """A setting's numbers for the limits, and their sensors behind those of others."""
    for stops in scene.stops():
        about = hinge(scene, stops, root)
        assert about.element is not None
        about.element.attrib.update(soft)
        found = root.find("sensor")
        sensors = ET.SubElement(root, "sensor") if found is None else found
        ET.SubElement(sensors, "jointlimitfrc", name=stops.name, joint=about.name)
        ET.SubElement(sensors, "jointpos", name=f"{stops.name}.angle", joint=about.name)


def stop_numbers(model: mujoco.MjModel, stops: Stops, about: Hinge) -> dict[str, float]:
    """Where the range ends."""
    ends = sorted(about.way * model.jnt_range[model.joint(about.name).id])
    return {side: ends[("low", "high").index(side)] for side in stops.sides}


def pushing(scene: Scene, model: mujoco.MjModel, quantity: str, sensed: Array) -> Array:
    """(N,) with what moment one of the stops pushes, from the sensors' rows (N, ·)."""
    name, _, side = quantity.rpartition(".")
    stops = next(stops for stops in scene.stops() if stops.name == name)
    size, angle = (sensed[:, model.sensor(n).adr[0]] for n in (name, f"{name}.angle"))
    low, high = _ends(stops)
    below = hinge(scene, stops).way * angle < (low + high) / 2
    return np.where(below == (side == "low"), size, 0.0)


def recipe(bounce: float) -> list[Choice]:
    """The limits' numbers, for what throws back with a part of the speed."""
    if bounce:
        k, b = f"{BEAT**2:.4g}/h2", 2 * damping_ratio(bounce) * BEAT
        because = f"k = ({BEAT}/h)²: a bounce lasts 64 h; b gives e, to 0.5 %"
    else:
        k, b = f"{RISE:g}/h", 1.0
        because = f"k = {RISE:g}/h, b = 1/h: it is hardly thrown back, and rises slowly"
    return [
        Choice("stop.solreflimit", [f"-{k}", f"{-b}/h"], because),
        Choice("stop.solimplimit", [HARDEST, HARDEST, 0.001], "the hardest MuJoCo takes"),
        Choice(
            "flag.diagexact", "enable", "or k and b are those of the inertia at the file's own pose"
        ),
    ]
