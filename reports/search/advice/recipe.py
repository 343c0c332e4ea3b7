"""Two recipes that keep all tolerances: the one with the fewest changed options, and the cheapest.

Forward: none, one, two options, all sets of a size; then whole recipes. Taking options out of the
tuned setting ends elsewhere with every order.
"""

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import takewhile
from math import inf
from typing import Any

from ....engines.knobs import merged
from ..causes.candidate import Candidate
from ..causes.errors import of
from ..causes.search import Ladder, Runs, fewest, passing
from .candidates import MOST, NOTHING, WHOLE, Candidates, Choice, parts


@dataclass(frozen=True)
class Recipe:
    """A choice at its step: it keeps the tolerances there, and at the next finer step."""

    choice: Choice
    candidate: Candidate


def digits(error: float) -> float:
    """In digits that no rounding decides."""
    return float(f"{error:.3g}")


@dataclass(frozen=True)
class Search:
    """The choices that a recipe may be made of, what it costs, and what it has to keep.

    margin: how often the worst error has to fit into what is allowed. scale: by quantity what its
    error over the case's own tolerance is multiplied by, where another tolerance is asked for.
    elsewhere: the worst in models that a user may have instead, as far as that was asked; there no
    margin has to be left.
    """

    runs: Runs
    candidates: Candidates
    cost: Callable[[Candidate], float]
    margin: float
    scale: Mapping[str, float] = field(default_factory=dict[str, float])
    elsewhere: dict[Candidate, float] = field(default_factory=dict[Candidate, float])

    def worst(self, candidate: Candidate, runs: Runs | None = None) -> tuple[float, str]:
        """The largest error over what is allowed, and whose; inf where the run came to nothing.

        Whatever any run has told must be told: a setting may lose a quantity.
        """
        runs = runs or self.runs
        errors = runs.known[candidate]
        ratios = [(of(errors, name) * self.scale.get(name, 1.0), name) for name in runs.names]
        return max(ratios, default=(inf, ""), key=lambda each: each[0])

    def passes(self, candidate: Candidate) -> bool:
        """At this step alone."""
        here = self.worst(candidate)[0] <= 1 / self.margin
        return here and self.elsewhere.get(candidate, 0.0) <= 1.0

    def holds(self, recipe: Recipe) -> bool:
        """At its step and at half of it."""
        rungs = [recipe.candidate, recipe.choice.at(recipe.candidate.step / 2)]
        self.runs.need(rungs)
        return all(map(self.passes, rungs))

    def leave_out(self, elsewhere: Mapping[Candidate, float]) -> None:
        """Records the errors elsewhere; what is like a candidate that fails there fails with it.

        Two are alike if at one step the worst error here is the same, of the same quantity. Options
        that change nothing here change nothing there: each would be asked after the other.
        """
        self.elsewhere.update(elsewhere)
        here = {candidate: self._here(candidate) for candidate in self.runs.known}
        lost = {here[c]: x for c, x in self.elsewhere.items() if c in here and not x <= 1.0}
        alike = {c: lost[here[c]] for c in here.keys() - self.elsewhere if here[c] in lost}
        self.elsewhere.update(alike)

    def _here(self, candidate: Candidate) -> tuple[float, float, str]:
        worst, quantity = self.worst(candidate)
        return candidate.step, digits(worst), quantity

    def rank(self, recipe: Recipe) -> tuple[float, int, int, float]:
        """The cheapest first; of those the fewest options, the engine's own, the smallest error.

        In digits that no rounding decides: of those that are alike the first, which changes least.
        """
        candidate, choice = recipe.candidate, recipe.choice
        error = digits(self.worst(candidate)[0])
        return self.cost(candidate), choice.size, choice.protocol, error

    def first(self, groups: Iterable[Sequence[Ladder[Choice]]]) -> Recipe | None:
        """The best of the first group in which any choice passes."""
        passed = fewest(self.runs, groups, self.passes)
        return min((Recipe(*each) for each in passed), key=self.rank, default=None)


@dataclass(frozen=True)
class Recipes:
    """Which may be the same."""

    fewest: Recipe
    cheapest: Recipe


