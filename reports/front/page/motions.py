"""The motions behind the rows: poses to be drawn and curves to be plotted, few digits of each."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ....cases.case import Case
from ....cases.scene.observe import observe
from ....cases.scene.point import CENTER
from ....cases.scene.states import MASS_MATRIX
from ....cases.trajectory import Array, Trajectory
from ....reference.solve import motion_of
from ...runs.suite import Report
from ...runs.trials import Tried
from . import poses
from .digits import few_digits, few_digits_of_each
from .drawing import Drawing, Motion, thinned
from .model_motion import model_motion
from .sketch import extent, reach, sketch

MOST = 64  # times as many poses as samples at most are looked at for the reference to be drawn
HELD = 2  # parts of a sample: an engine's joints would be drawn two pixels more open than they are
TRAIL = 400  # points of what a body has drawn behind it: twenty loops of twenty points


def motions(report: Report) -> dict[str, Motion]:
    """Returns the motion of each case that has and claims one, and of each model with a limit."""
    of: dict[str, list[Tried]] = {}
    for run in report.tried:
        of.setdefault(run.pair.case.name, []).append(run)
    return {
        case.name: motion(case, report.solutions[case.name].trajectory, of.get(case.name, []))
        for case in report.cases
        if case.name in report.solutions and case.states is None
    } | {model.case.name: drawn for model in report.models if (drawn := model_motion(model))}


def way(run: Tried) -> str:
    """Names a way of running a case: `mujoco.tuned.native`."""
    return f"{run.pair.engine.name}.{run.pair.engine.setting}.{run.realised}"


def motion(case: Case, reference: Trajectory, tried: Sequence[Tried]) -> Motion:
    """The drawing, the poses of the reference and of what differs from it, and all curves."""
    scene, size = case.scene, extent(case.scene, reference.states)
    reaches = {name: reach(body) for name, body in scene.bodies.items()}
    drawing = Drawing(scene.frame, size, sketch(scene, size), reaches)
    ran = [run for run in tried if run.outcome.samples]
    times, states = _closely(case, reference, size)
    moves = {**poses.moves(states), **poses.driven(case, times)}
    return drawing.motion(
        "reference",
        drawing.poses(times, moves, poses.CLOSE).rounded(),
        {way(run): _ghost(run, reference.states, case, drawing) for run in ran},
        _curves(case, reference, ran),
        _trail(case, times, states),
    )


def _closely(case: Case, reference: Trajectory, size: float) -> tuple[Array, Mapping[str, Array]]:
    """The motion at its samples, and between them too where they are too few to be drawn."""
    times, states, between = case.times, reference.states, None
    while (
        len(times) < MOST * case.samples and (parts := poses.closer(case, times, states, size)) > 1
    ):
        whole = np.arange(len(times))
        finer = np.linspace(0, len(times) - 1, parts * (len(times) - 1) + 1)
        times = np.interp(finer, whole, times)  # every sample is one of them
        between = between or motion_of(case, forces=False)
        states = between(times).states
    return times, states


def _trail(case: Case, times: Array, moved: Mapping[str, Array]) -> list[list[float]] | None:
    """Returns in space the way of the first place that is observed; None where there is none."""
    n, scene = case.scene.frame.dimension, case.scene
    observed = [name.rpartition(".")[0] for name in case.allow if name.endswith((".x", ".z"))]
    joints = {name: joint.refers()[-1] for name, joint in scene.joints.items()}
    ends = {name: (end.body, "", end.point) for name, end in joints.items()}
    places = [ends.get(of, of.partition(".")) for of in observed]
    of_bodies = [place for place in places if place[0] in scene.bodies]
    if n == 2 or not of_bodies:
        return None
    body, _, point = of_bodies[0]
    states = scene.bodies[body].point(moved[body], point or CENTER)
    fine = np.linspace(times[0], times[-1], TRAIL)
    way = poses.cubic(times, states[:, :n], states[:, n:], fine)  # lines would be a polygon
    return [few_digits(column) for column in way.T]


def _ghost(run: Tried, reference: Mapping[str, Array], case: Case, drawing: Drawing) -> Any:
    """Returns the poses of a run; None where the reference covers them, nothing without any.

    held: whether it is drawn at its samples alone, because nobody knows the way between them.
    """
    own = {body: run.outcome.samples[body] for body in reference if body in run.outcome.samples}
    if not own or not all(np.all(np.isfinite(rows)) for rows in own.values()):
        return {}  # a quantity may be finite where a body is lost
    if not run.outcome.wanted and drawing.covers(own, reference):
        return None
    times, moves = run.pair.sampled.times, poses.moves(own)
    if len(own) == len(reference) and poses.closer(case, times, own, drawing.size) > HELD:
        return {**poses.Poses(times, moves).rounded(), "held": True}
    return drawing.poses(times, moves, poses.GHOST).rounded()


def _curves(case: Case, reference: Trajectory, ran: Sequence[Tried]) -> dict[str, Any]:
    """By quantity, at every sample: the reference, and by how much each engine is off it."""
    kept = thinned(case.samples)
    known, curves = case.quantities, {}
    for name in (name for name in case.allow if name in known and name != MASS_MATRIX):
        samples = observe(case.scene, reference, name)
        wanted = samples if samples.ndim == 1 else np.zeros(len(samples))
        off = {way(run): _curve(run, name, samples) for run in ran if name in run.outcome.samples}
        curves[name] = {
            "reference": few_digits(wanted[kept]),
            "off": {name: curve for name, curve in off.items() if curve is not None},
        }
    return {"times": few_digits(case.times[kept]), "quantities": curves}


def _curve(run: Tried, name: str, reference: Array) -> Any:
    """An engine's samples against the reference's; of attitudes the angle between them."""
    samples = run.outcome.samples[name]
    wanted = run.outcome.wanted.get(name)
    if samples.ndim > 1:
        off = np.linalg.norm(samples, axis=1)
    else:
        off = samples - (reference if wanted is None else wanted)
    kept = thinned(len(off))
    curve = {"curve": few_digits_of_each(off[kept])}
    if wanted is not None:  # its own samples
        values = off if samples.ndim > 1 else samples
        curve |= {
            "times": few_digits(run.pair.sampled.times[kept]),
            "values": few_digits(values[kept]),
        }
    return curve
