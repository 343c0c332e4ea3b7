"""The comments of the MJCF file that a user pastes."""

import re
from collections.abc import Iterable, Sequence
from inspect import getsource
from typing import Any
from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from ....cases.fields.signal import Signal
from ....cases.scene import CENTER, Scene
from ...engine import Start
from ...signal import NEAR, under
from .force import BY_ITSELF
from .number_text import written
from .tree import called

_SAID = (
    "what follows such a law in time is a control, which no MJCF file sets: load the model, start "
    "at the keyframe, and then paste this callback, which is asked at every stage (set between "
    "steps it would be held); while one is set MuJoCo loads no model, and "
    "mujoco.set_mjcb_control(None) takes it away"
)
_CORNERS = (
    "in a step in which a law jumps or bends its mean is held, as in our run, which is of 2nd "
    "order: else RK4's stages would weigh it by where they lie"
)
# MuJoCo tells no callback where a step begins: RK4 asks there, twice in its middle, at its end.
_BEGINS = """\
asked = {"begin": -1.0, "middle": False}


def begin_of_step(t, h):
    passed = (t - asked["begin"]) / h
    if not (abs(passed - 0.5) < 0.1 or (asked["middle"] and abs(passed - 1.0) < 0.1)):
        asked["begin"], passed = t, 0.0
    asked["middle"] = abs(passed - 0.5) < 0.1
    return asked["begin"]
"""


def commented(head: Iterable[str]) -> str:
    """Lines as comments, in which two hyphens would end one."""
    return "".join(f"<!-- {re.sub('-(?=-)', '- ', line)} -->\n" for line in head)


def control_script(model: mujoco.MjModel, laws: Sequence[Signal]) -> str:
    """Python in a comment that sets the controls which do not follow by themselves; or nothing."""
    following = [(i, law) for i, law in enumerate(laws) if law.law not in BY_ITSELF]
    if not following:
        return ""
    lines = [f"    data.ctrl[{i}] = {_at(law)}  # {model.actuator(i).name}" for i, law in following]
    # MuJoCo asks it of every model of the process.
    begins = ["def control(model, data):", f"    if model.nu != {model.nu}:", "        return"]
    begins.append("    t = data.time")
    comments, imports, helpers = (
        [_SAID],
        ["import math", "import mujoco", "import numpy"],
        list[str](),
    )
    if any(law.corners for _, law in following):
        comments.append(_CORNERS)
        begins += ["    h = model.opt.timestep", "    begin = begin_of_step(t, h)"]
        helpers += ["", "", *_BEGINS.splitlines()]
    if any(law.law == "table" for _, law in following):
        imports.insert(1, "from itertools import pairwise")
        helpers += ["", "", *getsource(under).splitlines()]
    code = [*imports, *helpers, *(["", ""] if helpers else []), *begins, *lines]
    return commented(comments) + "\n".join(
        ["<!--", *code, "mujoco.set_mjcb_control(control)", "-->", ""]
    )


def _at(law: Signal) -> str:
    """The factor of the law's amplitude at t, or its mean over a step with a corner."""
    times = [repr(time) for time in law.times]
    return {
        "sine": lambda: f"math.sin({law.angular_frequency!r} * t + {law.phase!r})",
        "step": lambda: _after(times[0]),
        "pulse": lambda: f"{_after(times[0])} - {_after(times[1])}",
        "polynomial": lambda: " + ".join(f"{c!r} * t**{k}" for k, c in enumerate(law.values)),
        "table": lambda: _interpolated(law),
    }[law.law]()


def _after(begins: str) -> str:
    """The share of the step that is after an instant."""
    return f"min(1.0, max(0.0, (begin + h - {begins}) / h))"


def _interpolated(law: Signal) -> str:
    """On lines between the table's points, or the mean."""
    times, values = law.times, law.values
    ends = (f"under({times}, {values}, {t})" for t in ("begin + h", "begin"))
    there = f"any(begin - {NEAR} * h <= x <= begin + (1 + {NEAR}) * h for x in {times})"
    return f"({' - '.join(ends)}) / h if {there} else numpy.interp(t, {times}, {values})"


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
    lengths = [np.linalg.norm(at) for body in scene.bodies.values() for at in body.points.values()]
    return float(max(lengths, default=0.0)) or 1.0


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
