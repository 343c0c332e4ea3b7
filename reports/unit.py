"""A unit of work: one engine on one case in one way, small enough to be sent anywhere."""

from dataclasses import dataclass
from functools import lru_cache

from ..cases.case import Case
from ..cases.trajectory import Trajectory
from ..engines.engine import Engine, Plan, Realised, Refusal
from ..reference.solve import Solution, solve
from .cache.store import Store
from .judge.compare import Outcome, compare
from .trial.ladder import judged_step, sampled
from .trial.start import first
from .trial.trial import Trial, ways, with_room

AT_HAND = 8  # references that a process remembers: it meets the ways of one case one after another


@dataclass(frozen=True)
class Pair:
    """An engine and a case, whose reference lies in the store under its key."""

    case: Case
    engine: Engine
    store: Store
    key: str

    def reference(self) -> Trajectory:
        """From the store; where that has none, as on a machine that does not share it, anew."""
        return _at_hand(self.store, self.key) or solve(self.case).trajectory


@dataclass(frozen=True)
class Unit:
    """One of the ways in which the engine runs the case, or refuses to."""

    pair: Pair
    realised: Realised

    @property
    def case(self) -> Case:
        """The case with the samples that the engine's own step meets."""
        return sampled(self.pair.case, self.pair.engine)

    @property
    def steps(self) -> float:
        """About how many the finest rung takes."""
        return self.case.duration / judged_step(self.case, self.pair.engine)


def planned(pair: Pair) -> tuple[Realised, ...]:
    """In which ways the engine runs the case, or refuses to."""
    return tuple(way.realised for way in _ways(pair, pair.reference()))


def tried(unit: Unit) -> Outcome:
    """The unit's rows: plans again, as a plan is made of functions and cannot lie in a store."""
    pair = unit.pair
    case, reference = pair.case, pair.reference()
    way = next(way for way in _ways(pair, reference) if way.realised == unit.realised)
    own = unit.case is not case and not isinstance(way, Refusal)
    if own:
        case, reference = unit.case, solve(unit.case).trajectory
    return compare(Trial(case, reference, pair.engine, way, sampled=own))


def _ways(pair: Pair, reference: Trajectory) -> tuple[Plan | Refusal, ...]:
    found = ways(pair.engine, pair.case.scene, first(reference))
    return with_room(found, pair.case, pair.engine)


@lru_cache(AT_HAND)
def _at_hand(store: Store, key: str) -> Trajectory | None:
    solution: Solution | None = store.get(key)
    return None if solution is None else solution.trajectory
