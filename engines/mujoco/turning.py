"""What acts about a joint: MuJoCo's own of the joint, or an actuator."""

import math
from collections.abc import Mapping
from xml.etree import ElementTree as ET

import mujoco
import numpy as np

from ...cases.scene.forces.turning import Motor, Torsion, TorsionDamper
from .hinge import Hinge
from .written import written


def torsion(sections: Mapping[str, ET.Element], force: Torsion, about: Hinge) -> None:
    """A torsion spring is a joint's own."""
    about.give("stiffness", force.stiffness)
    about.give("springref", math.degrees(about.way * force.rest_angle))


def torsion_numbers(model: mujoco.MjModel, force: Torsion, about: Hinge) -> dict[str, float]:
    """What the joint holds of it."""
    number = model.joint(about.name).id
    rest = about.way * model.qpos_spring[model.jnt_qposadr[number]]
    return {"stiffness": np.ravel(model.jnt_stiffness[number])[0], "rest_angle": rest}


def torsion_damper(sections: Mapping[str, ET.Element], force: TorsionDamper, about: Hinge) -> None:
    """A damper is a joint's own too."""
    about.give("damping", force.damping)


def torsion_damping(model: mujoco.MjModel, force: TorsionDamper, about: Hinge) -> dict[str, float]:
    """What the joint holds of it."""
    dof = model.jnt_dofadr[model.joint(about.name).id]
    return {"damping": np.ravel(model.dof_damping[dof])[0]}


def motor(sections: Mapping[str, ET.Element], force: Motor, about: Hinge) -> None:
    """An actuator of the joint."""
    gear = written(about.way * force.signal.amplitude[0])
    given = {"name": force.name, "joint": about.name, "gear": gear}
    element = ET.SubElement(sections["actuator"], "general", given)
    if force.signal.law == "ramp":
        element.set("dyntype", "integrator")
