"""Forces of joints and contacts from MuJoCo's arrays, for all samples at once."""

from collections.abc import Callable, Iterator, Mapping
from functools import partial

import mujoco
import numpy as np

from ....cases.scene import GROUND, Anchor, Joint, Scene
from ....cases.trajectory import Array
from ..model.force import ELEMENTS, outer
from ..model.loops import pulled
from ..model.pairs import pair_force
from ..model.planes import touching
from ..model.rope import tension
from ..model.stops import pushing
from ..model.tree import Tree, called

Seen = Mapping[str, Array]
_OBJECT = mujoco.mjtObj


def joint_force(
    scene: Scene, tree: Tree, model: mujoco.MjModel, seen: Seen, joint: Joint
) -> tuple[Array, Array, Array, Array]:
    """fx, fy and torque (about the second point) of the first part on the second; the size."""
    if joint in tree.loops and joint.swings:
        a, b = (_site(model, seen, end) for end in joint.refers())
        number = mujoco.mj_name2id(model, _OBJECT.mjOBJ_EQUALITY, joint.name)
        fx, fy = pulled(seen["efc_force"][:, number, :1], a, b).T
        return fx, fy, np.zeros_like(fx), np.hypot(fx, fy)
    if joint in tree.loops:
        fx, fy = pinned(model, seen, joint.name)
        return fx, fy, np.zeros_like(fx), np.hypot(fx, fy)
    branch = next(b for b in tree.branches if b.joint is joint)
    body = mujoco.mj_name2id(model, _OBJECT.mjOBJ_BODY, called(branch.body))
    at = _site(model, seen, joint.b)
    # cfrc_int is what holds the subtree together with its parent: the joint's force, and what
    # actuators do to the subtree, which MuJoCo counts as done through the joints. Tendons it
    # counts as forces on bodies, from 3.14 on.
    held = seen["cfrc_int"][:, body]
    force = held[:, 3:5].copy()
    center = seen["subtree_com"][:, model.body_rootid[body], :2]
    moment = held[:, 2] + _cross(center - at, force)
    for given, place, torque in _others(scene, tree.subtree(branch.body), model, seen):
        force -= given
        moment -= _cross(place - at, given) + torque
    sign = 1.0 if branch.forward else -1.0
    force *= sign
    for exerted in damped(scene, joint):  # counted too, as what the joint does
        slip = seen["qvel"][:, model.joint(joint.name).dofadr[0]]
        force -= exerted(slip)[:, None] * line(model, seen, joint)
    return force[:, 0], force[:, 1], sign * moment, np.hypot(*force.T)


def damped(scene: Scene, joint: Joint) -> list[Callable[[Array], Array]]:
    """For each force that MuJoCo has as the joint's damping: what it exerts, by the slip."""
    return [
        partial(element.damping, force)
        for force in scene.forces.values()
        if (element := ELEMENTS[type(force)]).damping and force.about == joint.name
        if element.lacks(force) is None
    ]


def line(model: mujoco.MjModel, seen: Seen, joint: Joint) -> Array:
    """(N, 2) the line of a slide in ground axes, which turns with its first part."""
    ux, uy = joint.along
    if joint.a.body == GROUND:
        return np.array([[ux, uy]])
    axes = seen["xmat"][:, model.body(called(joint.a.body)).id].reshape(-1, 3, 3)
    return axes[:, :2, 0] * ux + axes[:, :2, 1] * uy


def pinned(model: mujoco.MjModel, seen: Seen, name: str) -> Array:
    """fx and fy (2, N) of an equality's first part on the second: MuJoCo counts the other way."""
    return -seen["efc_force"][:, mujoco.mj_name2id(model, _OBJECT.mjOBJ_EQUALITY, name), :2].T


def _others(
    scene: Scene, bodies: set[str], model: mujoco.MjModel, seen: Seen
) -> Iterator[tuple[Array, Array, Array]]:
    """Forces (N, 2), where they act, and torques (N,) that actuators exert on the bodies."""
    for at, force, torque in outer(scene, model, seen["actuator_force"]):
        if at.body in bodies:
            yield force, _site(model, seen, at), torque


def _site(model: mujoco.MjModel, seen: Seen, anchor: Anchor) -> Array:
    return seen["site_xpos"][:, mujoco.mj_name2id(model, _OBJECT.mjOBJ_SITE, str(anchor)), :2]


def _cross(a: Array, b: Array) -> Array:
    return a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]


def felt_force(
    scene: Scene, model: mujoco.MjModel, name: str, felt: Array, pushed: Array | None = None
) -> Array:
    """(N,) of a contact, see `contact_force`, of a rope or a stop, from the sensors' rows."""
    part = name.rpartition(".")[0]
    if part in scene.contacts or part in scene.pairs:
        return contact_force(scene, model, name, felt, pushed)
    if any(rope.name == part for rope in scene.ropes()):
        return tension(model, part, felt)
    return pushing(scene, model, name, felt)


def contact_force(
    scene: Scene, model: mujoco.MjModel, name: str, felt: Array, pushed: Array | None = None
) -> Array:
    """`touch.normal` or `touch.tangent` (N,) from the sensors' rows; what is in the air has 0.

    Of several points that touch, the sum.

    pushed: the rows of what our law pushes with in MuJoCo's place.
    """
    part, _, field = name.rpartition(".")
    if part in scene.pairs:
        return pair_force(scene, name, felt)
    contact, names = scene.contacts[part], list(touching(scene))
    firsts = [3 * names.index(point.name) for point in contact.each()]
    force = np.sum([felt[:, first : first + 2] for first in firsts], axis=0)
    if field == "normal":
        return force @ contact.plane.normal
    x = mujoco.mj_name2id(model, _OBJECT.mjOBJ_JOINT, f"{contact.body}.x")
    if pushed is None or x < 0:
        return force @ contact.plane.along
    return force @ contact.plane.along + pushed[:, model.jnt_dofadr[x]]
