"""Stepping MuJoCo: its own loop between samples, one record a sample, everything read later."""

import mujoco
import numpy as np

from ....cases.scene import Scene
from ....cases.trajectory import Array, Trajectory
from ...engine import Diverged, Realised, Start
from ..callbacks.point_forces import activations, point_force_callbacks, rated
from ..callbacks.signal import Corners, listening, signals
from ..model.drive import controls
from ..read.poses import poses
from ..read.reaction import felt_force
from ..read.readout import read
from ..read.record import Record, all_steps, counted, sampled, whole
from .plans import STEPPERS


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
    """The motion at the times, whole multiples of the model's step from 0.

    every: all steps too, with the contacts' forces at each. Raises Diverged, or ValueError for
    other times.
    """
    counts = counted(times, model.opt.timestep)
    grid = all_steps(times, model.opt.timestep) if every else times
    steps = STEPPERS[realised](scene, model, data)
    laws = [*steps.controls, *point_force_callbacks(scene, model)]
    felt_by = {*scene.contacts, *scene.pairs, *(limit.name for limit in scene.limits())}
    touching = tuple(name for name in reactions if name.partition(".")[0] in felt_by)
    corners = Corners(controls(scene), float(model.opt.timestep))
    steps.take = corners.apart(steps.take)
    with listening() as warnings, rated(scene, model), signals(scene, laws, corners):
        steps.begin()
        if every and steps.alone and not corners.any:
            record = whole(model, data, len(grid))
        else:
            record = sampled(data, np.arange(len(grid)) if every else counts, steps)
        check(warnings, grid, record)
        each: dict[str, Array] = {}
        if record.felt is not None:
            each = {name: felt_force(scene, model, name, record.felt) for name in touching}
        elif every:
            each = read(scene, model, data, grid, record, touching, steps.recall)
        rows = record
        if every:
            rows = record.at(counts)
            steps.keep(counts)
        inner = activations(scene, model, rows.act)
        felt = tuple(name for name in reactions if name not in inner)
        forces = read(scene, model, data, times, rows, felt, steps.recall) | inner
        check(warnings, grid, record)
    states = poses(scene, model, data, record, start)
    if not every:
        return Trajectory(times, states, forces)
    phase = np.zeros(len(grid), dtype=np.int64)  # an engine does not say when one ends
    whole_run = Trajectory(grid, states, each, phase=phase)
    samples = {name: rows[counts] for name, rows in states.items()}
    return Trajectory(times, samples, forces, record=whole_run)


def check(warnings: list[str], times: Array, record: Record) -> None:
    """Raises Diverged."""
    finite = np.all(np.isfinite(record.qpos), axis=1) & np.all(np.isfinite(record.qvel), axis=1)
    if warnings:
        raise Diverged(f"MuJoCo warns: {' '.join(warnings[0].split())}")
    if not np.all(finite):
        raise Diverged(f"not finite from t = {times[np.argmin(finite)]:.4g} s on")
