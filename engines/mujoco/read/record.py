"""The record of a run: positions, velocities and activations, at samples or at every step."""

from dataclasses import dataclass

import mujoco
import numpy as np
from mujoco import rollout
from numpy.typing import NDArray

from ....cases.trajectory import Array
from ..callbacks.stepping import Steps

Counts = NDArray[np.int64]
_WHOLE = 1e-9  # of the longest time: what its sum of rounding may be


@dataclass(frozen=True)
class Record:
    """(N, ·) each, in MuJoCo's order; felt: what its sensors say, where its own loop kept it."""

    qpos: Array
    qvel: Array
    act: Array
    felt: Array | None = None

    def at(self, rows: Counts) -> "Record":
        """Some of the rows."""
        return Record(self.qpos[rows], self.qvel[rows], self.act[rows])


def counted(times: Array, step: float) -> Counts:
    """How many steps [s] each time is after 0. Raises ValueError where that is no whole number."""
    counts: Counts = np.rint(times / step).astype(np.int64)
    off = np.abs(times - counts * step)
    if np.max(off) > _WHOLE * max(float(times[-1]), step):
        worst = float(times[np.argmax(off)])
        raise ValueError(f"MuJoCo: {worst:.12g} s is no whole multiple of the step {step:.12g} s")
    return counts


def all_steps(times: Array, step: float) -> Array:
    """The time of every step up to the last sample; each a product, for sums drift."""
    return np.arange(round(times[-1] / step) + 1) * step


def sampled(data: mujoco.MjData, counts: Counts, steps: Steps) -> Record:
    """Steps from sample to sample."""
    parts = (data.qpos, data.qvel, data.act)  # views: fetching one costs 0.2 µs
    record = [np.empty((len(counts), len(part))) for part in parts]
    now = 0
    for i, count in enumerate(counts.tolist()):
        if count > now:
            steps.take(count - now)
            now = count
        steps.note()
        for kept, part in zip(record, parts, strict=True):
            kept[i] = part
    return Record(*record)


def whole(model: mujoco.MjModel, data: mujoco.MjData, rows: int) -> Record:
    """Every step, kept by MuJoCo's own loop: bit for bit what stepping gives."""
    first = np.empty(mujoco.mj_stateSize(model, _FULL))
    mujoco.mj_getState(model, data, first, _FULL)
    states, felt = np.empty((1, rows, len(first))), np.empty((1, rows, model.nsensordata))
    states[0, 0] = first
    if rows > 1:
        held = np.tile(data.ctrl, (1, rows - 1, 1)) if model.nu else None
        # A row of its sensors belongs to the state before the step, one of states to that after.
        states[:, 1:], felt[:, :-1] = rollout.rollout(
            model, data, first[None], held, nstep=rows - 1
        )
    mujoco.mj_forward(model, data)
    felt[0, -1] = data.sensordata
    _, qpos, qvel, act, _ = np.split(
        states[0], np.cumsum([1, model.nq, model.nv, model.na]), axis=1
    )
    return Record(qpos, qvel, act, felt[0])


_FULL = int(mujoco.mjtState.mjSTATE_FULLPHYSICS)
