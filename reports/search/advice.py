"""Which setting does a case need? The minimal recipe of each engine, and what it costs."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

from ...cases.mistake import CaseError
from ...engines.engine import Plan, Refusal, Tunable
from ...engines.knobs import as_text
from ..pool import Died
from ..results import Results
from ..row import Advice
from ..trial.start import first
from ..trial.trial import Trial, judged_names, planned
from ..unit import Pair, solved
from .bar import Bar
from .candidate import Candidate
from .menu import NOTHING, Choice, Menu, fitting
from .recipe import Kitchen, Recipe, best, recipe, rungs_of
from .together import Asking, Known, Search, together

NO_KNOBS = "adapter: it says of nothing how it can be turned"
NO_STEPS = "a claim about states: no step and no option plays a part"


@dataclass(frozen=True)
class Asked:
    """tolerance: of each quantity's own size; None: what the case allows."""

    tolerance: float | None
    margin: float
    front: bool = False  # whether cost against error is drawn


@dataclass(frozen=True)
class Advised:
    """way: the native one as shipped, or why there is none. kitchen: with all that was run."""

    pair: Pair
    asked: Asked
    way: Plan | Refusal
    kitchen: Kitchen | None
    recipe: Recipe | None

    @property
    def shipped(self) -> Candidate:
        assert self.kitchen is not None
        return NOTHING.at(self.kitchen.menu.own)


def advise(pairs: Sequence[Pair], asked: Asked, results: Results) -> list[Advised]:
    """For each case in each engine as shipped; of all searches at once.

    Raises CaseError with what only solving finds.
    """
    ready = [_prepared(pair, asked, lost) for pair, lost in _sampled(pairs, results)]
    searches = {
        f"{one.pair.case.name} {one.pair.engine.name}": Search(
            one.pair, one.kitchen.bar.known, _search(one.kitchen, front=asked.front)
        )
        for one in ready
        if one.kitchen is not None
    }
    found = together("advice", searches, results)
    return [
        replace(one, recipe=found.get(f"{one.pair.case.name} {one.pair.engine.name}"))
        for one in ready
    ]


def _sampled(pairs: Sequence[Pair], results: Results) -> list[tuple[Pair, str]]:
    """With the samples that the engine's own step meets; of those without a reference, why."""
    cases = [pair.sampled for pair in pairs]
    keys = [results.keys.solution(case) for case in cases]
    found = results.of("references", solved, dict(zip(keys, cases, strict=True)))
    wrong = [error for error in found.values() if isinstance(error, CaseError)]
    if wrong:
        raise CaseError([mistake for error in wrong for mistake in error.mistakes])
    lost = {key: answer.because for key, answer in found.items() if isinstance(answer, Died)}
    return [
        (replace(pair, case=case, key=key), lost.get(key, ""))
        for pair, case, key in zip(pairs, cases, keys, strict=True)
    ]


def _prepared(pair: Pair, asked: Asked, lost: str) -> Advised:
    case, engine = pair.case, pair.engine
    if lost or case.states is not None:
        why = f"there is no reference: {lost}" if lost else NO_STEPS
        return Advised(pair, asked, Refusal("native", why), None, None)
    reference = pair.reference()
    ways = planned(engine, case.scene, first(reference))
    way = next(way for way in ways if way.realised == "native")
    if isinstance(way, Plan) and not isinstance(engine, Tunable):
        way = Refusal("native", NO_KNOBS)
    if isinstance(way, Refusal):
        return Advised(pair, asked, way, None, None)
    assert isinstance(engine, Tunable)
    own = engine.own_step
    assert own is not None  # as shipped
    steps = fitting(engine.steps, own, case.interval)
    start = first(reference)
    knobs, tuned = engine.knobs(case.scene, start), engine.recipe(case.scene, start)
    menu = Menu(knobs, steps, own, tuned)
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


def _search(kitchen: Kitchen, *, front: bool) -> Asking[Recipe | None]:
    yield [NOTHING.at(kitchen.menu.own)]
    found = yield from recipe(kitchen)
    if front:
        tuned = Choice(("tuned",), kitchen.menu.tuned)
        yield rungs_of(kitchen, tuned, *([found.choice] if found else []))
    return found


def row(one: Advised) -> Advice:
    """A row of advice.csv."""
    empty = Advice(
        one.pair.case.name,
        one.pair.engine.name,
        one.asked.tolerance,
        one.asked.margin,
        *("none", "", None, None, None, None, "", ""),
    )
    if one.kitchen is None:
        assert isinstance(one.way, Refusal)
        return replace(empty, remains=one.way.because)
    empty = replace(empty, shipped_cost=one.kitchen.cost(one.shipped))
    if one.recipe is None:
        return replace(empty, **_remains(one))
    worst, quantity = one.kitchen.bar.worst(one.recipe.candidate)
    return replace(
        empty,
        recipe=words(one.recipe.choice),
        options=as_text(one.recipe.choice.options),
        step=one.recipe.step,
        cost=one.kitchen.cost(one.recipe.candidate),
        worst=worst,
        quantity=quantity,
    )


def words(choice: Choice) -> str:
    """`RK4 + impratio 100`."""
    return " + ".join(choice.words) or "as shipped"


def _remains(one: Advised) -> dict[str, str | float]:
    """What no recipe brings within the bar, and what the engine leaves out of the scene."""
    assert one.kitchen is not None
    assert isinstance(one.way, Plan)
    found, left_out = best(one.kitchen), one.way.simplified
    if found is None:
        return {"remains": "; ".join(filter(None, ("every run diverges", left_out)))}
    candidate, worst, quantity = found
    best_of = f"{as_text(candidate.options)} at {candidate.step:.3g} s"
    what = f"{quantity} stays ×{worst:.2g} with {best_of}, the best of all that was tried"
    return {
        "worst": worst,
        "quantity": quantity,
        "remains": "; ".join(filter(None, (what, left_out))),
    }
