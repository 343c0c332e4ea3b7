"""Makes the rows of advice.csv from what was asked for and what was found."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

from ....cases.theme import themes
from ....engines.engine import Plan, Refusal, Shape
from ....engines.knobs import as_text
from ...runs.tasks import Pair
from ...tables.row import Advice
from ...tables.short_numbers import milliseconds
from ..causes.candidate import Candidate
from .candidates import NOTHING, Choice
from .criterion import Bar
from .real_shapes import Beside
from .recipe import Kitchen, Recipe, Recipes, best, named_options


@dataclass(frozen=True)
class Requirement:
    """tolerance: of each quantity's own size; None: what the case allows."""

    tolerance: float | None
    margin: float
    front: bool = False  # whether cost against error is drawn


@dataclass(frozen=True)
class Advised:
    """way: the native one as shipped, or why there is none. kitchen: with all that was run."""

    pair: Pair
    asked: Requirement
    way: Plan | Refusal
    kitchen: Kitchen | None
    recipes: Recipes | None
    shapes: Sequence[Shape] = ()  # that a user has; what is advised is measured on the first
    beside: Beside = field(default_factory=dict[Candidate, Any])  # on the others

    @property
    def shipped(self) -> Candidate:
        assert self.kitchen is not None
        return NOTHING.at(self.kitchen.menu.own)

    @property
    def wanted(self) -> list[tuple[str, Recipe]]:
        """The recipes by what they are, one that is both once; none where nothing keeps the bar."""
        if self.recipes is None:
            return []
        fewest, cheapest = self.recipes.fewest, self.recipes.cheapest
        if fewest.candidate == cheapest.candidate:
            return [(BOTH, fewest)]
        return [(FEWEST, fewest), (CHEAPEST, cheapest)]

    @property
    def pasted(self) -> list[Candidate]:
        """The candidates to paste: the recipes, or where there is none the nearest of all runs."""
        if self.kitchen is None or self.recipes is not None:
            return [recipe.candidate for _, recipe in self.wanted]
        nearest = best(self.kitchen)
        return [nearest[0]] if nearest else []


FEWEST, CHEAPEST, BOTH = "fewest changes", "cheapest", "both"


def rows(one: Advised) -> list[Advice]:
    """The rows of advice.csv: one, or one for each of two recipes."""
    empty = Advice(
        one.pair.case.name,
        " ".join(themes(one.pair.case)),
        one.pair.engine.name,
        one.asked.tolerance,
        one.asked.margin,
        *("", "none", "", None, None, None, None, "", ""),
    )
    if one.kitchen is None:
        assert isinstance(one.way, Refusal)
        return [replace(empty, remains=one.way.because)]
    empty = replace(empty, shipped_cost=one.kitchen.cost(one.shipped))
    if one.recipes is None:
        return [replace(empty, **_remains(one))]
    return [_of(one, one.kitchen, want, recipe, empty) for want, recipe in one.wanted]


def _of(one: Advised, kitchen: Kitchen, want: str, recipe: Recipe, empty: Advice) -> Advice:
    worst, quantity = kitchen.bar.worst(recipe.candidate)
    return replace(
        empty,
        want=want,
        recipe=words(recipe.choice),
        settings=settings(one.pair, recipe.candidate),
        step=recipe.step,
        cost=kitchen.cost(recipe.candidate),
        ratio=worst,
        quantity=quantity,
    )


def settings(pair: Pair, candidate: Candidate) -> str:
    """A file of settings, whole, on one line: with it a run has the error that is told."""
    tried = candidate.on(pair.shapes)
    return f"{pair.engine.name}: {as_text({**tried.options, 'step': tried.step})}"


def words(choice: Choice) -> str:
    """`RK4 + impratio 100`: its one name, of the engine's own options and their values."""
    return " + ".join(named_options(choice.options)) or "as shipped"


def _nothing(bar: Bar) -> str:
    """Why no run has an error that could be told: in each of them one is without end."""
    if not any(bar.known.values()):
        return "every run diverges"
    return "no run tells every quantity, and has each event as often as the textbook"


def _remains(one: Advised) -> dict[str, str | float]:
    """Columns: what no recipe brings within the bar, what the engine leaves out of the scene."""
    assert one.kitchen is not None
    assert isinstance(one.way, Plan)
    found, left_out = best(one.kitchen), one.way.simplified
    if found is None:
        return {"remains": "; ".join(filter(None, (_nothing(one.kitchen.bar), left_out)))}
    candidate, worst, quantity = found
    told = f"with {as_text(candidate.options)}" if candidate.options else "as shipped"
    best_of = f"{told} at {milliseconds(candidate.step)}"
    if worst <= 1.0:
        margin = one.asked.margin
        but = f"within what is asked for, but not by the margin of {margin:g}"
        what = f"{quantity} is ×{worst:.2g} {best_of}: {but}"
    else:
        what = f"{quantity} stays ×{worst:.2g} {best_of}, the best of all that was tried"
    if not one.kitchen.bar.elsewhere.get(candidate, 0.0) <= 1.0:
        where = "on other shapes" if one.shapes else "where a loop is cut elsewhere"
        what = f"{quantity} is ×{worst:.2g} {best_of}, and not {where}"
    if one.kitchen.bar.holds(candidate):
        but = "and the next finer step does not confirm it"
        what = f"{quantity} is ×{worst:.2g} {best_of}, {but}"
    return {
        "ratio": worst,
        "quantity": quantity,
        "remains": "; ".join(filter(None, (what, left_out))),
    }
