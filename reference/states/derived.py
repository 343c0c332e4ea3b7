"""What follows of a mode's poses and energies for given q, q̇ and q̈, by the chapter's formalisms."""

from collections.abc import Iterator, Mapping, Set
from typing import Any

import numpy as np

from ...cases.frame import SPACE
from ...cases.scene import Scene
from ...cases.space.joint import effort_of
from ...cases.space.scene import SpatialScene
from ...cases.states import MASS_MATRIX
from ..formalisms import lagrange
from ..formalisms.derivative import along
from ..laws.rotation import acceleration, axes
from ..stated import Stated
from ..system import Array, Pose


def derived(
    mode: Stated, scene: Scene, wanted: Set[str], q: Array, v: Array, a: Array
) -> dict[str, Any]:
    """By quantity: accelerations of bodies and points, inertias, M_ab, and what q̈ needs.

    Of points those alone that are wanted.
    """
    found: dict[str, Any] = {}
    poses, changes = mode.poses(0.0, q, v), moving(mode, q, v, a)
    for name, body in scene.bodies.items():
        each = spatial if scene.frame is SPACE else planar
        E, omega, (a_c, alpha) = each(poses[name], changes[name])
        points = {f".{point}": x for point, x in body.points.items()}
        for end, x in {"": (), **points}.items():
            names = [f"{name}{end}.a{axis}" for axis in scene.frame.axes]
            if not wanted.isdisjoint(names):
                d = np.array([*x, 0.0, 0.0, 0.0])[:3] @ E
                found |= dict(zip(names, acceleration(a_c, alpha, omega, d).tolist(), strict=False))
        turning = {f"alpha_{i}": x for i, x in zip("xyz", alpha, strict=True)}
        turning = turning if scene.frame is SPACE else {}
        inertias = {key: x for key, x in body.numbers().items() if key.startswith("inertia")}
        found |= {f"{name}.{key}": x for key, x in (turning | inertias).items() if body.turns}
    if isinstance(scene, SpatialScene):
        found |= resisting(mode, scene, q, v, a)
    return found


def moving(mode: Stated, q: Array, v: Array, a: Array) -> dict[str, Array]:
    """d/dt of every pose along q̇ = v and q̈ = a, by the complex step."""

    def flat(q: Any, v: Any) -> Array:
        return np.array(list(mode.poses(0.0, q, v).values()))

    return dict(zip(mode.poses(0.0, q, v), along(flat, (q, v), (v, a)), strict=True))


def spatial(pose: Pose, change: Array) -> tuple[Array, Array, tuple[Array, Array]]:
    """E; ω; r̈_c and ω̇ in ground axes."""
    E = axes(pose[SPACE.attitude])
    return E, np.array(pose[SPACE.spin]) @ E, (change[SPACE.velocity], change[SPACE.spin] @ E)


def planar(pose: Pose, change: Array) -> tuple[Array, Array, tuple[Array, Array]]:
    """The same as vectors of space, about e₃."""
    cos, sin = np.cos(pose[2]), np.sin(pose[2])
    E = np.array([[cos, sin, 0.0], [-sin, cos, 0.0], [0.0, 0.0, 1.0]])
    linear, turning = np.array([*change[3:5], 0.0]), np.array([0.0, 0.0, change[5]])
    return E, np.array([0.0, 0.0, pose[5]]), (linear, turning)


def resisting(mode: Stated, scene: SpatialScene, q: Array, v: Array, a: Array) -> dict[str, Any]:
    """(2.44) M_ab (n, n), and d/dt ∂T/∂q̇ᵃ − ∂T/∂qᵃ + ∂U/∂qᵃ (n,) by the names of joints."""
    M = lagrange.mass_matrix(mode, 0.0, q)
    needed = M @ a - lagrange.forces(mode, 0.0, q, v)
    by_name = dict(zip(mode.coordinates, needed.tolist(), strict=True))
    return {MASS_MATRIX: M, **{effort: by_name[name] for name, effort in efforts(scene)}}


def efforts(scene: SpatialScene) -> Iterator[tuple[str, str]]:
    """Of each coordinate, what moves it: `q1.angle`, `q1.torque`."""
    for joint in scene.joints.values():
        for freedom in joint.freedoms:
            yield f"{joint.name}.{freedom.name}", f"{joint.name}.{effort_of(freedom)}"


def by_virtual_work(mode: Stated, g: Any, q: Array, v: Array, a: Array) -> Mapping[str, float]:
    """(2.39), (2.50) Σ (m (r̈_c − g)·∂ṙ_c/∂q̇ᵃ + (J ω̇ + ω × J ω)·∂ω/∂q̇ᵃ), by coordinate."""
    poses, changes = mode.poses(0.0, q, v), moving(mode, q, v, a)
    still = mode.poses(0.0, q, 0.0 * v)
    found = dict.fromkeys(mode.coordinates, 0.0)
    for name, e in zip(mode.coordinates, np.eye(len(v)), strict=True):
        virtual = mode.poses(0.0, q, e)
        for body, mass in mode.masses.items():
            way = np.array(virtual[body], float) - np.array(still[body], float)
            omega = np.array(poses[body][SPACE.spin])
            force = mass.m * (changes[body][SPACE.velocity] - np.asarray(g))
            moment = mass.J @ changes[body][SPACE.spin] + np.cross(omega, mass.J @ omega)
            found[name] += float(force @ way[SPACE.velocity] + moment @ way[SPACE.spin])
    return found
