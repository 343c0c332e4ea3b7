"""One simulation: a case in an engine with given options at a given step, and how far off it is."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from math import inf, isnan

import numpy as np

from ....cases.trajectory import Array
from ....engines.engine import Engine, Plan
from ...compare.judge import metric
from ...compare.judge.error_instant import away_from_instants
from ...compare.trial.limit import limit
from ...compare.trial.phases import STARTS, Begun, Phases
from ...compare.trial.run import Samples, climbed
from ...compare.trial.simulate import fairly, read, rung
from ...compare.trial.start import first
from ...compare.trial.trial import Trial, judged_names, planned
from ...compare.trial.work import pace
from ...runs.tasks import Pair
from .candidate import Candidate

Errors = Mapping[str, tuple[float, float]]
"""By quantity the largest error over what is allowed: of all samples, and of those that are not
beside any instant (of events the same). What has none is not in it: see `of`."""


@dataclass(frozen=True)
class Run:
    """pair: the case with the samples that its engine's own step meets, and that engine."""

    pair: Pair
    candidate: Candidate

    @property
    def name(self) -> str:
        """The name that progress shows."""
        return f"{self.pair.case.name} in {self.pair.engine.name}"

    @property
    def engine(self) -> Engine:
        """The engine with the candidate's options."""
        return self.pair.engine

    @property
    def limit(self) -> float:
        """The time [s] that the engine and, before it, a reference may take."""
        steps = self.pair.case.duration / self.candidate.step
        return self.pair.limit + limit(STARTS * steps * pace(self.pair.case, self.pair.engine))


def of(errors: Errors, name: str, *, elsewhere: bool = False) -> float:
    """Returns the error of a quantity; inf where the run diverged, was refused, or lacks it."""
    return errors[name][elsewhere] if name in errors else inf


def trial_of(pair: Pair, candidate: Candidate) -> Trial | None:
    """The candidate's native way before the pair's reference; None where it is refused."""
    engine, reference = candidate.on(pair.shapes).engine(pair.engine.name), pair.reference()
    ways = planned(engine, pair.case.scene, first(reference))
    way = next(way for way in ways if way.realised == "native")
    if not isinstance(way, Plan):
        return None
    return Trial(pair.case, reference, engine, way, timed=pair.timing(reference))


def errors(run: Run) -> Errors:
    """The errors of everything that is judged, of the worst start within a step.

    The pair's reference comes from the store.
    """
    trial, step = trial_of(run.pair, run.candidate), run.candidate.step
    samples = climbed(rung(trial, step)) if trial else ""
    if trial is None or isinstance(samples, str):
        return {}
    worst = _errors(run, Begun(trial, fairly(trial, read(trial, samples), step)))
    for later in Phases(trial).at(step):
        other = {} if isinstance(later, str) else _errors(run, later)
        worst = {
            name: (max(worst[name][0], other[name][0]), max(worst[name][1], other[name][1]))
            for name in worst
            if name in other
        }
    return worst


def _errors(run: Run, begun: Begun) -> Errors:
    trial, samples = begun
    differences = {name: _differences(trial, name, samples) for name in judged_names(run.pair.case)}
    elsewhere = away_from_instants(replace(trial, engine=run.pair.engine))
    return {
        name: (_ratio(trial, name, off), _ratio(trial, name, off[elsewhere]))
        if name in trial.motion
        else (_ratio(trial, name, off), _ratio(trial, name, off))
        for name, off in differences.items()
        if off is not None
    }


def _differences(trial: Trial, name: str, samples: Samples) -> Array | None:
    """The differences (N,), at events (K,), of a count (1,); None where there is none to take."""
    if name in trial.withheld:
        return None
    event, timing = trial.quantity(name).part, trial.timing
    if trial.quantity(name).field == "count" and name in trial.instants:
        times = samples.get(f"{event}.time")
        if times is None:
            return None
        off = timing.miscounted(event, len(times), trial.step)
        return None if off is None else np.array([off])
    if name not in samples:
        return None
    wanted, count = trial.wanted(name), len(samples[name])
    dated = event in timing.events and count < len(wanted)
    if dated and timing.miscounted(event, count, trial.step) is None:  # such steps tell no more
        wanted = wanted[timing.partners(event, samples[f"{event}.time"])]
    if count != len(wanted):  # another count: which belongs to which?
        return np.array([inf])
    return metric.sizes(samples[name] - wanted)


def _ratio(trial: Trial, name: str, off: Array) -> float:
    allowed = trial.allowed(name)
    if allowed is None:
        return inf
    largest = float(np.max(off, initial=0.0))
    return inf if isnan(largest) else largest / allowed
