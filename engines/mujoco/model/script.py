"""The comments of the MJCF file that a user pastes."""

import re
from collections.abc import Iterable, Sequence
from typing import Any
from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from ....cases.fields.signal import Signal
from ....cases.scene import CENTER, Scene
from ...engine import Start
from .force import BY_ITSELF
from .number_text import written
from .tree import called

_SAID = (
    "what follows such a law in time is a control, which no MJCF file sets: load the model, start "
    "at the keyframe, and then paste this callback, which is asked at every stage (set between "
    "steps it would be held); while one is set MuJoCo loads no model, and "
    "mujoco.set_mjcb_control(None) takes it away"
)
_CORNERS = "where a law jumps or bends our run holds its mean over that step, which is of 2nd order"


def commented(head: Iterable[str]) -> str:
    """Lines as comments, in which two hyphens would end one."""
    return "".join(f"<!-- {re.sub('-(?=-)', '- ', line)} -->\n" for line in head)


def told(model: mujoco.MjModel, laws: Sequence[Signal]) -> str:
    """Python in a comment that sets the controls which do not follow by themselves; or nothing."""
    lines = [
        f"    data.ctrl[{i}] = {_at(law)}  # {model.actuator(i).name}"
        for i, law in enumerate(laws)
        if law.law not in BY_ITSELF
    ]
    if not lines:
        return ""
    # MuJoCo asks it of every model of the process.
    begins = ["def control(model, data):", f"    if model.nu != {model.nu}:", "        return"]
    begins.append("    t = data.time")
    code = ["import math", "import mujoco", "import numpy", *begins, *lines]
    said = [_SAID, _CORNERS] if any(law.corners for law in laws) else [_SAID]
    return commented(said) + "\n".join(
        ["<!--", *code, "mujoco.set_mjcb_control(control)", "-->", ""]
    )


def _at(law: Signal) -> str:
    """The factor of the law's amplitude at t."""
    times = [repr(time) for time in law.times]
    return {
        "sine": lambda: f"math.sin({law.angular_frequency!r} * t + {law.phase!r})",
        "step": lambda: f"1.0 if t >= {times[0]} else 0.0",
        "pulse": lambda: f"1.0 if {times[0]} <= t < {times[1]} else 0.0",
        "polynomial": lambda: " + ".join(f"{c!r} * t**{k}" for k, c in enumerate(law.values)),
        "table": lambda: f"numpy.interp(t, {list(law.times)!r}, {list(law.values)!r})",
    }[law.law]()


# A scene's MJCF file with shapes for a viewer: they weigh nothing and touch nothing.


SLENDER = 0.03  # of a bar's length is its radius, of a disk's radius half its thickness
SMALL = 0.02  # of the scene's extent is the radius of what has no shape
_SEEN = {"contype": "0", "conaffinity": "0", "mass": "0", "group": "1", "rgba": "0.3 0.5 0.8 1"}


def drawn(text: str, scene: Scene, start: Start) -> str:
    """The MJCF with a geom drawn for each body, whose mass and inertia stay: the same motion."""
    root = ET.fromstring(text)
    elements = {element.attrib["name"]: element for element in root.iter("body")}
    places = np.array([state[: scene.frame.dimension] for state in start.values()])
    small = SMALL * max(float(np.max(np.ptp(places, axis=0), initial=0.0)), _longest(scene))
    for body in scene.bodies.values():
        ET.SubElement(elements[called(body.name)], "geom", {**_SEEN, **_geom(body, small)})
    ET.indent(root)
    return ET.tostring(root, encoding="unicode") + "\n"


def _longest(scene: Scene) -> float:
    """From a centre to a point of its body [m], of all."""
    found = [np.linalg.norm(at) for body in scene.bodies.values() for at in body.points.values()]
    return float(max(found, default=0.0)) or 1.0


def _geom(body: Any, small: float) -> dict[str, str]:
    """The attributes of a geom that shows a body's shape.

    A body that is given by numbers is a ball: a line to each of its points would be a guess.
    """
    match body.shape:
        case "bar":
            start, end = ([*body.points[name], 0.0][:3] for name in ("start", "end"))
            length = float(np.linalg.norm(np.subtract(end, start)))
            size = written(SLENDER * length)
            return {"type": "capsule", "fromto": written(*start, *end), "size": size}
        case "disk" | "spokes" if body.radius:
            axle = getattr(body, "axle", None) or (0.0, 0.0, 1.0)
            size = written(body.radius, SLENDER * body.radius)
            return {"type": "cylinder", "size": size, "zaxis": written(*axle)}
        case "sphere":
            return {"type": "sphere", "size": written(body.radius)}
        case "block":
            edges = [x / 2 for x in body.size]
            return {"type": "box", "size": written(*[*edges, SLENDER * max(edges)][:3])}
    at = [*body.points.get(CENTER, (0.0, 0.0)), 0.0][:3]
    return {"type": "sphere", "size": written(small), "pos": written(*at)}
