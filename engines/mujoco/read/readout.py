"""MuJoCo's quantities at recorded states, read when the run is over and its `MjData` is free.

MuJoCo's arrays are copied row by row and turned into forces for all rows at once: reading costs a
few percent of the stepping.
"""

from collections.abc import Callable, Mapping
from functools import cache, lru_cache

import mujoco
import numpy as np

from ....cases.scene import Scene
from ....cases.trajectory import Array
from ...foot_contact import strode
from ..model.drive import drives
from ..model.edge import fields
from ..model.tree import Tree, called, dry_joints, spanning_tree
from .reaction import Seen, component, damped, effort, felt_force, joint_wrench, pinned
from .record import Counts, Record

# Dry friction of joints, read from MuJoCo's constraint forces.


_FRICTION = int(mujoco.mjtConstraint.mjCNSTR_FRICTION_DOF)


class SlideFriction:
    """The friction [N or N m] on the second part of each slide or pin: (N,) by its name."""

    def __init__(self, scene: Scene, model: mujoco.MjModel, samples: int) -> None:
        dry = dry_joints(scene)
        self.forces = {joint.name: np.zeros(samples) for joint in dry}
        self._of_dof = {
            int(model.joint(joint.name).dofadr[0]): self.forces[joint.name] for joint in dry
        }

    def keep(self, sample: int, data: mujoco.MjData) -> None:
        """MuJoCo's own friction, and what our law pushes in its place."""
        for dof, kept in self._of_dof.items():
            rows = (data.efc_type == _FRICTION) & (data.efc_id == dof)
            kept[sample] = data.qfrc_applied[dof] + data.efc_force[rows].sum()


_TOUCHING = ("sensordata", "qfrc_applied")
_DRIVING = ("qpos", "qvel", "xmat", "xaxis", "actuator_force")
_JOINTS = ("cfrc_int", "subtree_com", "site_xpos", "actuator_force")
_STATE = int(
    mujoco.mjtState.mjSTATE_TIME
    | mujoco.mjtState.mjSTATE_QPOS
    | mujoco.mjtState.mjSTATE_QVEL
    | mujoco.mjtState.mjSTATE_ACT
)


def read(
    scene: Scene,
    model: mujoco.MjModel,
    data: mujoco.MjData,  # any of the model: it is moved through the record
    times: Array,
    record: Record,
    reactions: tuple[str, ...],
    recall: Callable[[int], None],  # what the run did to the model at a row
) -> dict[str, Array]:
    """The wanted reactions (N,) from positions, velocities and activations."""
    if not reactions:
        return {}
    dry = SlideFriction(scene, model, len(times))
    tree = spanning_tree(scene)
    names = _needed(scene, tree, reactions)
    seen = _seen(model, data, times, record, names, dry, recall)
    wrench = cache(lambda part: joint_wrench(scene, tree, model, seen, scene.joints[part]))
    driving = {drive.effort: drive for drive in drives(scene)}
    forces: dict[str, Array] = {}
    for name in reactions:
        part, _, field = name.partition(".")
        if field == "friction":
            forces[name] = dry.forces[part]
        elif part in scene.constraints:
            forces[name] = seen["userdata"][:, fields(scene).index(name)]
        elif part in scene.bodies:
            forces[name] = acceleration(model, seen, part, field)
        elif name in driving:
            forces[name] = effort(scene, tree, model, seen, driving[name], wrench(part))
        elif part in scene.joints:
            forces[name] = component(wrench(part), field)
        elif part in strode(scene):
            forces[name] = pinned(model, seen, part)[:, ("tangent", "normal").index(field)]
        else:
            forces[name] = felt_force(scene, model, name, seen["sensordata"], seen["qfrc_applied"])
    return forces


