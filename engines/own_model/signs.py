"""The signs of a run beside its error: shakes, forces at limits, energy."""

import copy
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import mujoco
import numpy as np

from ...cases.trajectory import Array
from .equations import SLIGHT, controls_of, data_from
from .limit import Limit
from .model import BROKEN, OwnModel
from .quantities import Motion, Quantity, label, observed
from .release import actuators, column
from .seen import Shake, shaking

BOUND = 1e-9  # of a range: a force that near to its end is clamped; what MuJoCo clamps is at it
OBJECT = mujoco.mjtObj


@dataclass(frozen=True)
class Lost:
    """Energy [J] that the steps lost against the limit at each time (N,) [s], below 0 if gained.

    kinetic: the largest kinetic energy of the limit, beside which that is much or little.
    """

    times: Array
    by: Array
    kinetic: float


@dataclass(frozen=True)
class Signs:
    """The signs of a run of a model's own steps, beside its error.

    shakes: by velocity, as `seen.shaking` has them. at_limit: by the name of an actuator, joint or
    tendon for which part of the steps a force is at its bound. y (k,): the state at the `end` [s].
    """

    shakes: Mapping[int, Shake]
    at_limit: Mapping[str, float]
    lost: Lost
    end: float
    y: Array


def signs(own: OwnModel, exact: Limit, until: float, bars: Array) -> Signs | None:
    """Returns what the model's own steps show until a time [s]; None where they diverge.

    bars (n,) [rad, m]: what moves a joint by no more than that in a step nobody sees.
    """
    times = exact.times[exact.times <= until]
    bounds, h = _bounds(own.model), own.model.opt.timestep
    data, controls = data_from(own.model, own.start()), controls_of(own, own.start())
    count = round(float(times[-1]) / h)
    states, touches = [_state(data)], np.zeros(len(bounds))
    for k in range(count):
        data.ctrl[:] = controls.at((k + SLIGHT) * h)
        mujoco.mj_step(own.model, data)
        if any(int(data.warning[kind].number) for kind in BROKEN):
            return None
        states.append(_state(data))
        touches += [_at_bound(bound, data) for bound in bounds]
    y = np.array(states)
    at_limit: dict[str, float] = {}
    for bound, steps in zip(bounds, touches.tolist(), strict=True):
        if steps:  # names may be equal: the worst of them
            at_limit[bound.name] = max(at_limit.get(bound.name, 0.0), steps / count)
    at = np.rint(times / h).astype(int)
    return Signs(
        shaking(own, np.arange(count + 1) * h, y, bars),
        at_limit,
        _energy_lost(own, times, y[at], exact.y[: len(times)]),
        count * h,
        y[-1],
    )


def _state(data: mujoco.MjData) -> Array:
    return np.concatenate([data.qpos, data.qvel, data.act])


@dataclass(frozen=True)
class _Bound:
    """A range of a force, of an element by its name, and how to read the force."""

    name: str
    least: float
    most: float
    read: Callable[[mujoco.MjData], float]


def _bounds(m: mujoco.MjModel) -> list[_Bound]:
    outputs, bounds = column(m, "actuator_outadr"), list[_Bound]()

    def add(
        kind: mujoco.mjtObj, i: int, ends: Array, read: Callable[[mujoco.MjData], float]
    ) -> None:
        bounds.append(_Bound(label(m, kind, i), float(ends[0]), float(ends[1]), read))

    for i in range(actuators(m)):
        if m.actuator_forcelimited[i]:
            ends, k = m.actuator_forcerange[i], int(outputs[i])
            add(OBJECT.mjOBJ_ACTUATOR, i, ends, lambda d, k=k: d.actuator_force[k])
    for j in map(int, np.flatnonzero(m.jnt_actfrclimited)):
        ends, k = m.jnt_actfrcrange[j], int(m.jnt_dofadr[j])
        add(OBJECT.mjOBJ_JOINT, j, ends, lambda d, k=k: d.qfrc_actuator[k])
    for t in map(int, np.flatnonzero(m.tendon_actfrclimited)):
        on_tendons = m.actuator_trntype == mujoco.mjtTrn.mjTRN_TENDON
        pulls = outputs[on_tendons & (m.actuator_trnid[:, 0] == t)]
        ends = m.tendon_actfrcrange[t]
        add(OBJECT.mjOBJ_TENDON, t, ends, lambda d, k=pulls: d.actuator_force[k].sum())
    return bounds


def _at_bound(bound: _Bound, data: mujoco.MjData) -> bool:
    """Whether a force is at an end of its range; at an end that is 0 it only rests."""
    force, near = bound.read(data), BOUND * (bound.most - bound.least)
    return bool(force) and not bound.least + near < force < bound.most - near


def _energy_lost(own: OwnModel, times: Array, y: Array, exact: Array) -> Lost:
    energy = Quantity("energy", "J", "energy")
    ours, theirs = (observed([energy], Motion(own, times, each))[energy] for each in (exact, y))
    return Lost(times, (ours - theirs)[:, 0], _kinetic(own, exact))


def _kinetic(own: OwnModel, y: Array) -> float:
    m = copy.copy(own.model)
    m.opt.enableflags |= mujoco.mjtEnableBit.mjENBL_ENERGY
    data, most = own.start(), 0.0
    for row in y:
        data.qpos[:], data.qvel[:], _ = np.split(row, [m.nq, m.nq + m.nv])
        mujoco.mj_forward(m, data)
        most = max(most, float(data.energy[1]))
    return most
