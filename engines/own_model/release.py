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


def _each(m: mujoco.MjModel) -> Array:
    return np.arange(m.nu)


def _all(rows: str, value: int, *wide: int) -> Callable[[mujoco.MjModel], Array]:
    return lambda m: np.full((getattr(m, rows), *wide), value)


ABSENT: Mapping[str, Callable[[mujoco.MjModel], Array]] = {
    "actuator_ctrladr": _each,  # 3.12
    "actuator_ctrlnum": _all("nu", 1),
    "actuator_outadr": _each,
    "actuator_delay": _all("nu", 0),  # 3.5
    "actuator_history": _all("nu", 0, 1),
    "sensor_delay": _all("nsensor", 0),
    "sensor_history": _all("nsensor", 0, 1),
    "actuator_armature": _all("nu", 0),  # 3.7
    "actuator_damping": _all("nu", 0),
    "actuator_dampingpoly": _all("nu", 0, 1),
    "dof_dampingpoly": _all("nv", 0, 1),
    "jnt_stiffnesspoly": _all("njnt", 0, 1),
    "tendon_dampingpoly": _all("ntendon", 0, 1),
    "tendon_stiffnesspoly": _all("ntendon", 0, 1),
    "jnt_plasticadr": _all("njnt", -1),  # 4.0
    "tendon_plasticadr": _all("ntendon", -1),
    "flex_plasticadr": _all("nflex", -1),
}
"""What a release before the one that brought a column means by having none."""
