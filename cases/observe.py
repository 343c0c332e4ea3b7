"""Derived quantities, by the same formulas for the reference and for every engine.

A producer gives body states and the reactions it knows; the rest is computed here. Tested by
itself (tests/cases/test_observe.py), because a mistake here would cancel in every comparison.
"""

import numpy as np

from .quantity import Quantity, table
from .scene import GROUND, Anchor, Contact, Damper, Joint, Scene, Spring
from .trajectory import ANGLE, OMEGA, VX, VY, Array, Trajectory, X, Y


def observe(scene: Scene, trajectory: Trajectory, name: str) -> Array:
    """Samples (N,) of the quantity `name`.

    Raises KeyError for an unknown quantity, or for a reaction the producer does not give.
    """
    quantity = table(scene)[name]
    if name in trajectory.reactions:
        return trajectory.reactions[name]
    if quantity.part == "energy":
        return _energy(scene, trajectory, quantity.field)
    if quantity.part == "momentum":
        return _momentum(scene, trajectory, quantity.field)
    if quantity.part in scene.joints:
        return _joint(scene, trajectory, scene.joints[quantity.part], quantity.field)
    if quantity.part in scene.contacts:
        return _contact(scene, trajectory, scene.contacts[quantity.part], quantity.field)
    if quantity.part in scene.forces:
        force = scene.forces[quantity.part]
        assert isinstance(force, Spring | Damper)
        length, rate = line(scene, trajectory, force.a, force.b)
        return length if quantity.field == "length" else tension(force, length, rate)
    return _point(scene, trajectory, quantity)


def point_states(scene: Scene, trajectory: Trajectory, anchor: Anchor) -> Array:
    """(N, 4): x, y, vx, vy of a point (2.1), (2.6)."""
    if anchor.body == GROUND:
        ground = scene.points[anchor.point]
        velocity = np.asarray(ground.velocity)
        position = np.asarray(ground.at) + velocity * trajectory.times[:, None]
        return np.hstack([position, np.broadcast_to(velocity, position.shape)])
    s = trajectory.states[anchor.body]
    a, b = scene.bodies[anchor.body].points[anchor.point]
    cos, sin = np.cos(s[:, ANGLE]), np.sin(s[:, ANGLE])
    dx, dy = cos * a - sin * b, sin * a + cos * b
    return np.stack(
        [s[:, X] + dx, s[:, Y] + dy, s[:, VX] - s[:, OMEGA] * dy, s[:, VY] + s[:, OMEGA] * dx],
        axis=1,
    )


def line(scene: Scene, trajectory: Trajectory, a: Anchor, b: Anchor) -> tuple[Array, Array]:
    """Length (N,) of the line from a to b, and its rate (zero where the length is zero)."""
    d = point_states(scene, trajectory, b) - point_states(scene, trajectory, a)
    length = np.hypot(d[:, 0], d[:, 1])
    rate = (d[:, 0] * d[:, 2] + d[:, 1] * d[:, 3]) / np.where(length > 0, length, 1.0)
    return length, rate


def tension(force: Spring | Damper, length: Array, rate: Array) -> Array:
    """With what force [N] the spring (2.82) or damper (2.47) pulls its ends together."""
    if isinstance(force, Spring):
        return force.stiffness * (length - force.rest_length)
    return force.damping * rate


def _point(scene: Scene, trajectory: Trajectory, quantity: Quantity) -> Array:
    body, _, point = quantity.part.partition(".")
    if quantity.field in ("angle", "omega"):
        return trajectory.states[body][:, ANGLE if quantity.field == "angle" else OMEGA]
    p = point_states(scene, trajectory, Anchor(body, point or "center"))
    if quantity.field == "speed":
        return np.hypot(p[:, 2], p[:, 3])
    return p[:, ("x", "y", "vx", "vy").index(quantity.field)]


def _joint(scene: Scene, trajectory: Trajectory, joint: Joint, field: str) -> Array:
    if field == "force":
        return np.hypot(
            trajectory.reactions[f"{joint.name}.fx"], trajectory.reactions[f"{joint.name}.fy"]
        )
    if field not in ("gap", "slip"):
        raise KeyError(f"{joint.name}.{field}")
    d = point_states(scene, trajectory, joint.b) - point_states(scene, trajectory, joint.a)
    if joint.kind != "slide":
        return np.hypot(d[:, 0], d[:, 1])
    grounded = joint.a.body == GROUND
    turned = 0.0 if grounded else trajectory.states[joint.a.body][:, ANGLE]
    ux = np.cos(turned) * joint.along[0] - np.sin(turned) * joint.along[1]
    uy = np.sin(turned) * joint.along[0] + np.cos(turned) * joint.along[1]
    gap = ux * d[:, 1] - uy * d[:, 0]
    if field == "gap":
        return gap
    turning = 0.0 if grounded else trajectory.states[joint.a.body][:, OMEGA]
    return ux * d[:, 2] + uy * d[:, 3] + turning * gap  # d/dt (u · d): the line turns too


def _contact(scene: Scene, trajectory: Trajectory, contact: Contact, field: str) -> Array:
    """The lowest point of a disk's rim, or the point that touches: its height and velocity."""
    x, y, vx, _ = point_states(scene, trajectory, contact.at).T
    radius = scene.bodies[contact.body].radius
    if radius is not None:
        s = trajectory.states[contact.body]
        x, y, vx = x + radius * s[:, ANGLE], y - radius, vx + radius * s[:, OMEGA]
    if field == "drift":
        return x - x[0]
    if field not in ("gap", "slip"):
        raise KeyError(f"{contact.name}.{field}")
    return y if field == "gap" else vx


def _energy(scene: Scene, trajectory: Trajectory, field: str) -> Array:
    """T by König (2.54); U = −m g·r + Σ ½ c (λ − λ₀)² (2.45)."""
    kinetic = np.zeros_like(trajectory.times)
    potential = np.zeros_like(trajectory.times)
    for body in scene.bodies.values():
        s = trajectory.states[body.name]
        kinetic += 0.5 * body.mass * (s[:, VX] ** 2 + s[:, VY] ** 2)
        kinetic += 0.5 * (body.inertia or 0.0) * s[:, OMEGA] ** 2
        potential -= body.mass * (scene.gravity[0] * s[:, X] + scene.gravity[1] * s[:, Y])
    for spring in scene.springs():
        length, _ = line(scene, trajectory, spring.a, spring.b)
        potential += 0.5 * spring.stiffness * (length - spring.rest_length) ** 2
    return {"kinetic": kinetic, "potential": potential, "total": kinetic + potential}[field]


def _momentum(scene: Scene, trajectory: Trajectory, field: str) -> Array:
    """p = m ṙ_c (2.22); D₀ = Σ r × m ṙ + J ω (2.24)."""
    total = np.zeros_like(trajectory.times)
    for body in scene.bodies.values():
        s = trajectory.states[body.name]
        if field == "angular":
            total += body.mass * (s[:, X] * s[:, VY] - s[:, Y] * s[:, VX])
            total += (body.inertia or 0.0) * s[:, OMEGA]
        else:
            total += body.mass * s[:, VX if field == "x" else VY]
    return total
