"""What was asked for and what was found, and the row of advice.csv that says so."""

from dataclasses import dataclass, replace

from ...engines.engine import Plan, Refusal
from ...engines.knobs import as_text
from ..row import Advice
from ..unit import Pair
from .candidate import Candidate
from .draws import Held
from .menu import NOTHING, Choice
from .recipe import Kitchen, Recipe, best


@dataclass(frozen=True)
class Asked:
    """tolerance: of each quantity's own size; None: what the case allows."""

    tolerance: float | None
    margin: float
    front: bool = False  # whether cost against error is drawn
    robust: bool = False  # whether the recipe is tried with other parameters


@dataclass(frozen=True)
class Advised:
    """way: the native one as shipped, or why there is none. kitchen: with all that was run."""

    pair: Pair
    asked: Asked
    way: Plan | Refusal
    kitchen: Kitchen | None
    recipe: Recipe | None
    draws: Held | None = None

    @property
    def shipped(self) -> Candidate:
        assert self.kitchen is not None
        return NOTHING.at(self.kitchen.menu.own)


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
    if one.kitchen.bar.holds(candidate):
        but = "and the next finer step does not confirm it"
        what = f"{quantity} is ×{worst:.2g} with {best_of}, {but}"
    return {
        "worst": worst,
        "quantity": quantity,
        "remains": "; ".join(filter(None, (what, left_out))),
    }
