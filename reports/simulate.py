"""All runs of a trial: each rung of each ladder once."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from cases.observe import observe
from cases.trajectory import Array
from engines.engine import Diverged
from reports.ladder import Ladder, ladders, wanted_reactions
from reports.trial import Trial

RUNAWAY = 1e6  # × the motion's size: finite, but no motion any more

Samples = Mapping[str, Array]


@dataclass(frozen=True)
class Runs:
    """Samples by ladder and step; `lost` says why the judged step has none."""

    judged: Samples | None
    ladders: Mapping[Ladder, Mapping[float, Samples]]
    lost: str = ""


def simulate(trial: Trial, names: tuple[str, ...]) -> Runs:
    """Runs the engine from the reference's first row. Rungs that diverge are left out."""
    climbed: dict[Ladder, dict[float, Samples]] = {}
    lost = ""
    for ladder in ladders(trial.case, trial.engine):
        climbed[ladder] = {}
        for h in reversed(ladder.steps):
            try:
                climbed[ladder][h] = _run(trial, names, h, ladder.tied_to(h))
            except Diverged as gone:
                climbed[ladder].clear()  # what is coarser than a rung that diverged is no ladder
                if h == trial.step:
                    lost = str(gone)
    judged = next(iter(climbed.values())).get(trial.step)
    return Runs(judged, climbed, lost)


def _run(trial: Trial, names: tuple[str, ...], step: float, tied_to: float) -> Samples:
    scene = trial.case.scene
    trajectory = trial.engine.run(
        scene,
        trial.start,
        trial.case.times,
        step,
        tied_to=tied_to,
        realised=trial.realised,
        reactions=wanted_reactions(scene, names),
    )
    samples = {name: observe(scene, trajectory, name) for name in names}
    for name, values in samples.items():
        size = max(1.0, float(np.max(np.abs(trial.wanted(name)))))
        if not np.all(np.abs(values) < RUNAWAY * size):
            raise Diverged(f"{name} reaches {np.max(np.abs(values)):.1g}")
    return samples
