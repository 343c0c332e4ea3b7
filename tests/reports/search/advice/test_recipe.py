"""The minimal recipe: the fewest options, then the largest step, of planted errors."""

from collections.abc import Callable, Mapping
from math import inf
from typing import Any

import pytest
from given.command.planted_runs import Error, answered, recipe_search
from given.otherwise import otherwise

from textmech.engines.knobs import Knob, Value
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.search.advice import advise
from textmech.reports.search.advice import recipe as searching
from textmech.reports.search.advice.candidates import Candidates, fitting
from textmech.reports.search.advice.recipe import Recipe, Recipes, Search, best, front, recipes
from textmech.reports.search.causes.candidate import Candidate

STEPS = [8e-3, 4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4]  # s
OWN = 2e-3


def knob(name: str, *values: Any, kind: Any = "option") -> Knob:
    return Knob(name, tuple(Value(f"{name} {x}", {name: x}) for x in values), kind=kind)


ONE, TWO = knob("one", 1), knob("two", 1, 2)
WHOLE = Knob("whole", (Value("whole", {"a": {"b": 1, "c": 1}, "d": 1}),), kind="bundle")
TUNED = {"one": 1, "two": 2, "three": 3, "inert": 1}


def searched(error: Error, *knobs: Knob) -> tuple[Recipes | None, Search]:
    candidates = Candidates(knobs or (ONE, TWO), STEPS, OWN, TUNED)
    search = recipe_search({}, 2.0, candidates=candidates)
    return answered(lambda: recipes(search), error), search


def of(error: Error, *knobs: Knob, which: str = "fewest") -> tuple[dict[str, Any], float] | None:
    found, _ = searched(error, *knobs)
    recipe: Recipe | None = getattr(found, which, None)
    return recipe and (dict(recipe.choice.options), recipe.candidate.step)


def off_by_sign(sign: int) -> Error:
    """`one` takes from the error, or adds to it."""
    return lambda o, h: abs(3.0 + sign * 2.8 * o.get("one", 0)) + (0 if "two" in o else 100)


START, MANY = knob("start", 1, kind="protocol"), knob("many", 10.0, 100.0, 1e4, 1e6)
MUCH = Knob("much", (Value("much", {"many": 1e6, "d": 1}),), kind="bundle")
FOUND: Mapping[str, tuple[Error, tuple[Knob, ...], tuple[dict[str, Any], float] | None]] = {
    "nothing, where nothing has to be changed": (lambda o, h: 100 * h, (), ({}, 4e-3)),
    "an option, which costs less than a step below its own": (
        lambda o, h: 0.1 if "one" in o else 1000 * h, (), ({"one": 1}, 8e-3)
    ),
    "a step below its own, which counts as an option": (
        lambda o, h: inf if o else 1000 * h, (), ({}, 5e-4)
    ),
    "two options with the values that do it": (
        lambda o, h: 0.1 if (o.get("one"), o.get("two")) == (1, 2) else 9.0,
        (), ({"one": 1, "two": 2}, 8e-3),
    ),
    "what holds at the next finer step too": (
        lambda o, h: {8e-3: 0.1, 4e-3: 9.0}.get(h, 0.1), (), ({}, 2e-3)
    ),
    "none that holds at one step alone": (lambda o, h: 0.1 if h == OWN else 9.0, (), None),
    "a knob of the right sign": (off_by_sign(-1), (), ({"one": 1, "two": 1}, 8e-3)),
    "none of the wrong sign": (off_by_sign(+1), (), None),
    "of the same cost the engine's own options": (
        lambda o, h: 0.1 / len(o) if o else 9.0, (START, ONE), ({"one": 1}, 8e-3)
    ),
    "at last a whole recipe without what it does not need": (
        lambda o, h: 0.1 if o.get("a", {}).get("b") and o.get("d") else 9.0,
        (ONE, WHOLE), ({"a": {"b": 1}, "d": 1}, 8e-3),
    ),
    "at last the tuned one without what it does not need": (
        lambda o, h: 0.1 if o.get("three") and o.get("two") == 2 else 9.0,
        (ONE, knob("two", 1)), ({"two": 2, "three": 3}, 8e-3),
    ),
    "the mildest number that does": (
        lambda o, h: 10.0 / o["many"] if "many" in o else 9.0, (MANY,), ({"many": 100.0}, 8e-3)
    ),
    "the mildest number of a whole recipe": (
        lambda o, h: 10.0 / o["many"] if {"many", "d"} <= set(o) else 9.0,
        (MANY, MUCH), ({"many": 100.0, "d": 1}, 8e-3),
    ),
}  # fmt: skip


