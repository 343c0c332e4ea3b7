"""What MuJoCo knows of recorded states, read when the run is over and its `MjData` is free."""

from collections.abc import Mapping

import mujoco
import numpy as np

from .....cases.trajectory import Array
from ...read.record import Record

Seen = Mapping[str, Array]

PLACES = ("xpos", "xquat", "cvel", "subtree_com")
JOINTS = ("cfrc_int", "site_xpos", "xaxis", "actuator_force")
TOUCHING = ("sensordata",)
EDGES = ("userdata",)
LOOPS = ("efc_force", "site_xpos")
_STATE = int(
    mujoco.mjtState.mjSTATE_TIME
    | mujoco.mjtState.mjSTATE_QPOS
    | mujoco.mjtState.mjSTATE_QVEL
    | mujoco.mjtState.mjSTATE_ACT
)


def seen(
    model: mujoco.MjModel,
    probe: mujoco.MjData,  # any of the model: it is moved through the record
    times: Array,
    record: Record,
    names: set[str],
) -> Seen:
    """MuJoCo's own arrays at every row, (N, …) each: those of places, and those that are named."""
    mujoco.mj_resetDataKeyframe(model, probe, 0)  # the run's last solution must not start the first
    rows = np.column_stack([times, record.qpos, record.qvel, record.act])
    plain = {*PLACES, *names} - {"efc_force"}
    views = {name: getattr(probe, name) for name in plain}
    found = {name: np.empty((len(rows), *part.shape)) for name, part in views.items()}
    pairs = [(found[name], part) for name, part in views.items()]
    held: list[Array] = []
    for i, row in enumerate(rows):
        mujoco.mj_setState(model, probe, row, _STATE)
        if names:
            mujoco.mj_forward(model, probe)
            if "cfrc_int" in names:
                mujoco.mj_rnePostConstraint(model, probe)
        else:
            mujoco.mj_kinematics(model, probe)
            mujoco.mj_comPos(model, probe)
            mujoco.mj_comVel(model, probe)
        for kept, part in pairs:
            kept[i] = part
        if "efc_force" in names:
            # Equalities come first among the constraints, always the same ones.
            held.append(probe.efc_force[: probe.ne].copy())
    if "efc_force" in names:
        found["efc_force"] = np.array(held)
    return found