def recipes(search: Search) -> Recipes | None:
    """Both, with the mildest numbers that do; None where nothing passes."""
    least = search.first(search.candidates.groups())
    if least is None:
        whole = search.first(search.candidates.whole_groups())
        if whole is None:
            return None
        least = _without_unneeded(search, whole)
    least = _weakest(search, least)
    cheapest = _cheapest(search, least)
    if _changes(search, cheapest) <= _changes(search, least):
        least = cheapest  # a knob may turn several options at once
    return Recipes(least, cheapest)


def _changes(search: Search, recipe: Recipe) -> int:
    """How many options a user writes, a smaller step among them."""
    finer = recipe.candidate.step < search.candidates.own * (1 - WHOLE)
    return len([*parts(recipe.choice.options)]) + finer


def _cheapest(search: Search, least: Recipe) -> Recipe:
    """Whatever it changes: what passes at the largest step at which it costs less."""
    listed, dear = search.candidates, search.cost(least.candidate) * (1 - WHOLE)
    choices = [choice for size in range(MOST + 1) for choice in listed.choices(size)]
    ladders: list[Ladder[Choice]] = []
    for choice in choices + listed.bundles(0):
        rungs = [choice.at(step) for step in (*listed.steps, listed.steps[-1] / 2)]
        if cheaper := sum(search.cost(candidate) < dear for candidate in rungs[:-1]):
            ladders.append(Ladder(choice, rungs[: cheaper + 1]))
    passed = passing(search.runs, ladders, search.passes)
    best = min([least, *(Recipe(*each) for each in passed)], key=search.rank)
    return least if best is least else _weakest(search, _without_unneeded(search, best))


def _weakest(search: Search, recipe: Recipe) -> Recipe:
    """With each number as far from extremes as does: knobs have their values in that order."""
    for knob, value in search.candidates.values_in(recipe.choice.options):
        for weaker in takewhile(lambda v, value=value: v is not value, knob.values):
            options = merged(recipe.choice.options, weaker.options)
            less = _with(recipe, replace(recipe.choice, options=options))
            holds = search.holds(less)
            if holds and search.cost(less.candidate) <= search.cost(recipe.candidate):
                recipe = less
                break
    return recipe


def _without_unneeded(search: Search, recipe: Recipe) -> Recipe:
    """Without what is not needed at its step, taken out one after the other."""
    for part in parts(recipe.choice.options):
        options = _without(recipe.choice.options, part)
        size = len([*parts(options)])
        less = _with(recipe, Choice(options, size, recipe.choice.protocol))
        if search.holds(less):
            recipe = less
    return recipe


def _with(recipe: Recipe, choice: Choice) -> Recipe:
    return Recipe(choice, choice.at(recipe.candidate.step))


def _without(options: Mapping[str, Any], part: tuple[str, ...]) -> dict[str, Any]:
    name, *rest = part
    inner = _without(options[name], tuple(rest)) if rest else {}
    others = {k: inner if k == name else v for k, v in options.items()}
    return others if inner else {k: v for k, v in others.items() if k != name}


def best(search: Search) -> tuple[Candidate, float, str] | None:
    """The least bad of all runs, where nothing passes: candidate, worst ratio, quantity."""
    finite = [each for each in _all_runs(search) if each[1] < inf]
    return min(finite, key=lambda each: (digits(each[1]), search.cost(each[0])), default=None)


def front(search: Search, thin: float = 0.8) -> Iterator[tuple[Candidate, float, str]]:
    """Pareto front of cost and error; a step must gain 20 %."""
    least = inf
    for each in sorted(_all_runs(search), key=lambda each: (search.cost(each[0]), each[1])):
        if each[1] <= thin * least and each[1] < inf:
            least = each[1]
            yield each


def _all_runs(search: Search) -> list[tuple[Candidate, float, str]]:
    return [(each, *search.worst(each)) for each in search.runs.known]


def rungs_of(search: Search, *choices: Choice) -> list[Candidate]:
    """Nothing changed and each of the choices, at every step: what a front is drawn through."""
    return [choice.at(step) for choice in (NOTHING, *choices) for step in search.candidates.steps]
