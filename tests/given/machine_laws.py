"""The laws of any machine in space, written down once more, each relative to its largest term.

(2.23) and (2.27) take the reactions as the engine of a joint would: forces and moments at the
second point, in ground axes, on bodies that are cut free.
"""

from collections.abc import Callable, Iterator
from types import ModuleType
from typing import Any

import numpy as np

from textmech.cases.scene import GROUND, Anchor, Damper, Push, Spring, Torque
from textmech.reference.formalisms import appell, chaplygin, lagrange, voronets
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.system import Array

from .free_cut import matrix
from .multibody_laws import balance, lagrangian

Machine = SpatialMultibody
Law = Callable[[Machine, float, Array, Array], float]
EXACT = 1e-12  # of the largest term: the laws are algebra, only rounding may differ
UP = np.array([0.0, 0.0, 1.0])


def multipliers(mode: Machine, t: float, q: Array, v: Array) -> float:
    """(2.60) λ of the explicit solution against those of T, U, D, Q₄, f_a and g."""
    known, found = lagrange.multipliers(mode, t, q, v)[1], mode.solve(t, q, v)[1]
    return float(np.max(np.abs(found - known)) / np.max(np.abs(known))) if len(known) else 0.0


def without(form: ModuleType) -> Callable[[Machine, float, Array, Array], float | None]:
    """Explicit accelerations against a formalism without multipliers; None: it does not apply."""

    def law(mode: Machine, t: float, q: Array, v: Array) -> float | None:
        a, found = mode.accelerations(t, q, v), form.accelerations(mode, t, q, v)
        size = max(float(np.max(np.abs(a))), mode.terms(t, q, v)[0])
        return None if found is None else float(np.max(np.abs(found - a)) / size)

    return law


def bodies(mode: Machine, t: float, q: Array, v: Array) -> float:
    """(2.23) m r̈_c = F and (2.33) J ω̇ + ω × (J ω) = M_c of every body that is cut free."""
    a, forces, worst = mode.accelerations(t, q, v), mode.reactions(t, q, v), 0.0
    poses = mode.poses(t, q, v)
    for name, body in mode.scene.bodies.items():
        at = mode.where.slots[name]
        acting = np.array(list(_acting(mode, name, t, poses, forces)))
        change = np.zeros(6)
        change[:3] = body.mass * a[at.r_dot : at.r_dot + 3]
        if at.omega is not None:
            omega, J = np.array(poses[name][10:]), body.tensor
            turning = J @ a[at.omega : at.omega + 3] + np.cross(omega, J @ omega)
            change[3:] = matrix(poses[name]) @ turning
        else:
            acting = acting[:, :3]  # a particle takes no moment
        left = acting.sum(axis=0) - change[: acting.shape[1]]
        worst = max(worst, float(np.max(np.abs(left)) / np.max(np.abs(acting))))
    return worst


def lowest_points(mode: Machine, t: float, q: Array, v: Array) -> float:
    """(2.19) The rows of what rolls are the velocity of the body's point that touches the floor."""
    rows, g, _ = mode.rows(t, q, v)
    free = v + np.random.default_rng(5).normal(size=len(v))  # such as slip
    poses = mode.poses(t, q, free)
    worst, slips = 0.0, rows @ free - g
    for name, contact in mode.scene.contacts.items():
        mine = [owner == name for owner in mode.owners]
        pose, at = poses[contact.body], _touching(mode, name, poses)
        arm, omega = at - pose[:3], matrix(pose) @ pose[10:]
        slip = np.array(pose[7:10]) + np.cross(omega, arm)
        worst = max(worst, float(np.max(np.abs(slips[mine] - slip)) / np.max(np.abs(slip))))
    return worst


def lengths(mode: Machine, t: float, q: Array, v: Array) -> float:
    """What a quaternion's length changes: neither places, rows, energies nor accelerations."""
    r, e = mode.where.attitudes.shape[0], mode.where.attitudes
    long, stretch = q.copy(), np.ones(len(q))
    stretch[e] = np.linspace(0.7, 1.9, r)[:, None]
    long *= stretch

    def all_of(q: Array, stretch: Any) -> Array:
        q_dot = mode.rates(t, q, v)
        places = [x for pose in mode.poses(t, q, v).values() for x in pose]
        numbers = [mode.T(t, q, q_dot), mode.U(t, q), *mode.f(t, q), *mode.accelerations(t, q, v)]
        return np.array([*places, *numbers, *mode.f_a(t, q).ravel(), *(q_dot / stretch)])

    one, other = all_of(q, 1.0), all_of(long, stretch)
    return float(np.max(np.abs(one - other)) / np.max(np.abs(one)))


