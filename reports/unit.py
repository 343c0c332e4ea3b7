"""A unit of work: one engine on one case in one way, small enough to be sent anywhere."""

from dataclasses import dataclass
from functools import lru_cache

from ..cases.case import Case
from ..cases.trajectory import Trajectory
from ..engines.engine import Engine, Realised
from ..reference.solve import Solution, solve
from .cache.store import Store
from .judge.compare import Outcome, compare
from .trial.ladder import judged_step
from .trial.start import first
from .trial.trial import Trial, ways

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
    def steps(self) -> float:
        """About how many the finest rung takes."""
        return self.pair.case.duration / judged_step(self.pair.case, self.pair.engine)


def planned(pair: Pair) -> tuple[Realised, ...]:
    """In which ways the engine runs the case, or refuses to."""
    found = ways(pair.engine, pair.case.scene, first(pair.reference()))
    return tuple(way.realised for way in found)


def tried(unit: Unit) -> Outcome:
    """The unit's rows: plans again, as a plan is made of functions and cannot lie in a store."""
    case, engine = unit.pair.case, unit.pair.engine
    reference = unit.pair.reference()
    found = ways(engine, case.scene, first(reference))
    way = next(way for way in found if way.realised == unit.realised)
    return compare(Trial(case, reference, engine, way))


@lru_cache(AT_HAND)
def _at_hand(store: Store, key: str) -> Trajectory | None:
    solution: Solution | None = store.get(key)
    return None if solution is None else solution.trajectory
