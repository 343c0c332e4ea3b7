"""Which setting does a case need? The search for the minimal recipe of each engine."""

from collections.abc import Mapping, Sequence
from dataclasses import replace

from ....cases.mistake import CaseError
from ....engines.engine import Plan, Refusal, Tunable, lacking
from ...compare.trial.start import first
from ...compare.trial.trial import Trial, judged_names, planned
from ...system.pool import Died
from ..search.candidate import Candidate
from ..search.parallel_search import Asking, Known, Search, together
from ..search.solving import solved
from ..search.tunable import lost
from ..task_results import Results
from ..tasks import Pair
from .advice_rows import Advised, Asked
from .candidates import NOTHING, Choice, Menu, fitting
from .criterion import Bar
from .loop_cuts import elsewhere
from .parameter_draws import tried_in_draws
from .recipe import Kitchen, Recipes, recipes, rungs_of

ROUNDS = 12  # of what keeps the bar here, and not where a loop is cut elsewhere
TOLD_IN = "engines/README.md#the-protocol"
NO_STEPS = "a claim about states: no step and no option plays a part"


def advise(pairs: Sequence[Pair], asked: Asked, results: Results) -> list[Advised]:
    """For each case in each engine as shipped; of all searches at once.

    Raises CaseError with what only solving finds.
    """
    sampled = _sampled(pairs, results)
    broken = lost({pair.name: pair for pair, why in sampled if not why}, results)
    ready = [_prepared(pair, asked, why, broken.get(pair.name, "")) for pair, why in sampled]
    advised = _searched(ready, asked, results)
    return [_drawn(one, results) for one in advised] if asked.robust else advised


def _searched(ready: Sequence[Advised], asked: Asked, results: Results) -> list[Advised]:
    """Each with its recipes: such as hold wherever a loop is cut, though there without a margin.

    What does not is left out, and the rest searched once more.
    """
    found = {f"{one.pair.case.name} {one.pair.engine.name}": one for one in ready}
    left = {key: one for key, one in found.items() if one.kitchen is not None}
    for _ in range(ROUNDS):
        searches = {
            key: Search(one.pair, one.kitchen.bar.known, _search(one.kitchen, front=asked.front))
            for key, one in left.items()
            if one.kitchen is not None
        }
        answers = together("advice", searches, results)
        left = {key: replace(one, recipes=answers[key]) for key, one in left.items()}
        found |= left
        worst = elsewhere({key: _asked_elsewhere(one) for key, one in left.items()}, results)
        left = {key: one for key, one in left.items() if _rejected(one, worst[key])}
    return [replace(one, recipes=None) if key in left else one for key, one in found.items()]


def _asked_elsewhere(one: Advised) -> tuple[Pair, list[Candidate], Mapping[str, float]]:
    """The recipes at their steps, and at all finer ones."""
    assert one.kitchen is not None
    candidates = [
        recipe.choice.at(step)
        for _, recipe in one.wanted
        for step in one.kitchen.menu.steps
        if step <= recipe.step
    ]
    return one.pair, list(dict.fromkeys(candidates)), one.kitchen.bar.scale


def _rejected(one: Advised, worst: Mapping[Candidate, float]) -> bool:
    """Whether one of the recipes does not hold elsewhere; what does not is not taken again."""
    assert one.kitchen is not None
    one.kitchen.bar.leave_out(worst)
    return not all(one.kitchen.bar.holds(recipe.candidate) for _, recipe in one.wanted)


def _drawn(one: Advised, results: Results) -> Advised:
    if one.kitchen is None:
        return one
    scale = one.kitchen.bar.scale
    tried = (tried_in_draws(one.pair, recipe.candidate, scale, results) for _, recipe in one.wanted)
    return replace(one, draws=tuple(tried))


_FAR = "at samples as far apart as its own step asks for"


def _sampled(pairs: Sequence[Pair], results: Results) -> list[tuple[Pair, str]]:
    """With the samples that the engine's own step meets; of those without a reference, why."""
    cases = [pair.sampled for pair in pairs]
    keys = [results.keys.solution(case) for case in cases]
    found = results.of("references", solved, dict(zip(keys, cases, strict=True)))
    own = {key for pair, case, key in zip(pairs, cases, keys, strict=True) if case is pair.case}
    wrong = {key: error for key, error in found.items() if isinstance(error, CaseError)}
    if mistaken := [wrong[key] for key in wrong.keys() & own]:
        raise CaseError([mistake for error in mistaken for mistake in error.mistakes])
    lost = {key: answer.because for key, answer in found.items() if isinstance(answer, Died)}
    lost |= {key: f"{_FAR}: {error.mistakes[0].what}" for key, error in wrong.items()}
    return [
        (replace(pair, case=case, key=key), lost.get(key, ""))
        for pair, case, key in zip(pairs, cases, keys, strict=True)
    ]


def _prepared(pair: Pair, asked: Asked, unsolved: str, broken: str) -> Advised:
    case, engine = pair.case, pair.engine
    if broken:
        return Advised(pair, asked, Refusal("native", broken), None, None)
    if unsolved or case.states is not None:
        why = f"there is no reference: {unsolved}" if unsolved else NO_STEPS
        return Advised(pair, asked, Refusal("native", why), None, None)
    reference = pair.reference()
    ways = planned(engine, case.scene, first(reference))
    way = next(way for way in ways if way.realised == "native")
    if isinstance(way, Plan) and (missing := lacking(engine, Tunable)):
        way = Refusal("native", f"adapter: it has no {', '.join(missing)} of Tunable: {TOLD_IN}")
    if isinstance(way, Refusal):
        return Advised(pair, asked, way, None, None)
    assert isinstance(engine, Tunable)
    own = engine.own_step
    assert own is not None  # as shipped
    steps = fitting(engine.steps, own, case.interval)
    start = first(reference)
    knobs = engine.knobs(case.scene, start)
    ours = {
        name for knob in knobs if knob.kind == "ours" for v in knob.values for name in v.options
    }
    tuned = {k: v for k, v in engine.recipe(case.scene, start).items() if k not in ours}
    menu = Menu([knob for knob in knobs if knob.kind != "ours"], steps, own, tuned)
    bar = Bar(Known(), asked.margin, _scale(Trial(case, reference, engine, way), asked.tolerance))

    def cost(candidate: Candidate) -> float:
        return engine.cost(candidate.options, candidate.step, case.scene)

    return Advised(pair, asked, way, Kitchen(menu, bar, cost), None)


def _scale(trial: Trial, tolerance: float | None) -> Mapping[str, float]:
    """From the case's tolerances to a part of each quantity's size; events happen as often."""
    if tolerance is None:
        return {}
    dated = {f"{event}.time": trial.case.duration for event in trial.case.events}
    counts = {f"{event}.count" for event in trial.case.events}
    names = [name for name in judged_names(trial.case) if name not in counts]
    sizes = {name: dated.get(name) or trial.size(name) for name in names}
    return {
        name: (trial.allowed(name) or 0.0) / (tolerance * size)
        for name, size in sizes.items()
        if size > 0
    }


def _search(kitchen: Kitchen, *, front: bool) -> Asking[Recipes | None]:
    yield [NOTHING.at(kitchen.menu.own)]
    found = yield from recipes(kitchen)
    if front:
        tuned = Choice(("tuned",), kitchen.menu.tuned)
        both = [found.fewest.choice, found.cheapest.choice] if found else []
        yield rungs_of(kitchen, tuned, *both)
    return found
