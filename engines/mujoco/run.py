"""Stepping MuJoCo: its own loop between samples, one record a sample, everything read later."""

from collections.abc import Iterator
from contextlib import contextmanager

import mujoco
import numpy as np

from cases.scene import Scene
from cases.trajectory import Array, Trajectory
from engines.engine import Diverged, State
from engines.mujoco.control import installed, signals
from engines.mujoco.readout import STATE, read


@contextmanager
def heard() -> Iterator[list[str]]:
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


def load(text: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The model, and data at its start. Raises ValueError with what MuJoCo does not take."""
    with heard(), installed(None):
        model = mujoco.MjModel.from_xml_string(text)
        data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


def simulate(
    scene: Scene,
    model: mujoco.MjModel,
    data: mujoco.MjData,
    start: State,
    times: Array,
    reactions: tuple[str, ...],
) -> Trajectory:
    """The motion at the times, whole multiples of the model's step from 0. Raises Diverged."""
    with heard() as warnings, signals(scene):
        record = _record(model, data, times)
        _check(warnings, times, record)
        trajectory = read(scene, model, data, start, times, record, reactions)
        _check(warnings, times, record)
    return trajectory


def _record(model: mujoco.MjModel, data: mujoco.MjData, times: Array) -> Array:
    """Time, position, velocity, activation and control of every sample: a row as STATE has it."""
    record = np.empty((len(times), mujoco.mj_stateSize(model, STATE)))
    steps = round((times[1] - times[0]) / model.opt.timestep)
    mujoco.mj_getState(model, data, record[0], STATE)
    for row in record[1:]:
        mujoco.mj_step(model, data, steps)
        mujoco.mj_getState(model, data, row, STATE)
    record[:, 0] = times  # MuJoCo adds up its steps, with their rounding
    return record


def _check(warnings: list[str], times: Array, record: Array) -> None:
    if warnings:
        raise Diverged(f"MuJoCo warns: {' '.join(warnings[0].split())}")
    finite = np.isfinite(record).all(axis=1)
    if not finite.all():
        raise Diverged(f"not finite from t = {times[np.argmin(finite)]:.4g} s on")
