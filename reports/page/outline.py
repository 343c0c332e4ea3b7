"""The outline of a body: lines in its own axes, whatever its shape. Lengths in m.

A place of the plane has two numbers, one of space three.
"""

from typing import Any

import numpy as np

from ...cases.point import CENTER
from ...cases.trajectory import Array

ROUND = 72  # corners of a circle: on a large disk fewer are seen
DIGITS = 4  # of a length: a picture has some hundred points
CROSS = 0.08  # of what the motion reaches: the axes of a body that has neither shape nor points

Line = list[list[float]]


def outline(body: Any, size: float) -> dict[str, Any]:
    """Its lines, and whether its centre is marked; size: how far [m] the motion reaches."""
    if body.shape == "particle":
        return {"lines": [], "dot": True}
    lines: list[Line] = []
    if body.size is not None:
        lines += _box(np.asarray(body.size) / 2)
    elif body.shape == "bar":
        lines.append([rounded(body.points["start"]), rounded(body.points["end"])])
    if body.radius is not None:
        lines += _round(body)
    return {"lines": lines or _rays(body, size), "dot": body.shape in ("rigid", "spokes")}


def reach(body: Any) -> float:
    """How far [m] it reaches from its centre."""
    own = [body.radius or 0.0, *(float(np.linalg.norm(p)) for p in body.points.values())]
    half = 0.5 * float(np.linalg.norm(body.size)) if body.size else 0.0
    return max(*own, half)


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
