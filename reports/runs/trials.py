"""Plans all trials, runs every rung of all of them on its own, and judges once they are there."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from ...cases.trajectory import Trajectory
from ...engines.engine import Realised, Refusal
from ..compare.judge.compare import Outcome, crashed
from ..compare.trial.run import Climbed, Rung, climbed
from ..compare.trial.simulate import At
from ..compare.trial.trial import Trial
from .processes.pool import Died
from .task_results import Results
from .tasks import Climb, Pair, Unit, judged, planned

References = Mapping[str, Trajectory]
"""By the case's name."""


@dataclass(frozen=True)
class Tried:
    """The outcome of an engine for a case in one of its ways."""

    pair: Pair
    realised: Realised
    outcome: Outcome


def tried(pairs: Sequence[Pair], references: References, results: Results) -> list[Tried]:
    """Every way of every engine, in the order of the pairs."""
    asked = {results.keys.ways(pair.case, pair.engine): pair for pair in pairs}
    by_key = {key: kept for key, pair in asked.items() if (kept := _stored(key, pair, results))}
    remaining = {key: pair for key, pair in asked.items() if key not in by_key}
    if remaining:
        by_key |= _computed(remaining, references, results)
    return [run for key in asked for run in by_key[key]]


def _stored(key: str, pair: Pair, results: Results) -> list[Tried]:
    """The stored outcomes of a pair in every way, if all are stored; else nothing."""
    ways: tuple[Realised, ...] = results.store.get(key) or ()
    names = [results.keys.outcome(key, way) for way in ways]
    outcomes = results.stored(names)
    if len(outcomes) < len(names):
        return []
    return [Tried(pair, way, outcomes[name]) for way, name in zip(ways, names, strict=True)]


def _computed(
    pairs: Mapping[str, Pair], references: References, results: Results
) -> dict[str, list[Tried]]:
    """Computes outcomes by the pairs' keys; what died is not kept, so the next run retries it."""
    ways = results.anew("plans", planned, pairs)
    units: dict[str, Unit] = {}
    gone: dict[str, Died] = {}
    mine: dict[str, list[str]] = {key: [] for key in pairs}
    planned_ways: dict[str, tuple[Realised, ...]] = {}
    for key, pair in pairs.items():
        answer = ways[key]
        died = isinstance(answer, Died)
        for way in (Refusal("native", answer.because),) if died else answer:
            name = results.keys.outcome(key, way.realised)
            units[name] = Unit(pair, way)
            mine[key].append(name)
            gone |= {name: answer} if died else {}
        if not died:
            planned_ways[key] = tuple(way.realised for way in answer)
    results.keep(planned_ways)
    outcomes = results.stored(units)
    remaining = {name: unit for name, unit in units.items() if name not in {**outcomes, **gone}}
    outcomes |= gone | _run(remaining, references, results)
    return {key: [_as_tried(units[n], outcomes[n], references) for n in mine[key]] for key in pairs}


def _run(
    units: Mapping[str, Unit], references: References, results: Results
) -> dict[str, Outcome | Died]:
    """Runs all rungs, by the units' keys, the longest first so that no core is left alone.

    A rung that dies costs its unit, for all of a unit's rungs are behind what its rows say.
    """
    rungs: dict[str, Rung] = {}
    places: dict[str, tuple[str, At]] = {}
    for key, unit in units.items():
        for at, rung in unit.rungs(references[unit.pair.case.name]).items():
            name = results.keys.rung(key, *at)
            rungs[name], places[name] = rung, (key, at)
    longest = sorted(rungs.items(), key=lambda item: -item[1].steps)
    samples = results.of("engines", climbed, dict(longest))
    by_unit: dict[str, dict[At, Climbed]] = {key: {} for key in units}
    gone: dict[str, Died] = {}
    for name, (key, at) in places.items():
        by_unit[key][at] = samples[name]
        if isinstance(samples[name], Died):
            gone.setdefault(key, samples[name])
    climbs = {key: Climb(units[key], by_unit[key]) for key in units if key not in gone}
    outcomes = results.of("rows", judged, climbs)
    whole = {key for key, outcome in outcomes.items() if isinstance(outcome, Outcome)}
    results.store.drop(name for name, (key, _) in places.items() if key in whole)
    return outcomes | gone


def _as_tried(unit: Unit, outcome: Outcome | Died, references: References) -> Tried:
    if isinstance(outcome, Died):
        pair, because = unit.pair, outcome.because
        refused = Refusal(unit.realised, because)
        trial = Trial(pair.case, references[pair.case.name], pair.engine, refused)
        outcome = crashed(trial, because)
    return Tried(unit.pair, unit.realised, outcome)
