"""Finds when outlines overlap in a motion, and when contacts close past a side's ends.

An outline is convex, as far around its corners as its radius. Two are apart by the least distance
of a corner of one from a side of the other, unless no side has all of the other before it.
"""

from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ...cases.scene import Scene
from ...cases.scene.observe import motion_of, observe
from ...cases.trajectory import ANGLE, Array, Trajectory, X, Y
from .shapes import Outline, Side, Touch, start_corners

DEEP = 1e-6  # of the size of the motion: less is rounding, of the shapes at the start


def depth(a: Outline, b: Outline) -> tuple[float, float]:
    """How deep [m] two outlines overlap at the start, and what of that is rounding."""
    both = [np.array([start_corners(outline)], float) for outline in (a, b)]
    size = a.radius + b.radius
    deep = size - float(gaps(*both)[0])
    return deep, DEEP * (size + max(float(np.max(np.ptp(corners[0], axis=0))) for corners in both))


def first_overlap(motion: Trajectory, a: Outline, b: Outline, size: float) -> float:
    """The first of the motion's times [s] at which two outlines overlap; inf if they never do."""
    p, q, around = _corner_places(motion, a), _corner_places(motion, b), a.radius + b.radius
    reach = around + sum(float(np.max(np.hypot(*(c - c[0]).T))) for c in (p[0], q[0]))
    if np.min(np.hypot(*(p - q[:, :1])[:, 0].T)) > reach:
        return np.inf
    return _first_time(motion, gaps(p, q) < around - DEEP * size)


def _first_time(motion: Trajectory, are: NDArray[np.bool_]) -> float:
    return float(motion.times[np.argmax(are)]) if np.any(are) else np.inf


def past_end_times(scene: Scene, motion: Trajectory, touch: Touch, size: float) -> dict[str, float]:
    """First time [s], by contact, at which it closes past an end of its side; or inf."""
    places, times = motion_of(scene, motion), dict[str, float]()
    for name in touch.contacts:
        if name in scene.contacts and touch.side is not None:
            x, y = places.point(scene.contacts[name].at)[:, :2].T
            past = _past_ends(touch.side, x, y, DEEP * size)
        elif name in scene.pairs and scene.pairs[name].face:
            past = scene.pairs[name].beyond(places)
        else:
            continue
        closed = observe(scene, motion, f"{name}.gap") < DEEP * size
        times[name] = _first_time(motion, past & closed)
    return times


def _past_ends(side: Side, x: Array, y: Array, near: float) -> NDArray[np.bool_]:
    """(N,) whether points are past an end of a side, along its line."""
    along = side.ends - side.begins
    (ux, uy), length = along.normalized(), along.length
    place = ux * (x - side.begins.x) + uy * (y - side.begins.y)
    return (place < -near) | (place > length + near)


def _corner_places(motion: Trajectory, outline: Outline) -> Array:
    """(N, K, 2) positions of an outline's corners."""
    corners = np.array(outline.corners, float)
    if outline.body is None:
        return np.broadcast_to(corners, (len(motion.times), *corners.shape))
    states = motion.states[outline.body]
    cos, sin = np.cos(states[:, ANGLE, None]), np.sin(states[:, ANGLE, None])
    x = states[:, X, None] + cos * corners[:, 0] - sin * corners[:, 1]
    y = states[:, Y, None] + sin * corners[:, 0] + cos * corners[:, 1]
    return np.stack([x, y], axis=2)


def gaps(a: Array, b: Array) -> Array:
    """(N,) how far two convex outlines (N, K, 2) are apart; negative: how deep they overlap."""
    distance = np.full(len(a), np.inf)
    before = np.full(len(a), -np.inf)
    for corners, others in ((a, b), (b, a)):
        for p, q in _edges(corners):
            along = q - p
            square = np.sum(along**2, axis=1)
            for c in np.moveaxis(others, 1, 0):
                share = np.clip(np.sum((c - p) * along, axis=1) / square, 0.0, 1.0)
                distance = np.minimum(distance, np.hypot(*(c - p - share[:, None] * along).T))
            normal = np.stack([along[:, 1], -along[:, 0]], axis=1) / np.sqrt(square)[:, None]
            axes = [normal] if corners.shape[1] > 2 else [normal, along / np.sqrt(square)[:, None]]
            for n in axes:
                before = np.maximum(before, _clearance(corners, others, n))
    if a.shape[1] == b.shape[1] == 1:
        return np.hypot(*(a - b)[:, 0].T)
    return np.where(before >= 0.0, distance, before)


def _edges(outline: Array) -> list[tuple[Array, Array]]:
    """The edges from corner to corner; both ways for a segment, none for one corner."""
    corners = [*np.moveaxis(outline, 1, 0)]
    return [*pairwise((*corners, corners[0]))] if len(corners) > 1 else []


def _clearance(corners: Array, others: Array, n: Array) -> Array:
    """(N,) clearance [m] of the other corners from these along a normal."""
    most = np.max(np.einsum("nkd,nd->nk", corners, n), axis=1)
    return np.min(np.einsum("nkd,nd->nk", others, n), axis=1) - most
