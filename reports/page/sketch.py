"""The drawing of a scene: the outlines of its bodies, what links them, what stands on the ground.

Plain numbers, for whoever draws: a place is `[part, place]`, with the part a body, a driven point
of the ground as `ground.hook`, or "" for the ground itself.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...cases.scene import Scene
from ...cases.scene.point import GROUND, Anchor
from ...cases.trajectory import Array
from .outline import outline, reach, rounded

BLADE = 0.07  # of what the motion reaches: half of a blade's length
ZIGZAG = ("spring", "muscle", "linear_muscle")

Sketch = dict[str, Any]


def sketch(scene: Scene, size: float) -> Sketch:
    """Returns all that is drawn of a scene; size: how far [m] its motion reaches."""
    joints = scene.joints.values()
    return {
        "bodies": {name: outline(body, size) for name, body in scene.bodies.items()},
        "links": [*_forces(scene), *(_rod(scene, joint) for joint in joints if _swings(joint))],
        "joints": [_joint(scene, joint) for joint in joints],
        "blades": [_blade(scene, edge, BLADE * size) for edge in scene.constraints.values()],
        "planes": _planes(scene),
        "ground": [rounded(point.at) for point in scene.points.values() if not point.driven],
    }


def extent(scene: Scene, poses: Mapping[str, Array]) -> float:
    """How far [m] the motion (N, …) of the bodies reaches, with their own size."""
    places = np.concatenate([rows[:, : scene.frame.dimension] for rows in poses.values()])
    span = float(np.max(np.ptp(places, axis=0)))
    return max(span, *(2 * reach(body) for body in scene.bodies.values())) or 1.0


def _forces(scene: Scene) -> list[dict[str, Any]]:
    """Returns the links of forces that act along a line through two points or more."""
    found = [(force, force.refers()) for force in scene.forces.values()]
    return [
        {"kind": _kind(force.word), "ends": [_end(scene, end) for end in ends], **_one_sided(force)}
        for force, ends in found
        if len(ends) > 1
    ]


def _one_sided(force: Any) -> dict[str, Any]:
    """On which side of which length [m] a spring acts, where it does so on one alone."""
    only = getattr(force, "only", None)
    return {} if only is None else {"only": only, "rest": force.rest_length}


def _kind(word: str) -> str:
    if word in ZIGZAG:
        return "spring"
    return "damper" if word == "damper" else "line"


def _swings(joint: Any) -> bool:
    return bool(getattr(joint, "swings", False))


def _rod(scene: Scene, joint: Any) -> dict[str, Any]:
    return {"kind": "rod", "ends": [_end(scene, end) for end in joint.refers()]}


def _end(scene: Scene, anchor: Anchor) -> list[Any]:
    if anchor.body != GROUND:
        return [anchor.body, rounded(scene.bodies[anchor.body].points[anchor.point])]
    point = scene.points[anchor.point]
    if point.driven:
        return [f"{GROUND}.{anchor.point}", [0.0] * scene.frame.dimension]
    return ["", rounded(point.at)]


def _joint(scene: Scene, joint: Any) -> dict[str, Any]:
    """Its place on its second part, and the line on its first along which that may shift."""
    ends = joint.refers()
    found: dict[str, Any] = {"at": _end(scene, ends[-1])}
    along = _along(joint)
    if along is not None:
        found["rail"] = [*_end(scene, ends[0]), rounded(along)]
    return found


def _along(joint: Any) -> Any:
    """The direction of its one shift, in the axes of its first part."""
    return joint.shifts[0].axis if len(joint.shifts) == 1 else None


def _blade(scene: Scene, edge: Any, arm: float) -> dict[str, Any]:
    """Both its ends on its body."""
    place = np.asarray(scene.bodies[edge.at.body].points[edge.at.point])
    along = arm * np.asarray(edge.along)
    return {"body": edge.at.body, "line": [rounded(place - along), rounded(place + along)]}


def _planes(scene: Scene) -> list[dict[str, Any]]:
    """Returns the planes of contact, each with a place and a direction; in space the floor."""
    if scene.frame.dimension == 3:
        return [{"floor": True}] if scene.contacts or scene.constraints else []
    planes = {getattr(contact, "plane", None) for contact in scene.contacts.values()} - {None}
    told = sorted((plane.name, plane) for plane in planes if plane is not None)
    return [{"at": rounded(plane.at), "along": rounded(plane.along)} for _, plane in told]
