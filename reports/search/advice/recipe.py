"""Two recipes that keep a bar: the one with the fewest changed options, and the cheapest.

Forward: none, one, two options, all sets of a size; then whole recipes. Taking options out of the
tuned setting ends elsewhere with every order.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import takewhile
from math import inf
from typing import Any

from ....engines.knobs import short_value
from ..causes.candidate import Candidate
from ..causes.parallel_search import Asking
from .candidates import MOST, NOTHING, WHOLE, Choice, Menu, parts
from .criterion import Bar, digits

Cost = Callable[[Candidate], float]


@dataclass(frozen=True)
class Recipe:
    """A choice at its step [s]: the bar is kept there, and at the next finer step."""

    choice: Choice
    step: float

    @property
    def candidate(self) -> Candidate:
        return self.choice.at(self.step)


@dataclass(frozen=True)
class Kitchen:
    """The input of a search for recipes: its menu, the bar to keep, and what a candidate costs."""

    menu: Menu
    bar: Bar
    cost: Cost

    def rank(self, recipe: Recipe) -> tuple[float, int, int, float]:
        """The cheapest first; of those the fewest options, the engine's own, the smallest error.

        In digits that no rounding decides: of those that are alike the first, which changes least.
        """
        candidate = recipe.candidate
        error = digits(self.bar.worst(candidate)[0])
        return self.cost(candidate), recipe.choice.size, recipe.choice.protocol, error


@dataclass(frozen=True)
class Recipes:
    """Which may be the same."""

    fewest: Recipe
    cheapest: Recipe


def recipes(kitchen: Kitchen) -> Asking[Recipes | None]:
    """Both, with the mildest numbers that do; None where nothing keeps the bar."""
    found = yield from _fewest(kitchen)
    if found is None:
        return None
    fewest = yield from _mild(kitchen, found)
    cheapest = yield from _cheapest(kitchen, fewest)
    if _changes(kitchen, cheapest) <= _changes(kitchen, fewest):
        fewest = cheapest  # a knob may turn several options at once
    return Recipes(fewest, cheapest)


def _changes(kitchen: Kitchen, recipe: Recipe) -> int:
    """How many options a user writes, a smaller step among them."""
    finer = recipe.step < kitchen.menu.own * (1 - WHOLE)
    return len([*parts(recipe.choice.options)]) + finer


def _fewest(kitchen: Kitchen) -> Asking[Recipe | None]:
    """The first size that has an answer; a step below its own counts as an option."""
    menu = kitchen.menu
    finer: list[Choice] = []
    for size in range(MOST + 1):
        choices = list(menu.choices(size))
        found = yield from _usable(kitchen, choices, menu.coarse)
        found += yield from _usable(kitchen, finer, menu.fine)
        if found:
            return min(found, key=kitchen.rank)
        finer = choices
    for steps in (menu.coarse, menu.fine):
        for wholes in (menu.bundles(0), menu.bundles(1)):
            if found := (yield from _usable(kitchen, wholes, steps)):
                return (yield from _lean(kitchen, min(found, key=kitchen.rank)))
    return None


def _usable(
    kitchen: Kitchen, choices: Sequence[Choice], steps: Sequence[float]
) -> Asking[list[Recipe]]:
    """Each with the largest of the steps from which on the bar is kept, and at half the last.

    The finest is asked first: most that cannot keep it are seen there, also where errors beside an
    event do not fall with any slope.
    """
    if not steps:
        return []
    yield [choice.at(steps[-1]) for choice in choices]
    left = [choice for choice in choices if kitchen.bar.holds(choice.at(steps[-1]))]
    rungs = [*steps, steps[-1] / 2]
    yield [choice.at(step) for choice in left for step in rungs]
    return [recipe for choice in left if (recipe := _largest(kitchen, choice, rungs))]


def _largest(kitchen: Kitchen, choice: Choice, rungs: Sequence[float]) -> Recipe | None:
    """The last of the rungs is only there to be finer: where it does not hold, none does."""
    held = list(takewhile(lambda h: kitchen.bar.holds(choice.at(h)), reversed(rungs)))
    return Recipe(choice, held[-1]) if held else None


def _cheapest(kitchen: Kitchen, fewest: Recipe) -> Asking[Recipe]:
    """Whatever it changes: what keeps the bar at the largest step at which it costs less."""
    menu, dear = kitchen.menu, kitchen.cost(fewest.candidate) * (1 - WHOLE)
    choices = [c for size in range(MOST + 1) for c in menu.choices(size)] + menu.bundles(0)
    steps = {
        choice: [step for step in menu.steps if kitchen.cost(choice.at(step)) < dear]
        for choice in choices
    }
    left = [choice for choice in choices if steps[choice]]
    yield [choice.at(steps[choice][-1]) for choice in left]
    left = [choice for choice in left if kitchen.bar.holds(choice.at(steps[choice][-1]))]
    all_steps = [*menu.steps, menu.steps[-1] / 2]
    rungs = {choice: all_steps[: len(steps[choice]) + 1] for choice in left}
    yield [choice.at(step) for choice in left for step in rungs[choice]]
    found = [one for choice in left if (one := _largest(kitchen, choice, rungs[choice]))]
    found = [one for one in found if one.step in steps[one.choice]]
    best = min([fewest, *found], key=kitchen.rank)
    if best is fewest:
        return fewest
    lean = yield from _lean(kitchen, best)
    return (yield from _mild(kitchen, lean if lean.choice.options != best.choice.options else best))


def _mild(kitchen: Kitchen, found: Recipe) -> Asking[Recipe]:
    """With each number as far from extremes as does: knobs have their values in that order."""
    for knob, value in list(kitchen.menu.values_in(found.choice.options)):
        for milder in takewhile(lambda v, value=value: v is not value, knob.values):
            less = Recipe(found.choice.milder(value, milder), found.step)
            confirmed = [less.candidate, less.choice.at(less.step / 2)]
            yield confirmed
            cheaper = kitchen.cost(less.candidate) <= kitchen.cost(found.candidate)
            if cheaper and all(kitchen.bar.holds(candidate) for candidate in confirmed):
                found = less
                break
    return found


def _lean(kitchen: Kitchen, whole: Recipe) -> Asking[Recipe]:
    """Without what is not needed at its step, taken out one after the other."""
    kept = whole
    for part in parts(whole.choice.options):
        options = _without(kept.choice.options, part)
        less = Recipe(Choice(named_options(options), options, kept.choice.protocol), kept.step)
        rungs = [less.candidate, less.choice.at(less.step / 2)]
        yield rungs
        if all(kitchen.bar.holds(candidate) for candidate in rungs):
            kept = less
    return kept


def named_options(options: Mapping[str, Any]) -> tuple[str, ...]:
    """The names of options, each with its value: `pair.solref 2h 1`."""
    return tuple(_called(part, options) for part in parts(options))


def _called(part: tuple[str, ...], options: Mapping[str, Any]) -> str:
    value: Any = options
    for name in part:
        value = value[name]
    if part == ("integrator",):
        return str(value)
    on = value is True
    return ".".join(part) if on else f"{'.'.join(part)} {short_value(value)}"


def _without(options: Mapping[str, Any], part: tuple[str, ...]) -> dict[str, Any]:
    name, *rest = part
    if not rest:
        return {k: v for k, v in options.items() if k != name}
    inner = _without(options[name], tuple(rest))
    found = {k: inner if k == name else v for k, v in options.items()}
    return found if inner else {k: v for k, v in found.items() if k != name}


def best(kitchen: Kitchen) -> tuple[Candidate, float, str] | None:
    """The least bad of all runs, where nothing keeps the bar: candidate, worst ratio, quantity."""
    told = [(candidate, *kitchen.bar.worst(candidate)) for candidate in kitchen.bar.known]
    finite = [one for one in told if one[1] < inf]
    return min(finite, key=lambda one: (digits(one[1]), kitchen.cost(one[0])), default=None)


def front(kitchen: Kitchen, thin: float = 0.8) -> Iterator[tuple[Candidate, float, str]]:
    """Cost against error: what is worth more than what costs less, each by a fifth at least."""
    least = inf
    told = [(candidate, *kitchen.bar.worst(candidate)) for candidate in kitchen.bar.known]
    for one in sorted(told, key=lambda one: (kitchen.cost(one[0]), one[1])):
        if one[1] <= thin * least and one[1] < inf:
            least = one[1]
            yield one


def rungs_of(kitchen: Kitchen, *choices: Choice) -> list[Candidate]:
    """Nothing changed and each of the choices, at every step: what a front is drawn through."""
    return [choice.at(step) for choice in (NOTHING, *choices) for step in kitchen.menu.steps]
