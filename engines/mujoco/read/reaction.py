"""Forces and moments of joints, drives and contacts from MuJoCo's arrays, all samples at once."""

from collections.abc import Callable, Iterator, Mapping
from functools import partial

import mujoco
import numpy as np

from ....cases.scene import GROUND, Anchor, Joint, Scene
from ....cases.scene.frame import PLANE, SPACE
from ....cases.trajectory import Array
from ...law import TORQUES
from ..model.drive import Drive
from ..model.force import ELEMENTS, damps, limit_force, outer
from ..model.loops import connections, pulled
from ..model.pairs import pair_force
from ..model.planes import touching
from ..model.tree import Tree, called, freedoms_left, number_of

Seen = Mapping[str, Array]
_OBJECT = mujoco.mjtObj


def joint_wrench(
    scene: Scene, tree: Tree, model: mujoco.MjModel, seen: Seen, joint: Joint
) -> Array:
    """(N, 6): force, and moment about the second point, of the first part on the second."""
    at = _site(model, seen, joint.b)
    if joint in tree.loops and joint.swings:
        a, b = (_site(model, seen, end) for end in joint.refers())
        number = mujoco.mj_name2id(model, _OBJECT.mjOBJ_EQUALITY, joint.name)
        force = pulled(seen["efc_force"][:, number, :1], a, b)
        return np.hstack([force, np.zeros_like(force)])
    if joint in tree.loops:
        wrench = np.zeros((len(at), 6))
        for name, _, site in connections(scene, joint):
            force = pinned(model, seen, name)
            wrench += np.hstack([force, np.cross(_site(model, seen, site) - at, force)])
        return wrench
    branch = next(b for b in tree.branches if b.joint is joint)
    body = mujoco.mj_name2id(model, _OBJECT.mjOBJ_BODY, called(branch.body))
    # cfrc_int is what holds the subtree together with its parent: the joint's force, and what
    # actuators do to the subtree, which MuJoCo counts as done through the joints. Tendons it
    # counts as forces on bodies, from 3.14 on.
    held = seen["cfrc_int"][:, body]
    force = held[:, 3:].copy()
    center = seen["subtree_com"][:, model.body_rootid[body]]
    moment = held[:, :3] + np.cross(center - at, force)
    for given, place, torque in _others(scene, tree.subtree(branch.body), model, seen):
        force -= given
        moment -= np.cross(place - at, given) + torque
    sign = 1.0 if branch.forward else -1.0
    force *= sign
    for exerted in damped(scene, joint):  # counted too, as what the joint does
        slip = seen["qvel"][:, model.joint(joint.name).dofadr[0]]
        force -= exerted(slip)[:, None] * line(model, seen, joint)
    return np.hstack([force, sign * moment])


def component(wrench: Array, field: str) -> Array:
    """(N,) a joint's reaction, by its name: in the plane its torque, and its force's size."""
    if field == "force":
        return np.hypot(*wrench[:, :2].T)
    return wrench[:, _COMPONENTS[field]]


_COMPONENTS = {"fx": 0, "fy": 1, "fz": 2, "mx": 3, "my": 4, "mz": 5, "torque": 5}


def damped(scene: Scene, joint: Joint) -> list[Callable[[Array], Array]]:
    """For each force that MuJoCo has as the joint's damping: what it exerts, by the slip."""
    return [
        partial(element.damping, force)
        for force in scene.forces.values()
        if (element := ELEMENTS[type(force)]).damping and joint.name in damps(scene, force)
        if element.lacks(scene, force) is None
    ]


def line(model: mujoco.MjModel, seen: Seen, joint: Joint) -> Array:
    """(N, 3) the line of a slide of the plane in ground axes, which turns with its first part."""
    ux, uy = joint.along
    if joint.a.body == GROUND:
        return np.array([[ux, uy, 0.0]])
    axes = seen["xmat"][:, model.body(called(joint.a.body)).id].reshape(-1, 3, 3)
    return axes[:, :, 0] * ux + axes[:, :, 1] * uy


