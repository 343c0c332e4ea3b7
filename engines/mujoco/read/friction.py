"""Friction forces along slides, read from MuJoCo's constraint forces."""

import mujoco
import numpy as np

from ....cases.scene import Scene

_FRICTION = int(mujoco.mjtConstraint.mjCNSTR_FRICTION_DOF)


class SlideFriction:
    """The friction force [N] on the second part along each slide: (N,) by the joint's name."""

    def __init__(self, scene: Scene, model: mujoco.MjModel, samples: int) -> None:
        dry = [joint.name for joint in scene.joints.values() if joint.dry_friction is not None]
        self.forces = {name: np.zeros(samples) for name in dry}
        self._of_dof = {int(model.joint(name).dofadr[0]): self.forces[name] for name in dry}

    def keep(self, sample: int, data: mujoco.MjData) -> None:
        """MuJoCo's own friction, and what our law or driver pushes in its place."""
        for dof, kept in self._of_dof.items():
            rows = (data.efc_type == _FRICTION) & (data.efc_id == dof)
            kept[sample] = data.qfrc_applied[dof] + data.efc_force[rows].sum()
