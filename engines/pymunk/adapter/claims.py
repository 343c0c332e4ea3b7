"""pymunk's answers about states of free bodies: places, velocities, energy, and its own moments."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import pymunk
from pymunk.body import Body

from ....cases.scene import Body as Part
from ....cases.scene import Scene
from ....cases.scene.point import CENTER
from ....cases.trajectory import Array
from ..callbacks.force import lacking
from ..model.world import World

_KINEMATIC = ("x", "y", "vx", "vy")


def answered(
    world: World, states: Mapping[str, Array], wanted: Sequence[str]
) -> dict[str, Array | str]:
    """For each wanted quantity its samples, or why there are none."""
    scene = world.scene
    for name, body in world.bodies.items():
        if (moment := _moment(scene.bodies[name])) is not None:
            body.moment = moment
    refusals = {name: _withheld(scene, name) for name in wanted}
    seen: dict[str, list[float]] = {name: [] for name in wanted if not refusals[name]}
    for row in range(len(next(iter(states.values())))):
        for name, body in world.bodies.items():
            columns = [states.get(f"{name}.{own}") for own in ("x", "y", "angle")]
            (x, vx), (y, vy), (angle, omega) = (
                (0.0, 0.0) if c is None else c[row, :2].tolist() for c in columns
            )
            body.position, body.velocity = (x, y), (vx, vy)
            body.angle, body.angular_velocity = angle, omega
        for name, samples in seen.items():
            samples.append(_read(world, name))
    return {**refusals, **{name: np.array(samples) for name, samples in seen.items()}}


def _withheld(scene: Scene, name: str) -> str:
    """Why a quantity is not told, or nothing."""
    part, _, field = name.rpartition(".")
    if part in scene.forces:
        alone = "adapter: what a space's damping exerts is not asked of pymunk"
        return next((why for force, why in lacking(scene, {}) if force.name == part), alone)
    if part == "momentum" and field == "angular":
        return "engine: pymunk has no angular momentum"
    if part == "energy" and field != "kinetic":
        return "engine: pymunk knows no potential energy"
    if field == "inertia" and scene.bodies[part].shape == "rigid":
        return f"adapter: {part} has no shape from which pymunk could compute it"
    if field in ("ax", "ay"):
        return "engine: pymunk has velocities, and nothing that tells an acceleration"
    return ""


def _read(world: World, name: str) -> float:
    part, _, field = name.rpartition(".")
    bodies = world.bodies.values()
    if part == "energy":
        return sum(body.kinetic_energy for body in bodies)
    if part == "momentum":
        return sum(body.mass * body.velocity[("x", "y").index(field)] for body in bodies)
    owner, _, point = part.partition(".")
    body = world.bodies[owner]
    if field == "inertia":
        return body.moment
    return _point(body, world.scene.bodies[owner].points[point or CENTER], field)


def _point(body: Body, at: Any, field: str) -> float:
    velocity = body.velocity_at_local_point(at)
    if field == "speed":
        return velocity.length
    return (*body.local_to_world(at), *velocity)[_KINEMATIC.index(field)]


def _moment(part: Part) -> float | None:
    """By pymunk's own helpers; None of what is given by its numbers."""
    match part.shape:
        case "bar":
            return pymunk.moment_for_segment(part.mass, part.points["start"], part.points["end"], 0)
        case "disk":
            assert part.radius is not None
            return pymunk.moment_for_circle(part.mass, 0, part.radius)
        case "block":
            assert part.size is not None
            return pymunk.moment_for_box(part.mass, part.size)
    return None