@pytest.mark.parametrize("what", FOUND)
def test_a_recipe_is(what: str) -> None:
    error, knobs, recipe = FOUND[what]
    assert of(error, *knobs) == recipe


def test_what_only_rounding_makes_better_is_not_advised() -> None:
    """Two values of one knob that do the same: the first, on any processor."""
    for last in (-1, 1):

        def error(o: Mapping[str, Any], h: float, last: int = last) -> float:
            return 0.4 * (1 + last * o["two"] * 1e-15) if "two" in o else 9.0

        assert of(error, TWO) == ({"two": 1}, 8e-3)
        nothing, search = searched(lambda o, h, error=error: 10 * error(o, h), TWO)
        assert nothing is None
        assert best(search)


def test_where_nothing_keeps_the_bar_the_least_worst_is_told() -> None:
    found, search = searched(lambda o, h: 5.0 if o.get("two") == 2 else 9.0)
    assert found is None
    told = best(search)
    assert told is not None
    assert (told[0].options.get("two"), told[1], told[2]) == (2, 5.0, "x")
    _, lost = searched(lambda o, h: inf)
    assert best(lost) is None


def test_a_front_has_no_point_that_costs_more_and_is_hardly_better() -> None:
    errors = {8e-3: 9.0, 4e-3: 8.9, 2e-3: 3.0, 1e-3: 4.0, 5e-4: 1.0, 2.5e-4: inf}
    known = {Candidate.of({}, h): {"x": x} if x < inf else {} for h, x in errors.items()}
    points = front(recipe_search(known, 2.0))
    assert [(c.step, x) for c, x, _ in points] == [(8e-3, 9.0), (2e-3, 3.0), (5e-4, 1.0)]


def test_what_one_setting_tells_the_others_must_tell_too() -> None:
    both, one = Candidate.of({}, 1.0), Candidate.of({"one": 1}, 1.0)
    search = recipe_search({both: {"x": 0.1, "force": 0.1}, one: {"x": 0.1}}, 1.0)
    assert search.passes(both)
    assert search.worst(one) == (inf, "force")


@pytest.mark.parametrize(
    ("interval", "steps"),
    [
        (0.04, [1e-2, 5e-3, 2e-3, 1e-3]),
        (0.02, [1e-2, 5e-3, 2e-3, 1e-3]),
        (0.012, [2e-3, 1e-3]),  # nothing is shortened
        (0.002, [2e-3, 1e-3]),
    ],
)
def test_steps_meet_every_sample(interval: float, steps: list[float]) -> None:
    assert fitting([1e-2, 5e-3, 2e-3, 1e-3], 2e-3, interval) == steps
    assert fitting([1e-2, 5e-3], 2e-3, 2e-2) == [1e-2, 5e-3, 2e-3]


def test_the_cheapest_may_change_more() -> None:
    """One option needs 0.25 ms; both do with 8 ms, and cost a thirty-second."""

    def error(o: Mapping[str, Any], h: float) -> float:
        return 0.1 if {"one", "two"} <= set(o) else 1000 * h if "one" not in o else 9.0

    assert of(error) == ({}, 5e-4)
    assert of(error, which="cheapest") == ({"one": 1, "two": 1}, 8e-3)
    lucky = lambda o, h: error(o, h) if h == 8e-3 or not o else 9.0  # noqa: E731
    assert of(lucky, which="cheapest") == ({}, 5e-4)  # not confirmed at the next finer step


def test_what_costs_the_same_changes_less() -> None:
    found, _ = searched(lambda o, h: 0.1 / (1 + len(o)) if "one" in o else 9.0)
    assert found
    assert found.cheapest is found.fewest


