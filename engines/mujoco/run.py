"""Stepping MuJoCo: its own loop between samples, one record a sample, everything read later."""

import math
from collections.abc import Callable, Iterator
from contextlib import contextmanager

import mujoco
import numpy as np

from cases.scene import Scene
from cases.trajectory import Array, Trajectory
from engines.engine import Diverged
from engines.mujoco.readout import Readout


def load(text: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """The model, and data at its start."""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


def simulate(scene: Scene, text: str, times: Array, reactions: tuple[str, ...]) -> Trajectory:
    """The motion at the times, whole multiples of the model's step from 0. Raises Diverged."""
    model, data = load(text)
    with signals(scene):
        record = _record(model, data, times)
        return _read(scene, model, times, record, reactions)


def _record(model: mujoco.MjModel, data: mujoco.MjData, times: Array) -> list[Array]:
    """Position, velocity, activation and control of every sample, (N, ·) each."""
    n = len(times)
    parts = (data.qpos, data.qvel, data.act, data.ctrl)
    record = [np.empty((n, len(part))) for part in parts]
    steps = round((times[1] - times[0]) / model.opt.timestep)
    for i in range(n):
        if i:
            mujoco.mj_step(model, data, steps)
        for kept, part in zip(record, parts, strict=True):
            kept[i] = part
    _check(data, times, record)
    return record


def _check(data: mujoco.MjData, times: Array, record: list[Array]) -> None:
    finite = np.all([np.all(np.isfinite(kept), axis=1) for kept in record], axis=0)
    if not np.all(finite):
        raise Diverged(f"not finite from t = {times[np.argmin(finite)]:.4g} s on")
    bad = (
        mujoco.mjtWarning.mjWARN_BADQPOS,
        mujoco.mjtWarning.mjWARN_BADQVEL,
        mujoco.mjtWarning.mjWARN_BADQACC,
    )
    named = [warning.name[len("mjWARN_") :] for warning in bad if data.warning[warning].number]
    if named:
        raise Diverged(f"MuJoCo warns of {', '.join(named)}")


def _read(
    scene: Scene,
    model: mujoco.MjModel,
    times: Array,
    record: list[Array],
    reactions: tuple[str, ...],
) -> Trajectory:
    readout = Readout.of(scene, model)
    states = {name: np.empty((len(times), 6)) for name in scene.bodies}
    found = {name: np.empty(len(times)) for name in reactions}
    for i, t in enumerate(times.tolist()):
        readout.at(t, *(kept[i] for kept in record))
        for name, rows in states.items():
            rows[i] = readout.state(name)
        for name, values in found.items():
            values[i] = readout.reaction(name)
    return Trajectory(times, states, found)


@contextmanager
def signals(scene: Scene) -> Iterator[None]:
    """Sines as controls of their actuators, set by MuJoCo's callback at every RK4 stage.

    A control set between steps would be held during the step: first order, without a warning.
    """
    control = _control(scene)
    if control is None:
        yield
        return
    mujoco.set_mjcb_control(control)
    try:
        yield
    finally:
        mujoco.set_mjcb_control(None)  # it is one for the whole process


def _control(scene: Scene) -> Callable[[mujoco.MjModel, mujoco.MjData], None] | None:
    sines = [
        (i, force.signal.angular_frequency, force.signal.phase)
        for i, force in enumerate(scene.signals())
        if force.signal.law == "sine"
    ]
    if not sines:
        return None

    def control(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        t = data.time
        for i, frequency, phase in sines:
            data.ctrl[i] = math.sin(frequency * t + phase)

    return control
