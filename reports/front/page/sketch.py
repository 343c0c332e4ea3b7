"""The drawing of a scene: the outlines of its bodies, what links them, what stands on the ground.

Plain numbers, for whoever draws: a place is `[part, place]`, with the part a body, a driven point
of the ground as `ground.hook`, or "" for the ground itself.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from ....cases.scene import Scene
from ....cases.scene.point import CENTER, GROUND, Anchor
from ....cases.trajectory import Array

BLADE = 0.07  # of what the motion reaches: half of a blade's length
FLOOR = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]  # a place on it, and two axes
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
    pairs = [(force, force.refers()) for force in scene.forces.values()]
    return [
        {"kind": _kind(force.word), "ends": [_end(scene, end) for end in ends], **_one_sided(force)}
        for force, ends in pairs
        if len(ends) > 1
    ]


def _one_sided(force: Any) -> dict[str, Any]:
    """Returns the side and length [m] at which a one-sided spring acts."""
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
    """Returns a joint's place on its second part, and the line on its first that it shifts on."""
    ends = joint.refers()
    entry: dict[str, Any] = {"at": _end(scene, ends[-1])}
    along = _along(joint)
    if along is not None:
        entry["rail"] = [*_end(scene, ends[0]), rounded(along)]
    return entry


def _along(joint: Any) -> Any:
    """Returns the direction of a joint's one shift, in the axes of its first part."""
    return joint.shifts[0].axis if len(joint.shifts) == 1 else None


def _blade(scene: Scene, edge: Any, arm: float) -> dict[str, Any]:
    """Returns both ends of a blade on its body."""
    place = np.asarray(scene.bodies[edge.at.body].points[edge.at.point])
    along = arm * np.asarray(edge.along)
    return {"body": edge.at.body, "line": [rounded(place - along), rounded(place + along)]}


def _planes(scene: Scene) -> list[dict[str, Any]]:
    """Returns the planes of contact, each with a place and a direction; in space the floor."""
    if scene.frame.dimension == 3:
        return [{"floor": FLOOR}] if scene.contacts or scene.constraints else []
    planes = {getattr(contact, "plane", None) for contact in scene.contacts.values()} - {None}
    named = sorted((plane.name, plane) for plane in planes if plane is not None)
    return [{"at": rounded(plane.at), "along": rounded(plane.along)} for _, plane in named]


# Makes the lines with which the page draws a body, in its own axes, whatever its shape.
#
# Lengths in m. A place in the plane has two numbers, one in space three. A body in space of which
# only mass, inertia and points are known is drawn as a disk, sphere or box with that inertia.


ROUND = 72  # corners of a circle: with fewer they can be seen on a large disk
DIGITS = 4  # significant ones of a length: a picture is some hundred points wide
ALIKE = 1e-6  # of the largest moment of inertia: nearer than that, two are taken as equal
CROSS = 0.08  # of what the motion reaches: the axes of a body that has neither shape nor points

Line = list[list[float]]


def outline(body: Any, size: float) -> dict[str, Any]:
    """Returns `lines`, and as `dot` whether its centre is marked; size: the motion's extent [m]."""
    if body.shape == "particle":
        return {"lines": [], "dot": True}
    lines: list[Line] = []
    if body.size is not None:
        lines += _box(np.asarray(body.size) / 2)
    elif _solid(body):
        lines += _as_heavy(body)
    elif body.shape == "bar":
        lines.append([rounded(body.points["start"]), rounded(body.points["end"])])
    if body.radius is not None:
        lines += _round(body)
    return {"lines": lines or _rays(body, size), "dot": body.shape in ("rigid", "spokes")}


def reach(body: Any) -> float:
    """Returns how far [m] the body, as it is drawn, reaches from its centre."""
    own = [body.radius or 0.0, _farthest(body)]
    half = 0.5 * float(np.linalg.norm(body.size)) if body.size else 0.0
    drawn = [np.linalg.norm(p) for line in _as_heavy(body) for p in line] if _solid(body) else []
    return float(max(*own, half, *drawn))


def rounded(place: Any) -> list[float]:
    """Returns a place with DIGITS significant digits."""
    return [float(f"{float(x):.{DIGITS}g}") for x in place]


def _round(body: Any) -> list[Line]:
    """Returns a disk with a spoke, by which its turning is seen; of a sphere three circles."""
    if len(body.points[CENTER]) == 2:
        return [_circle(body.radius, np.eye(2)), [[0.0, 0.0], rounded((body.radius, 0.0))]]
    if getattr(body, "axle", None) is None:
        return [_circle(body.radius, _across(axle)) for axle in np.eye(3)]
    axes = _across(np.asarray(body.axle))
    return [_circle(body.radius, axes), [[0.0] * 3, rounded(body.radius * axes[0])]]


