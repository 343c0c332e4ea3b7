"""Physics read back from MuJoCo's compiled model, for the equal-physics audit."""

import mujoco

from ....cases.scene import Scene
from ..model.force import numbers
from ..model.planes import touching
from ..model.tree import called, driven


def measured(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> dict[str, float]:
    """The physics that MuJoCo holds, see `Engine.measure`."""
    found = {"gravity.x": model.opt.gravity[0], "gravity.y": model.opt.gravity[1]}
    for body in scene.bodies.values():
        number = model.body(called(body.name)).id
        found[f"{body.name}.mass"] = model.body_mass[number]
        if body.turns:
            found[f"{body.name}.inertia"] = model.body_inertia[number, 2]
    for contact in (*touching(scene), *scene.pairs):
        found[f"{contact}.friction"] = model.pair(contact).friction[0]
    for joint in scene.joints.values():
        dry = joint.dry_friction
        if dry is not None and dry.kinetic.forward == dry.kinetic.backward:  # else a mean: neither
            loss = model.dof_frictionloss[model.joint(joint.name).dofadr[0]]
            found[f"{joint.name}.friction_forward"] = loss
            found[f"{joint.name}.friction_backward"] = loss
    found |= numbers(scene, model)
    if not (any(driven(scene)) or scene.drives):  # their mass drowns the rest
        mujoco.mj_forward(model, data)
        mujoco.mj_energyVel(model, data)
        mujoco.mj_subtreeVel(model, data)
        momentum = data.subtree_linvel[0] * model.body_subtreemass[0]
        found["energy.kinetic"] = data.energy[1]
        found["momentum.x"], found["momentum.y"] = momentum[0], momentum[1]
    return {name: float(value) for name, value in found.items()}
