"""A model's own continuous equations: MuJoCo's accelerations, integrated to far below its steps.

It is the engine's *limit* for h → 0, and no reference: it proves nothing about the equations.
"""

import copy
import math
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Literal

import mujoco
import numpy as np
from scipy.integrate import solve_ivp

from ...cases.trajectory import Array
from .control import Controls
from .model import BROKEN, OwnModel, apart
from .release import column, enabled

TIGHT, LOOSE = 1e-10, 1e-8  # relative: what the two answers differ by is the limit's own error
FLOOR = 1e-3  # of a relative tolerance: the absolute one, of rad and m
MOST = 60_000  # accelerations of one answer: an explicit method crawls where a servo is stiff
ITERATIONS = 200  # of Newton's solver at most
EXACT = 1e-16  # its tolerance: what 1e-8 leaves is noise that stalls integrators; 0 never stops
FIRST = 1e-6  # s: the first step of each piece at most
SLIGHT = 1e-6  # of a step: what begins with a step in the clock's rounding begins with it
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
    """The motion for h → 0: y = (qpos, qvel, act) (N, k) at the times (N,) [s], q (N, m) of them.

    error: by how much two answers differ, the largest of all coordinates; method: what integrates.
    """

    times: Array
    y: Array
    q: Array
    error: float
    method: str


def limit(own: OwnModel, times: Array, start: mujoco.MjData | None = None) -> Limit:
    """Returns the limit of a model from a start on, by default its own. Raises NoLimit.

    The law is that of the model's own step: what `refsafe` makes of a contact hangs on that. Where
    many contacts switch it is the engine's own at a small part of its step.
    """
    if reasons := with_step(own.model):
        raise NoLimit("; ".join(reasons))
    begun = start or own.start()
    equations = Equations(own, begun)
    for method in METHODS:
        try:
            tight, loose = (equations.followed(times, method, rtol) for rtol in (TIGHT, LOOSE))
        except _TooMany:
            continue
        return _of(own.model, times, tight, loose, method)
    h = own.model.opt.timestep
    if apart_by_pairs(own.model):
        raise NoLimit(f"{MOST} accelerations do not suffice, and {PAIRS}")
    fine, coarse = (stepped_states(own, times, {}, h / n, begun) for n in (FINE, FINE // 2))
    if fine is None or coarse is None:
        raise NoLimit(f"{MOST} accelerations do not suffice, and small steps diverge")
    return _of(own.model, times, fine, coarse, f"its own steps of {h / FINE:.2g} s")


def _of(model: mujoco.MjModel, times: Array, y: Array, other: Array, method: str) -> Limit:
    q, others = y[:, : model.nq], other[:, : model.nq]
    return Limit(times, y, q, float(np.abs(apart(model, q, others)).max(initial=0.0)), method)


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
    """ẏ = f(t, y) of y = (qpos, qvel, act), from a start on and with its controls in time."""

    def __init__(self, own: OwnModel, start: mujoco.MjData) -> None:
        self.model, self.controls = copy.copy(own.model), controls_of(own, start)
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
        if self.controls.laws:
            d.ctrl[:] = self.controls.at(min(t, self.before))
        self._set(y)
        mujoco.mj_forward(m, d)
        return np.concatenate([self._q_dot(y), d.qacc, d.act_dot])

    def followed(self, times: Array, method: Method, rtol: float) -> Array:
        """Returns y (N, k) at the times, to a relative tolerance. Raises _TooMany.

        Each corner of the controls ends a piece, which sees of a jump what stood before.
        """
        self.asked = 0
        first, last = float(times[0]), float(times[-1])
        ends = [t for t in self.controls.corners if first < t < last] + [last]
        y, rows = self.y, [self.y[None]]
        for begins, ends_at in pairwise([first, *ends]):
            self.before = math.nextafter(ends_at, begins)
            inside = times[(times > begins) & (times <= ends_at)]
            answer = solve_ivp(
                self.rate, (begins, ends_at), y, method, np.union1d(inside, ends_at),
                rtol=rtol, atol=rtol * FLOOR, max_step=float(times[1] - times[0]),
                first_step=min(FIRST, (ends_at - begins) / 2),
            )  # fmt: skip
            if not answer.success:
                raise _TooMany
            rows.append(answer.y.T[: len(inside)])
            y = answer.y[:, -1]
        return np.concatenate(rows)

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
    begun = start or own.start()
    data, controls = begun_as(model, begun), controls_of(own, begun)
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


def controls_of(own: OwnModel, start: mujoco.MjData) -> Controls:
    """Returns a model's controls in time; those without a law stay as they start."""
    return Controls(np.array(start.ctrl), own.laws)


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
