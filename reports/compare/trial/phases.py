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
from numpy.typing import NDArray

from ....cases.case import Case
from ....cases.trajectory import Trajectory
from ....engines.engine import Plan
from ....reference.solve import motion_at
from ..events.timing import Timing, timing
from .run import Samples, climbed
from .simulate import fairly, rung
from .start import first
from .trial import Trial, planned

PARTS = (0.25, 0.5, 0.75)  # of a step, by which the engine begins later
STARTS = len(PARTS) + 1


class Begun(NamedTuple):
    """A trial that begins somewhere within a step, and what its run gave."""

    trial: Trial
    samples: Samples


def moves(trial: Trial) -> bool:
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
            case = replace(trial.case, late=late)
            reference, timed = _from(trial, case)
            begins = first(reference)
            ways = planned(trial.engine, case.scene.later(late), begins)
            for way in ways:
                if way.realised == trial.realised and isinstance(way, Plan):
                    plan = replace(way, withheld=trial.plan.withheld, kept=trial.plan.kept)
                    yield replace(trial, case=case, reference=reference, way=plan, timed=timed)


def _from(trial: Trial, case: Case) -> tuple[Trajectory, Timing]:
    """The reference at the case's samples, of which the first is later than the start."""
    if case.late not in trial.timing.later:
        motion = motion_at(case, np.append(0.0, case.times))
        record = motion.record and _rows(motion.record, motion.record.times >= case.late)
        reference = replace(_rows(motion, motion.times > 0.0), record=record)
        trial.timing.later[case.late] = reference, timing(case, reference)
    return trial.timing.later[case.late]


def _rows(motion: Trajectory, rows: NDArray[np.bool_]) -> Trajectory:
    return replace(
        motion,
        times=motion.times[rows],
        states={name: states[rows] for name, states in motion.states.items()},
        reactions={name: values[rows] for name, values in motion.reactions.items()},
        near={name: turns[rows] for name, turns in motion.near.items()},
        phase=None if motion.phase is None else motion.phase[rows],
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
        return moves(self.trial)

    @cached_property
    def _made(self) -> dict[tuple[float, float | None], list[Begun | str]]:
        return {}


def _run(trial: Trial, step: float) -> Begun | str:
    samples = climbed(rung(trial, step))
    return samples if isinstance(samples, str) else Begun(trial, fairly(trial, samples, step))
