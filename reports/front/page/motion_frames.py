"""The motions of a case as frames, by time: the reference's, and every engine's."""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pandas as pd

from ....cases.case import Case
from ....cases.scene.difference import deviation
from ....cases.scene.observe import observe
from ....cases.scene.states import MASS_MATRIX
from ....cases.trajectory import Array, Trajectory
from ...compare.own_rows import Modelled
from ...runs.suite import Report
from ...runs.trials import Tried
from .drawing import LIMIT

POSES = ("x", "y", "z", "angle")
REFERENCE = ("reference", "", "")  # no setting, and no way to realise one
RIGHT = (REFERENCE, (LIMIT, "", ""))
"""How the motion is called that engines are held against: of a model its limit."""
BY = ("engine", "setting", "realised")


def reference_frame(case: Case, trajectory: Trajectory) -> pd.DataFrame:
    """By time [s], or by the number of a state: what the case bounds, and where its bodies are.

    Of an attitude the angle [rad] from where it began.
    """
    columns = {name: _seen(observe(case.scene, trajectory, name)) for name in names(case)}
    return _framed(case, case.times, columns)


def _framed(case: Case, times: Array, columns: Mapping[str, Array]) -> pd.DataFrame:
    frame = pd.DataFrame(columns, index=_index(case, times))
    frame.attrs["units"] = {name: case.quantities[name].unit for name in columns}
    return frame


def names(case: Case) -> list[str]:
    """The columns: what is bounded first."""
    known = case.quantities
    bounded = [name for name in case.allow if name in known and name != MASS_MATRIX]
    poses = [f"{body}.{pose}" for body in case.scene.bodies for pose in POSES]
    return list(dict.fromkeys([*bounded, *(name for name in poses if name in known)]))


def motion_frames(report: Report) -> dict[str, pd.DataFrame]:
    """By case one frame, by engine, setting, way and time; the reference is called `reference`.

    Its columns are the reference's. Empty is what an engine does not answer.
    """
    of: dict[str, list[Tried]] = {}
    for run in report.tried:
        of.setdefault(run.pair.case.name, []).append(run)
    by_case: dict[str, pd.DataFrame] = {}
    for case in report.cases:
        if case.name in report.solutions:
            frames = dict(_frames(report, case, of.get(case.name, [])))
            by_case[case.name] = pd.concat(frames, names=list(BY)).sort_index()
    return by_case | {
        model.case.name: pd.concat(dict(_model_frames(model)), names=list(BY)).sort_index()
        for model in report.models
        if model.steps is not None
    }


def _model_frames(model: Modelled) -> Iterator[tuple[tuple[str, str, str], pd.DataFrame]]:
    """The coordinates of a user's model: of its limit, in a reference's place, and of its steps."""
    assert model.steps is not None
    limit, names = model.steps.limit, [name for name, _ in model.coordinates]
    motions = {RIGHT[1]: limit.q} | {
        ("mujoco", each.setting.name, "native"): each.y[:, : len(names)]
        for each in model.steps.settings
        if each.y is not None
    }
    for way, q in motions.items():
        frame = pd.DataFrame(q, columns=names, index=pd.Index(limit.times, name="t"))
        frame.attrs["units"] = dict(model.coordinates)
        frame.attrs["until"] = model.steps.until if model.steps.late else None
        yield way, frame


def _frames(
    report: Report, case: Case, tried: list[Tried]
) -> Iterator[tuple[tuple[str, str, str], pd.DataFrame]]:
    yield REFERENCE, reference_frame(case, report.solutions[case.name].trajectory)
    for run in tried:
        if run.outcome.samples:
            engine = run.pair.engine
            yield (engine.name, engine.setting, run.realised), _engine_frame(case, run)


def _engine_frame(case: Case, run: Tried) -> pd.DataFrame:
    samples, times = run.outcome.samples, run.pair.sampled.times
    states = {body: samples[body] for body in case.scene.bodies if body in samples}
    columns: dict[str, Array] = {}
    for name in names(case):
        values = samples.get(name)
        if values is None or values.shape != times.shape:  # an attitude is judged by its turn off
            values = _of_states(case, times, states, name)
        columns[name] = np.full(len(times), np.nan) if values is None else values
    return _framed(case, times, columns)


def _of_states(case: Case, times: Array, states: Mapping[str, Array], name: str) -> Array | None:
    if len(states) < len(case.scene.bodies):
        return None
    try:
        return _seen(observe(case.scene, Trajectory(times, states, {}), name))
    except KeyError:  # a force, which the states do not tell
        return None


def _seen(samples: Array) -> Any:
    return samples if samples.ndim == 1 else deviation(samples, samples[:1])


def _index(case: Case, times: Array) -> pd.Index:
    return pd.Index(times, name="t" if case.states is None else "state")
