"""Stepping MuJoCo: its own loop between samples, one record a sample, everything read later."""

from collections.abc import Iterator
from contextlib import contextmanager

import mujoco
import numpy as np

from ...cases.scene import Scene
from ...cases.trajectory import Array, Trajectory
from ..engine import Diverged, Realised, Start
from .law.signal import installed, signals
from .law.smooth import smooth
from .law.stepping import Steps, stepping
from .read.readout import read
from .read.record import all_steps, recorded


@contextmanager
def listening() -> Iterator[list[str]]:
    """MuJoCo's warnings as a list.

    Without someone who listens, MuJoCo writes them to MUJOCO_LOG.TXT in the user's folder.
    """
    messages: list[str] = []
    before = mujoco.get_mju_user_warning()
    mujoco.set_mju_user_warning(messages.append)
    try:
        yield messages
    finally:
        mujoco.set_mju_user_warning(before)


def started(model: mujoco.MjModel) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The model, and data at its start."""
    with listening(), installed(None):
        data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


def simulate(
    scene: Scene,
    model: mujoco.MjModel,
    data: mujoco.MjData,
    start: Start,
    times: Array,
    reactions: tuple[str, ...],
    *,
    realised: Realised,
    every: bool,
) -> Trajectory:
    """The motion at the times, whole multiples of the model's step from 0. Raises Diverged."""
    steps = stepping(scene, model, data, realised)
    laws = smooth(scene, model) if realised == "law" else []
    grid = all_steps(times, model.opt.timestep) if every else times
    with listening() as warnings, signals(scene, laws):
        record = _record(model, data, grid, steps)
        _check(warnings, grid, record)
        stride = (len(grid) - 1) // (len(times) - 1)
        samples, steps.noted = [kept[::stride] for kept in record], steps.noted[::stride]
        trajectory = read(scene, model, data, start, times, samples, reactions, steps.recall)
        _check(warnings, times, samples)
    return recorded(scene, model, trajectory, grid, record, start) if every else trajectory


def _record(model: mujoco.MjModel, data: mujoco.MjData, times: Array, take: Steps) -> list[Array]:
    """Position, velocity, activation and control of every sample, (N, ·) each."""
    parts = (data.qpos, data.qvel, data.act, data.ctrl)  # views: fetching one costs 0.2 µs
    record = [np.empty((len(times), len(part))) for part in parts]
    steps = round((times[1] - times[0]) / model.opt.timestep)
    for i in range(len(times)):
        if i:
            take.take(steps)
        take.note()
        for kept, part in zip(record, parts, strict=True):
            kept[i] = part
    return record


def _check(warnings: list[str], times: Array, record: list[Array]) -> None:
    finite = np.all([np.all(np.isfinite(kept), axis=1) for kept in record], axis=0)
    if warnings:
        raise Diverged(f"MuJoCo warns: {' '.join(warnings[0].split())}")
    if not np.all(finite):
        raise Diverged(f"not finite from t = {times[np.argmin(finite)]:.4g} s on")
