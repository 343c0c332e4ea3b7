"""States of all bodies, for a whole record at once.

In the plane from joint coordinates, which count whole turns: what MuJoCo's kinematics does, a step
at a time and 4 µs each, done here for all steps of a run; tested to give the same. In space from
MuJoCo's kinematics.
"""

import math
from collections.abc import Callable

import mujoco
import numpy as np

from ....cases.scene import GROUND, Scene
from ....cases.scene.frame import PLANE, SPACE
from ....cases.scene.rotation import UPRIGHT, Vector3, inverse, turned
from ....cases.trajectory import ANGLE, OMEGA, VX, VY, Array, X, Y
from ...engine import Start
from ..model.tree import Branch, called, driven, held_angle, local, natives, spanning_tree
from .record import Record

Coordinate = Callable[[str], tuple[Array, Array]]


def poses(
    scene: Scene,
    model: mujoco.MjModel,
    probe: mujoco.MjData,  # any of the model: in space it is moved through the record
    record: Record,
    start: Start,
) -> dict[str, Array]:
    """The states (N, ·) of each body's centre of mass, as its frame has them."""
    if scene.frame is PLANE:
        return _in_plane(scene, model, record.qpos, record.qvel, start)
    return _in_space(scene, model, probe, record, start)


def _in_plane(
    scene: Scene, model: mujoco.MjModel, qpos: Array, qvel: Array, start: Start
) -> dict[str, Array]:
    """(N, 6) of each body: x, y, angle, vx, vy, omega of the centre of mass."""
    tree = spanning_tree(scene)
    at = {GROUND: np.zeros((len(qpos), 6))}

    def joint(name: str) -> tuple[Array, Array]:
        place = model.joint(name)
        return qpos[:, place.qposadr[0]], qvel[:, place.dofadr[0]]

    for name in driven(scene):
        at[name] = np.zeros((len(qpos), 6))
        for axis, rate in ((X, VX), (Y, VY)):
            at[name][:, axis], at[name][:, rate] = joint(f"{name}.{'xy'[axis]}")
    for branch in tree.branches:
        at[branch.body] = _hung(scene, branch, at[branch.parent], joint)
    return {name: _counted(scene, rows=at[name], name=name, start=start) for name in scene.bodies}


def _hung(scene: Scene, branch: Branch, parent: Array, joint: Coordinate) -> Array:
    """The frame of a body that hangs on its parent's."""
    rows = np.zeros_like(parent)
    joints = natives(scene, branch)
    if branch.joint is None:
        for native in joints:
            rows[:, native.of], rows[:, VX + native.of] = joint(native.name)
        return rows
    rows[:, ANGLE], rows[:, OMEGA] = parent[:, ANGLE], parent[:, OMEGA]
    rows[:, ANGLE] += held_angle(scene, branch)
    before = rows.copy()
    for native in (native for native in joints if native.type == "hinge"):
        angle, omega = joint(native.name)
        rows[:, ANGLE] += native.axis[2] * angle
        rows[:, OMEGA] += native.axis[2] * omega
    outer, inner = branch.ends()
    for columns, rate in ((slice(X, Y + 1), False), (slice(VX, VY + 1), True)):
        rows[:, columns] = parent[:, columns]
        rows[:, columns] += _carried(parent, local(scene, outer), rate=rate)
        rows[:, columns] -= _carried(rows, local(scene, inner), rate=rate)
    for native in (native for native in joints if native.type == "slide"):
        shift, speed = joint(native.name)
        line = before if branch.forward else rows  # it turns with the joint's first part
        axis, turning = _carried(line, native.axis), _carried(line, native.axis, rate=True)
        rows[:, X : Y + 1] += shift[:, None] * axis
        rows[:, VX : VY + 1] += speed[:, None] * axis + shift[:, None] * turning
    return rows


def _carried(frame: Array, vector: Vector3, *, rate: bool = False) -> Array:
    """(N, 2): a vector of the plane that turns with the frame, or its rate."""
    cos, sin = np.cos(frame[:, ANGLE]), np.sin(frame[:, ANGLE])
    x, y = cos * vector[0] - sin * vector[1], sin * vector[0] + cos * vector[1]
    if rate:
        x, y = -frame[:, OMEGA] * y, frame[:, OMEGA] * x
    return np.column_stack([x, y])


def _counted(scene: Scene, *, rows: Array, name: str, start: Start) -> Array:
    """The angle counted from the start's, which may be 370 deg; a particle has none."""
    if not scene.bodies[name].turns:
        rows = rows.copy()
        rows[:, ANGLE] = rows[:, OMEGA] = 0.0
        return rows
    rows[:, ANGLE] += math.tau * np.round((start[name][ANGLE] - rows[0, ANGLE]) / math.tau)
    return rows


def _in_space(
    scene: Scene, model: mujoco.MjModel, probe: mujoco.MjData, record: Record, start: Start
) -> dict[str, Array]:
    """(N, 13) of each body: r, quaternion and v of its centre of mass, ω in its own axes."""
    views = [probe.xpos, probe.xquat, probe.cvel, probe.subtree_com]
    seen = [np.empty((len(record.qpos), *view.shape)) for view in views]
    for i, (qpos, qvel) in enumerate(zip(record.qpos, record.qvel, strict=True)):
        probe.qpos[:], probe.qvel[:] = qpos, qvel
        mujoco.mj_kinematics(model, probe)
        mujoco.mj_comPos(model, probe)
        mujoco.mj_comVel(model, probe)
        for kept, view in zip(seen, views, strict=True):
            kept[i] = view
    places, attitudes, spins, centers = seen
    states = {}
    for name, body in scene.bodies.items():
        number = model.body(called(name)).id
        place, spin = places[:, number], spins[:, number]
        # MuJoCo's velocities are those at the centre of mass of the whole tree.
        center = centers[:, model.body_rootid[number]]
        rows = np.zeros((len(place), SPACE.width))
        rows[:, SPACE.place] = place
        rows[:, SPACE.velocity] = spin[:, 3:] + np.cross(spin[:, :3], place - center)
        if body.turns:
            attitude = attitudes[:, number]
            rows[:, SPACE.attitude] = _continuous(attitude, np.array(start[name][SPACE.attitude]))
            rows[:, SPACE.spin] = turned(inverse(attitude), spin[:, :3])
        else:
            rows[:, SPACE.attitude] = UPRIGHT
        states[name] = rows
    return states


def _continuous(attitude: Array, first: Array) -> Array:
    """(N, 4) each with the sign that is nearer to the one before it."""
    before = np.vstack([first, attitude[:-1]])
    turns = np.where(np.sum(before * attitude, axis=1) < 0, -1.0, 1.0)
    return attitude * np.cumprod(turns)[:, None]
