"""The book's smooth friction (2.95) of a joint, at every RK4 stage in MuJoCo's callback."""

from collections.abc import Callable

import mujoco
import numpy as np

from ....cases.scene import DryFriction, Scene
from ....cases.trajectory import Array
from ...law import smooth_under
from ..model.tree import dry_joints
from .friction import closed, uncoupled
from .signal import Control, bound

Acting = Callable[[], float]
"""All generalized force along the slide [N] but its friction, before MuJoCo has added it up."""


def smooth(scene: Scene, model: mujoco.MjModel) -> list[Control]:
    """A callback for each joint with smooth friction, in place of MuJoCo's own."""
    return [
        _friction(model, joint.name, joint.dry_friction)
        for joint in dry_joints(scene)
        if joint.dry_friction and joint.dry_friction.smooth
    ]


def _friction(model: mujoco.MjModel, name: str, friction: DryFriction) -> Control:
    dof = int(model.joint(name).dofadr[0])
    model.dof_frictionloss[dof] = 0.0
    band = friction.smooth
    assert band is not None
    acts = _among_loops if model.neq else alone if uncoupled(model, dof) else _among

    def bind(data: mujoco.MjData) -> Callable[[], None]:
        acting, rates, forces = acts(model, data, dof), data.qvel, data.qfrc_applied

        def control() -> None:
            along = smooth_under(friction, band, acting())
            forces[dof] = along(rates.item(dof))

        return control

    return bound(bind)


def alone(model: mujoco.MjModel, data: mujoco.MjData, dof: int) -> Acting:
    """A callback runs at every stage: no array is made here, and no number taken twice."""
    actuators = [
        (actuator, int(model.actuator_actadr[actuator])) for actuator in range(int(model.nu))
    ]
    passive, bias, activations, controls = data.qfrc_passive, data.qfrc_bias, data.act, data.ctrl
    counts, starts = data.moment_rownnz, data.moment_rowadr
    columns, moments = data.moment_colind, data.actuator_moment

    def acting() -> float:
        force = passive.item(dof) - bias.item(dof)
        for actuator, state in actuators:
            first = starts.item(actuator)
            for k in range(first, first + counts.item(actuator)):
                if columns.item(k) == dof:
                    size = activations.item(state) if state >= 0 else controls.item(actuator)
                    force += size * moments.item(k)
        return force

    return acting


def _among(model: mujoco.MjModel, data: mujoco.MjData, dof: int) -> Acting:
    """Through the mass matrix: what acts on others moves the slide too."""
    unit, effort = np.zeros((1, model.nv)), np.zeros((1, model.nv))
    unit[0, dof] = 1.0

    def acting() -> float:
        mujoco.mj_solveM(model, data, effort, unit)
        share = effort[0] / effort[0, dof]  # of each generalized force, along the slide
        return float(share @ (data.qfrc_passive - data.qfrc_bias + actuated(model, data)))

    return acting


def _among_loops(model: mujoco.MjModel, data: mujoco.MjData, dof: int) -> Acting:
    """The force along the slide [N] but its friction, also through what holds the loops closed."""
    free = np.zeros((1, model.nv))

    def acting() -> float:
        forces = data.qfrc_passive - data.qfrc_bias + actuated(model, data)
        mujoco.mj_solveM(model, data, free, forces[None])
        gains, mass = closed(model, data, dof, free[0])
        return mass * gains

    return acting


def actuated(model: mujoco.MjModel, data: mujoco.MjData) -> Array:
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
