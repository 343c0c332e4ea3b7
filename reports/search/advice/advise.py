"""Which setting does a case need? The search for the minimal recipe of each engine."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from functools import cache, partial
from typing import Any

from ....cases.mistake import CaseError, Mistake
from ....cases.theme import themes
from ....engines.engine import Plain, Plan, Refusal, Tunable, lacking
from ...compare.judge.uncertified import uncertified
from ...compare.trial.start import first
from ...compare.trial.trial import Trial, judged_names, planned
from ...runs.request import Request
from ...runs.task_results import Results, mistakes_of
from ...runs.tasks import Pair, solved
from ..causes.search import Runs, at_own_samples, lost, need, together
from .advice_rows import Advised, Requirement, Variant
from .candidates import NOTHING, Candidates, Choice, fitting
from .recipe import Search, recipes, rungs_of

ZERO = 1e-9  # of `allow`: what is no larger in all the motion is nothing but rounding
ROUNDS = 12  # of recipes that hold here, and not where a user's model is another
TOLD_IN = "engines/README.md#the-protocol"
NO_STEPS = "a claim about states: no step and no option plays a part"


@dataclass(frozen=True)
class Listener:
    """Who hears of a search on its way.

    begun: once each engine has run as shipped, before anything is searched; stopped: with what was
    tried so far, when the user interrupts it.
    """

    begun: "Callable[[Sequence[Advised]], None]" = lambda ready: None
    stopped: "Callable[[Sequence[Advised]], None]" = lambda ready: None


def advise(
    pairs: Sequence[Pair], asked: Requirement, results: Results, listener: Listener | None = None
) -> list[Advised]:
    """For each case in each engine as shipped; of all searches at once.

    Raises CaseError with what only solving finds.
    """
    listener = listener or Listener()
    sampled = _sampled(pairs, results)
    broken = lost({pair.name: pair for pair, why in sampled if not why}, results)
    ready = [_prepared(pair, asked, why, broken.get(pair.name, "")) for pair, why in sampled]
    searches = {one.pair.name: (one, one.search) for one in ready if one.search}
    shipped = {
        name: partial(search.runs.need, [one.shipped]) for name, (one, search) in searches.items()
    }
    together("shipped", shipped, results)
    listener.begun(ready)
    try:
        advice = together(
            "advice", {name: partial(_searched, *each) for name, each in searches.items()}, results
        )
    except KeyboardInterrupt:
        listener.stopped(ready)
        raise
    return [advice.get(one.pair.name, one) for one in ready]


def _searched(one: Advised, search: Search) -> Advised:
    """With recipes that hold in every model that a user may have, though there without a margin.

    What does not is left out, and the rest searched once more.
    """
    held = [variant for variant in one.variants if variant.held]
    search.elsewhere.clear()
    for _ in range(ROUNDS):
        tried = replace(one, recipes=recipes(search))
        choices = [recipe.choice for _, recipe in tried.wanted]
        if one.asked.front:
            tuned = Choice(search.candidates.tuned)
            search.runs.need(rungs_of(search, tuned, *choices))
        candidates = [
            recipe.choice.at(step)
            for _, recipe in tried.wanted
            for step in search.candidates.steps
            if step <= recipe.candidate.step
        ]
        need((variant.runs, candidate) for variant in held for candidate in candidates)
        search.leave_out(
            {c: max(search.worst(c, v.runs)[0] for v in held) for c in candidates if held}
        )
        if all(search.passes(recipe.candidate) for _, recipe in tried.wanted):
            break
    else:
        tried = one
    shapes = [variant for variant in one.variants if variant.words]
    need((variant.runs, candidate) for variant in shapes for candidate in tried.pasted)
    beside = {c: [(v.words, *search.worst(c, v.runs)) for v in shapes] for c in tried.pasted}
    return replace(tried, beside=beside)


def _sampled(pairs: Sequence[Pair], results: Results) -> list[tuple[Pair, str]]:
    """With the samples that the engine's own step meets; of those without a reference, why."""
    sampled = [at_own_samples(pair, results) for pair in pairs]
    answers = results.of("references", solved, {pair.key: pair.case for pair in sampled})
    wrong = {pair.key: mistakes_of(pair.case, answers[pair.key]) for pair in sampled}
    # What is mistaken at its own samples is mistaken, whatever an engine's step asks for.
    own = {
        pair.key: pair.case for pair, other in zip(pairs, sampled, strict=True) if wrong[other.key]
    }
    others = {key: case for key, case in own.items() if key not in answers}
    answers |= results.of("references", solved, others) if others else {}
    if mistaken := [m for key, case in own.items() for m in mistakes_of(case, answers[key])]:
        raise CaseError(mistaken)
    return [(pair, _unsolved(answers[pair.key], wrong[pair.key])) for pair in sampled]


