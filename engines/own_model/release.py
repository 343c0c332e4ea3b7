"""The columns of a compiled model that older MuJoCo releases lack, as these mean them.

`textmech versions` runs a model with many releases. From 3.12 on an actuator may have several
controls or outputs, or none; before that each has one of each, and the matrix is read otherwise.
"""

from collections.abc import Callable, Mapping

import mujoco
import numpy as np

from ...cases.trajectory import Array


def column(m: mujoco.MjModel, name: str) -> Array:
    """Returns the model's numbers of that name; of a release that lacks them what holds there."""
    present = getattr(m, name, None)
    return ABSENT[name](m) if present is None else np.asarray(present)


def actuators(m: mujoco.MjModel) -> int:
    """Returns how many actuators the model has."""
    return int(getattr(m, "nactuator", m.nu))


def mass_matrix(m: mujoco.MjModel, data: mujoco.MjData) -> Array:
    """(nv, nv): MuJoCo's mass matrix where the data stand."""
    M = np.zeros((m.nv, m.nv))
    if hasattr(data, "qM"):
        mujoco.mj_fullM(m, M, data.qM)
    else:
        mujoco.mj_fullM(m, data, M)
    return M


def enabled(m: mujoco.MjModel, flag: str) -> bool:
    """Whether a flag is set, by its enumerator's name; in a release without it none is."""
    bit = getattr(mujoco.mjtEnableBit, flag, None)
    return bit is not None and bool(m.opt.enableflags & bit)


def _indices(m: mujoco.MjModel) -> Array:
    return np.arange(m.nu)


def _filled(rows: str, value: int, *wide: int) -> Callable[[mujoco.MjModel], Array]:
    return lambda m: np.full((getattr(m, rows), *wide), value)


ABSENT: Mapping[str, Callable[[mujoco.MjModel], Array]] = {
    "actuator_ctrladr": _indices,  # 3.12
    "actuator_ctrlnum": _filled("nu", 1),
    "actuator_outadr": _indices,
    "actuator_delay": _filled("nu", 0),  # 3.5
    "actuator_history": _filled("nu", 0, 1),
    "sensor_delay": _filled("nsensor", 0),
    "sensor_history": _filled("nsensor", 0, 1),
    "actuator_armature": _filled("nu", 0),  # 3.7
    "actuator_damping": _filled("nu", 0),
    "actuator_dampingpoly": _filled("nu", 0, 1),
    "dof_dampingpoly": _filled("nv", 0, 1),
    "jnt_stiffnesspoly": _filled("njnt", 0, 1),
    "tendon_dampingpoly": _filled("ntendon", 0, 1),
    "tendon_stiffnesspoly": _filled("ntendon", 0, 1),
    "jnt_plasticadr": _filled("njnt", -1),  # 4.0
    "tendon_plasticadr": _filled("ntendon", -1),
    "flex_plasticadr": _filled("nflex", -1),
}
"""What a release before the one that brought a column means by having none."""
