"""An impact falls anywhere within a step: the same motion, begun parts of a step later.

An engine that sees an impact at the end of a step h goes on for what is left of that step. A body
that strikes at v and leaves at e v is then wrong by up to (1 + e) v h ever after, and by nothing if
the impact falls on the end of a step. So each start is luck: of some, spread evenly over a step,
the worst counts.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ....cases.trajectory import Trajectory
from ....engines.engine import Plan
from ..events.timing import Timing
from .run import Samples, climbed
from .simulate import fairly, read, rung
from .trial import Trial, planned

PARTS = (0.25, 0.5, 0.75)  # of a step, by which the engine begins later
STARTS = len(PARTS) + 1


class Begun(NamedTuple):
    """A trial that begins somewhere within a step, and what its run gave."""

    trial: Trial
    samples: Samples


def start_can_move(trial: Trial) -> bool:
    """Whether something strikes in the reference, and its start can be moved along the motion."""
    scene = trial.case.scene
    still = not any(point.driven for point in scene.points.values())
    return trial.reference.blows.size > 0 and not scene.inner() and still


def begun_later(trial: Trial, step: float) -> Iterator[Trial]:
    """Yields the trial begun each of the parts of a step [s] later, where the engine can begin.

    Not beside where the reference switches: what has only just begun may be begun otherwise.
    """
    switches = trial.reference.switches
    quiet = float(np.min(switches[switches > 0.0], initial=trial.case.duration))
    for part in PARTS:
        late = part * step
        if late + step < quiet:
            other = _later(trial, late)
            ways = planned(trial.engine, other.case.scene.later(late), other.start)
            for way in ways:
                if way.realised == trial.realised and isinstance(way, Plan):
                    plan = replace(way, withheld=trial.plan.withheld, kept=trial.plan.kept)
                    yield replace(other, way=plan)


def _later(trial: Trial, late: float) -> Trial:
    """The trial with the same motion at samples so much [s] later, but for the last."""
    case, timed = trial.case, trial.timing
    if late not in timed.later:
        other = replace(
            case, late=late, samples=case.samples - 1, duration=case.duration - case.interval
        )
        motion = timed.motion(other.times)
        motion = replace(motion, record=timed.record and _from(timed.record, motion))
        timed.later[late] = other, motion, Timing(other, motion.record)
    other, motion, since = timed.later[late]
    return replace(trial, case=other, reference=motion, timed=since)


def _from(record: Trajectory, motion: Trajectory) -> Trajectory:
    """The record from the motion's first sample to its last."""
    begins, ends = motion.times[0], motion.times[-1]
    inside = (record.times > begins) & (record.times <= ends)
    phase = np.zeros(0, dtype=np.int64) if record.phase is None else record.phase
    assert motion.phase is not None
    return replace(
        record,
        times=np.append(begins, record.times[inside]),
        states={
            name: np.vstack([motion.states[name][:1], states[inside]])
            for name, states in record.states.items()
        },
        reactions={
            name: np.append(motion.reactions[name][:1], values[inside])
            for name, values in record.reactions.items()
        },
        near={
            name: np.vstack([motion.near[name][:1], turns[inside]])
            for name, turns in record.near.items()
        },
        phase=np.append(motion.phase[:1], phase[inside]),
    )


@dataclass(frozen=True)
class Phases:
    """The runs of a trial at any step, begun at parts of that step, each made once."""

    trial: Trial

    def at(self, step: float, kept: float | None = None) -> Sequence[Begun | str]:
        """The runs begun later, or in words why one has no samples; kept: as of the plan."""
        if (step, kept) not in self._made:
            trial = replace(self.trial, way=replace(self.trial.plan, kept=kept))
            later = begun_later(trial, step) if self.moved else ()
            self._made[step, kept] = [_run(other, step) for other in later]
        return self._made[step, kept]

    @cached_property
    def moved(self) -> bool:
        """Whether there are any."""
        return start_can_move(self.trial)

    @cached_property
    def _made(self) -> dict[tuple[float, float | None], list[Begun | str]]:
        return {}


def _run(trial: Trial, step: float) -> Begun | str:
    samples = climbed(rung(trial, step))
    return (
        samples
        if isinstance(samples, str)
        else Begun(trial, fairly(trial, read(trial, samples), step))
    )
