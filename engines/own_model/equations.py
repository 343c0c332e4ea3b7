"""A model's own equations of motion, integrated part by part by what comes through."""

import copy
import math
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import mujoco
import numpy as np
from scipy.integrate import DOP853, Radau

from ...cases.trajectory import Array
from .constraints import EXACT_SOLVER, first_constraint
from .control import Controls
from .model import OwnModel

FLOOR = 1e-3  # of a relative tolerance: the absolute one, of rad and m
PART = 0.02  # s: the longest part of a motion that is integrated by one method
FIRST = 1e-6  # s: the first step of the first part at most
INSTANT = 1e-12  # s: parts shorter than that are of rounding
MOST, LEAST = 30_000, 400  # accelerations of an answer; a part may cost a quarter of what is left
CRAWLS = 15  # accelerations of a step of DOP853, which takes 12: more, and it rejects at switches
STEPS = "small steps"
SLIGHT = 1e-6  # of a step: what begins with a step in the clock's rounding begins with it


class NoLimit(Exception):
    """Why a model has no limit here, in words."""


@dataclass(frozen=True)
class Fineness:
    """How finely an answer is integrated.

    smooth, stiff: relative tolerances of DOP853 and Radau; parts: those of the model's own step
    that MuJoCo takes where neither comes through.
    """

    smooth: float
    stiff: float
    parts: int


class _TooMany(Exception):
    """More accelerations than a part may cost; whether that is as something switches in it."""

    def __init__(self, *, switches: bool) -> None:
        super().__init__()
        self.switches = switches


