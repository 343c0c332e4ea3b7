"""Every step of a run, from which event times are read."""

from collections.abc import Sequence
from dataclasses import replace

import mujoco
import numpy as np

from ....cases.scene import Scene
from ....cases.trajectory import Array, Trajectory
from ...engine import Start
from .poses import poses


def all_steps(times: Array, step: float) -> Array:
    """The time of every step up to the last sample; each a product, for sums drift."""
    return np.arange(round(times[-1] / step) + 1) * step


def recorded(
    scene: Scene,
    model: mujoco.MjModel,
    trajectory: Trajectory,
    times: Array,
    record: Sequence[Array],  # positions and velocities, then what is not needed here
    start: Start,
) -> Trajectory:
    """The trajectory with its record; an engine does not say when a phase ends."""
    qpos, qvel, *_ = record
    states = poses(scene, model, qpos, qvel, start)
    phase = np.zeros(len(times), dtype=np.int64)
    return replace(trajectory, record=Trajectory(times, states, {}, phase=phase))
