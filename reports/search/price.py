"""What a simulated second of a candidate costs beside another, in CPU time."""

import time

from ..trial.rung import climbed
from ..trial.simulate import rung
from ..trial.trial import Trial
from ..unit import Pair
from .candidate import Candidate
from .errors import trial_of

ROUNDS = 5  # in turn; the least of each counts
LONG = 0.05  # s of CPU time: what is shorter is run as often as makes it so long


def ratio(pair: Pair, candidate: Candidate, over: Candidate) -> float | None:
    """Of the candidate's run over the other's, both with all that is read; None: one is refused."""
    one, other = (trial_of(pair, each) for each in (candidate, over))
    if one is None or other is None:
        return None
    measured = [(_seconds(one), _seconds(other)) for _ in range(ROUNDS)]
    return min(mine for mine, _ in measured) / min(others for _, others in measured)


def _seconds(one: Trial) -> float:
    asked, times = rung(one, one.step), list[float]()
    while sum(times) < LONG:
        begun = time.process_time()
        climbed(asked)
        times.append(time.process_time() - begun)
    return min(times)
