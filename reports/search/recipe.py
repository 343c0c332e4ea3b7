"""The minimal recipe: the fewest changed options, and with them the largest step, that keep a bar.

Forward: none, one, two options, all sets of a size; then whole recipes. Taking options out of the
tuned setting ends elsewhere with every order.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import takewhile
from math import inf
from typing import Any

from .bar import Bar
from .candidate import Candidate
from .menu import MOST, NOTHING, Choice, Menu, parts
from .together import Asking

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
    """What is cooked with: what there is, what is asked for, and what a candidate costs."""

    menu: Menu
    bar: Bar
    cost: Cost

    def rank(self, recipe: Recipe) -> tuple[float, int, float]:
        """The cheapest first; of those the engine's own options, then the smallest error.

        In digits that no rounding decides: of those that are alike the first, which changes least.
        """
        candidate = recipe.candidate
        return self.cost(candidate), recipe.choice.protocol, _told(self.bar.worst(candidate)[0])


def recipe(kitchen: Kitchen) -> Asking[Recipe | None]:
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


def _lean(kitchen: Kitchen, whole: Recipe) -> Asking[Recipe]:
    """Without what is not needed at its step, taken out one after the other."""
    kept = whole
    for part in parts(whole.choice.options):
        options = _without(kept.choice.options, part)
        less = Recipe(Choice(_left(options), options, kept.choice.protocol), kept.step)
        rungs = [less.candidate, less.choice.at(less.step / 2)]
        yield rungs
        if all(kitchen.bar.holds(candidate) for candidate in rungs):
            kept = less
    return kept


def _left(options: Mapping[str, Any]) -> tuple[str, ...]:
    """What is left of a recipe, as the options are called."""
    return tuple(".".join(part) for part in parts(options))


def _without(options: Mapping[str, Any], part: tuple[str, ...]) -> dict[str, Any]:
    name, *rest = part
    if not rest:
        return {k: v for k, v in options.items() if k != name}
    inner = _without(options[name], tuple(rest))
    found = {k: inner if k == name else v for k, v in options.items()}
    return found if inner else {k: v for k, v in found.items() if k != name}


def best(kitchen: Kitchen) -> tuple[Candidate, float, str] | None:
    """Of all that was run the least worst, where nothing keeps the bar."""
    told = [(candidate, *kitchen.bar.worst(candidate)) for candidate in kitchen.bar.known]
    finite = [one for one in told if one[1] < inf]
    return min(finite, key=lambda one: (_told(one[1]), kitchen.cost(one[0])), default=None)


def _told(error: float) -> float:
    return float(f"{error:.3g}")


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
