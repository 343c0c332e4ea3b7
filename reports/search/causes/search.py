"""One search for causes, cures and recipes: the fewest changes that pass, runs mapped in rounds.

A search is a function that is called anew once the runs that it asked for are made: with the same
errors it goes the same way. So it reads as if all were known, and each run is made once.
"""

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import takewhile
from typing import Generic, TypeVar

from .... import engines
from ....engines.engine import Plain, Plan, Tunable
from ...compare.trial.answers import tunable
from ...compare.trial.start import first
from ...compare.trial.trial import planned
from ...runs.processes.pool import Died
from ...runs.task_results import Results
from ...runs.tasks import Pair
from .candidate import Candidate
from .errors import Errors, Run, errors

T = TypeVar("T")
Key = TypeVar("Key", bound=Hashable)
Passes = Callable[[Candidate], bool]


@dataclass(frozen=True, eq=False)
class Runs:
    """The errors of a pair's runs as far as they are known, and every quantity that they name."""

    pair: Pair
    known: dict[Candidate, Errors] = field(default_factory=dict[Candidate, Errors])
    names: dict[str, None] = field(default_factory=dict[str, None])

    def add(self, candidate: Candidate, errors: Errors) -> None:
        self.known[candidate] = errors
        self.names.update(dict.fromkeys(errors))

    def need(self, candidates: Iterable[Candidate]) -> None:
        """Raises Missing if any of the candidates has to be run."""
        need((self, candidate) for candidate in candidates)


class Missing(Exception):
    """The runs without which a search cannot go on."""

    def __init__(self, runs: Sequence[tuple[Runs, Candidate]]) -> None:
        super().__init__(runs)
        self.runs = runs


def need(wanted: Iterable[tuple[Runs, Candidate]]) -> None:
    """Raises Missing if any of the candidates has to be run, of whatever pair."""
    if missing := [(runs, candidate) for runs, candidate in wanted if candidate not in runs.known]:
        raise Missing(missing)


@dataclass(frozen=True)
class Ladder(Generic[T]):
    """Changes at steps from coarse to fine; confirmed: the last is only there to be finer."""

    changes: T
    rungs: Sequence[Candidate]
    confirmed: bool = True

    @property
    def first(self) -> Candidate:
        """The finest that may be taken: most of what cannot pass is seen there."""
        return self.rungs[-2 if self.confirmed else -1]


def fewest(
    runs: Runs, changes: Iterable[Sequence[Ladder[T]]], passes: Passes
) -> list[tuple[T, Candidate]]:
    """The changes of the first group in which any pass; groups are asked one after the other."""
    return next(filter(None, (passing(runs, ladders, passes) for ladders in changes)), [])


def passing(runs: Runs, ladders: Sequence[Ladder[T]], passes: Passes) -> list[tuple[T, Candidate]]:
    """The changes that pass, each at the coarsest step from which on all finer ones do too."""
    runs.need(ladder.first for ladder in ladders)
    hopeful = [ladder for ladder in ladders if passes(ladder.first)]
    runs.need(candidate for ladder in hopeful for candidate in ladder.rungs)
    return [
        (ladder.changes, usable[-1])
        for ladder in hopeful
        if (usable := list(takewhile(passes, reversed(ladder.rungs))))
    ]


def together(what: str, searches: Mapping[Key, Callable[[], T]], results: Results) -> dict[Key, T]:
    """Each search's result by key; a run whose process dies has no errors and costs nobody else."""
    ends: dict[Key, T] = {}
    done = 0
    while len(ends) < len(searches):
        missing: dict[tuple[Runs, Candidate], str] = {}
        for key in [key for key in searches if key not in ends]:
            try:
                ends[key] = searches[key]()
            except Missing as asked:
                missing |= dict.fromkeys(asked.runs, "")
        missing = {run: _key_of(*run, results) for run in missing}
        tasks = {key: Run(runs.pair, candidate) for (runs, candidate), key in missing.items()}
        counted = _counted(results, done, left=len(searches) - len(ends))
        answers = counted.of(what, errors, tasks) if tasks else {}
        done += len(tasks)
        for (runs, candidate), key in missing.items():
            runs.add(candidate, {} if isinstance(answers[key], Died) else answers[key])
    if done:
        results.progress(what, done, done)
    return {key: ends[key] for key in searches}


def _key_of(runs: Runs, candidate: Candidate, results: Results) -> str:
    text = candidate.on(runs.pair.shapes).text
    return results.keys.tried(runs.pair.case, runs.pair.engine, text, candidate.step)


def _counted(results: Results, done: int, *, left: int) -> Results:
    """Progress over all rounds: a search that is not at its end asks for one more run at least."""

    def progress(
        what: str, now: int, of: int, last: str = "", part: float = 0.0, /
    ) -> None:  # of one round nobody can say how long all of them take
        results.progress(what, done + now, done + of + left, last)

    return replace(results, progress=progress)


def at_own_samples(pair: Pair, results: Results) -> Pair:
    """The pair with the samples that the engine's own step meets."""
    case = pair.sampled
    return replace(pair, case=case, key=results.keys.solution(case))


# Whether an engine of somebody else's can be asked what of it can be turned.


def lost(pairs: Mapping[Key, Pair], results: Results) -> dict[Key, str]:
    """By their keys the pairs whose engine cannot, and why: tried in other processes.

    What passes is asked once more in this one, where the search is.
    """
    strange = {key: pair for key, pair in pairs.items() if engines.foreign(pair.engine.name)}
    answers = results.anew("plans", _asked, strange) if strange else {}
    return {key: died.because for key, died in answers.items() if isinstance(died, Died)}


def _asked(pair: Pair) -> None:
    engine, scene, start = pair.engine, pair.case.scene, first(pair.reference())
    ways = planned(engine, scene, start)
    native = any(isinstance(way, Plan) and way.realised == "native" for way in ways)
    if isinstance(engine, Tunable) and native:
        options = tunable(engine, scene, start)
        built = engine.shapes(scene, start) if isinstance(engine, Plain) else ()
        for shape in built:
            Candidate.of(shape.options, engine.steps[0]).engine(engine.name)
        for step in engine.steps:
            Candidate.of(options, step).engine(engine.name)  # it takes its own recipe, and a step
