"""MuJoCo's arrays at recorded states, read when the run is over and its `MjData` is free."""

from collections.abc import Mapping

import mujoco
import numpy as np

from .....cases.scene import Scene
from .....cases.scene.frame import SPACE
from .....cases.scene.rotation import UPRIGHT, inverse, turned
from .....cases.trajectory import Array
from ....engine import Start
from ...model.tree import called
from ..record import Record

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


def recorded_arrays(
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


# States of all bodies from MuJoCo's kinematics, for a whole record at once.


def states(scene: Scene, model: mujoco.MjModel, seen: Seen, start: Start) -> dict[str, Array]:
    """(N, 13) of each body: r, quaternion and v of its centre of mass, ω in its own axes."""
    found = {}
    for name, body in scene.bodies.items():
        number = model.body(called(name)).id
        place, spin = seen["xpos"][:, number], seen["cvel"][:, number]
        # MuJoCo's velocities are those at the centre of mass of the whole tree.
        center = seen["subtree_com"][:, model.body_rootid[number]]
        rows = np.zeros((len(place), SPACE.width))
        rows[:, SPACE.place] = place
        rows[:, SPACE.velocity] = spin[:, 3:] + np.cross(spin[:, :3], place - center)
        if body.turns:
            attitude = seen["xquat"][:, number]
            rows[:, SPACE.attitude] = _continuous(attitude, np.array(start[name][SPACE.attitude]))
            rows[:, SPACE.spin] = turned(inverse(attitude), spin[:, :3])
        else:
            rows[:, SPACE.attitude] = UPRIGHT
        found[name] = rows
    return found


def _continuous(attitude: Array, first: Array) -> Array:
    """(N, 4) each with the sign that is nearer to the one before it."""
    before = np.vstack([first, attitude[:-1]])
    turns = np.where(np.sum(before * attitude, axis=1) < 0, -1.0, 1.0)
    return attitude * np.cumprod(turns)[:, None]
