"""Viscous friction along a slide as MuJoCo's damping of a joint: a v + b v|v| + c v³."""

import mujoco
import numpy as np

from ...cases.scene.forces.drag import Viscous
from ...cases.trajectory import Array
from .hinge import Hinge
from .written import written

_POWERS = (1.0, 2.0, 3.0)


def not_polynomial(force: Viscous) -> str | None:
    """Why it is not such a damping: another exponent, or another coefficient each way."""
    if force.exponent in _POWERS and force.coefficient.forward == force.coefficient.backward:
        return None
    return "engine: MuJoCo damps a joint by a v + b v|v| + c v³, alike both ways"


def write_viscous(sections: object, force: Viscous, along: Hinge) -> None:
    """The coefficient of its power, if MuJoCo has that."""
    if not_polynomial(force):
        return
    assert along.element is not None
    d, power = force.coefficient.forward, _POWERS.index(force.exponent)
    along.element.set("damping", written(*[d if i == power else 0.0 for i in range(3)]))


def damping(force: Viscous, slip: Array) -> Array:
    """(N,) what such a damping exerts along the slide, by the slip [m/s]."""
    return -force.coefficient.forward * np.abs(slip) ** force.exponent * np.sign(slip)


def viscous_numbers(model: mujoco.MjModel, force: Viscous, along: Hinge) -> dict[str, float]:
    """The coefficient, as the compiled model holds it."""
    dof = model.jnt_dofadr[model.joint(along.name).id]
    held = [model.dof_damping[dof], *np.ravel(model.dof_dampingpoly[dof])]
    d = float(held[_POWERS.index(force.exponent)])
    return {"forward": d, "backward": d}