def smallest_error(search: Search, recipe: Recipe) -> tuple[float]:
    """The recipe of the smallest error in place of the cheapest."""
    return (search.worst(recipe.candidate)[0],)


@pytest.mark.mutant("the recipe of the smallest error in place of the cheapest")
def test_of_recipes_that_keep_the_bar_the_cheapest_is_taken(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """`one` is within at 8 ms, hardly; `two` at 1 ms alone, and there by far."""

    def error(o: Mapping[str, Any], h: float) -> float:
        return 0.4 if "one" in o else (1e-3 if h <= 2e-3 else 9.0) if "two" in o else 9.0

    assert of(error) == ({"one": 1}, 8e-3)
    monkeypatch.setattr(Search, "rank", smallest_error)
    assert of(error) == ({"two": 1}, 2e-3)


@pytest.mark.mutant("what is taken out of a recipe is not confirmed at half the step")
def test_what_is_left_of_a_recipe_holds_at_half_its_step_too(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Without `d` it is within at 8 ms alone, by luck: `d` stays."""
    luck = lambda o, h: h == 8e-3 or o.get("d")  # noqa: E731

    def error(o: Mapping[str, Any], h: float) -> float:
        return 0.1 if o.get("a", {}).get("b") and luck(o, h) else 9.0

    assert of(error, ONE, WHOLE) == ({"a": {"b": 1}, "d": 1}, 8e-3)
    was = "rungs = [recipe.candidate, recipe.choice.at(recipe.candidate.step / 2)]"
    hasty = otherwise(searching, was, "rungs = [recipe.candidate]")
    monkeypatch.setattr(Search, "holds", hasty.Search.holds)
    assert of(error, ONE, WHOLE) == ({"a": {"b": 1}}, 8e-3)


# Another tolerance than the case's: errors over a part of each quantity's own size.

PLAIN = Candidate.of({}, 1e-3)


def scale(made: Trial, tolerance: float | None, module: Any = advise) -> Any:
    return module._scale(made, tolerance)


@pytest.mark.mutant("what is asked for upside down")
def test_an_error_is_told_over_a_part_of_the_quantitys_size(trial: Callable[..., Trial]) -> None:
    """It reaches 1 m, and 1 cm is allowed: ten times a thousandth of it."""
    made = trial()
    assert scale(made, None) == {}
    assert scale(made, 1e-3) == {"ball.x": pytest.approx(10.0)}
    assert scale(made, 1e-1) == {"ball.x": pytest.approx(0.1)}
    was = "(trial.allowed(name) or 0.0) / (tolerance * size)"
    other = otherwise(advise, was, "(tolerance * size) / (trial.allowed(name) or 1.0)")
    assert scale(made, 1e-3, other) == {"ball.x": pytest.approx(0.1)}


@pytest.mark.mutant("a thousandth of what is zero but for rounding is asked for")
@pytest.mark.parametrize("size", [0.0, 4e-17])
def test_what_is_zero_has_no_size(
    trial: Callable[..., Trial], size: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = trial()
    monkeypatch.setattr(Trial, "size", lambda self, name: size)
    assert scale(made, 1e-3) == {}
    was = "size > ZERO * (trial.allowed(name) or 0.0)"
    assert (scale(made, 1e-3, otherwise(advise, was, "size > 0")) == {}) is (size == 0.0)


def passes(margin: float, factor: float, module: Any = searching) -> bool:
    """Of an error of 0.4 of what the case allows."""
    return recipe_search({PLAIN: {"x": 0.4}}, margin, {"x": factor}, module=module).passes(PLAIN)


@pytest.mark.mutant("the tolerance that is asked for, or the margin, left out")
def test_the_margin_and_the_tolerance_that_is_asked_for_are_kept() -> None:
    assert [passes(margin, 1.0) for margin in (1.0, 2.0, 3.0)] == [True, True, False]
    assert [passes(1.0, factor) for factor in (0.1, 2.0, 10.0)] == [True, True, False]
    assert passes(1.0, 10.0, otherwise(searching, " * self.scale.get(name, 1.0)", ""))
    assert passes(3.0, 1.0, otherwise(searching, "<= 1 / self.margin", "<= 1"))
