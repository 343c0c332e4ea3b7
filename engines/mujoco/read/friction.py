"""Dry friction of joints, read from MuJoCo's constraint forces."""

import mujoco
import numpy as np

from ....cases.scene import Scene
from ..hinge import way

_FRICTION = int(mujoco.mjtConstraint.mjCNSTR_FRICTION_DOF)


class SlideFriction:
    """The friction [N or N m] on the second part of each slide or pin: (N,) by its name."""

    def __init__(self, scene: Scene, model: mujoco.MjModel, samples: int) -> None:
        dry = [joint for joint in scene.joints.values() if joint.dry_friction is not None]
        self.forces = {joint.name: np.zeros(samples) for joint in dry}
        self._of_dof = {
            int(model.joint(joint.name).dofadr[0]): (way(scene, joint), self.forces[joint.name])
            for joint in dry
        }

    def keep(self, sample: int, data: mujoco.MjData) -> None:
        """MuJoCo's own friction, and what our law or driver pushes in its place."""
        for dof, (sign, kept) in self._of_dof.items():
            rows = (data.efc_type == _FRICTION) & (data.efc_id == dof)
            kept[sample] = sign * (data.qfrc_applied[dof] + data.efc_force[rows].sum())
