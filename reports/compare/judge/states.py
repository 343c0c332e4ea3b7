"""Rows of a claim about states: no step, no order, and nothing that happens at a time."""

from ...data.row import UNSETTLED, Comparison
from ..trial.run import Samples
from ..trial.trial import Trial
from . import metric
from .convergence import Convergence
from .metric import floor, round_to_floor
from .rows import row
from .verdict import verdict


def judged(trial: Trial, name: str, samples: Samples) -> Comparison:
    """The quantity's row, judged by its largest difference over all states."""
    error = metric.error(samples[name], trial.wanted(name))
    least, allowed = floor(trial, name, trial.case.duration), trial.allowed(name)
    largest = round_to_floor(error.largest, least)
    why = f"largest in state {error.at + 1}" if samples[name].size == trial.case.samples else ""
    word, because = verdict(trial, name, error.largest, Convergence(UNSETTLED, {}, None), why)
    return row(
        trial,
        name,
        word,
        error=largest,
        rms=round_to_floor(error.rms, least),
        ratio=None if allowed is None else largest / allowed,
        because=because,
    )
