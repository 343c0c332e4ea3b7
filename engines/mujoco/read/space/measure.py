"""Physics read back from MuJoCo's compiled model, for the equal-physics audit."""

import mujoco

from .....cases.scene import Scene
from .....cases.scene.rotation import matrix
from .....cases.trajectory import Array
from ...model.force import numbers
from ...model.tree import called, driven

_ENTRIES = {"11": (0, 0), "22": (1, 1), "33": (2, 2), "12": (0, 1), "13": (0, 2), "23": (1, 2)}


def measured(scene: Scene, model: mujoco.MjModel, data: mujoco.MjData) -> dict[str, float]:
    """The physics that MuJoCo holds, see `Engine.measure`."""
    found = {f"gravity.{axis}": g for axis, g in zip("xyz", model.opt.gravity, strict=True)}
    for body in scene.bodies.values():
        number = model.body(called(body.name)).id
        found[f"{body.name}.mass"] = model.body_mass[number]
        if body.turns:
            tensor = _tensor(model, number)
            found |= {f"{body.name}.inertia_{ik}": tensor[at] for ik, at in _ENTRIES.items()}
    for contact in scene.contacts:
        found[f"{contact}.friction"] = model.pair(contact).friction[0]
    found |= numbers(scene, model)
    if not (any(driven(scene)) or scene.drives):  # their mass drowns the rest
        mujoco.mj_forward(model, data)
        mujoco.mj_energyVel(model, data)
        mujoco.mj_subtreeVel(model, data)
        momentum = data.subtree_linvel[0] * model.body_subtreemass[0]
        found["energy.kinetic"] = data.energy[1]
        found |= {f"momentum.{axis}": p for axis, p in zip("xyz", momentum, strict=True)}
    return {name: float(value) for name, value in found.items()}


def _tensor(model: mujoco.MjModel, number: int) -> Array:
    """(3, 3) in body axes: MuJoCo keeps principal moments and the attitude of their axes."""
    axes = matrix(model.body_iquat[number])
    return (axes * model.body_inertia[number]) @ axes.T
