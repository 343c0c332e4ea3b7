"""The book's smooth friction (2.95) on a slide, at every RK4 stage in MuJoCo's callback."""

import mujoco
import numpy as np

from ....cases.scene import DryFriction, Scene
from ....cases.trajectory import Array
from ...law import smooth_friction
from .signal import Control


def smooth(scene: Scene, model: mujoco.MjModel) -> list[Control]:
    """A callback for each slide with smooth friction, in place of MuJoCo's own."""
    return [
        _friction(model, joint.name, joint.dry_friction)
        for joint in scene.joints.values()
        if joint.dry_friction is not None and joint.dry_friction.smooth is not None
    ]


def _friction(model: mujoco.MjModel, name: str, friction: DryFriction) -> Control:
    dof = int(model.joint(name).dofadr[0])
    model.dof_frictionloss[dof] = 0.0
    unit, effort = np.zeros((1, model.nv)), np.zeros((1, model.nv))
    unit[0, dof] = 1.0
    band = friction.smooth
    assert band is not None

    def control(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        mujoco.mj_solveM(model, data, effort, unit)
        share = effort[0] / effort[0, dof]  # of each generalized force, along the slide
        acting = data.qfrc_passive - data.qfrc_bias + _actuated(model, data)
        data.qfrc_applied[dof] = smooth_friction(
            friction, float(data.qvel[dof]), float(share @ acting), smooth=band
        )

    return control


def _actuated(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
    """Generalized forces of pushes and torques, which MuJoCo works out after the callback."""
    if not model.nu:
        return np.zeros(model.nv)
    force = data.ctrl.copy()
    ramps = model.actuator_actadr >= 0
    force[ramps] = data.act[model.actuator_actadr[ramps]]
    moment = np.zeros((model.nu, model.nv))
    mujoco.mju_sparse2dense(
        moment,
        data.actuator_moment,
        data.moment_rownnz,
        data.moment_rowadr,
        data.moment_colind,
    )
    return force @ moment
