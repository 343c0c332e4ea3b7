"""What MuJoCo knows of recorded states, read when the run is over and its `MjData` is free.

MuJoCo's arrays are copied sample by sample and turned into quantities for all samples at once:
reading costs a few percent of the stepping.
"""

import math
from collections.abc import Callable, Mapping, Sequence

import mujoco
import numpy as np

from ....cases.scene import Scene
from ....cases.trajectory import ANGLE, Array, Trajectory
from ...engine import Start
from ..tree import Tree, built_as, coordinate, spanning_tree
from .friction import SlideFriction
from .reaction import Contacts, joint_force

_PLACES = ("xipos", "cvel", "subtree_com")
_FORCES = ("cfrc_int", "site_xpos", "actuator_force", "efc_force")


def read(
    scene: Scene,
    model: mujoco.MjModel,
    data: mujoco.MjData,  # any of the model: it is moved through the record
    start: Start,
    times: Array,
    record: list[Array],
    reactions: tuple[str, ...],
    recall: Callable[[int], None],  # what the run did to the model at a sample
) -> Trajectory:
    """States of all bodies, and the wanted reactions, from positions, velocities and controls."""
    tree = spanning_tree(scene)
    contacts = Contacts(scene, model, len(times)) if scene.contacts and reactions else None
    joints = [name for name in reactions if name.partition(".")[0] in scene.joints]
    wanted = (*_PLACES, *(_FORCES if joints else ()))
    dry = SlideFriction(scene, model, len(times))
    keepers = [dry] if contacts is None else [contacts, dry]
    seen = _seen(model, data, times, record, wanted, keepers, recall, forces=bool(reactions))
    found: dict[str, Array] = {}
    for name in reactions:
        part, _, field = name.partition(".")
        if field == "friction":
            found[name] = dry.forces[part]
        elif part in scene.joints:
            forces = joint_force(scene, tree, model, seen, scene.joints[part])
            found[name] = forces[("fx", "fy", "torque", "force").index(field)]
        else:
            assert contacts is not None
            found[name] = contacts.forces[part][:, 1 if field == "normal" else 0]
    states = {name: _states(scene, tree, model, name, record[0], seen) for name in scene.bodies}
    for name, rows in states.items():  # a slide or weld holds 370 deg as well as 10 deg
        turns = np.round((start[name][ANGLE] - rows[0, ANGLE]) / math.tau)
        rows[:, ANGLE] += turns * math.tau
    return Trajectory(times, states, found)


def _seen(
    model: mujoco.MjModel,
    probe: mujoco.MjData,
    times: Array,
    record: list[Array],
    wanted: tuple[str, ...],
    keepers: Sequence[Contacts | SlideFriction],
    recall: Callable[[int], None],
    *,
    forces: bool,
) -> Mapping[str, Array]:
    """MuJoCo's own arrays at every sample, (N, …) each."""
    mujoco.mj_resetData(model, probe)  # a run's last solution must not start the first sample's
    targets = (probe.qpos, probe.qvel, probe.act, probe.ctrl)
    sources: dict[str, Array] = {}
    seen: dict[str, Array] = {}
    for i, t in enumerate(times.tolist()):
        probe.time = t
        for target, kept in zip(targets, record, strict=True):
            target[:] = kept[i]
        if forces:
            recall(i)
            mujoco.mj_forward(model, probe)
            mujoco.mj_rnePostConstraint(model, probe)
        else:
            mujoco.mj_kinematics(model, probe)
            mujoco.mj_comPos(model, probe)
            mujoco.mj_comVel(model, probe)
        if not seen:
            sources = {name: getattr(probe, name) for name in wanted if name != "efc_force"}
            seen = {name: np.empty((len(times), *part.shape)) for name, part in sources.items()}
            if "efc_force" in wanted:  # equalities come first, always the same ones
                seen["efc_force"] = np.empty((len(times), probe.ne))
        for name, part in sources.items():
            seen[name][i] = part
        if "efc_force" in seen and probe.ne:
            seen["efc_force"][i] = probe.efc_force[: probe.ne]
        for keeper in keepers if forces else ():
            keeper.keep(i, probe)
    return seen


def _states(
    scene: Scene,
    tree: Tree,
    model: mujoco.MjModel,
    body: str,
    qpos: Array,
    seen: Mapping[str, Array],
) -> Array:
    """(N, 6): x, y, angle, vx, vy, omega of the centre of mass."""
    number = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, body)
    place, velocity = seen["xipos"][:, number, :2], seen["cvel"][:, number]
    # MuJoCo counts velocities about the centre of mass of the whole tree.
    arm = place - seen["subtree_com"][:, model.body_rootid[number], :2]
    omega = velocity[:, 2]
    vx, vy = velocity[:, 3] - omega * arm[:, 1], velocity[:, 4] + omega * arm[:, 0]
    turns = scene.bodies[body].turns
    angle = _angle(scene, tree, model, body, qpos) if turns else np.zeros(len(qpos))
    return np.column_stack([place, angle, vx, vy, omega if turns else np.zeros(len(qpos))])


def _angle(scene: Scene, tree: Tree, model: mujoco.MjModel, body: str, qpos: Array) -> Array:
    """The angle, unwound: the sum of the hinges below the body, and what slides hold."""
    branches = {branch.body: branch for branch in tree.branches}
    total, name = np.zeros(len(qpos)), body
    while name in branches:
        branch = branches[name]
        joint = branch.joint
        if not scene.bodies[name].turns:
            pass  # a particle turns with what carries it
        elif joint is None or built_as(scene, joint).turns:
            hinge = f"{name}.angle" if joint is None else coordinate(joint, "turn")
            total += qpos[:, model.joint(hinge).qposadr[0]]
        else:
            total += joint.angle if branch.forward else -joint.angle
        name = branch.parent
    return total
