"""Elements that hold on one side: ropes, and stops of a joint's turn."""

import math
from collections.abc import Mapping, Sequence
from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from ....cases.scene import Limit
from ....cases.scene.forces.limit import Rope, Stops
from ....cases.trajectory import Array
from ...engine import Choice
from .bounce import dead, springy
from .contact import HARDEST
from .hinge import Hinge
from .number_text import Softness, of_one, written

# Ropes: tendons that may not be longer than their range, each with a sensor of what holds it.


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
            "else k and b go by a mean inertia at the file's own pose, not where it is taut",
        ),
    ]


# Stops of a joint's turn: the range of MuJoCo's joint, with sensors of what holds it there.


NEVER = 1e6  # rad: where no turn ends
AT = 1e-9  # rad: what is nearer to a stop is at it
BEHIND = 1e-12  # rad
BEAT = 0.05  # h times the frequency of a stop that throws back


def write_stops(sections: Mapping[str, ET.Element], stops: Stops, about: Hinge) -> None:
    """The range."""
    assert about.element is not None
    about.element.set("limited", "true")
    about.element.set("range", written(*map(math.degrees, _ends(stops))))


def _ends(stops: Stops) -> tuple[float, float]:
    low = -NEVER if stops.low is None else stops.low
    return low, NEVER if stops.high is None else stops.high


def finish_stops(
    root: ET.Element, sensors: ET.Element, stops: Stops, soft: Softness, about: Hinge
) -> None:
    """A setting's numbers for the limits, and their sensors."""
    assert about.element is not None
    about.element.attrib.update(soft)
    ET.SubElement(sensors, "jointlimitfrc", name=stops.name, joint=about.name)
    ET.SubElement(sensors, "jointpos", name=f"{stops.name}.angle", joint=about.name)


def stop_numbers(model: mujoco.MjModel, stops: Stops, about: Hinge) -> dict[str, float]:
    """Where the range ends."""
    low, high = model.jnt_range[model.joint(about.name).id]
    return {side: {"low": low, "high": high}[side] for side in stops.sides}


def lean_back(model: mujoco.MjModel, data: mujoco.MjData, stops: Stops, about: Hinge) -> None:
    """Puts what starts at a stop a rounding behind it: exactly there MuJoCo sees no limit."""
    joint = model.joint(about.name).id
    place = model.jnt_qposadr[joint]
    for end, way in zip(model.jnt_range[joint], (-1.0, 1.0), strict=True):
        if abs(data.qpos[place] - end) <= AT:
            data.qpos[place] = end + way * BEHIND


def pushing(model: mujoco.MjModel, stops: Stops, side: str, sensed: Array) -> Array:
    """(N,) with what moment one of the stops pushes, from the sensors' rows (N, ·)."""
    size, angle = (
        sensed[:, model.sensor(name).adr[0]] for name in (stops.name, f"{stops.name}.angle")
    )
    low, high = _ends(stops)
    below = angle < (low + high) / 2
    return np.where(below == (side == "low"), size, 0.0)


def recipe_of_stops(all_of_them: Sequence[Limit]) -> list[Choice]:
    """The limits' numbers: of the stops that throw back most, and what others have instead."""
    most = max(stops.back for stops in all_of_them)
    others = [stops for stops in all_of_them if stops.back != most]
    return [
        _spring("stop", most),
        *(_spring(of_one(stops.name), stops.back) for stops in others),
        Choice("stop.solimplimit", [HARDEST, HARDEST, 0.001], "the hardest MuJoCo takes"),
        Choice(
            "flag.diagexact", "enable", "or k and b are those of the inertia at the file's own pose"
        ),
    ]


def _spring(whose: str, bounce: float) -> Choice:
    """The spring and damper of a stop that throws back with a part of the speed, or with none."""
    if bounce:
        k, b, because = springy(bounce, BEAT)
    else:
        k, b, because = dead(1)
    return Choice(f"{whose}.solreflimit", [f"-{k}", f"{-b}/h"], because)
