"""Signs that a person sees of a model: it diverges, a joint shakes, a servo stays short."""

from dataclasses import dataclass

import mujoco
import numpy as np

from ...cases.trajectory import Array
from ...cases.tree import Motor
from .limit import stepped_states
from .model import BROKEN, OwnModel
from .quantities import FIELDS, label

LONG = 20  # steps: a rate that changes its sign in each of so many is no turn of a motion


@dataclass(frozen=True)
class Shake:
    """How fast [rad/s, m/s] a joint shakes, and from when to when [s]."""

    rate: float
    begins: float
    ends: float


def motion_at_steps(own: OwnModel, end: float) -> tuple[Array, Array] | None:
    """Returns times (N,) [s] and y (N, k) at each of its own steps, or None where it diverges."""
    h = own.model.opt.timestep
    times = np.arange(int(end / h) + 1) * h
    y = stepped_states(own, times, {}, h)
    return None if y is None else (times, y)


def diverges(own: OwnModel, end: float) -> tuple[float, int | None]:
    """Returns when [s] its own steps diverge, and the velocity in which MuJoCo sees it first."""
    data, controls, when = own.start(), own.controls, 0.0
    while when < end:
        data.ctrl[:] = controls.at(data.time)
        mujoco.mj_step(own.model, data)  # which begins anew where it breaks
        when += own.model.opt.timestep
        for kind in BROKEN:
            if data.warning[kind].number:
                of_velocity = kind != mujoco.mjtWarning.mjWARN_BADQPOS
                return when, int(data.warning[kind].lastinfo) if of_velocity else None
    return end, None


def shaking(own: OwnModel, times: Array, y: Array, bars: Array) -> dict[int, Shake]:
    """Returns by velocity how it shakes: its rate changes its sign from step to step.

    What moves a joint in a step by no more than its bar (n,) [rad, m] nobody sees.
    """
    h, m = own.model.opt.timestep, own.model
    shakes: dict[int, Shake] = {}
    for k, rate in enumerate(y[:, m.nq : m.nq + m.nv].T):
        turns = np.concatenate([[False], rate[1:] * rate[:-1] < 0, [False]])
        edges = np.flatnonzero(np.diff(turns.astype(int)))
        begins, ends = edges[::2], edges[1::2]
        longest = int(np.argmax(ends - begins)) if len(ends) else 0
        if len(ends) and ends[longest] - begins[longest] >= LONG:
            first, last = int(begins[longest]), int(ends[longest])
            size = float(np.median(np.abs(rate[first : last + 1])))
            if size * h > bars[k]:
                shakes[k] = Shake(size, float(times[first]), float(times[last]))
    return shakes


def servos(own: OwnModel) -> dict[int, Motor]:
    """Returns by velocity the position servo that alone moves it, if it has one."""
    return {
        int(dofs[0]): motor
        for motor in own.tree.motors
        if motor.bias[1] < 0 < motor.gain[0] and len(dofs := np.flatnonzero(motor.moments)) == 1
    }


def short_of_target(own: OwnModel, time: float, y: Array) -> dict[int, float]:
    """Returns by velocity how far [rad, m] its servo is from its target in a state (k,)."""
    u = own.controls.at(time)
    short: dict[int, float] = {}
    for k, motor in servos(own).items():
        gear = float(motor.moments[k])
        pull = motor.gain[0] * np.clip(u[motor.u], *motor.control) + motor.bias[0]
        short[k] = abs(float(pull / -motor.bias[1] / gear - y[own.tree.places[k]]))
    return short


def joint_of(model: mujoco.MjModel, dof: int) -> tuple[str, str]:
    """Returns a velocity's joint, by its name, and the unit of what it moves."""
    joint = int(model.dof_jntid[dof])
    within = dof - int(model.jnt_dofadr[joint])
    fields = FIELDS[int(model.jnt_type[joint])]
    unit = next(unit for _, unit, first, wide in fields if first <= within < first + wide)
    return label(model, mujoco.mjtObj.mjOBJ_JOINT, joint), unit
