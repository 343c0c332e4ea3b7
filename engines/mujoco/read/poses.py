"""States of all bodies from joint coordinates, for a whole record at once.

What MuJoCo's kinematics does, a step at a time and 4 µs each, done here for all steps of a run;
tested to give the same.
"""

import math
from collections.abc import Callable

import mujoco
import numpy as np

from ....cases.scene import GROUND, Scene
from ....cases.trajectory import ANGLE, OMEGA, VX, VY, Array, X, Y
from ...engine import Start
from ..model.scene import local
from ..model.tree import Branch, built_as, coordinate, driven, spanning_tree, turned

Coordinate = Callable[[str], tuple[Array, Array]]


def poses(
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
    body, by = scene.bodies[branch.body], branch.joint
    rows = np.zeros_like(parent)
    if by is None:
        columns = [("x", X, VX), ("y", Y, VY), ("angle", ANGLE, OMEGA)][: 3 if body.turns else 2]
        for name, place, rate in columns:
            rows[:, place], rows[:, rate] = joint(f"{body.name}.{name}")
        return rows
    left = built_as(scene, by)
    rows[:, ANGLE], rows[:, OMEGA] = parent[:, ANGLE], parent[:, OMEGA]
    held = 0.0 if left.turns or not body.turns else by.angle if branch.forward else -by.angle
    rows[:, ANGLE] += held
    before = rows.copy()
    if left.turns and body.turns:
        angle, omega = joint(coordinate(by, "turn"))
        rows[:, ANGLE] += angle
        rows[:, OMEGA] += omega
    outer, inner = branch.ends()
    for columns, rate in ((slice(X, Y + 1), False), (slice(VX, VY + 1), True)):
        rows[:, columns] = parent[:, columns]
        rows[:, columns] += _carried(parent, local(scene, outer), rate=rate)
        rows[:, columns] -= _carried(rows, local(scene, inner), rate=rate)
    if left.shifts:
        along = turned(by.along, -held) if branch.forward else turned(by.along, math.pi)
        shift, speed = joint(coordinate(by, "shift"))
        line = before if branch.forward else rows  # it turns with the joint's first part
        axis, turning = _carried(line, along), _carried(line, along, rate=True)
        rows[:, X : Y + 1] += shift[:, None] * axis
        rows[:, VX : VY + 1] += speed[:, None] * axis + shift[:, None] * turning
    return rows


def _carried(frame: Array, vector: tuple[float, float], *, rate: bool = False) -> Array:
    """(N, 2): a vector that turns with the frame, or its rate."""
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