def _unsolved(answer: Any, wrong: Sequence[Mistake]) -> str:
    if wrong:
        far = "at samples as far apart as its own step asks for"
        return f"there is no reference: {far}: {wrong[0].what}"
    return "" if answer.holds else uncertified(answer)


def _prepared(pair: Pair, asked: Requirement, unsolved: str, broken: str) -> Advised:
    case, engine = pair.case, pair.engine
    if broken:
        return Advised(pair, asked, Refusal("native", broken), None)
    if unsolved or case.states is not None:
        return Advised(pair, asked, Refusal("native", unsolved or NO_STEPS), None)
    reference = pair.reference()
    ways = planned(engine, case.scene, first(reference))
    way = next(way for way in ways if way.realised == "native")
    if isinstance(way, Plan) and (missing := lacking(engine, Tunable)):
        way = Refusal("native", f"adapter: it has no {', '.join(missing)} of Tunable: {TOLD_IN}")
    if isinstance(way, Refusal):
        return Advised(pair, asked, way, None)
    assert isinstance(engine, Tunable)
    own = engine.own_step
    assert own is not None  # as shipped
    steps = fitting(engine.steps, own, case.interval)
    start = first(reference)
    shapes = engine.shapes(case.scene, start) if isinstance(engine, Plain) else ()
    pair = replace(pair, shapes=shapes[0].options if shapes else {})
    built = NOTHING.at(own).on(pair.shapes).engine(engine.name) if shapes else engine
    assert isinstance(built, Tunable)
    knobs = built.knobs(case.scene, start)
    ours = {
        name for knob in knobs if knob.kind == "ours" for v in knob.values for name in v.options
    }
    tuned = {k: v for k, v in built.recipe(case.scene, start).items() if k not in ours}
    withheld = [knob.tuned.words for knob in knobs if knob.kind == "ours" and knob.tuned]
    candidates = Candidates(
        [knob for knob in knobs if knob.kind != "ours"], steps, own, tuned, withheld
    )
    scale = _scale(Trial(case, reference, engine, way), asked.tolerance)
    cost = engine.cost(case.scene, start)
    search = Search(
        Runs(pair),
        candidates,
        cache(lambda candidate: cost(candidate.options, candidate.step)),
        asked.margin,
        scale,
    )
    variants = [Variant(Runs(other)) for other in _cut_elsewhere(pair)]
    variants += [
        Variant(Runs(replace(pair, shapes=shape.options)), shape.words, shape.held)
        for shape in shapes[1:]
    ]
    return Advised(pair, asked, way, search, shapes=shapes, variants=variants)


def _scale(trial: Trial, tolerance: float | None) -> Mapping[str, float]:
    """From the case's tolerances to a part of each quantity's size; events happen as often.

    What is zero has no size: it is asked for what the case allows.
    """
    if tolerance is None:
        return {}
    dated = {f"{event}.time": trial.case.duration for event in trial.case.events}
    counts = {f"{event}.count" for event in trial.case.events}
    names = [name for name in judged_names(trial.case) if name not in counts]
    sizes = {name: dated.get(name) or trial.size(name) for name in names}
    return {
        name: (trial.allowed(name) or 0.0) / (tolerance * size)
        for name, size in sizes.items()
        if size > ZERO * (trial.allowed(name) or 0.0)
    }


# Does a recipe hold wherever a loop is cut? The same scene with its joints in other orders.
#
# Which joint of a loop an engine holds by a soft constraint, and which by its coordinates, hangs
# on their order in some; a user's model has another one.


MOST = 4  # other orders that are tried of a scene


def _cut_elsewhere(pair: Pair) -> list[Pair]:
    """The pair with another joint the last, once for each of some, where joints close a loop."""
    scene: Any = pair.case.scene
    names = list(scene.joints) if "loops" in themes(pair.case) else []
    orders = [names[k:] + names[:k] for k in range(1, len(names))][:MOST]
    scenes = [replace(scene, joints={name: scene.joints[name] for name in n}) for n in orders]
    return [replace(pair, case=replace(pair.case, scene=other)) for other in scenes]


# A search from the words of a command: its processes, its store, and all cases at once.


@contextmanager
def advised(
    request: Request, asked: Requirement, listener: Listener | None = None
) -> Iterator[list[Advised]]:
    """Yields the advice for each case in each engine as shipped; references stay until the end.

    listener: who hears of it on the way. Raises CaseError for what only solving finds.
    """
    with request.results() as results:
        pairs = [
            Pair(case, engine, results.store, results.keys.solution(case))
            for case in request.cases
            for engine in request.engines
        ]
        yield advise(pairs, asked, results, listener)