LAWS: dict[str, Law] = {
    "lagrangian": lagrangian, "balance": balance, "multipliers": multipliers, "bodies": bodies,
    "lowest points": lowest_points, "lengths": lengths,
}  # fmt: skip
REDUCED = {form: without(form) for form in (voronets, appell, chaplygin)}


def _acting(
    mode: Machine, name: str, t: float, poses: Any, reactions: dict[str, float]
) -> Iterator[Array]:
    """Force and moment about the centre (6,) of each that acts on a body, in ground axes."""
    scene, centre = mode.scene, np.array(poses[name][:3])

    def wrench(at: Array, force: Array, moment: Any = 0.0) -> Array:
        return np.concatenate([force, np.cross(at - centre, force) + moment])

    yield wrench(centre, scene.bodies[name].mass * np.array(scene.gravity))
    for force in scene.forces.values():
        yield from (wrench(*each) for each in _applied(mode, force, name, t, poses))

    def told(part: str, *fields: str) -> Array:
        return np.array([reactions.get(f"{part}.{field}", 0.0) for field in fields])

    for joint in scene.joints.values():
        at = _point(mode, joint.b, t, poses)[0]
        sign = (joint.b.body == name) - float(joint.a.body == name)
        if sign:
            force, moment = told(joint.name, "fx", "fy", "fz"), told(joint.name, "mx", "my", "mz")
            yield wrench(at, sign * force, sign * moment)
    for contact in scene.contacts.values():
        if contact.body == name:
            at = _touching(mode, contact.name, poses)
            yield wrench(at, told(contact.name, "fx", "fy", "normal"))
    for edge in scene.constraints.values():
        if edge.at.body == name:
            x, y, _ = matrix(poses[name]) @ edge.along
            left = np.array([-y, x, 0.0]) / np.hypot(x, y)
            side, up = told(edge.name, "force", "normal")
            yield wrench(_point(mode, edge.at, t, poses)[0], side * left + up * UP)


def _applied(mode: Machine, f: Any, name: str, t: float, poses: Any) -> Iterator[Any]:
    """Where, which force, and which moment."""
    match f:
        case Spring() | Damper():
            for here, there in ((f.a, f.b), (f.b, f.a)):
                if here.body == name:
                    (at, v), (to, w) = (_point(mode, end, t, poses) for end in (here, there))
                    d = to - at
                    long = np.linalg.norm(d)
                    if isinstance(f, Spring):
                        size = f.stiffness * (long - f.rest_length)
                    else:
                        size = f.damping * (d @ (w - v)) / long
                    yield at, size * d / long
        case Push() if f.at.body == name:
            yield _point(mode, f.at, t, poses)[0], _signal(f, t)
        case Torque() if f.body == name:
            yield np.array(poses[name][:3]), np.zeros(3), _signal(f, t)
        case _:
            pass


def _signal(f: Push | Torque, t: float) -> Array:
    wave = np.sin(f.signal.angular_frequency * t + f.signal.phase)
    return {"constant": 1.0, "ramp": t, "sine": wave}[f.signal.law] * np.array(f.signal.amplitude)


def _point(mode: Machine, anchor: Anchor, t: float, poses: Any) -> tuple[Array, Array]:
    """r and ṙ of a point of a body or of the ground."""
    if anchor.body == GROUND:
        point = mode.scene.points[anchor.point]
        return np.array(point.at) + t * np.array(point.velocity), np.array(point.velocity)
    pose = poses[anchor.body]
    R, x = matrix(pose), np.array(mode.scene.bodies[anchor.body].points[anchor.point])
    return np.array(pose[:3]) + R @ x, np.array(pose[7:10]) + R @ np.cross(pose[10:], x)


def _touching(mode: Machine, contact: str, poses: Any) -> Array:
    """The lowest point of a rim or a sphere, the lower end of the steepest diameter."""
    body = mode.scene.bodies[mode.scene.contacts[contact].body]
    pose, radius = poses[body.name], body.radius or 0.0
    if body.axle is None:
        return np.array(pose[:3]) - radius * UP
    axle = matrix(pose) @ body.axle
    level = np.cross(UP, axle)
    steep = radius * np.cross(level, axle) / np.linalg.norm(level)
    ends = np.array(pose[:3]) + steep, np.array(pose[:3]) - steep
    return min(ends, key=lambda end: float(end[2]))
