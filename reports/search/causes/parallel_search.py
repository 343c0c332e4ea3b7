"""Many searches at once: each asks for runs in rounds, which are spread over all cores."""

from collections.abc import Generator, Iterable, Mapping
from dataclasses import dataclass, field, replace
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
Known = dict[Candidate, Errors]
Asking = Generator[Iterable[Candidate], None, T]
"""It yields what it wants to know, which it then knows, and returns what it found."""


@dataclass(frozen=True)
class Search(Generic[T]):
    """A search among the runs of a pair, and what is known of them."""

    pair: Pair
    known: Known
    asking: Asking[T]


@dataclass
class _Round:
    """The runs that all searches ask for in one round, by the results' keys."""

    runs: dict[str, Run] = field(default_factory=dict)
    wanted: list[tuple[Known, Candidate, str]] = field(default_factory=list)


def together(what: str, searches: Mapping[str, Search[T]], results: Results) -> dict[str, T]:
    """Each search's result by key; a run whose process dies has no errors and costs nobody else."""
    found: dict[str, T] = {}
    done = 0
    while len(found) < len(searches):
        asked = _Round()
        for key in [key for key in searches if key not in found]:
            try:
                _ask(searches[key], next(searches[key].asking), asked, results)
            except StopIteration as end:
                found[key] = end.value
        counted = _counted(results, done, left=len(searches) - len(found))
        answers = counted.of(what, errors, asked.runs) if asked.runs else {}
        done += len(asked.runs)
        for known, candidate, key in asked.wanted:
            known[candidate] = {} if isinstance(answers[key], Died) else answers[key]
    if done:
        results.progress(what, done, done)
    return {key: found[key] for key in searches}


def _counted(results: Results, done: int, *, left: int) -> Results:
    """Progress over all rounds: a search that is not at its end asks for one more run at least."""

    def progress(
        what: str, now: int, of: int, last: str = "", part: float = 0.0, /
    ) -> None:  # of one round nobody can say how long all of them take
        results.progress(what, done + now, done + of + left, last)

    return replace(results, progress=progress)


def _ask(search: Search, wanted: Iterable[Candidate], asked: _Round, results: Results) -> None:
    pair = search.pair
    for candidate in wanted:
        if candidate not in search.known:
            text = candidate.on(pair.shapes).text
            key = results.keys.tried(pair.case, pair.engine, text, candidate.step)
            asked.runs[key] = Run(pair, candidate)
            asked.wanted.append((search.known, candidate, key))


# Whether an engine of somebody else's can be asked what of it can be turned.


def lost(pairs: Mapping[str, Pair], results: Results) -> dict[str, str]:
    """By their keys the pairs whose engine cannot, and why: tried in other processes.

    What passes is asked once more in this one, where the search is.
    """
    strange = {key: pair for key, pair in pairs.items() if engines.foreign(pair.engine.name)}
    found = results.anew("plans", _asked, strange) if strange else {}
    return {key: died.because for key, died in found.items() if isinstance(died, Died)}


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
