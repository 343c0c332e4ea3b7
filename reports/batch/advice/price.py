"""Measures what a simulated second of a candidate costs over another's, in CPU time."""

import time

import numpy as np

from ...compare.trial.trial import Trial
from ..search.candidate import Candidate
from ..search.errors import trial_of
from ..tasks import Pair

ROUNDS = 3  # in turn; the least of each counts
LONG = 0.05  # s: what is shorter is run as often as fills it, for its least time to be found


def ratio(pair: Pair, candidate: Candidate, over: Candidate) -> float | None:
    """CPU time of all steps of the candidate's run over the other's; None where one is refused."""
    one, other = (trial_of(pair, each) for each in (candidate, over))
    if one is None or other is None:
        return None
    measured = [(_whole(one), _begun(one), _whole(other), _begun(other)) for _ in range(ROUNDS)]
    mine, built, others, too = (min(column) for column in zip(*measured, strict=True))
    return (mine - built) / (others - too)


def _whole(trial: Trial) -> float:
    return _seconds(trial, trial.case.duration)


def _begun(trial: Trial) -> float:
    """CPU time [s] of building alone, and one step: to be taken off."""
    return _seconds(trial, trial.step)


def _seconds(trial: Trial, end: float) -> float:
    times, spent = np.array([0.0, end]), list[float]()
    while sum(spent) < LONG:
        begun = time.process_time()
        trial.engine.run(trial.case.scene, trial.start, times, trial.step, trial.plan, reactions=())
        spent.append(time.process_time() - begun)
    return min(spent)
