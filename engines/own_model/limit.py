"""A model's own continuous equations: MuJoCo's accelerations, integrated to far below its steps.

It is the engine's *limit* for h → 0, and no reference: it proves nothing about the equations.
"""

import copy
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, Literal

import mujoco
import numpy as np
from scipy.integrate import solve_ivp

from ...cases.trajectory import Array
from .model import BROKEN, OwnModel, apart
from .release import column, enabled

TIGHT, LOOSE = 1e-10, 1e-8  # relative: what the two answers differ by is the limit's own error
FLOOR = 1e-3  # of a relative tolerance: the absolute one, of rad and m
MOST = 60_000  # accelerations of one answer: an explicit method crawls where a servo is stiff
ITERATIONS = 200  # of Newton's solver at most
EXACT = 1e-16  # its tolerance: what 1e-8 leaves is noise that stalls integrators; 0 never stops
FINE = 64  # parts of its own step, where no integrator comes through
Method = Literal["DOP853", "Radau"]
METHODS: tuple[Method, ...] = ("DOP853", "Radau")  # explicit, and for stiff servos
H_IN_THE_LAW = {
    "discrete": "the integrator `discrete` has the step in its law",
    "delay": "an actuator's delay or history is counted in steps",
    "early": "`actearly` takes the activation of the next step",
    "sleep": "bodies that sleep have the step in their law",
    "state": "a plugin or a spring that yields has a state outside of qpos, qvel and act",
}


class NoLimit(Exception):
    """Why a model has no limit here, in words."""


@dataclass(frozen=True)
class Limit:
    """The motion for h → 0: q (N, m) and y (N, m + n + a) = (qpos, qvel, act) at times (N,) [s].

    error: by how much two answers differ, the largest of all coordinates; method: what integrates.
    """

    times: Array
    q: Array
    error: float
    method: str
    y: Array


