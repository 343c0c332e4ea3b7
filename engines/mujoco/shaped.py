"""A scene's MJCF file with shapes for inertias, which MuJoCo's compiler computes, and sensors."""

import math
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np

from ...cases.scene import Scene
from .scene import LEAST
from .tree import called
from .written import written

THIN = 1e-7  # m, half of what is ideally thin: 1e-14 of its inertia

SENSORS = ("framepos", "framequat", "framelinvel", "gyro", "framelinacc", "frameangacc")


def shaped(text: str, scene: Scene) -> str:
    """The same with geoms in place of the inertials of ideal shapes, and sensors at all points."""
    root = ET.fromstring(text)
    elements = {element.attrib["name"]: element for element in root.iter("body")}
    sensors = ET.SubElement(root, "sensor")
    for body in scene.bodies.values():
        if (shape := _shape(body)) is not None:
            element = elements[called(body.name)]
            element.remove(element.find("inertial"))  # type: ignore[arg-type]
            given = {"mass": written(body.mass), "contype": "0", "conaffinity": "0"}
            ET.SubElement(element, "geom", {**given, **shape})
        for point in body.points:
            at = f"{body.name}.{point}"
            for kind in SENSORS:
                where = {"site": at} if kind == "gyro" else {"objtype": "site", "objname": at}
                ET.SubElement(sensors, kind, where, name=sensor(kind, at))
    return ET.tostring(root, encoding="unicode")


def sensor(kind: str, at: str) -> str:
    """Its name: what it measures, and at which point."""
    return f"{kind} {at}"


def _shape(body: Any) -> dict[str, str] | None:
    """The geom of an ideal shape; None of what is given by its numbers."""
    match body.shape:
        case "bar":
            half = float(np.linalg.norm(np.subtract(body.points["end"], body.points["start"]))) / 2
            # a light one is thicker: about its own axis MuJoCo takes no less than LEAST of any body
            thin = max(THIN, math.sqrt(3 * LEAST / body.mass))
            return {"type": "box", "size": written(half, thin, thin)}
        case "disk":
            axle = getattr(body, "axle", None) or (0.0, 0.0, 1.0)
            return {"type": "cylinder", "size": written(body.radius, THIN), "zaxis": written(*axle)}
        case "sphere":
            return {"type": "sphere", "size": written(body.radius)}
        case "block":
            edges = [x / 2 for x in body.size]
            return {"type": "box", "size": written(*[*edges, THIN][:3])}
    return None
