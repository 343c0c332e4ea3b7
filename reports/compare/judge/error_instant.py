"""Where in time an error is: all along a motion, or at an instant, which tells nothing of a model.

A contact that is not yet closed has no force at the first sample; beside an impact one of the two
is before it and the other behind it.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....cases.trajectory import Array
from ..trial.trial import Trial
from .convergence import FEWEST
from .metric import Error, largest

BESIDE = 4  # steps: within so many an engine sees an impact, an onset, a stop
ELSEWHERE = 0.5  # of the largest error: if it is nowhere else so large, the instant is its place
TOGETHER = 1e-9  # s: an event and a switch of the reference that are the same


@dataclass(frozen=True)
class Moment:
    """An instant in words, and the samples (N,) that are not beside any."""

    words: str
    elsewhere: NDArray[np.bool_]


def moment(trial: Trial, samples: Array, wanted: Array, error: Error) -> Moment | None:
    """The instant at which alone the error is so large, or None."""
    words = _words(trial, float(trial.case.times[error.at]))
    elsewhere = away_from_instants(trial)
    if words is None or np.count_nonzero(elsewhere) < FEWEST:
        return None
    others = largest((samples - wanted)[elsewhere])
    return Moment(words, elsewhere) if others <= ELSEWHERE * error.largest else None


def away_from_instants(trial: Trial) -> NDArray[np.bool_]:
    """The samples (N,) that are beside neither the start nor what happens in the reference."""
    beside = BESIDE * trial.step
    elsewhere = trial.away(beside) & (trial.case.times >= beside - TOGETHER)
    elsewhere[0] = False
    return elsewhere


def _words(trial: Trial, t: float) -> str | None:
    """Names the first sample, or the event within a few steps of t [s]."""
    if t == 0.0:
        return "the first sample"
    near = [s for s in trial.reference.switches if abs(s - t) < BESIDE * trial.step]
    if not near:
        return "beside the start" if t < BESIDE * trial.step - TOGETHER else None
    switch = min(near, key=lambda s: abs(s - t))
    named = (name for name, times in trial.timing.events.items() if _among(switch, times))
    return f"beside {next(named, 'a switch')} at {switch:.4g} s"


def _among(t: float, times: Array) -> bool:
    return bool(np.min(np.abs(times - t), initial=np.inf) < TOGETHER)
