"""Scenes with the shapes that users have, of which advice is measured: see `PlainShapes`.

A body of a plane that planes alone touch is a box or a ball there, free to move; a particle is a
box, for nobody has a point.
"""

import math
from collections.abc import Mapping
from dataclasses import replace
from functools import partial

import numpy as np

from ..cases.scene import CENTER, Anchor, Body, Scene
from ..cases.scene.frame import PLANE
from ..cases.scene.shape import CORNERS, block
from ..cases.trajectory import ANGLE, OMEGA, Trajectory
from .engine import Plan, Start

PLAIN, CUBE, CYLINDER = SHAPES = ("plain", "cube", "cylinder")
"""Values of the option `shapes`: a particle is a flat box, or a cube, of which fewer corners carry
when it is pushed; what is round is a sphere with the disk's inertia, or the disk itself."""
SIZES = {PLAIN: (0.2, 0.1), CUBE: (0.1, 0.1)}  # m, width and height of what stands for a particle
FOOT = "foot"  # the middle of its lower face, where the particle is


def unsuited(scene: Scene, shape: str) -> str | None:
    """Why no plain shapes stand for the scene, as a `Refusal` says it; None: they do."""
    beside = (scene.joints, scene.constraints, scene.pairs, scene.drives)
    if scene.frame is not PLANE or len(scene.bodies) != 1 or any(beside) or any(scene.limits()):
        return "adapter: shapes: only a body of the plane that nothing but planes holds has them"
    if any(point.driven for point in scene.points.values()):
        return "adapter: shapes: a point is driven"
    (body,), contacts = scene.bodies.values(), scene.contacts.values()
    if not contacts or not all(_touches(body, contact.at.point) for contact in contacts):
        return (
            f"adapter: shapes: {body.name} does not touch with its rim, its corners or as a point"
        )
    if not body.turns and len(contacts) > 1:
        return f"adapter: shapes: {body.name} is a point on two planes"
    if (shape == CUBE and body.turns) or (shape == CYLINDER and body.radius is None):
        return f"adapter: shapes: {body.name} is no {shape}"
    return None


def _touches(body: Body, point: str) -> bool:
    if body.radius is not None or not body.turns:
        return point == CENTER
    return body.size is not None and point in CORNERS


def with_box(scene: Scene, start: Start, shape: str) -> tuple[Scene, Start]:
    """The scene with a box for its particle, which lies flat on the plane; others as they are."""
    (body,) = scene.bodies.values()
    if body.turns:
        return scene, start
    width, height = SIZES[shape]
    foot = {FOOT: (0.0, -height / 2)}
    box = block(name=body.name, mass=body.mass, width=width, height=height, points=foot)
    (contact,), (x, y, _, vx, vy, _) = scene.contacts.values(), start[body.name]
    (ux, uy), (nx, ny) = contact.plane.along, contact.plane.normal
    place = x + height / 2 * nx, y + height / 2 * ny
    contacts = {contact.name: replace(contact, at=Anchor(body.name, FOOT))}
    boxed = replace(scene, bodies={body.name: box}, contacts=contacts)
    return boxed, {body.name: (*place, math.atan2(uy, ux) + 0.0, vx, vy, 0.0)}


def as_built(plan: Plan, words: str, withheld: Mapping[str, str]) -> Plan:
    """The plan with what is built, in words, and what of that is not read."""
    return replace(plan, protocol=partial(_said, words), withheld={**plan.withheld, **withheld})


def _said(words: str, step: float) -> str:
    return words


def known_of(scene: Scene, numbers: Mapping[str, float]) -> dict[str, float]:
    """The numbers measured of `with_box`, less the moment of inertia that a particle has not."""
    points = [f"{name}.inertia" for name, body in scene.bodies.items() if not body.turns]
    return {name: number for name, number in numbers.items() if name not in points}


def without_box(scene: Scene, motion: Trajectory, shape: str) -> Trajectory:
    """The motion of `with_box` as the particle's: half a box below its centre."""
    (body,) = scene.bodies.values()
    if body.turns:
        return motion
    (contact,) = scene.contacts.values()
    away = SIZES[shape][1] / 2 * np.array(contact.plane.normal)

    def lowered(states: Mapping[str, np.ndarray]) -> dict[str, np.ndarray]:
        rows = states[body.name].copy()
        rows[:, :2] -= away
        rows[:, [ANGLE, OMEGA]] = 0.0
        return {body.name: rows}

    record = motion.record and replace(motion.record, states=lowered(motion.record.states))
    return replace(motion, states=lowered(motion.states), record=record)
