"""What MuJoCo knows of recorded states, read when the run is over and its `MjData` is free.

MuJoCo's arrays are copied row by row and turned into forces for all rows at once: reading costs a
few percent of the stepping.
"""

from collections.abc import Callable, Mapping

import mujoco
import numpy as np

from ....cases.scene import Scene
from ....cases.trajectory import Array
from ..tree import spanning_tree
from .friction import SlideFriction
from .reaction import contact_force, joint_force
from .record import Record

_TOUCHING = ("sensordata", "qfrc_applied")
_FORCES = ("cfrc_int", "subtree_com", "site_xpos", "actuator_force", "efc_force", *_TOUCHING)


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
    joints = any(name.partition(".")[0] in scene.joints for name in reactions)
    wanted = _FORCES if joints else _TOUCHING
    seen = _seen(model, data, times, record, wanted, dry, recall)
    tree = spanning_tree(scene)
    found: dict[str, Array] = {}
    for name in reactions:
        part, _, field = name.partition(".")
        if field == "friction":
            found[name] = dry.forces[part]
        elif part in scene.joints:
            forces = joint_force(scene, tree, model, seen, scene.joints[part])
            found[name] = forces[("fx", "fy", "torque", "force").index(field)]
        else:
            found[name] = contact_force(
                scene, model, name, seen["sensordata"], seen["qfrc_applied"]
            )
    return found


def _seen(
    model: mujoco.MjModel,
    probe: mujoco.MjData,
    times: Array,
    record: Record,
    wanted: tuple[str, ...],
    dry: SlideFriction,
    recall: Callable[[int], None],
) -> Mapping[str, Array]:
    """MuJoCo's own arrays at every row, (N, …) each."""
    mujoco.mj_resetDataKeyframe(model, probe, 0)  # the run's last solution must not start the first
    sources: dict[str, Array] = {}
    seen: dict[str, Array] = {}
    qpos, qvel, act = probe.qpos, probe.qvel, probe.act
    for i, t in enumerate(times.tolist()):
        probe.time = t
        qpos[:], qvel[:], act[:] = record.qpos[i], record.qvel[i], record.act[i]
        recall(i)
        mujoco.mj_forward(model, probe)
        if "cfrc_int" in wanted:
            mujoco.mj_rnePostConstraint(model, probe)
        if not seen:
            sources = {name: getattr(probe, name) for name in wanted if name != "efc_force"}
            seen = {name: np.empty((len(times), *part.shape)) for name, part in sources.items()}
            # Equalities come first among the constraints, always the same ones.
            seen["efc_force"] = np.empty((len(times), probe.ne))
        for name, part in sources.items():
            seen[name][i] = part
        if probe.ne:
            seen["efc_force"][i] = probe.efc_force[: probe.ne]
        dry.keep(i, probe)
    return seen
