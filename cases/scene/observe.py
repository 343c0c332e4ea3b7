"""Derived quantities, by the same formulas for the reference and for every engine.

A producer gives body states and the reactions it knows; the rest is computed here. Tested by
itself (tests/cases/test_observe.py), because a mistake here would cancel in every comparison.
"""

import numpy as np

from ..trajectory import OMEGA, VX, VY, Array, Trajectory, X, Y
from . import Scene
from .body import Body
from .frame import SPACE
from .islands import islands
from .motion import Motion
from .power import work_done
from .quantity import table


def observe(scene: Scene, trajectory: Trajectory, name: str) -> Array:
    """Samples (N,) of the quantity `name`.

    Raises KeyError for an unknown quantity, or for a reaction the producer does not give.
    """
    if name in trajectory.reactions:
        return trajectory.reactions[name]
    quantity = table(scene)[name]
    if quantity.part == "energy":
        return _energy(scene, trajectory, quantity.field)
    if quantity.part == "momentum":
        return _momentum(scene, trajectory, quantity.field)
    owner, _, point = quantity.part.partition(".")
    if quantity.field == "work" and owner in (*scene.joints, *scene.forces):
        return work_done(trajectory, corners(scene, owner), lambda rows: power(scene, rows, owner))
    for section in (scene.joints, scene.constraints, scene.contacts, scene.pairs, scene.forces):
        if owner in section:
            return section[owner].observe(motion_of(scene, trajectory), quantity.field)
    return scene.bodies[owner].observe(trajectory.states[owner], point, quantity.field)


def power(scene: Scene, trajectory: Trajectory, owner: str) -> Array:
    """(N,) the power [W] of a force, or of what drives a joint."""
    acts = scene.joints[owner] if owner in scene.joints else scene.forces[owner]
    return acts.power(motion_of(scene, trajectory))


def corners(scene: Scene, owner: str) -> set[float]:
    """The times [s] of the laws that move what an element acts on."""
    parts = islands(scene)
    mine = next((p for p in parts if owner in p.forces or owner in p.joints), scene)
    return {*mine.corners()}


def motion_of(scene: Scene, trajectory: Trajectory) -> Motion:
    """The trajectory as elements look at it."""
    return Motion(scene.bodies, scene.points, trajectory, scene.joints, scene.drives)


def _energy(scene: Scene, trajectory: Trajectory, field: str) -> Array:
    """T by König (2.54); U = −m g·r and what forces store (2.45)."""
    kinetic = np.zeros_like(trajectory.times)
    potential = np.zeros_like(trajectory.times)
    for body in scene.bodies.values():
        s = trajectory.states[body.name]
        if scene.frame is SPACE:
            kinetic += _kinetic_in_space(body, s)
            potential -= body.mass * s[:, SPACE.place] @ scene.gravity
            continue
        kinetic += 0.5 * body.mass * (s[:, VX] ** 2 + s[:, VY] ** 2)
        kinetic += 0.5 * body.moment * s[:, OMEGA] ** 2
        potential -= body.mass * (scene.gravity[0] * s[:, X] + scene.gravity[1] * s[:, Y])
    if field == "kinetic":
        return kinetic  # which asks for no inner state
    motion = motion_of(scene, trajectory)
    for force in scene.forces.values():
        potential += force.potential(motion)
    return {"potential": potential, "total": kinetic + potential}[field]


def _momentum(scene: Scene, trajectory: Trajectory, field: str) -> Array:
    """p = m ṙ_c (2.22); D₀ = Σ r × m ṙ + J ω (2.24)."""
    total = np.zeros_like(trajectory.times)
    for body in scene.bodies.values():
        s = trajectory.states[body.name]
        if scene.frame is SPACE:
            total += _momentum_in_space(body, s)[field]
        elif field == "angular":
            total += body.mass * (s[:, X] * s[:, VY] - s[:, Y] * s[:, VX])
            total += body.moment * s[:, OMEGA]
        else:
            total += body.mass * s[:, VX if field == "x" else VY]
    return total


def _kinetic_in_space(body: Body, states: Array) -> Array:
    """(2.54) T = ½ m v² + ½ ωᵀ J ω [J] (N,), with ω and J in body axes."""
    v, omega = states[:, SPACE.velocity], states[:, SPACE.spin]
    turning = np.sum((omega @ body.tensor) * omega, axis=1)
    return 0.5 * body.mass * np.sum(v * v, axis=1) + 0.5 * turning


def _momentum_in_space(body: Body, states: Array) -> dict[str, Array]:
    """(2.22) p = m v [kg m/s], (2.24) D₀ = r × m v + J ω [kg m²/s]: (N,) by axis of the ground."""
    p = body.mass * states[:, SPACE.velocity]
    own = SPACE.turned(states[:, SPACE.attitude], states[:, SPACE.spin] @ body.tensor)
    D = np.cross(states[:, SPACE.place], p) + own
    return {
        **{axis: p[:, i] for i, axis in enumerate(SPACE.axes)},
        **{f"angular_{axis}": D[:, i] for i, axis in enumerate(SPACE.axes)},
    }
