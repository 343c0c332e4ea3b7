"""The constraints that act in a state of a model: their names, and the numbers of each row."""

import copy
from collections.abc import Iterator, Mapping

import mujoco
import numpy as np

from ...cases.constraints import Bound, Constrained, Constraint
from .model import OwnModel, State
from .numbers import element_name
from .release import mass_matrix

KIND = mujoco.mjtConstraint
OBJECT = mujoco.mjtObj
OF: dict[int, tuple[str, mujoco.mjtObj, Bound]] = {
    KIND.mjCNSTR_EQUALITY: ("equality", OBJECT.mjOBJ_EQUALITY, "none"),
    KIND.mjCNSTR_FRICTION_DOF: ("friction loss of joint", OBJECT.mjOBJ_JOINT, "loss"),
    KIND.mjCNSTR_FRICTION_TENDON: ("friction loss of tendon", OBJECT.mjOBJ_TENDON, "loss"),
    KIND.mjCNSTR_LIMIT_JOINT: ("limit of joint", OBJECT.mjOBJ_JOINT, "one way"),
    KIND.mjCNSTR_LIMIT_TENDON: ("limit of tendon", OBJECT.mjOBJ_TENDON, "one way"),
}
"""By the kind of a row: what acts there, on which element, and how its force is bounded."""
EXACT_SOLVER: Mapping[str, float] = {
    "solver": int(mujoco.mjtSolver.mjSOL_NEWTON),
    "iterations": 200,
    "tolerance": 1e-16,  # what 1e-8 leaves is noise that stalls integrators; 0 never stops
    "ls_iterations": 50,
    "ls_tolerance": 0.01,
}
"""Options with which constraints are solved to the last digit; a model may have few iterations."""
ONCE_MORE = 4  # iterations of Newton's, from where it stopped: they double the digits that hold
NO_SLIP = "option noslip_iterations: forces that a second pass changes follow no one law"


def first_constraint(m: mujoco.MjModel, data: mujoco.MjData) -> str:
    """Returns the name of the first active constraint of a state."""
    return _name(m, data, 0)


def _name(m: mujoco.MjModel, data: mujoco.MjData, row: int) -> str:
    kind, number = int(data.efc_type[row]), int(data.efc_id[row])
    if kind in OF:
        word, of, _ = OF[KIND(kind)]
        number = int(m.dof_jntid[number]) if kind == KIND.mjCNSTR_FRICTION_DOF else number
        return f"{word} {element_name(m, of, number)}"
    contact = data.contact[number]
    pairs = zip(contact.geom.tolist(), contact.flex.tolist(), strict=True)
    return f"contact of {' and '.join(_side(m, geom, flex) for geom, flex in pairs)}"


def _side(m: mujoco.MjModel, geom: int, flex: int) -> str:
    if geom < 0:
        return f"flex {element_name(m, OBJECT.mjOBJ_FLEX, flex)}"
    name = mujoco.mj_id2name(m, OBJECT.mjOBJ_GEOM, geom)
    body = element_name(m, OBJECT.mjOBJ_BODY, int(m.geom_bodyid[geom]))
    return f"geom {name}" if name else f"body {body}"


class Constraints:
    """The constraints of a model's states, whose forces are solved for to the last digit."""

    def __init__(self, own: OwnModel) -> None:
        m = self.model = copy.copy(own.model)
        for name, value in EXACT_SOLVER.items():
            setattr(m.opt, name, value)
        m.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
        m.opt.disableflags &= ~int(mujoco.mjtDisableBit.mjDSBL_WARMSTART)
        self.exact = copy.copy(m)
        self.exact.opt.tolerance, self.exact.opt.iterations = 0.0, ONCE_MORE
        self.start = own.start()

    @property
    def unread(self) -> list[str]:
        """Returns why its forces follow no law, in words; or nothing."""
        return [NO_SLIP] if self.model.opt.noslip_iterations else []

    def at(self, state: State) -> Constrained | None:
        """Returns the constraints of a state, or None where none acts."""
        m, d = self.model, copy.copy(self.start)
        d.qpos[:], d.qvel[:], d.ctrl[:] = state.q, state.v, state.u
        mujoco.mj_forward(m, d)
        if not d.nefc:
            return None
        d.qacc_warmstart[:] = d.qacc
        mujoco.mj_forward(self.exact, d)
        J = np.array(d.efc_J).reshape(d.nefc, m.nv)
        rows = (np.array(of) for of in (d.efc_aref, d.efc_R, d.efc_force))
        return Constrained([*self._each(d)], mass_matrix(m, d), np.array(d.qfrc_smooth),
                           np.array(d.qacc), J, *rows)  # fmt: skip

    def _each(self, d: mujoco.MjData) -> Iterator[Constraint]:
        row = 0
        while row < d.nefc:
            kind, name = int(d.efc_type[row]), _name(self.model, d, row)
            bound = OF[KIND(kind)][2] if kind in OF else "one way"
            bounds = np.array(d.efc_frictionloss[row : row + 1])
            if kind == KIND.mjCNSTR_CONTACT_ELLIPTIC:
                contact = d.contact[int(d.efc_id[row])]
                bound, bounds = "cone", np.array(contact.friction[: contact.dim - 1])
            constraint = Constraint(name, bound, row, bounds)
            yield constraint
            row = constraint.rows.stop
