"""Makes the runs of a trial: each rung of each ladder once."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from .impacts import beside, fair
from .ladder import Ladder, ladders
from .run import Climbed, Rung, Samples, climbed
from .trial import Trial

RUNAWAY = 1e6  # × the motion's size: finite, but no motion any more

At = tuple[str, float]
"""A ladder's name and a step [s]: where a rung belongs."""


@dataclass(frozen=True)
class Runs:
    """Samples and `event.time`s, of the judged step as read, by ladder and step as compared.

    lost: why the judged step has none. finer: why a smaller one has none, if it is a user's own.
    """

    judged: Samples | None
    ladders: Mapping[Ladder, Mapping[float, Samples]]
    lost: str = ""
    finer: str = ""


def rungs(trial: Trial) -> dict[At, Rung]:
    """Every run of the trial, by ladder and step, from the reference's first row."""
    case, engine, start, bounds = trial.case, trial.engine, trial.start, _bounds(trial)
    climbs = list(ladders(case, engine, trial.plan))
    return {
        (ladder.name, h): Rung(
            case,
            engine,
            start,
            ladder.plan(trial.plan),
            h,
            bounds,
            poses=ladder is climbs[0] and h == trial.step,  # the judged run is looked at
            fastest=trial.reference.fastest,
            events=trial.timing.known(h),
        )
        for ladder in climbs
        for h in reversed(ladder.steps)
    }


def rung(trial: Trial, step: float) -> Rung:
    """One run at a step [s], which the numbers of its plan follow."""
    return Rung(
        trial.case, trial.engine, trial.start, trial.plan, step, _bounds(trial),
        fastest=trial.reference.fastest, events=trial.timing.known(step),
    )  # fmt: skip


def _bounds(trial: Trial) -> dict[str, float]:
    """For each quantity of the motion: the bound that its numbers stay below."""
    return {
        name: RUNAWAY * max(1.0, float(np.max(np.abs(trial.wanted(name))))) for name in trial.motion
    }


def gathered(trial: Trial, climbed: Mapping[At, Climbed]) -> Runs:
    """The rungs by their ladders.

    Rungs that diverge are left out, and what is coarser than they are; the judged run stays.
    """
    judged: Samples | None = None
    kept: dict[Ladder, dict[float, Samples]] = {}
    lost = finer = ""
    for ladder in ladders(trial.case, trial.engine, trial.plan):
        kept[ladder] = {}
        for h in reversed(ladder.steps):
            samples = climbed[ladder.name, h]
            if isinstance(samples, str):
                kept[ladder].clear()
                if h < trial.step:
                    finer = f"h = {h:.3g} s: {samples}"
                elif h == trial.step:
                    lost = lost or samples
            else:
                samples = read(trial, samples)
                kept[ladder][h] = fairly(trial, samples, h)
                if h == trial.step and len(kept) == 1:  # the plan's first ladder is judged
                    judged = samples
    return Runs(judged, kept, lost, finer)


def read(trial: Trial, samples: Samples) -> Samples:
    """Returns a run's samples beside the reference's: of attitudes the turns from those."""
    return {name: trial.read(name, rows) for name, rows in samples.items()}


def fairly(trial: Trial, samples: Samples, step: float) -> Samples:
    """Returns samples that were read at a step [s] as they are compared: beside impacts fairly."""
    if not beside(trial, step):
        return samples
    motion = {name: fair(trial, name, samples[name], step) for name in trial.motion}
    return {**samples, **motion}


def simulate(trial: Trial) -> Runs:
    """Runs every rung, one after the other, and gathers them by ladder."""
    return gathered(trial, {at: climbed(rung) for at, rung in rungs(trial).items()})
