"""Which setting does a case need? The search for the minimal recipe of each engine."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import Any

from ....cases.mistake import CaseError
from ....cases.scene import GROUND
from ....engines.engine import Plan, Refusal, Tunable, lacking
from ....reference.solve import Solution
from ...compare.judge.uncertified import uncertified
from ...compare.trial.start import first
from ...compare.trial.trial import Trial, judged_names, planned
from ...runs.request import Request
from ...runs.task_results import Results, mistakes_of
from ...runs.tasks import Pair, solved
from ..causes.candidate import Candidate
from ..causes.parallel_search import Asking, Known, Search, lost, together
from .advice_rows import Advised, Requirement
from .candidates import NOTHING, Choice, Menu, fitting
from .criterion import Bar
from .real_shapes import measured_beside, shapes, worst_on_shapes
from .recipe import Kitchen, Recipes, recipes, rungs_of

ZERO = 1e-9  # of `allow`: what is no larger in all the motion is nothing but rounding
ROUNDS = 12  # of what keeps the bar here, and not where a loop is cut elsewhere
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
    _run_as_shipped(ready, results)
    listener.begun(ready)
    try:
        return _searched(ready, asked, results)
    except KeyboardInterrupt:
        listener.stopped(ready)
        raise


def _run_as_shipped(ready: Sequence[Advised], results: Results) -> None:
    searches = {
        f"{one.pair.case.name} {one.pair.engine.name}": Search(
            one.pair, one.kitchen.bar.known, _shipped(one)
        )
        for one in ready
        if one.kitchen is not None
    }
    together("shipped", searches, results)


def _shipped(one: Advised) -> Asking[None]:
    yield [one.shipped]


def _searched(ready: Sequence[Advised], asked: Requirement, results: Results) -> list[Advised]:
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
        worst |= worst_on_shapes(
            {key: (one.shapes, *_asked_elsewhere(one)) for key, one in left.items()}, results
        )
        left = {key: one for key, one in left.items() if _rejected(one, worst[key])}
    found |= {key: replace(one, recipes=None) for key, one in left.items()}
    return _on_other_shapes(found, results)


def _on_other_shapes(found: Mapping[str, Advised], results: Results) -> list[Advised]:
    """Each with what its recipes do on the other shapes that a user may have."""
    asked = {
        key: (one.pair, one.shapes[1:], one.pasted, one.kitchen.bar.scale)
        for key, one in found.items()
        if one.kitchen is not None
    }
    beside = measured_beside(asked, results)
    return [replace(one, beside=beside.get(key, {})) for key, one in found.items()]


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


_FAR = "at samples as far apart as its own step asks for"


def _sampled(pairs: Sequence[Pair], results: Results) -> list[tuple[Pair, str]]:
    """With the samples that the engine's own step meets; of those without a reference, why."""
    cases = [pair.sampled for pair in pairs]
    keys = [results.keys.solution(case) for case in cases]
    by_key = dict(zip(keys, cases, strict=True))
    found = results.of("references", solved, by_key)
    own = {key for pair, case, key in zip(pairs, cases, keys, strict=True) if case is pair.case}
    wrong = {key: mistakes_of(by_key[key], answer) for key, answer in found.items()}
    mistaken = [mistake for key in by_key if key in own for mistake in wrong[key]]
    # What is mistaken at its own samples is mistaken, whatever an engine's step asks for.
    others = {
        results.keys.solution(pair.case): pair.case
        for pair, key in zip(pairs, keys, strict=True)
        if key not in own and wrong[key]
    }
    again = results.of("references", solved, others) if others else {}
    mistaken += [m for key, answer in again.items() for m in mistakes_of(others[key], answer)]
    if mistaken:
        raise CaseError(mistaken)
    lost = {key: f"{_FAR}: {each[0].what}" for key, each in wrong.items() if each}
    lost = {key: f"there is no reference: {why}" for key, why in lost.items()}
    solutions = {key: answer for key, answer in found.items() if isinstance(answer, Solution)}
    lost |= {key: uncertified(one) for key, one in solutions.items() if not one.holds}
    return [
        (replace(pair, case=case, key=key), lost.get(key, ""))
        for pair, case, key in zip(pairs, cases, keys, strict=True)
    ]