class Equations:
    """ẏ = f(t, y) of y = (qpos, qvel, act), from a start on and with its controls in time."""

    def __init__(self, own: OwnModel, start: mujoco.MjData) -> None:
        self.model, self.controls = copy.copy(own.model), controls_of(own, start)
        for name, value in EXACT_SOLVER.items():
            setattr(self.model.opt, name, value)
        self.fine = copy.copy(self.model)
        self.fine.opt.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
        self.start, self.act_range = start, _act_range(self.model)
        q, v, self.turns = list[int](), list[int](), list[tuple[int, int]]()
        kinds = zip(self.model.jnt_qposadr, self.model.jnt_dofadr, self.model.jnt_type, strict=True)
        for first, at, kind in kinds:
            shifts, turns = SHIFTS_AND_TURNS[int(kind)]
            q += range(first, first + shifts)
            v += range(at, at + shifts)
            self.turns += [(first + shifts, at + shifts)] * turns
        self.scalar_q, self.scalar_v = np.array(q, dtype=int), np.array(v, dtype=int)
        self._begin()

    def _begin(self) -> None:
        self.data = data_from(self.model, self.start)
        self.left, self.steps, self.first, self.stiff = MOST, 0, FIRST, False
        self.acts: tuple[float, str] = (math.inf, "")
        self.over: dict[str, float] = dict.fromkeys(("DOP853", "Radau", STEPS), 0.0)

    @property
    def method(self) -> str:
        """Returns by what the last answer was integrated; for how long is the processor's."""
        return " and ".join(name for name, over in self.over.items() if over)

    def rate(self, t: float, y: Any) -> Any:
        """Returns ẏ; q̇ of a quaternion is ½ q ∘ (0, ω)."""
        self.asked += 1
        if not np.all(np.isfinite(y)):
            raise _TooMany(switches=False)
        m, d = self.model, self.data
        d.time = t
        if self.controls.laws:
            d.ctrl[:] = self.controls.at(min(t, self.before))
        self._set(y)
        mujoco.mj_forward(m, d)
        self._note(t)
        low, high = self.act_range  # from whose ends no rate leads outwards
        least, most = np.where(d.act > low, -np.inf, 0.0), np.where(d.act < high, np.inf, 0.0)
        return np.concatenate([self._q_dot(y), d.qacc, np.clip(d.act_dot, least, most)])

    def _note(self, t: float) -> None:
        """Notes what constraint acts first, of those that act at t [s]."""
        if self.data.nefc and t < self.acts[0]:
            self.acts = float(t), first_constraint(self.model, self.data)

    def followed(self, times: Array, to: Fineness) -> Array:
        """Returns y (N, k) at the times. Raises NoLimit where even small steps diverge.

        Each corner of the controls ends a part, which sees of a jump what stood before.
        """
        self._begin()
        y, rows = np.concatenate([self.start.qpos, self.start.qvel, self.start.act]), list[Array]()
        rows.append(y)
        corners = [t for t in self.controls.corners if times[0] < t < times[-1]]
        for begins, ends in pairwise(np.union1d(times, corners).tolist()):
            for a, b in pairwise(np.linspace(begins, ends, 1 + math.ceil((ends - begins) / PART))):
                if b - a > INSTANT:
                    self.before = math.nextafter(b, a)
                    y = self._advanced(y, float(a), float(b), to)
            if ends in times:
                rows.append(y)
        return np.array(rows)

    def _advanced(self, y: Array, a: float, b: float, to: Fineness) -> Array:
        """Returns y at b: by DOP853, where that crawls by Radau, and else by small steps."""
        for method in (Radau,) if self.stiff else (DOP853, Radau):
            rtol = to.stiff if method is Radau else to.smooth
            try:
                after, self.stiff = self._integrated(method, y, a, b, rtol), method is Radau
            except _TooMany as error:
                if error.switches:
                    break
                continue
            self.over[method.__name__] += b - a
            return after
        self.stiff = False
        self.over[STEPS] += b - a
        return self._stepped(y, a, b, to.parts)

    def _integrated(
        self, method: type[DOP853] | type[Radau], y: Array, a: float, b: float, rtol: float
    ) -> Array:
        self.asked, most = 0, max(self.left // 4, LEAST)
        first = min(self.first, b - a)
        solver = method(self.rate, a, y, b, first_step=first, rtol=rtol, atol=rtol * FLOOR)
        steps = 0
        while solver.status == "running" and self.asked < most:
            solver.step()
            steps += 1
        self.left -= self.asked
        if solver.status != "finished":
            raise _TooMany(switches=self.asked > CRAWLS * steps)
        self.first = solver.h_abs
        return solver.y

    def _stepped(self, y: Array, a: float, b: float, parts: int) -> Array:
        """Returns y at b by small steps of implicitfast, whose law is that of the model's own."""
        m, fine, d = self.model, self.fine, self.data
        count = math.ceil((b - a) / m.opt.timestep * parts)
        h = fine.opt.timestep = (b - a) / count
        self.steps += count
        self._set(y)
        for k in range(count):
            if self.controls.laws:
                d.ctrl[:] = self.controls.at(a + (k + SLIGHT) * h)
            mujoco.mj_forward(m, d)
            mujoco.mj_implicit(fine, d)
            self._note(a + k * h)
        after = np.concatenate([d.qpos, d.qvel, d.act])
        if not np.all(np.isfinite(after)):
            raise NoLimit(f"no integrator comes through, and steps of {h:.2g} s diverge")
        self.first = FIRST
        return after

    def _set(self, y: Array) -> None:
        nq, nv = self.model.nq, self.model.nv
        self.data.qpos[:], self.data.qvel[:] = y[:nq], y[nq : nq + nv]
        self.data.act[:] = np.clip(y[nq + nv :], *self.act_range)

    def _q_dot(self, y: Array) -> Array:
        v, q_dot = self.data.qvel, np.empty(self.model.nq)
        q_dot[self.scalar_q] = v[self.scalar_v]
        for q, at in self.turns:
            q_dot[q : q + 4] = _turning(y[q : q + 4], v[at : at + 3])
        return q_dot


def _act_range(m: mujoco.MjModel) -> Array:
    """(2, na): between what a step keeps each activation."""
    ends = np.tile(np.array([[-np.inf], [np.inf]]), m.na)
    for i in np.flatnonzero(m.actuator_actlimited):
        first, wide = int(m.actuator_actadr[i]), int(m.actuator_actnum[i])
        ends[:, first : first + wide] = m.actuator_actrange[i][:, None]
    return ends


def _turning(q: Array, omega: Array) -> Array:
    """(4,): ½ q ∘ (0, ω), ω in the body's axes; mju_derivQuat takes it in the ground's."""
    w, x, y, z = q
    a, b, c = omega
    rates = [-x * a - y * b - z * c, w * a + y * c - z * b]
    return np.array([*rates, w * b + z * a - x * c, w * c + x * b - y * a]) / 2


SHIFTS_AND_TURNS = {0: (3, 1), 1: (0, 1), 2: (1, 0), 3: (1, 0)}
"""By a joint's type its coordinates that velocities move alone, and its quaternions after them."""


def controls_of(own: OwnModel, start: mujoco.MjData) -> Controls:
    """Returns a model's controls in time; those without a law stay as they start."""
    return Controls(np.array(start.ctrl), own.laws)


def data_from(model: mujoco.MjModel, start: mujoco.MjData) -> mujoco.MjData:
    """Returns new data of the model with the state and controls of others."""
    data = mujoco.MjData(model)
    for name in ("qpos", "qvel", "act", "ctrl", "mocap_pos", "mocap_quat"):
        getattr(data, name)[:] = getattr(start, name)
    return data
