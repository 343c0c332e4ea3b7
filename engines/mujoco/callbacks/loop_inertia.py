"""One freedom in a loop: constraints pass on to it what acts elsewhere, and more moves with it."""

import mujoco
import numpy as np

from ....cases.trajectory import Array

_LEAST = 1e-15  # 1/kg: in a dead centre nothing moves the freedom


def closed(
    model: mujoco.MjModel, data: mujoco.MjData, dof: int, free: Array
) -> tuple[float, float]:
    """Acceleration of a freedom [m/s²] while all loops stay closed, and the mass [kg] it moves.

    M a = M a₀ + Jᵀ f with J a + R f = a_ref of MuJoCo's equalities, and nothing else that gives
    way. free: a₀ (nv,). Of the state that MuJoCo was last asked for.
    """
    rows = data.efc_J.reshape(-1, model.nv)[: data.ne]
    unit = np.zeros((1, model.nv))
    unit[0, dof] = 1.0
    effort, passed = np.empty_like(unit), np.empty_like(rows)
    mujoco.mj_solveM(model, data, effort, unit)
    mujoco.mj_solveM(model, data, passed, np.ascontiguousarray(rows))
    lever, given = passed[:, dof], data.efc_aref[: data.ne] - rows @ free
    both = np.column_stack([given, lever])
    forces = np.linalg.solve(rows @ passed.T + np.diag(data.efc_R[: data.ne]), both)
    pulled, held = (lever @ forces).tolist()
    return float(free[dof]) + pulled, 1.0 / max(effort.item(0, dof) - held, _LEAST)
