"""The outline of a body: lines in its own axes, whatever its shape. Lengths in m.

A place of the plane has two numbers, one of space three.
"""

from typing import Any

import numpy as np

from ...cases.scene.point import CENTER
from ...cases.trajectory import Array

ROUND = 72  # corners of a circle: on a large disk fewer are seen
DIGITS = 4  # of a length: a picture has some hundred points
ALIKE = 1e-6  # of the largest moment of inertia: nearer than that, two are one
CROSS = 0.08  # of what the motion reaches: the axes of a body that has neither shape nor points

Line = list[list[float]]


def outline(body: Any, size: float) -> dict[str, Any]:
    """Its lines, and whether its centre is marked; size: how far [m] the motion reaches."""
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
    """How far [m] it reaches from its centre."""
    own = [body.radius or 0.0, _farthest(body)]
    half = 0.5 * float(np.linalg.norm(body.size)) if body.size else 0.0
    drawn = [np.linalg.norm(p) for line in _as_heavy(body) for p in line] if _solid(body) else []
    return float(max(*own, half, *drawn))


def rounded(place: Any) -> list[float]:
    """A place with few digits."""
    return [float(f"{float(x):.{DIGITS}g}") for x in place]


def _round(body: Any) -> list[Line]:
    """A disk with a spoke, so that its turning is seen; a sphere by three circles."""
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
    return max(float(np.linalg.norm(p)) for p in body.points.values())


def _as_heavy(body: Any) -> list[Line]:
    """Returns the lines of a disk, sphere or box that is as hard to turn, and rays to its points.

    It is a picture: where the body has points, it is no larger than they reach.
    """
    moments, axes = np.linalg.eigh(body.tensor)  # ascending
    alike = np.diff(moments) <= ALIKE * moments[-1]
    rays = [[[0.0] * 3, rounded(p)] for n, p in body.points.items() if n != CENTER and np.any(p)]
    most = _farthest(body) or np.inf
    if all(alike):
        radius = min(most, float(np.sqrt(2.5 * moments[0] / body.mass)))
        return [*(_circle(radius, _across(axle)) for axle in np.eye(3)), *rays]
    if any(alike):
        k = 2 if alike[0] else 0  # which is another one: the axle's
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
    """Says whether a place lies on the axis, off the centre: then the body is a top."""
    length = float(np.linalg.norm(place))
    return length > 0.0 and abs(float(axle @ np.asarray(place))) >= (1 - ALIKE) * length


def _rays(body: Any, size: float) -> list[Line]:
    """From the centre to every point of a body that has no shape; else a cross of its axes."""
    n = len(body.points[CENTER])
    points = [p for name, p in body.points.items() if name != CENTER and np.any(p)]
    if points:
        return [[[0.0] * n, rounded(p)] for p in points]
    return [[rounded(-axis * CROSS * size), rounded(axis * CROSS * size)] for axis in np.eye(n)]


def _box(half: Array) -> list[Line]:
    """The outline of a rectangle, or the edges of a cuboid."""
    signs = [(-1, -1), (1, -1), (1, 1), (-1, 1), (-1, -1)]
    if len(half) == 2:
        return [[rounded(half * s) for s in signs]]
    faces = [[rounded(half * (*s, z)) for s in signs] for z in (-1, 1)]
    return [*faces, *([rounded(half * (*s, -1)), rounded(half * (*s, 1))] for s in signs[:4])]


def _circle(radius: float, axes: Array) -> Line:
    turns = np.linspace(0.0, 2 * np.pi, ROUND + 1)
    return [rounded(radius * (np.cos(t) * axes[0] + np.sin(t) * axes[1])) for t in turns]


def _across(axle: Array) -> Array:
    """(2, 3) two unit vectors that span the plane of a disk with this axle."""
    first: Array = np.cross(axle, np.eye(3)[int(np.argmin(np.abs(axle)))]).astype(float)
    first = first / np.linalg.norm(first)
    return np.array([first, np.cross(axle, first)])
