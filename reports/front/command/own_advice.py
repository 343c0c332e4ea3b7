"""Advice on models of the user's own, in lines."""

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING

from ....cases.mistake import plain
from ...tables.row import BEYOND, DIVERGED
from ...tables.short_numbers import factor, milliseconds

if TYPE_CHECKING:
    from ....cases.mistake import Mistake
    from ...runs.request import Request
    from ...runs.suite import Report
    from ...search.advice.own_model import OwnAdvice, Recipe, Tried


MARGIN = 2.0  # how often errors have to fit into what is allowed, where nobody says it


def advised_models(
    request: "Request", tolerance: float | None, margin: float
) -> "tuple[list[OwnAdvice], list[Mistake]]":
    """Returns the advice on a request's models, each in a process of its own, and the mistakes."""
    from ...runs.models import answers
    from ...search.advice.own_model import AdviceTask

    tasks = [AdviceTask(case, tolerance, margin) for case in request.models]
    with request.results(len(tasks)) as results:
        pairs, mistakes = answers("models advised", tasks, results)
    return [advice for _, advice in pairs], mistakes


def cures(request: "Request", report: "Report") -> dict[str, str]:
    """Returns by name what cures each model that is off by more than a tolerance, in words."""
    off = {line.case for line in report.lines if line.verdict in (BEYOND, DIVERGED)}
    models = [case for case in request.models if case.name in off]
    if not models:
        return {}
    advice, _ = advised_models(replace(request, models=models), None, MARGIN)
    return {each.case: _cure(each) for each in advice}


def _cure(advice: "OwnAdvice") -> str:
    """Returns what costs least of all that keeps every tolerance; or why there is nothing."""
    if advice.because:
        return advice.because
    tried = advice.tried[0]
    keep = [recipe for recipe in tried.cures if recipe.ratio is not None and recipe.ratio <= 1]
    keep += [tried.cheapest] if tried.cheapest else []
    if best := min(keep, key=lambda recipe: recipe.cost, default=None):
        return "; ".join([f"{best.change} ×{best.cost:.2g}", *best.lines])
    return tried.because or "none tried cures it"


def lines(advice: "OwnAdvice") -> Iterator[str]:
    """Yields the advice on a model, line by line; what a person sees comes first."""
    yield ""
    yield plain(f"{advice.case}: {advice.model}" if advice.model else advice.case)
    if advice.because:
        yield plain(f"  nothing is advised: {advice.because}")
    for tried in advice.tried:
        yield from map(plain, _model_lines(tried, advice.margin))


def _model_lines(tried: "Tried", margin: float) -> Iterator[str]:
    yield f"  {tried.started}, judged until {tried.until:.3g} s; its limit by {tried.limit}"
    yield from (f"    {sentence}" for sentence in tried.seen)
    yield from (f"      {number}" for number in tried.suspected)
    own = tried.own
    setting = f"{own.integrator}, {milliseconds(own.step)}"
    yield f"    its own setting, {setting}: {_worst_text(own)}"
    if tried.because:
        yield f"    nothing is advised: {tried.because}"
        return
    if tried.cures:
        yield "    what cures"
    for cure in tried.cures:
        yield f"      {cure.change}: {_price(cure)}"
        yield from (f"        {line}" for line in cure.lines)
        if cure.then and cure.then.change:
            yield f"        then {cure.then.change} keeps all: {_price(cure.then)}"
            yield from (f"          {line}" for line in cure.then.lines)
    yield f"    the coarsest step that keeps all within its tolerance / {margin:g}"
    for recipe in tried.coarsest:
        if recipe.keeps is None:
            yield f"      {recipe.integrator:13} none down to {milliseconds(recipe.step)}"
        else:
            yield f"      {recipe.integrator:13} {milliseconds(recipe.step):9} {_price(recipe)}"
    best = tried.cheapest
    if best is None:
        yield "    no setting keeps it"
    elif best.change:
        yield f"    the cheapest: {best.change}, ×{best.cost:.2g} of its own cost"
        yield from (f"      {line}" for line in best.lines)
    else:
        yield "    the cheapest: its own setting"


def _price(recipe: "Recipe") -> str:
    moves = f"; its own equations then move {recipe.moves} otherwise" if recipe.moves else ""
    return f"costs ×{recipe.cost:.2g}, {_worst_text(recipe)}{moves}"


def _worst_text(recipe: "Recipe") -> str:
    if recipe.ratio is None:
        return "diverges"
    return f"{recipe.quantity} {factor(recipe.ratio)} of what is allowed"