def limit(own: OwnModel, times: Array, start: mujoco.MjData | None = None) -> Limit:
    """Returns the limit of a model from a start on, by default its own. Raises NoLimit.

    The law is that of the model's own step: what `refsafe` makes of a contact hangs on that. Where
    many contacts switch it is the engine's own at a small part of its step.
    """
    if reasons := with_step(own.model):
        raise NoLimit("; ".join(reasons))
    begun = start or own.start()
    equations = Equations(own.model, begun)
    for method in METHODS:
        try:
            tight, loose = (equations.followed(times, method, rtol) for rtol in (TIGHT, LOOSE))
        except _TooMany:
            continue
        return _limit(own, times, tight, loose, method)
    h = own.model.opt.timestep
    if apart_by_pairs(own.model):
        raise NoLimit(f"{MOST} accelerations do not suffice, and {PAIRS}")
    fine, coarse = (ran(own, times, None, h / n, begun) for n in (FINE, FINE // 2))
    if fine is None or coarse is None:
        raise NoLimit(f"{MOST} accelerations do not suffice, and small steps diverge")
    return _limit(own, times, fine, coarse, f"its own steps of {h / FINE:.2g} s")


def _limit(own: OwnModel, times: Array, y: Array, other: Array, method: str) -> Limit:
    nq = own.model.nq
    error = float(np.abs(apart(own.model, y[:, :nq], other[:, :nq])).max(initial=0.0))
    return Limit(times, y[:, :nq], error, method, y)


def with_step(m: mujoco.MjModel) -> list[str]:
    """Returns what of a model's law hangs on its step, in words."""
    has = {
        "discrete": mujoco.mjtIntegrator(m.opt.integrator).name == "mjINT_DISCRETE",
        "delay": column(m, "actuator_delay").any() or column(m, "nhistory"),
        "early": np.any(m.actuator_actearly),
        "sleep": enabled(m, "mjENBL_SLEEP"),
        "state": m.nplugin or column(m, "nplastic"),
    }
    return [words for name, words in H_IN_THE_LAW.items() if has[name]]


class _TooMany(Exception):
    """More accelerations than one answer may cost."""


class Equations:
    """ẏ = f(y) of y = (qpos, qvel, act), with the controls of a start held."""

    def __init__(self, model: mujoco.MjModel, start: mujoco.MjData) -> None:
        self.model = copy.copy(model)
        self.model.opt.solver = mujoco.mjtSolver.mjSOL_NEWTON
        self.model.opt.tolerance, self.model.opt.iterations = EXACT, ITERATIONS
        self.data = begun_as(self.model, start)
        self.y = np.concatenate([start.qpos, start.qvel, start.act])
        self.asked = 0

    def rate(self, t: float, y: Array) -> Array:
        """Returns ẏ; q̇ of a quaternion is ½ q ∘ (0, ω)."""
        self.asked += 1
        if self.asked > MOST or not np.all(np.isfinite(y)):
            raise _TooMany
        m, d = self.model, self.data
        d.time = t
        self._set(y)
        mujoco.mj_forward(m, d)
        return np.concatenate([self._q_dot(y), d.qacc, d.act_dot])

    def followed(self, times: Array, method: Method, rtol: float) -> Array:
        """Returns y (N, m + n + a) at the times, to a relative tolerance. Raises _TooMany."""
        self.asked = 0
        span = float(times[0]), float(times[-1])
        answer = solve_ivp(
            self.rate, span, self.y, method, times, rtol=rtol, atol=rtol * FLOOR,
            first_step=1e-6, max_step=float(times[1] - times[0]),
        )  # fmt: skip
        if not answer.success:
            raise _TooMany
        return answer.y.T

    def _set(self, y: Array) -> None:
        nq, nv = self.model.nq, self.model.nv
        self.data.qpos[:], self.data.qvel[:] = y[:nq], y[nq : nq + nv]
        self.data.act[:] = y[nq + nv :]

    def _q_dot(self, y: Array) -> Array:
        m, v = self.model, self.data.qvel
        q_dot = np.empty(m.nq)
        for j in range(m.njnt):
            q, at, kind = int(m.jnt_qposadr[j]), int(m.jnt_dofadr[j]), int(m.jnt_type[j])
            if kind in QUATERNION:
                shift = QUATERNION[kind]
                q_dot[q : q + shift] = v[at : at + shift]
                turn, spin = slice(q + shift, q + shift + 4), slice(at + shift, at + shift + 3)
                q_dot[turn] = _turning(y[turn], v[spin])
            else:
                q_dot[q] = v[at]
        return q_dot


def _turning(q: Array, omega: Array) -> Array:
    """(4,): ½ q ∘ (0, ω), ω in the body's axes; mju_derivQuat takes it in the ground's."""
    w, x, y, z = q
    a, b, c = omega
    rates = [-x * a - y * b - z * c, w * a + y * c - z * b]
    return np.array([*rates, w * b + z * a - x * c, w * c + x * b - y * a]) / 2


QUATERNION = {0: 3, 1: 0}  # by a joint's type: free, ball: how many shifts stand before it


def stepped(
    own: OwnModel,
    times: Array,
    integrator: str | None,
    h: float,
    start: mujoco.MjData | None = None,
) -> Array | None:
    """Returns q (N, m) of MuJoCo's own steps h [s] at the times; None where it diverges."""
    y = ran(own, times, {} if integrator is None else {"integrator": integrator}, h, start)
    return None if y is None else y[:, : own.model.nq]


def ran(
    own: OwnModel,
    times: Array,
    options: Mapping[str, Any] | None,
    h: float,
    start: mujoco.MjData | None = None,
) -> Array | None:
    """Returns y (N, m + n + a) of MuJoCo's own steps h [s] at the times; None where it diverges.

    options: of `mjOption`, by name, over the model's own. times: multiples of h.
    """
    model = copy.copy(own.model) if h >= own.model.opt.timestep else _with_law_of(own.model)
    for name, value in (options or {}).items():
        setattr(model.opt, name, WORDS.get(name, {}).get(value, value))
    model.opt.timestep = h
    data, states = begun_as(model, start or own.start()), list[Array]()
    for steps in np.diff(np.rint(times / h).astype(int), prepend=0):
        if steps:
            mujoco.mj_step(model, data, int(steps))
        if any(int(data.warning[kind].number) for kind in BROKEN):
            return None
        states.append(np.concatenate([data.qpos, data.qvel, data.act]))
    return np.array(states)


def begun_as(model: mujoco.MjModel, start: mujoco.MjData) -> mujoco.MjData:
    """Returns data of the model that begin where others stand, with their controls."""
    data = mujoco.MjData(model)
    for name in ("qpos", "qvel", "act", "ctrl", "mocap_pos", "mocap_quat"):
        getattr(data, name)[:] = getattr(start, name)
    return data


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
    """Whether what `refsafe` makes of contacts at the model's own step can be written into none."""
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