def _solid(body: Any) -> bool:
    """Says whether it is a body of space of which only mass, tensor and points are known."""
    bare = body.radius is None and body.size is None and body.shape == "rigid"
    return bare and len(body.points[CENTER]) == 3 and bool(np.any(body.tensor))


def _farthest(body: Any) -> float:
    """Returns how far [m] its farthest point is from its centre."""
    return max(float(np.linalg.norm(p)) for p in body.points.values())


def _as_heavy(body: Any) -> list[Line]:
    """Returns the lines of the disk, sphere or box of its mass and moments, and rays to its points.

    A sphere if all three moments are equal, a disk if two are, else a box: J = ⅖ m r², ½ m r²
    about the axle, or ⅓ m (b² + c²) with half edges. Where the body has points, it is drawn no
    larger than they reach: it is a picture, not a measure. A disk with a point on its axle is a
    top, and gets lines from there to its rim.
    """
    moments, axes = np.linalg.eigh(body.tensor)  # ascending
    alike = np.diff(moments) <= ALIKE * moments[-1]
    rays = [[[0.0] * 3, rounded(p)] for n, p in body.points.items() if n != CENTER and np.any(p)]
    most = _farthest(body) or np.inf
    if all(alike):
        radius = min(most, float(np.sqrt(2.5 * moments[0] / body.mass)))
        return [*(_circle(radius, _across(axle)) for axle in np.eye(3)), *rays]
    if any(alike):
        k = 2 if alike[0] else 0  # the moment that differs from the other two: the axle's
        radius = min(most, float(np.sqrt(2.0 * max(moments[k], 0.0) / body.mass)))
        rim = _across(axes[:, k])
        stays = [radius * sign * arm for arm in rim for sign in (1, -1)]
        tops = [p for n, p in body.points.items() if n != CENTER and _on(axes[:, k], p)]
        cone = [[rounded(p), rounded(stay)] for p in tops for stay in stays]
        return [_circle(radius, rim), [[0.0] * 3, rounded(stays[0])], *cone, *rays]
    half = np.sqrt(np.maximum(1.5 * (np.sum(moments) - 2 * moments) / body.mass, 0.0))
    half *= min(1.0, most / float(np.linalg.norm(half)))
    return [*([rounded(axes @ p) for p in line] for line in _box(half)), *rays]


def _on(axle: Array, place: Any) -> bool:
    """Says whether a place lies on the axle through the centre, but not at the centre itself."""
    length = float(np.linalg.norm(place))
    return length > 0.0 and abs(float(axle @ np.asarray(place))) >= (1 - ALIKE) * length


def _rays(body: Any, size: float) -> list[Line]:
    """Returns lines from the centre to each point of a body, or without any a cross of its axes."""
    n = len(body.points[CENTER])
    points = [p for name, p in body.points.items() if name != CENTER and np.any(p)]
    if points:
        return [[[0.0] * n, rounded(p)] for p in points]
    return [[rounded(-axis * CROSS * size), rounded(axis * CROSS * size)] for axis in np.eye(n)]


def _box(half: Array) -> list[Line]:
    """Returns the outline of a rectangle, or the edges of a cuboid, with these half edges."""
    signs = [(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)]
    if len(half) == 2:
        return [[rounded(half * s) for s in signs]]
    faces = [[rounded(half * (*s, z)) for s in signs] for z in (-1, 1)]
    return [*faces, *([rounded(half * (*s, -1)), rounded(half * (*s, 1))] for s in signs[:4])]


def _circle(radius: float, axes: Array) -> Line:
    """Returns a closed circle about the centre, in the plane of two unit vectors."""
    turns = np.linspace(0.0, 2 * np.pi, ROUND + 1)
    return [rounded(radius * (np.cos(t) * axes[0] + np.sin(t) * axes[1])) for t in turns]


def _across(axle: Array) -> Array:
    """(2, 3) two orthogonal unit vectors that span the plane across this axle, a unit vector."""
    # Across the axis of the body from which the axle is farthest: no product of near parallels.
    first: Array = np.cross(axle, np.eye(3)[int(np.argmin(np.abs(axle)))]).astype(float)
    first = first / np.linalg.norm(first)
    return np.array([first, np.cross(axle, first)])
