"""Makes the rows of advice.csv from what was asked for and what was found."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import reduce
from operator import getitem
from typing import Any

from ....cases.theme import themes
from ....engines.engine import Plan, Refusal, Shape
from ....engines.knobs import as_text, short_value
from ...runs.tasks import Pair
from ...tables.row import Advice
from ...tables.short_numbers import milliseconds
from ..causes.candidate import Candidate
from ..causes.search import Runs
from .candidates import NOTHING, Choice, parts
from .recipe import Recipe, Recipes, Search, best


@dataclass(frozen=True)
class Requirement:
    """tolerance: of each quantity's own size; None: what the case allows."""

    tolerance: float | None
    margin: float
    front: bool = False  # whether cost against error is drawn


@dataclass(frozen=True, eq=False)
class Variant:
    """A model that a user may have instead: a loop cut elsewhere, or other shapes, with words.

    held: whether a recipe has to hold there.
    """

    runs: Runs
    words: str = ""
    held: bool = True


@dataclass(frozen=True)
class Advised:
    """way: the native one as shipped, or why there is none. search: with all that was run."""

    pair: Pair
    asked: Requirement
    way: Plan | Refusal
    search: Search | None
    recipes: Recipes | None = None
    shapes: Sequence[Shape] = ()  # that a user has; what is advised is measured on the first
    variants: Sequence[Variant] = ()
    beside: Mapping[Candidate, Sequence[tuple[str, float, str]]] = field(
        default_factory=dict[Candidate, Any]
    )
    """By candidate, for each other shape its words, the worst error, and whose."""

    @property
    def shipped(self) -> Candidate:
        assert self.search is not None
        return NOTHING.at(self.search.candidates.own)

    @property
    def wanted(self) -> list[tuple[str, Recipe]]:
        """The recipes by what they are, one that is both once; none where nothing passes."""
        if self.recipes is None:
            return []
        fewest, cheapest = self.recipes.fewest, self.recipes.cheapest
        if fewest.candidate == cheapest.candidate:
            return [(BOTH, fewest)]
        return [(FEWEST, fewest), (CHEAPEST, cheapest)]

    @property
    def pasted(self) -> list[Candidate]:
        """The candidates to paste: the recipes, or where there is none the nearest of all runs."""
        if self.search is None or self.recipes is not None:
            return [recipe.candidate for _, recipe in self.wanted]
        nearest = best(self.search)
        return [nearest[0]] if nearest else []


FEWEST, CHEAPEST, BOTH = "fewest changes", "cheapest", "both"


def rows(advised: Advised) -> list[Advice]:
    """The rows of advice.csv: one, or one for each of two recipes."""
    empty = Advice(
        advised.pair.case.name,
        " ".join(themes(advised.pair.case)),
        advised.pair.engine.name,
        advised.asked.tolerance,
        advised.asked.margin,
        *("", "none", "", None, None, None, None, "", ""),
    )
    search = advised.search
    if search is None:
        assert isinstance(advised.way, Refusal)
        return [replace(empty, remains=advised.way.because)]
    empty = replace(empty, shipped_cost=search.cost(advised.shipped))
    if advised.recipes is None:
        return [replace(empty, **_nearest_columns(advised, search))]
    return [
        replace(
            empty,
            want=want,
            recipe=words(recipe.choice),
            settings=settings(advised.pair, recipe.candidate),
            step=recipe.candidate.step,
            cost=search.cost(recipe.candidate),
            ratio=worst,
            quantity=quantity,
        )
        for want, recipe in advised.wanted
        for worst, quantity in [search.worst(recipe.candidate)]
    ]


def settings(pair: Pair, candidate: Candidate) -> str:
    """A file of settings, whole, on one line: with it a run has the error that is told."""
    tried = candidate.on(pair.shapes)
    return f"{pair.engine.name}: {as_text({**tried.options, 'step': tried.step})}"


def words(choice: Choice) -> str:
    """`RK4 + impratio 100`: its one name, of the engine's own options and their values."""
    return (
        " + ".join(_called(part, choice.options) for part in parts(choice.options)) or "as shipped"
    )


def _called(part: tuple[str, ...], options: Mapping[str, Any]) -> str:
    value = reduce(getitem, part, options)
    if part == ("integrator",):
        return str(value)
    return ".".join(part) if value is True else f"{'.'.join(part)} {short_value(value)}"


def _nearest_columns(tried: Advised, search: Search) -> dict[str, str | float]:
    """Describes the run nearest to passing, and why it is no recipe, as columns of advice.csv."""
    assert isinstance(tried.way, Plan)
    nearest = best(search)
    columns: dict[str, str | float] = {}
    if nearest is None:
        what = "no run tells every quantity, and has each event as often as the textbook"
        if not search.runs.names:
            what = "every run diverges"
    else:
        candidate, worst, quantity = nearest
        options = f"with {as_text(candidate.options)}" if candidate.options else "as shipped"
        at = f"{options} at {milliseconds(candidate.step)}"
        what = f"{quantity} is ×{worst:.2g} {at}"
        if search.passes(candidate):
            what += ", and the next finer step does not confirm it"
        elif not search.elsewhere.get(candidate, 0.0) <= 1.0:
            elsewhere = "on other shapes" if tried.shapes else "where a loop is cut elsewhere"
            what += f", and not {elsewhere}"
        elif worst <= 1.0:
            what += f": within what is asked for, but not by the margin of {tried.asked.margin:g}"
        else:
            what = f"{quantity} stays ×{worst:.2g} {at}, the best of all that was tried"
        columns = {"ratio": worst, "quantity": quantity}
    return {**columns, "remains": "; ".join(filter(None, (what, tried.way.simplified)))}
