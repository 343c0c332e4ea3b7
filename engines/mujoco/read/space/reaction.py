"""Forces and moments of joints, drives and contacts from MuJoCo's arrays, all samples at once."""

from collections.abc import Iterator

import mujoco
import numpy as np

from .....cases.scene import Anchor, Scene
from .....cases.scene.joint import Joint
from .....cases.trajectory import Array
from ....law import TORQUES, turning
from ...model.force import outer
from ...model.space.drive import Drive
from ...model.space.scene import connect_points
from ...model.tree import Tree, called
from .seen import Seen

_OBJECT = mujoco.mjtObj
CONTACT = ("fx", "fy", "normal")


def joint_wrench(
    scene: Scene,
    tree: Tree[Joint],
    model: mujoco.MjModel,
    seen: Seen,
    joint: Joint,
) -> Array:
    """(N, 6): force, and moment about the second point, of the first part on the second."""
    at = _site(model, seen, str(joint.b))
    if joint in tree.loops:
        return _loop(scene, model, seen, joint, at)
    branch = next(b for b in tree.branches if b.joint is joint)
    body = model.body(called(branch.body)).id
    # cfrc_int is what holds the subtree together with its parent: the joint's force, and what
    # actuators do to the subtree, which MuJoCo counts as done through the joints.
    through = seen["cfrc_int"][:, body]
    force = through[:, 3:].copy()
    center = seen["subtree_com"][:, model.body_rootid[body]]
    moment = through[:, :3] + np.cross(center - at, force)
    for given, place, torque in _others(scene, tree.subtree(branch.body), model, seen):
        force -= given
        moment -= np.cross(place - at, given) + torque
    sign = 1.0 if branch.forward else -1.0
    return sign * np.hstack([force, moment])


def effort(model: mujoco.MjModel, seen: Seen, drive: Drive, forward: bool, wrench: Array) -> Array:
    """(N,) what a drive exerts on the second part along its freedom [N, N m]."""
    axis = seen["xaxis"][:, model.joint(drive.name).id] * (1.0 if forward else -1.0)
    kind = drive.joint.freedoms[drive.number].kind
    return np.sum(axis * (wrench[:, :3] if kind == "shift" else wrench[:, 3:]), axis=1)


def contact_force(scene: Scene, name: str, felt: Array) -> Array:
    """`touch.fx`, `touch.fy` or `touch.normal` (N,) from the sensors' rows."""
    part, _, field = name.rpartition(".")
    return felt[:, 3 * list(scene.contacts).index(part) + CONTACT.index(field)]


def _loop(scene: Scene, model: mujoco.MjModel, seen: Seen, joint: Joint, at: Array) -> Array:
    """The forces of the points that hold the joint; MuJoCo counts those on the first part."""
    found = np.zeros((len(at), 6))
    for number in range(len(connect_points(scene, joint))):
        name = f"{joint.name}.{number}"
        first = 3 * mujoco.mj_name2id(model, _OBJECT.mjOBJ_EQUALITY, name)
        force = -seen["efc_force"][:, first : first + 3]
        arm = _site(model, seen, f"{name}.b") - at
        found += np.hstack([force, np.cross(arm, force)])
    return found


def _others(
    scene: Scene, bodies: set[str], model: mujoco.MjModel, seen: Seen
) -> Iterator[tuple[Array, Array, Array]]:
    """Forces (N, 3), where they act, and torques (N, 3) that actuators exert on the bodies."""
    for anchor, force, torque in outer(scene, model, seen["actuator_force"]):
        if anchor.body in bodies:
            yield force, _site(model, seen, _name(anchor)), torque


def _name(anchor: Anchor) -> str:
    return str(anchor)


def _site(model: mujoco.MjModel, seen: Seen, name: str) -> Array:
    return seen["site_xpos"][:, mujoco.mj_name2id(model, _OBJECT.mjOBJ_SITE, name)]


# Torques of force elements about a turn, which MuJoCo counts as the joint's own.


ABOUT = ("qpos", "qvel", "actuator_force")


def acting(scene: Scene, model: mujoco.MjModel, seen: Seen, drive: Drive) -> Array | float:
    """(N,) [N m] what springs, dampers and motors exert about a driven turn."""
    joint, native = drive.joint, model.joint(drive.name)
    total: Array | float = 0.0
    for force in scene.forces.values():
        if force.about != joint.name or joint.turning(force.turn) != drive.number:
            continue
        if type(force) in TORQUES:
            angle, rate = seen["qpos"][:, native.qposadr[0]], seen["qvel"][:, native.dofadr[0]]
            total = total + turning(force, angle, rate)  # type: ignore[arg-type]
        else:
            actuator = model.actuator(force.name)
            total = total + actuator.gear[0] * seen["actuator_force"][:, actuator.id]
    return total