def _needed(scene: Scene, tree: Tree, reactions: tuple[str, ...]) -> set[str]:
    """Which of MuJoCo's arrays: each costs a third of a microsecond a sample."""
    names: set[str] = set()
    for name in reactions:
        part, _, field = name.partition(".")
        if part in scene.constraints:
            names.add("userdata")
        elif part in scene.bodies:
            names |= {*NEEDED}
        elif part not in scene.joints:
            names |= {"efc_force"} if part in strode(scene) else {*_TOUCHING}
        elif field != "friction":
            names |= {*_DRIVING} if scene.drives else set()
            closes = scene.joints[part] in tree.loops
            names |= {"efc_force", "site_xpos"} if closes else {*_JOINTS}
            names |= {"qvel", "xmat"} if damped(scene, scene.joints[part]) else set()
    return names


def _seen(
    model: mujoco.MjModel,
    probe: mujoco.MjData,
    times: Array,
    record: Record,
    names: set[str],
    dry: SlideFriction,
    recall: Callable[[int], None],
) -> Mapping[str, Array]:
    """MuJoCo's own arrays at every row, (N, …) each."""
    mujoco.mj_resetDataKeyframe(model, probe, 0)  # the run's last solution must not start the first
    states = np.column_stack([times, record.qpos, record.qvel, record.act])
    holds, after = "efc_force" in names, not names.isdisjoint({"cfrc_int", "cacc"})
    views = {name: getattr(probe, name) for name in names if name != "efc_force"}
    seen = {name: np.empty((len(times), *part.shape)) for name, part in views.items()}
    pairs = [(seen[name], part) for name, part in views.items()]
    held = []
    for i, state in enumerate(states):
        mujoco.mj_setState(model, probe, state, _STATE)
        recall(i)
        mujoco.mj_forward(model, probe)
        if after:
            mujoco.mj_rnePostConstraint(model, probe)
        for kept, part in pairs:
            kept[i] = part
        if holds:
            held.append(_equalities(model, probe))
        dry.keep(i, probe)
    if holds:
        seen["efc_force"] = np.array(held)
    return seen


def _equalities(model: mujoco.MjModel, probe: mujoco.MjData) -> Array:
    """(neq, 3) what each equality exerts, 0 if it is not active; they come first of all rows.

    A `connect` has three rows, a tendon one.
    """
    forces, active = np.zeros((model.neq, 3)), probe.ne
    ids = tuple(probe.efc_id[:active].tolist())
    forces[_rows(ids)] = probe.efc_force[:active]
    return forces


@lru_cache(maxsize=16)  # equalities are seldom switched: a run has a few such lists
def _rows(ids: tuple[int, ...]) -> tuple[Counts, Counts]:
    """Where in `_equalities` each row of those equalities belongs."""
    begins = np.flatnonzero(np.diff(ids, prepend=-1))
    rows = np.arange(len(ids)) - np.repeat(begins, np.diff(begins, append=len(ids)))
    return np.array(ids, dtype=np.int64), rows


# Accelerations of bodies, as MuJoCo knows them after `mj_rnePostConstraint`.


NEEDED = ("cacc", "cvel", "subtree_com", "xipos")
FIELDS = ("ax", "ay", "alpha")


def acceleration(model: mujoco.MjModel, seen: Seen, body: str, field: str) -> Array:
    """`ax`, `ay` [m/s²] of the centre of mass, or `alpha` [rad/s²], (N,).

    MuJoCo's spatial vectors are about the centre of mass of the whole tree, and its world falls
    upward instead of weights pulling down.
    """
    i = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, called(body))
    change, rate = seen["cacc"][:, i], seen["cvel"][:, i]
    if field == "alpha":
        return change[:, 2].copy()
    arm = seen["xipos"][:, i] - seen["subtree_com"][:, model.body_rootid[i]]
    velocity = rate[:, 3:] + np.cross(rate[:, :3], arm)
    growth = change[:, 3:] + np.cross(change[:, :3], arm) + np.cross(rate[:, :3], velocity)
    return (growth + model.opt.gravity)[:, FIELDS.index(field)]
