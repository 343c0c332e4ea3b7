"""Units of work, small enough to be sent anywhere: a case's ways, one run, a pair's rows."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import lru_cache
from typing import Any

from ...cases.case import Case
from ...cases.language.check.work import LIMIT
from ...cases.mistake import CaseError
from ...cases.trajectory import Trajectory
from ...engines.engine import Engine, Plan, Realised, Refusal
from ...engines.knobs import Options
from ...reference.solve import Solution, solve
from ..compare.events.timing import Timing, timing
from ..compare.judge.compare import Outcome, answered, compare
from ..compare.judge.uncertified import failing, uncertified
from ..compare.trial import states
from ..compare.trial.ladder import sampled
from ..compare.trial.limit import limit
from ..compare.trial.run import Climbed, Rung
from ..compare.trial.simulate import At, gathered, rungs
from ..compare.trial.start import first
from ..compare.trial.trial import Trial, ways, with_room
from .cache.store import Store

AT_HAND = 8  # references that a process remembers: it meets the ways of one case one after another

Way = Plan | Refusal


@dataclass(frozen=True)
class Pair:
    """An engine and a case, whose reference lies in the store under its key.

    shapes: own options of the engine under which a search tries all others: see `Plain`.
    """

    case: Case
    engine: Engine
    store: Store
    key: str
    shapes: Options = field(default_factory=dict[str, Any])

    @property
    def name(self) -> str:
        """The name that progress shows."""
        return f"{self.case.name} in {self.engine.name}.{self.engine.setting}"

    @property
    def limit(self) -> float:
        """The time [s] that the engine may take to plan."""
        return limit()

    def reference(self) -> Trajectory:
        """Returns the stored reference; solves it anew where the store has none."""
        return _at_hand(self.store, self.key) or solve(self.case).trajectory

    def timing(self, reference: Trajectory) -> Timing:
        """The events in the reference, read once for all engines that a process meets here."""
        read = _timings(self.store, self.key)
        if not read:
            read.append(timing(self.case, reference))
        return read[0]

    @property
    def sampled(self) -> Case:
        """The case with the samples that the engine's own step meets."""
        return sampled(self.case, self.engine)


@dataclass(frozen=True)
class Unit:
    """One of the ways in which the engine runs the case, or refuses to."""

    pair: Pair
    way: Way

    @property
    def realised(self) -> Realised:
        """`native`, `law` or `driver`."""
        return self.way.realised

    def rungs(self, reference: Trajectory) -> dict[At, Rung]:
        """The unit's runs, each on its own; the reference of the case's own samples will do."""
        if isinstance(self.way, Refusal):
            return {}
        pair, timed = self.pair, self.pair.timing(reference)
        trial = Trial(pair.sampled, reference, pair.engine, self.way, timed=timed)
        return rungs(trial) if trial.case.states is None else {states.AT: states.rung(trial)}


@dataclass(frozen=True)
class Climb:
    """A unit and what its rungs gave."""

    unit: Unit
    by_rung: Mapping[At, Climbed]

    @property
    def name(self) -> str:
        """The name that progress shows."""
        return self.unit.pair.name

    @property
    def engine(self) -> Engine:
        """The engine whose numbers are read once more."""
        return self.unit.pair.engine

    @property
    def limit(self) -> float:
        """How long the audit may take [s]; of other samples the reference is solved before."""
        pair = self.unit.pair
        anew = 0.0 if pair.sampled is pair.case else math.inf if pair.case.long else LIMIT
        return limit() + anew


def solved(case: Case) -> Solution | CaseError:
    """The case's reference, or the mistakes that only solving finds."""
    try:
        return solve(case)
    except CaseError as error:
        return error


def planned(pair: Pair) -> tuple[Way, ...]:
    """Returns the ways in which the engine runs the case, or refuses to."""
    start = first(pair.reference())
    if pair.case.states is not None:
        return states.ways(pair.engine, pair.case, start)
    possible = ways(pair.engine, pair.case.scene, start)
    return with_room(possible, pair.case, pair.engine)


def judged(climb: Climb) -> Outcome:
    """The unit's rows."""
    pair, way = climb.unit.pair, climb.unit.way
    reference = pair.reference()
    if isinstance(way, Refusal):
        return compare(Trial(pair.case, reference, pair.engine, way))
    case = pair.sampled
    if case.states is not None:
        return answered(Trial(case, reference, pair.engine, way), climb.by_rung[states.AT])
    if case is pair.case:
        trial = Trial(case, reference, pair.engine, way, timed=pair.timing(reference))
        return compare(trial, gathered(trial, climb.by_rung))
    solution, unsure = _at_own_samples(case)
    way = replace(way, withheld={**way.withheld, **dict.fromkeys(unsure, _UNSURE)})
    trial = Trial(case, solution.trajectory, pair.engine, way, sampled=True)
    outcome = compare(trial, gathered(trial, climb.by_rung))
    return outcome if solution.holds else failing(outcome, uncertified(solution))


_UNSURE = "adapter: at samples so far apart as its own step asks for, the reference is too rough"


def _at_own_samples(case: Case) -> tuple[Solution, set[str]]:
    """Returns the reference, and the bars it cannot certify: work is summed between samples."""
    try:
        return solve(case), set()
    except CaseError as error:
        bars = [m.where.split(".", 1) for m in error.mistakes]
        named = {rest if bar == "allow" else rest.partition(".")[2] for bar, rest in bars}
        if not all(bar in ("allow", "reach") for bar, _ in bars):
            raise
        less = {name: None if name in named else bar for name, bar in case.allow.items()}
        return solve(replace(case, allow=less, reach={}, deviates={})), named


@lru_cache(AT_HAND)
def _at_hand(store: Store, key: str) -> Trajectory | None:
    solution: Solution | None = store.get(key)
    return None if solution is None else solution.trajectory


@lru_cache(AT_HAND)
def _timings(store: Store, key: str) -> list[Timing]:
    """Where the timing of a case's reference is kept once it has been asked for."""
    return []
