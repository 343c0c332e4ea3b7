"""A model's own continuous equations: MuJoCo's accelerations, integrated to far below its steps.

It is the engine's *limit* for h → 0, and no reference: it proves nothing about the equations.
"""

import copy
import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np

from ...cases.trajectory import Array
from .equations import SLIGHT, Equations, Fineness, NoLimit, controls_of, data_from
from .model import BROKEN, OwnModel, joint_moves
from .step_law import with_step

WITHIN = 1e-4  # rad, m: no limit is sought finer than that where it takes many steps
PARTS = 32  # of the model's own step, at first, where no integrator comes through
MOST_STEPS, FEW = 3_000_000, 8  # of an answer, by the number of degrees of freedom, FEW at least


def _coarse(parts: int) -> Fineness:
    return Fineness(1e-8, 1e-6, parts)


def _fine(parts: int) -> Fineness:
    return Fineness(1e-10, 1e-8, parts)


@dataclass(frozen=True)
class Limit:
    """The motion for h → 0: y = (qpos, qvel, act) (N, k) at the times (N,) [s], q (N, m) of them.

    coarser (N, k): y of a second answer, integrated less finely; errors (N,): by how much the two
    differ up to each time, the largest of all coordinates; method: what integrates; fineness: of
    the finer answer; acts: when [s] a constraint acts first along it, and which.
    """

    times: Array
    y: Array
    q: Array
    coarser: Array
    errors: Array
    method: str
    fineness: Fineness
    acts: tuple[float, str] = (math.inf, "")

    @property
    def error(self) -> float:
        """The largest of its errors."""
        return float(self.errors[-1])


def limit(
    own: OwnModel, times: Array, start: mujoco.MjData | None = None, within: float = WITHIN
) -> Limit:
    """Returns the limit of a model from a start on, by default its own. Raises NoLimit.

    The law is that of the model's own step: what `refsafe` makes of a contact hangs on that. Parts
    in which contacts switch too often for an integrator are left to small steps of the engine's,
    ever smaller ones until two answers differ by no more than `within` [rad, m], as far as is
    affordable.
    """
    if reasons := with_step(own):
        raise NoLimit("; ".join(reasons))
    equations = Equations(own, start or own.start())
    coarse = equations.followed(times, _coarse(PARTS // 2))
    fineness = _fine(PARTS)
    fine = equations.followed(times, fineness)
    while True:
        moves = np.abs(joint_moves(own.model, coarse[:, : own.model.nq], fine[:, : own.model.nq]))
        errors = np.maximum.accumulate(moves.max(axis=1, initial=0.0))
        affordable = MOST_STEPS / max(own.model.nv, FEW) / max(equations.steps, 1)
        if errors[-1] <= within or not equations.steps or affordable < 2:
            break
        finer = 2 ** math.floor(math.log2(min(2 * errors[-1] / within, affordable)))
        fineness = _fine(fineness.parts * finer)
        coarse = equations.followed(times, _coarse(fineness.parts // 2))
        fine = equations.followed(times, fineness)
    q, method = fine[:, : own.model.nq], equations.method
    return Limit(times, fine, q, coarse, errors, method, fineness, equations.acts)


def repeat_limit(own: OwnModel, exact: Limit, start: mujoco.MjData) -> Array:
    """Returns y (N, k) from another start, integrated as finely as a limit. Raises NoLimit."""
    return Equations(own, start).followed(exact.times, exact.fineness)


def stepped(
    own: OwnModel,
    times: Array,
    integrator: str | None,
    h: float,
    start: mujoco.MjData | None = None,
) -> Array | None:
    """Returns q (N, m) as `stepped_states` has it, of an integrator by its name."""
    options = {} if integrator is None else {"integrator": integrator}
    y = stepped_states(own, times, options, h, start)
    return None if y is None else y[:, : own.model.nq]


def stepped_states(
    own: OwnModel,
    times: Array,
    options: Mapping[str, Any],
    h: float,
    start: mujoco.MjData | None = None,
) -> Array | None:
    """Returns y (N, k) of MuJoCo's own steps h [s] at the times; None where it diverges.

    options: of `mjOption`, by name, over the model's own. times: multiples of h. A control is what
    it is at the beginning of a step, as in a user's loop.
    """
    model = copy.copy(own.model) if h >= own.model.opt.timestep else _with_law_of(own.model)
    for name, value in options.items():
        setattr(model.opt, name, WORDS.get(name, {}).get(value, value))
    model.opt.timestep = h
    origin = start or own.start()
    data, controls = data_from(model, origin), controls_of(own, origin)
    done, states = 0, list[Array]()
    for step in np.rint(times / h).astype(int):
        if controls.laws:
            for k in range(done, step):
                data.ctrl[:] = controls.at((k + SLIGHT) * h)
                mujoco.mj_step(model, data)
        elif step > done:
            mujoco.mj_step(model, data, int(step - done))
        done = step
        if any(int(data.warning[kind].number) for kind in BROKEN):
            return None
        states.append(np.concatenate([data.qpos, data.qvel, data.act]))
    return np.array(states)


INTEGRATORS = {
    "Euler": mujoco.mjtIntegrator.mjINT_EULER,
    "implicitfast": mujoco.mjtIntegrator.mjINT_IMPLICITFAST,
    "implicit": mujoco.mjtIntegrator.mjINT_IMPLICIT,
    "RK4": mujoco.mjtIntegrator.mjINT_RK4,
}
WORDS: Mapping[str, Mapping[str, int]] = {
    "integrator": INTEGRATORS,
    "solver": {
        "PGS": mujoco.mjtSolver.mjSOL_PGS,
        "CG": mujoco.mjtSolver.mjSOL_CG,
        "Newton": mujoco.mjtSolver.mjSOL_NEWTON,
    },
    "cone": {
        "pyramidal": mujoco.mjtCone.mjCONE_PYRAMIDAL,
        "elliptic": mujoco.mjtCone.mjCONE_ELLIPTIC,
    },
}
"""Options of `mjOption` that are words, by their names in MJCF."""


PAIRS = (
    "its contacts mix time constants below and above two steps, which `refsafe` raises pair by "
    "pair: at a finer step its law is another"
)


def apart_by_pairs(model: mujoco.MjModel) -> bool:
    """Whether `refsafe` raises the time constants of some geoms' contacts, and not of all."""
    collides = (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    times = model.geom_solref[collides, 0]
    short = (times > 0) & (times < 2 * model.opt.timestep)
    return bool(_refsafe(model) and short.any() and not short.all())


def _refsafe(model: mujoco.MjModel) -> bool:
    return not model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_REFSAFE


def _with_law_of(model: mujoco.MjModel) -> mujoco.MjModel:
    """Returns a copy whose constraints are at smaller steps as stiff as at the model's own step.

    `refsafe` takes no time constant below two steps: what it makes of one is written down.
    """
    same, least = copy.copy(model), 2 * model.opt.timestep
    for time_constants in _time_constants(same) if _refsafe(model) else ():
        time_constants[(time_constants > 0) & (time_constants < least)] = least
    return same


def _time_constants(model: mujoco.MjModel) -> list[Array]:
    return [getattr(model, name)[..., 0] for name in SOLREF] + [model.opt.o_solref[:1]]


SOLREF = (
    "geom_solref", "pair_solref", "pair_solreffriction", "eq_solref", "jnt_solref", "dof_solref",
    "tendon_solref_lim", "tendon_solref_fri",
)  # fmt: skip
