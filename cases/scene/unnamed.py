"""Points of a body that no contact names, and that go through what its other points stand on."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import replace
from functools import partial
from itertools import product

import numpy as np

from ..trajectory import Array, Trajectory
from . import Scene
from .body import Body
from .frame import SPACE
from .motion import Motion
from .observe import motion_of
from .pair import Pair
from .plane import Plane
from .point import CENTER, Anchor, Vector

DEEP = 1e-6  # of the body's size: less is rounding, or how deep a contact starts

Depths = Callable[[str, Vector], Array]
"""How deep (N,) [m] a point of a body, by its name and place on it, is in something."""


def penetrations(scene: Scene, trajectory: Trajectory) -> Iterator[str]:
    """Yields a sentence for each surface that a body penetrates, with its deepest point."""
    motion = motion_of(scene, trajectory)
    for body in scene.bodies.values():
        outline = _outline(body)
        deep = DEEP * max((float(np.linalg.norm(at)) for at in outline.values()), default=0.0)
        for (on, depths), names in _named_points(scene, body, motion).items():
            depth = {name: depths(name, at) for name, at in outline.items() if name not in names}
            deepest = max(depth, key=lambda name: float(np.max(depth[name])), default="")
            if deepest and (most := float(np.max(depth[deepest]))) > deep:
                begins = trajectory.times[int(np.argmax(depth[deepest] > deep))]
                yield (
                    f"{body.name}.{deepest} goes {most * 1e3:.3g} mm deep into the {on}, which it "
                    f"enters by t = {begins:.3g} s: no contact names it, so nothing holds it there"
                )


def _outline(body: Body) -> Mapping[str, Vector]:
    """The points of the body but its centre, by name; empty for a round body."""
    if body.radius is not None:
        return {}
    points = {name: at for name, at in body.points.items() if name != CENTER}
    if body.frame is SPACE and body.size is not None:  # in the plane its corners have names
        corners = product(*((-x / 2, x / 2) for x in body.size))
        points |= {f"corner{k}": corner for k, corner in enumerate(corners, start=1)}
    return points


def _named_points(scene: Scene, body: Body, motion: Motion) -> dict[tuple[str, Depths], set[str]]:
    """The surfaces in contacts of the body, each with the points that the contacts name."""
    by_name: dict[str, Depths] = {}
    names: dict[tuple[str, Depths], set[str]] = {}
    for contact in scene.contacts.values():
        if contact.body == body.name:
            below = by_name.setdefault(contact.on, partial(_depth, motion, body, contact.plane))
            names.setdefault((contact.on, below), set()).update(contact.tips or (contact.at.point,))
    for pair in scene.pairs.values():
        if pair.body == body.name and pair.face is not None:
            inside = by_name.setdefault(pair.on, partial(_depth_inside, motion, pair))
            names.setdefault((pair.on, inside), set()).add(pair.at.point)
    return names


def _depth(motion: Motion, body: Body, plane: Plane, name: str, at: Vector) -> Array:
    states = motion.trajectory.states[body.name]
    points = body.frame.moved(states, at)[:, : len(at)]
    return -(points - np.array(plane.at)) @ np.array(plane.normal)


def _depth_inside(motion: Motion, pair: Pair, name: str, at: Vector) -> Array:
    """(N,) depth [m] in a block; 0 beside the face and beyond the opposite side."""
    other = replace(pair, at=Anchor(pair.body, name))
    depth = -other.normal_and_gap(motion)[1]
    thick = min(motion.bodies[pair.touched].size)
    return np.where(~other.beyond(motion) & (depth < thick), depth, 0.0)
