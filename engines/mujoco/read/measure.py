"""Physics read back from MuJoCo's compiled model, for the equal-physics audit."""

import mujoco

from ....cases.scene import Scene
from ....cases.scene.frame import PLANE
from ....cases.scene.rotation import matrix
from ....cases.trajectory import Array
from ..model.force import numbers
from ..model.planes import met
from ..model.tree import called, driven

_ENTRIES = {"11": (0, 0), "22": (1, 1), "33": (2, 2), "12": (0, 1), "13": (0, 2), "23": (1, 2)}


def measured(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> dict[str, float]:
    """The physics that MuJoCo holds, see `Engine.measure`."""
    axes = scene.frame.axes
    physics = {f"gravity.{axis}": model.opt.gravity[i] for i, axis in enumerate(axes)}
    for body in scene.bodies.values():
        number = model.body(called(body.name)).id
        physics[f"{body.name}.mass"] = model.body_mass[number]
        if body.turns and scene.frame is PLANE:
            physics[f"{body.name}.inertia"] = model.body_inertia[number, 2]
        elif body.turns:
            held = tensor(model, number)
            physics |= {f"{body.name}.inertia_{ik}": held[at] for ik, at in _ENTRIES.items()}
    for contact in met(scene):
        physics[f"{contact.name}.friction"] = model.pair(contact.name).friction[0]
    for joint in scene.joints.values():
        dry = joint.dry_friction
        if dry is not None and dry.kinetic.forward == dry.kinetic.backward:  # else a mean: neither
            loss = model.dof_frictionloss[model.joint(joint.name).dofadr[0]]
            physics[f"{joint.name}.friction_forward"] = loss
            physics[f"{joint.name}.friction_backward"] = loss
    physics |= numbers(scene, model)
    if not (any(driven(scene)) or scene.drives):  # their mass drowns the rest
        mujoco.mj_forward(model, data)
        mujoco.mj_energyVel(model, data)
        mujoco.mj_subtreeVel(model, data)
        momentum = data.subtree_linvel[0] * model.body_subtreemass[0]
        physics["energy.kinetic"] = data.energy[1]
        physics |= {f"momentum.{axis}": momentum[i] for i, axis in enumerate(axes)}
    return {name: float(value) for name, value in physics.items()}


def tensor(model: mujoco.MjModel, number: int) -> Array:
    """(3, 3) in a body's axes: MuJoCo keeps principal moments and the attitude of their axes."""
    axes = matrix(model.body_iquat[number])
    return (axes * model.body_inertia[number]) @ axes.T