def _prepared(pair: Pair, asked: Requirement, unsolved: str, broken: str) -> Advised:
    case, engine = pair.case, pair.engine
    if broken:
        return Advised(pair, asked, Refusal("native", broken), None, None)
    if unsolved or case.states is not None:
        return Advised(pair, asked, Refusal("native", unsolved or NO_STEPS), None, None)
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
    users = shapes(engine, case, start)
    pair = replace(pair, shapes=users[0].options if users else {})
    built = NOTHING.at(own).on(pair.shapes).engine(engine.name) if users else engine
    assert isinstance(built, Tunable)
    knobs = built.knobs(case.scene, start)
    ours = {
        name for knob in knobs if knob.kind == "ours" for v in knob.values for name in v.options
    }
    tuned = {k: v for k, v in built.recipe(case.scene, start).items() if k not in ours}
    withheld = [knob.tuned.words for knob in knobs if knob.kind == "ours" and knob.tuned]
    menu = Menu([knob for knob in knobs if knob.kind != "ours"], steps, own, tuned, withheld)
    bar = Bar(Known(), asked.margin, _scale(Trial(case, reference, engine, way), asked.tolerance))

    dear = engine.cost(case.scene, start)

    def cost(candidate: Candidate) -> float:
        return dear(candidate.options, candidate.step)

    return Advised(pair, asked, way, Kitchen(menu, bar, cost), None, shapes=users)


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


def _search(kitchen: Kitchen, *, front: bool) -> Asking[Recipes | None]:
    yield [NOTHING.at(kitchen.menu.own)]
    found = yield from recipes(kitchen)
    if front:
        tuned = Choice(("tuned",), kitchen.menu.tuned)
        both = [found.fewest.choice, found.cheapest.choice] if found else []
        yield rungs_of(kitchen, tuned, *both)
    return found


# Does a recipe hold wherever a loop is cut? The same scene with its joints in other orders.
#
# Which joint of a loop an engine holds by a soft constraint, and which by its coordinates, hangs
# on their order in some; a user's model has another one.


MOST = 4  # other orders that are tried of a scene


def elsewhere(
    asked: Mapping[str, tuple[Pair, list[Candidate], Mapping[str, float]]], results: Results
) -> dict[str, dict[Candidate, float]]:
    """By key and candidate the worst error over its tolerance wherever the loops are cut.

    asked: by key the pair, its candidates, and the scale of its bar. Of a scene without loops
    nothing.
    """
    searches: dict[str, Search[list[float]]] = {}
    for key, (pair, candidates, scale) in asked.items():
        for number, other in enumerate(_others(pair)):
            known = Known()
            searches[f"{key} {number}"] = Search(other, known, _worst(known, candidates, scale))
    found = together("other cuts", searches, results) if searches else {}
    worst: dict[str, dict[Candidate, float]] = {}
    for key, (_, candidates, _) in asked.items():
        cut = [found[f"{key} {n}"] for n in range(MOST) if f"{key} {n}" in found]
        worst[key] = {c: max(each[i] for each in cut) for i, c in enumerate(candidates) if cut}
    return worst


def _worst(
    known: Known, candidates: list[Candidate], scale: Mapping[str, float]
) -> Asking[list[float]]:
    yield candidates
    return [Bar(known, 1.0, scale).worst(candidate)[0] for candidate in candidates]


def _others(pair: Pair) -> list[Pair]:
    """The pair with another joint the last, once for each of some, where joints close a loop."""
    scene: Any = pair.case.scene
    names = list(scene.joints)
    if not _loops(scene):
        return []
    turned = [names[k:] + names[:k] for k in range(1, len(names))][:MOST]
    scenes = [replace(scene, joints={name: scene.joints[name] for name in n}) for n in turned]
    return [replace(pair, case=replace(pair.case, scene=other)) for other in scenes]


def _loops(scene: Any) -> bool:
    """Whether some joint joins what is joined already."""
    whole = {name: {name} for name in (GROUND, *scene.bodies)}
    for joint in scene.joints.values():
        a, b = whole[joint.a.body], whole[joint.b.body]
        if a is b:
            return True
        a |= b
        whole.update(dict.fromkeys(b, a))
    return False


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
