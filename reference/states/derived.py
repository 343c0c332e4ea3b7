"""Quantities derived from a mode's poses and energies at q, q̇, q̈, by the chapter's formalisms."""

import math
from collections.abc import Callable, Iterator, Mapping, Set
from functools import partial
from typing import Any

import numpy as np

from ...cases.scene import Scene
from ...cases.scene.frame import SPACE
from ...cases.scene.states import MASS_MATRIX
from ..coverage import equation
from ..formalisms import lagrange
from ..formalisms.derivative import along
from ..laws.rotation import axes
from ..mechanism.forces.action import actions
from ..mechanism.forces.ingredients import Ingredients
from ..mechanism.kinematics.coordinates import Coordinates
from ..stated import Stated
from ..system import Array, Pose


def derived(
    mode: Stated, scene: Scene, wanted: Set[str], q: Array, v: Array, a: Array
) -> dict[str, Any]:
    """By quantity: accelerations of bodies and points, inertias, M_ab, and what q̈ needs.

    Accelerations are the derivatives of velocities; of points those alone that are wanted.
    """
    quantities: dict[str, Any] = {}
    each = spatial if scene.frame is SPACE else planar
    for name, body in scene.bodies.items():
        for end in ("", *(f".{point}" for point in body.points)):
            names = [f"{name}{end}.a{axis}" for axis in scene.frame.axes]
            if not wanted.isdisjoint(names):
                x = np.array([*body.points.get(end[1:], ()), 0.0, 0.0, 0.0])[:3]
                rates = changing(lambda pose, x=x: each(pose, x)[0], mode, name, q, v, a)
                quantities |= dict(zip(names, rates.tolist(), strict=False))
        if body.turns and scene.frame is SPACE:
            alpha = changing(lambda pose: each(pose, np.zeros(3))[1], mode, name, q, v, a)
            quantities |= {f"{name}.alpha_{i}": x for i, x in zip("xyz", alpha, strict=True)}
        numbers = body.numbers().items()
        quantities |= {f"{name}.{key}": x for key, x in numbers if key.startswith("inertia")}
    if scene.frame is SPACE:
        return quantities | resisting(mode, scene, q, v, a)
    return quantities | slowed(scene, q, v)


@equation
def slowed(scene: Scene, q: Array, v: Array) -> dict[str, float]:
    """(2.46) F = −∂D/∂ṙ [N] of what slows a point, where q is x, y and angle of each body.

    By the complex step: a point moves with its body, so that ∂ṙ_P/∂ṙ_c = 1.
    """
    where, forces = Coordinates(scene), {}
    for name, force in scene.forces.items():
        (at,) = force.refers()
        xy, _ = where.columns[at.body]
        ways = np.eye(len(v))[xy : xy + 2]
        D = partial(Ingredients(where, actions([force])).D, 0.0, q)
        fx, fy = (-along(D, (v,), (way,)).item() for way in ways)
        forces |= {f"{name}.fx": fx, f"{name}.fy": fy, f"{name}.force": math.hypot(fx, fy)}
    return forces


def changing(
    of: Callable[[Pose], Any], mode: Stated, body: str, q: Array, v: Array, a: Array
) -> Array:
    """d/dt of what a body's pose has, along q̇ = v and q̈ = a, by the complex step."""
    rates: Array = lagrange.derivative(lambda q, v: of(mode.poses(0.0, q, v)[body]), (q, v), (v, a))
    return rates


def moving(mode: Stated, q: Array, v: Array, a: Array) -> dict[str, Array]:
    """d/dt of every body's pose by name, along q̇ = v and q̈ = a, by the complex step."""

    def flat(q: Any, v: Any) -> Array:
        return np.array(list(mode.poses(0.0, q, v).values()))

    return dict(zip(mode.poses(0.0, q, v), along(flat, (q, v), (v, a)), strict=True))


@equation
def spatial(pose: Pose, x: Array) -> tuple[Any, Any]:
    """(2.6) ṙ of a point x, and ω, in ground axes."""
    E = axes(pose[SPACE.attitude])
    omega = np.array(pose[SPACE.spin]) @ E
    return np.array(pose[SPACE.velocity]) + np.cross(omega, x @ E), omega


@equation
def planar(pose: Pose, x: Array) -> tuple[Any, Any]:
    """(2.6) ṙ of a point x, and ω, as vectors of space."""
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    dx, dy = cos * x[0] - sin * x[1], sin * x[0] + cos * x[1]
    return np.array([pose[3] - pose[5] * dy, pose[4] + pose[5] * dx, 0.0 * dx]), pose[5]


@equation
def resisting(mode: Stated, scene: Scene, q: Array, v: Array, a: Array) -> dict[str, Any]:
    """(2.44) M_ab (n, n), and d/dt ∂T/∂q̇ᵃ − ∂T/∂qᵃ + ∂U/∂qᵃ (n,) by the names of joints."""
    M = lagrange.mass_matrix(mode, 0.0, q)
    needed = M @ a - lagrange.forces(mode, 0.0, q, v)
    by_name = dict(zip(mode.coordinates, needed.tolist(), strict=True))
    return {MASS_MATRIX: M, **{effort: by_name[name] for name, effort in efforts(scene)}}


def efforts(scene: Scene) -> Iterator[tuple[str, str]]:
    """For each coordinate: its name, and that of what moves it: `q1.angle`, `q1.torque`."""
    for joint in scene.joints.values():
        for freedom in joint.freedoms:
            yield f"{joint.name}.{freedom.name}", f"{joint.name}.{freedom.effort}"


@equation
def by_virtual_work(
    mode: Stated, g: Any, q: Array, v: Array, a: Array
) -> Mapping[str, tuple[float, float]]:
    """(2.39), (2.50) Σ (m (r̈_c − g)·∂ṙ_c/∂q̇ᵃ + (J ω̇ + ω × J ω)·∂ω/∂q̇ᵃ), by coordinate.

    And the size of its terms: the sum of what each product of two numbers has, however they cancel.
    """
    poses, changes = mode.poses(0.0, q, v), moving(mode, q, v, a)
    still = mode.poses(0.0, q, 0.0 * v)
    works = dict.fromkeys(mode.coordinates, (0.0, 0.0))
    for name, e in zip(mode.coordinates, np.eye(len(v)), strict=True):
        virtual = mode.poses(0.0, q, e)
        for body, mass in mode.masses.items():
            way = np.array(virtual[body], float) - np.array(still[body], float)
            omega = np.array(poses[body][SPACE.spin])
            force = mass.m * (changes[body][SPACE.velocity] - np.asarray(g))
            spun = np.cross(omega, mass.J @ omega)
            moment = mass.J @ changes[body][SPACE.spin] + spun
            done = float(force @ way[SPACE.velocity] + moment @ way[SPACE.spin])
            # What cancels in ω × J ω is as large as J ω², also where ω is along an axis of J.
            fast = np.linalg.norm(mass.J) * (omega @ omega)
            size = np.abs(force) @ np.abs(way[SPACE.velocity])
            size += (np.abs(moment) + fast) @ np.abs(way[SPACE.spin])
            work, largest = works[name]
            works[name] = work + done, largest + float(size)
    return works
