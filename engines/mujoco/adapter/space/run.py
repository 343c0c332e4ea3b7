"""Stepping MuJoCo in space: its own loop between samples, everything read later."""

from functools import cache

import mujoco
import numpy as np

from .....cases.scene import Scene
from .....cases.trajectory import Array, Trajectory
from ....engine import Realised, Start
from ...callbacks.signal import Corners, following, listening, together
from ...callbacks.space.edge import edges
from ...callbacks.stepping import Steps
from ...model.space.drive import drives
from ...model.space.edge import fields
from ...model.space.scene import signals
from ...model.spatial_tree import spanning_tree
from ...read.record import Counts, Record, all_steps, counted, sampled, whole
from ...read.space.reaction import ABOUT, acting, contact_force, effort, joint_wrench
from ...read.space.seen import EDGES, JOINTS, LOOPS, TOUCHING, Seen, recorded_arrays, states
from ..run import check

_WRENCH = ("fx", "fy", "fz", "mx", "my", "mz")


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
    touching = tuple(name for name in reactions if name.partition(".")[0] in scene.contacts)
    laws = edges(scene, model) if realised == "law" else []
    corners = Corners(signals(scene), float(model.opt.timestep))
    controls = [following(signals(scene), corners), *laws]
    with listening() as warnings, together(controls):
        if every and not corners.any:
            record = whole(model, data, len(grid))
        else:
            record = _sampled(model, data, np.arange(len(grid)) if every else counts, corners)
        check(warnings, grid, record)
        rows = record.at(counts) if every else record
        known = recorded_arrays(model, data, times, rows, _needed(scene, reactions))
        alone = record.felt is None  # our loop kept it, and not MuJoCo's, which keeps its sensors
        each = (
            recorded_arrays(model, data, grid, record, {*TOUCHING} if alone else set())
            if every
            else known
        )
        check(warnings, grid, record)
    forces = read(scene, model, known, reactions)
    found = states(scene, model, each, start)
    if not every:
        return Trajectory(times, found, forces)
    floor = each["sensordata"] if record.felt is None else record.felt
    felt = {name: contact_force(scene, name, floor) for name in touching}
    phase = np.zeros(len(grid), dtype=np.int64)  # an engine does not say when one ends
    samples = {name: rows[counts] for name, rows in found.items()}
    return Trajectory(times, samples, forces, record=Trajectory(grid, found, felt, phase=phase))


def _sampled(
    model: mujoco.MjModel, data: mujoco.MjData, counts: Counts, corners: Corners
) -> Record:
    take = corners.held(lambda n: mujoco.mj_step(model, data, n))
    return sampled(data, counts, Steps(model, data, [], take))


def _needed(scene: Scene, reactions: tuple[str, ...]) -> set[str]:
    """Which of MuJoCo's arrays."""
    loops = spanning_tree(scene).loops
    names: set[str] = set()
    for name in reactions:
        part = name.partition(".")[0]
        if part in scene.constraints:
            names |= {*EDGES}
        elif part not in scene.joints:
            names |= {*TOUCHING}
        else:
            names |= {*LOOPS} if scene.joints[part] in loops else {*JOINTS, *ABOUT}
    return names


def read(
    scene: Scene, model: mujoco.MjModel, known: Seen, reactions: tuple[str, ...]
) -> dict[str, Array]:
    """The wanted reactions (N,)."""
    tree = spanning_tree(scene)
    driving = {drive.quantity: drive for drive in drives(scene)}
    forward = {branch.joint.name: branch.forward for branch in tree.branches if branch.joint}
    wrench = cache(lambda part: joint_wrench(scene, tree, model, known, scene.joints[part]))
    found: dict[str, Array] = {}
    for name in reactions:
        part, _, field = name.partition(".")
        if name in driving:
            whole = effort(model, known, driving[name], forward[part], wrench(part))
            found[name] = whole - acting(scene, model, known, driving[name])
        elif part in scene.constraints:
            found[name] = known["userdata"][:, fields(scene).index(name)]
        elif part in scene.joints:
            found[name] = wrench(part)[:, _WRENCH.index(field)]
        else:
            found[name] = contact_force(scene, name, known["sensordata"])
    return found
