"""What force elements exert about a turn, which MuJoCo counts as the joint's own."""

import mujoco

from .....cases.scene.space.scene import SpatialScene
from .....cases.trajectory import Array
from ....law import TORQUES, turning
from ..drive import Drive
from .seen import Seen

ABOUT = ("qpos", "qvel", "actuator_force")


def acting(scene: SpatialScene, model: mujoco.MjModel, seen: Seen, drive: Drive) -> Array | float:
    """(N,) [N m] what springs, dampers and motors exert about a driven turn."""
    joint, native = drive.joint, model.joint(drive.name)
    total: Array | float = 0.0
    for force in scene.forces.values():
        if force.about != joint.name or joint.turning(force.turn) != drive.number:
            continue
        if type(force) in TORQUES:
            angle, rate = seen["qpos"][:, native.qposadr[0]], seen["qvel"][:, native.dofadr[0]]
            total = total + turning(force, angle, rate)  # type: ignore[arg-type]
        else:
            actuator = model.actuator(force.name)
            total = total + actuator.gear[0] * seen["actuator_force"][:, actuator.id]
    return total
