"""All runs of a trial: each rung of each ladder once."""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass

import numpy as np

from ...cases.observe import observe
from ...cases.trajectory import Array, Trajectory
from ...engines.engine import Diverged, Plan
from ..events.times import engine_events
from .ladder import Ladder, ladders, wanted_reactions
from .trial import Trial

RUNAWAY = 1e6  # × the motion's size: finite, but no motion any more

Samples = Mapping[str, Array]


@dataclass(frozen=True)
class Runs:
    """Samples and `event.time`s, of the judged step and by ladder and step.

    lost: why the judged step has none. finer: why a smaller one has none, if it is a user's own.
    """

    judged: Samples | None
    ladders: Mapping[Ladder, Mapping[float, Samples]]
    lost: str = ""
    finer: str = ""


def simulate(trial: Trial, names: tuple[str, ...]) -> Runs:
    """Runs the engine from the reference's first row.

    Rungs that diverge are left out, and what is coarser than they are; the judged run stays.
    """
    judged: Samples | None = None
    climbed: dict[Ladder, dict[float, Samples]] = {}
    lost = finer = ""
    for ladder in ladders(trial.case, trial.engine, trial.plan):
        climbed[ladder] = {}
        plan = ladder.plan(trial.plan)
        for h in reversed(ladder.steps):
            try:
                climbed[ladder][h] = _run(trial, names, h, plan)
            except Diverged as gone:
                climbed[ladder].clear()
                if h < trial.step:
                    finer = f"h = {h:.3g} s: {gone}"
                elif h == trial.step:
                    lost = lost or str(gone)
            else:
                if h == trial.step and len(climbed) == 1:  # the plan's first ladder is judged
                    judged = climbed[ladder][h]
    return Runs(judged, climbed, lost, finer)


def _run(trial: Trial, names: tuple[str, ...], step: float, plan: Plan) -> Samples:
    scene, events = trial.case.scene, trial.case.events
    wanted = dict.fromkeys((*names, *(event.quantity for event in events.values())))
    trajectory = trial.engine.run(
        scene,
        trial.start,
        trial.case.times,
        step,
        plan,
        reactions=wanted_reactions(scene, wanted),
        record=bool(events),
    )
    samples = {name: observe(scene, trajectory, name) for name in names}
    for name, values in samples.items():
        size = max(1.0, float(np.max(np.abs(trial.wanted(name)))))
        if not np.all(np.abs(values) < RUNAWAY * size):
            raise Diverged(f"{name} reaches {np.max(np.abs(values)):.1g}")
    return {**samples, **_events(trial, trajectory)}


def _events(trial: Trial, trajectory: Trajectory) -> Samples:
    """Times (K,) of every event that can be read from the engine's record, as `event.time`."""
    found = {}
    for name, event in trial.case.events.items():
        if trajectory.record is not None:
            with suppress(KeyError):  # a reaction that is not recorded at every step
                times = engine_events(trial.case.scene, trajectory.record, event)
                found[f"{name}.time"] = times
    return found
