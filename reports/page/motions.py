"""The motions behind the rows: poses to be drawn and curves to be plotted, few digits of each."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ...cases.case import Case
from ...cases.scene.frame import SPACE
from ...cases.scene.observe import observe
from ...cases.scene.point import CENTER, GROUND
from ...cases.scene.states import MASS_MATRIX
from ...cases.trajectory import Array, Trajectory
from ..batch.suite import Report
from ..batch.trials import Tried
from ..compare.trial.run import sample_columns
from .pack import Packed, packed, packed_by_size
from .sketch import extent, sketch

FRAMES = 61  # of an animation at most
POINTS = 128  # of a curve at most
TRAIL = 400  # points of what a body has drawn behind it: twenty loops of twenty points
SEEN = 1 / 400  # of what the motion reaches: nearer than that, two drawings are one

Motion = dict[str, Any]


def motions(report: Report) -> dict[str, Motion]:
    """By case, of those that have a reference and claim a motion."""
    of: dict[str, list[Tried]] = {}
    for one in report.tried:
        of.setdefault(one.pair.case.name, []).append(one)
    return {
        case.name: motion(case, report.solutions[case.name].trajectory, of.get(case.name, []))
        for case in report.cases
        if case.name in report.solutions and case.states is None
    }


def way(one: Tried) -> str:
    """`mujoco.tuned.native`."""
    return f"{one.pair.engine.name}.{one.pair.engine.setting}.{one.realised}"


def motion(case: Case, reference: Trajectory, tried: Sequence[Tried]) -> Motion:
    """The drawing, the poses of the reference and of what differs from it, and all curves."""
    poses = sample_columns(reference)
    size = extent(case.scene, poses)
    ran = [one for one in tried if one.outcome.samples]
    frames = thinned(case.samples, FRAMES)
    ghosts = {way(one): _ghost(one, poses, case, size) for one in ran}
    return {
        "axes": case.scene.frame.dimension,
        "size": float(f"{size:.4g}"),
        "sketch": sketch(case.scene, size),
        "times": packed(case.times[frames]),
        "poses": _columns(poses, frames) | _driven(case, frames),
        "trail": _trail(case, reference),
        "ghosts": {name: ghost for name, ghost in ghosts.items() if ghost},
        "covered": sorted(name for name, ghost in ghosts.items() if ghost is None),
        "curves": _curves(case, reference, ran),
    }


def thinned(count: int, most: int) -> Any:
    """Which of so many samples are drawn: evenly, the first and the last among them."""
    return np.unique(np.linspace(0, count - 1, min(count, most)).round().astype(int))


def _trail(case: Case, reference: Trajectory) -> list[Packed] | None:
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
    states = scene.bodies[body].point(reference.states[body], point or CENTER)
    way = between(case.times, states[:, :n], states[:, n:], TRAIL)
    return [packed(column) for column in np.ascontiguousarray(way.T)]


def between(times: Array, places: Array, velocities: Array, count: int) -> Array:
    """Returns (count, n) places evenly in time, by cubics through samples (N, n) and velocities.

    Few samples of a loop would be a polygon.
    """
    fine = np.linspace(times[0], times[-1], count)
    k = np.clip(np.searchsorted(times, fine, side="right") - 1, 0, len(times) - 2)
    h = (times[k + 1] - times[k])[:, None]
    s = (fine - times[k])[:, None] / h
    ends = places[k] * (1 + 2 * s) * (1 - s) ** 2 + places[k + 1] * s**2 * (3 - 2 * s)
    return ends + h * (velocities[k] * s * (1 - s) ** 2 - velocities[k + 1] * s**2 * (1 - s))


def _ghost(one: Tried, poses: Mapping[str, Array], case: Case, size: float) -> Any:
    """Its poses; None where the reference's drawing covers them, nothing where it has none."""
    own = {body: one.outcome.samples[body] for body in poses if body in one.outcome.samples}
    if not own or not all(np.all(np.isfinite(rows)) for rows in own.values()):
        return {}  # a quantity may be finite where a body is lost
    times = one.pair.sampled.times
    frames = thinned(len(times), FRAMES)
    if not one.outcome.wanted and _covered(own, poses, case, size):
        return None
    return {"times": packed(times[frames]), "poses": _columns(own, frames)}


def _covered(own: Mapping[str, Array], poses: Mapping[str, Array], case: Case, size: float) -> bool:
    """Whether no place is off by more than is seen, and no attitude by as much at that size."""
    n = case.scene.frame.dimension
    for body, rows in own.items():
        off, other = rows - poses[body], rows + poses[body]
        turns = np.abs(off[:, n:])
        if n == len(SPACE.axes):  # a quaternion and its opposite are one attitude
            turns = np.minimum(turns.max(axis=1), np.abs(other[:, n:]).max(axis=1))
        if np.max(np.abs(off[:, :n])) > SEEN * size or np.max(turns) > SEEN:
            return False
    return True


def _columns(poses: Mapping[str, Array], frames: Any) -> dict[str, list[Packed]]:
    return {
        body: [packed(column) for column in np.ascontiguousarray(rows[frames].T)]
        for body, rows in poses.items()
    }


def _driven(case: Case, frames: Any) -> dict[str, list[Packed]]:
    """The places of the ground's driven points, which are drawn as bodies without a turn."""
    n = case.scene.frame.dimension
    return {
        f"{GROUND}.{name}": [packed(column) for column in point.states(case.times[frames]).T[:n]]
        for name, point in case.scene.points.items()
        if point.driven
    }


def _curves(case: Case, reference: Trajectory, ran: Sequence[Tried]) -> dict[str, Any]:
    """By quantity, at every sample: the reference, and by how much each engine is off it."""
    kept = thinned(case.samples, POINTS)
    known, found = case.quantities, {}
    for name in (name for name in case.allow if name in known and name != MASS_MATRIX):
        samples = observe(case.scene, reference, name)
        wanted = samples if samples.ndim == 1 else np.zeros(len(samples))
        off = {way(one): _off(one, name, samples) for one in ran if name in one.outcome.samples}
        found[name] = {
            "reference": packed(wanted[kept]),
            "off": {name: curve for name, curve in off.items() if curve is not None},
        }
    return {"times": packed(case.times[kept]), "quantities": found}


def _off(one: Tried, name: str, reference: Array) -> Any:
    """An engine's samples against the reference's; of attitudes the angle between them."""
    samples = one.outcome.samples[name]
    wanted = one.outcome.wanted.get(name)
    if samples.ndim > 1:
        off = np.linalg.norm(samples, axis=1)
    else:
        off = samples - (reference if wanted is None else wanted)
    kept = thinned(len(off), POINTS)
    curve = {"curve": packed_by_size(off[kept])}
    if wanted is not None:  # its own samples
        values = off if samples.ndim > 1 else samples
        curve |= {"times": packed(one.pair.sampled.times[kept]), "values": packed(values[kept])}
    return curve
