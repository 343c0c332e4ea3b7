"""Accelerations of bodies, as MuJoCo knows them after `mj_rnePostConstraint`."""

import mujoco
import numpy as np

from ....cases.trajectory import Array
from ..tree import called
from .reaction import Seen

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
    found = change[:, 3:] + np.cross(change[:, :3], arm) + np.cross(rate[:, :3], velocity)
    return (found + model.opt.gravity)[:, FIELDS.index(field)]