def pinned(model: mujoco.MjModel, seen: Seen, name: str) -> Array:
    """(N, 3) an equality's force by the first part on the second: MuJoCo counts the other way."""
    return -seen["efc_force"][:, mujoco.mj_name2id(model, _OBJECT.mjOBJ_EQUALITY, name)]


def effort(
    scene: Scene, tree: Tree, model: mujoco.MjModel, seen: Seen, drive: Drive, wrench: Array
) -> Array:
    """(N,) what a drive exerts on the second part along its freedom [N, N m].

    wrench: of all that holds the second part, from which what else acts about the freedom is taken
    away.
    """
    joint, native = drive.joint, model.joint(drive.name)
    shifts = freedoms_left(scene, joint)[drive.number].kind == "shift"
    if shifts and scene.frame is PLANE:
        axis = line(model, seen, joint)
    else:
        forward = next(b.forward for b in tree.branches if b.joint is joint)
        axis = seen["xaxis"][:, native.id] * (1.0 if forward else -1.0)
    held = np.sum(axis * (wrench[:, :3] if shifts else wrench[:, 3:]), axis=1)
    for exerted in _beside(scene, model, seen, drive):
        held = held - exerted
    return held


def _beside(scene: Scene, model: mujoco.MjModel, seen: Seen, drive: Drive) -> Iterator[Array]:
    """The moments (N,) [N m] that springs, dampers and motors exert about a driven freedom."""
    native = model.joint(drive.name)
    for force in scene.forces.values():
        if force.about != drive.joint.name or number_of(scene, force) != drive.number:
            continue
        if law := TORQUES.get(type(force)):  # type: ignore[arg-type]
            angle, rate = seen["qpos"][:, native.qposadr[0]], seen["qvel"][:, native.dofadr[0]]
            yield law(force, angle, rate)  # type: ignore[arg-type]
        elif ELEMENTS[type(force)].signal:
            actuator = model.actuator(force.name)
            yield actuator.gear[0] * seen["actuator_force"][:, actuator.id]


def _others(
    scene: Scene, bodies: set[str], model: mujoco.MjModel, seen: Seen
) -> Iterator[tuple[Array, Array, Array]]:
    """Forces, where they act, and torques (N, 3) that actuators exert on the bodies."""
    for at, force, torque in outer(scene, model, seen["actuator_force"]):
        if at.body in bodies:
            yield force, _site(model, seen, at), torque


def _site(model: mujoco.MjModel, seen: Seen, anchor: Anchor | str) -> Array:
    return seen["site_xpos"][:, mujoco.mj_name2id(model, _OBJECT.mjOBJ_SITE, str(anchor))]


def felt_force(
    scene: Scene, model: mujoco.MjModel, name: str, felt: Array, pushed: Array | None = None
) -> Array:
    """(N,) of a contact, see `contact_force`, or of a limit, from the sensors' rows."""
    part = name.rpartition(".")[0]
    if part in scene.contacts or part in scene.pairs:
        return contact_force(scene, model, name, felt, pushed)
    return limit_force(scene, model, name, felt)


def contact_force(
    scene: Scene, model: mujoco.MjModel, name: str, felt: Array, pushed: Array | None = None
) -> Array:
    """`touch.normal`, `touch.tangent` or in space `touch.fx` (N,); what is in the air has 0.

    Of several points that touch, the sum.

    felt: the sensors' rows. pushed: the rows of what our law pushes with in MuJoCo's place.
    """
    part, _, field = name.rpartition(".")
    if part in scene.pairs:
        return pair_force(scene, name, felt)
    contact, names = scene.contacts[part], list(touching(scene))
    firsts = [3 * names.index(point.name) for point in contact.each()]
    force = np.sum([felt[:, first : first + 3] for first in firsts], axis=0)
    if scene.frame is SPACE:
        return force[:, ("fx", "fy", "normal").index(field)]
    force = force[:, :2]
    if field == "normal":
        return force @ contact.plane.normal
    x = mujoco.mj_name2id(model, _OBJECT.mjOBJ_JOINT, f"{contact.body}.x")
    if pushed is None or x < 0:
        return force @ contact.plane.along
    return force @ contact.plane.along + pushed[:, model.jnt_dofadr[x]]
