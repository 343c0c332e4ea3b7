"""The minimal recipe: the fewest options, then the largest step, of planted errors."""

from collections.abc import Callable, Mapping
from math import inf
from typing import Any

import pytest
from given.otherwise import otherwise

from textmech.engines.knobs import Knob, Value
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.search.advice import advise
from textmech.reports.search.advice import criterion as bar
from textmech.reports.search.advice import recipe as searching
from textmech.reports.search.advice.candidates import Menu, fitting
from textmech.reports.search.advice.criterion import Bar
from textmech.reports.search.advice.recipe import Kitchen, Recipe, Recipes, best, front, recipes
from textmech.reports.search.causes.candidate import Candidate
from textmech.reports.search.causes.parallel_search import Known

Error = Callable[[Mapping[str, Any], float], float]
STEPS = [8e-3, 4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4, 1.25e-4]  # s
OWN = 2e-3


def knob(name: str, *values: Any, kind: Any = "option") -> Knob:
    return Knob(name, tuple(Value(f"{name} {x}", {name: x}) for x in values), kind=kind)


ONE, TWO = knob("one", 1), knob("two", 1, 2)
WHOLE = Knob("whole", (Value("whole", {"a": {"b": 1, "c": 1}, "d": 1}),), kind="bundle")
TUNED = {"one": 1, "two": 2, "three": 3, "inert": 1}


def cooked(error: Error, *knobs: Knob, margin: float = 2.0) -> tuple[Recipes | None, Kitchen]:
    menu = Menu(knobs or (ONE, TWO), STEPS, OWN, TUNED)
    kitchen = Kitchen(menu, Bar(Known(), margin), lambda c: 1 / c.step)
    asking = recipes(kitchen)
    while True:
        try:
            wanted = next(asking)
        except StopIteration as done:
            return done.value, kitchen
        for candidate in wanted:
            found = error(candidate.options, candidate.step)
            kitchen.bar.known[candidate] = {"x": (found, found)} if found < inf else {}


def of(error: Error, *knobs: Knob, margin: float = 2.0) -> tuple[dict[str, Any], float] | None:
    found, _ = cooked(error, *knobs, margin=margin)
    return None if found is None else (dict(found.fewest.choice.options), found.fewest.step)


def test_nothing_is_changed_where_nothing_has_to_be() -> None:
    assert of(lambda o, h: 100 * h) == ({}, 4e-3)


def test_a_step_below_its_own_counts_as_an_option() -> None:
    """Either is one: the option costs less here, and there the step does."""
    assert of(lambda o, h: 0.1 if "one" in o else 1000 * h) == ({"one": 1}, 8e-3)
    assert of(lambda o, h: inf if o else 1000 * h) == ({}, 5e-4)


def test_two_options_are_found_with_the_values_that_do_it() -> None:
    found = of(lambda o, h: 0.1 if (o.get("one"), o.get("two")) == (1, 2) else 9.0)
    assert found == ({"one": 1, "two": 2}, 8e-3)


def test_what_only_rounding_makes_better_is_not_advised() -> None:
    """Two values of one knob that do the same: the first, on any processor."""
    for last in (-1, 1):

        def error(o: Mapping[str, Any], h: float, last: int = last) -> float:
            return 0.4 * (1 + last * o["two"] * 1e-15) if "two" in o else 9.0

        assert of(error, TWO) == ({"two": 1}, 8e-3)
        nothing, kitchen = cooked(lambda o, h, error=error: 10 * error(o, h), TWO)
        assert nothing is None
        assert best(kitchen)


def test_the_margin_is_kept_at_the_step_and_at_the_next_finer_one() -> None:
    assert of(lambda o, h: 200 * h, margin=1.0) == ({}, 4e-3)
    assert of(lambda o, h: 200 * h, margin=4.0) == ({}, 1e-3)
    luck = {8e-3: 0.1, 4e-3: 9.0}
    assert of(lambda o, h: luck.get(h, 0.1)) == ({}, 2e-3)
    assert of(lambda o, h: 0.1 if h == OWN else 9.0) is None


def test_a_knob_of_the_wrong_sign_is_not_advised() -> None:
    """Planted: `one` takes from the error, or adds to it."""

    def error(sign: int) -> Error:
        return lambda o, h: abs(3.0 + sign * 2.8 * o.get("one", 0)) + (0 if "two" in o else 100)

    assert of(error(-1)) == ({"one": 1, "two": 1}, 8e-3)
    assert of(error(+1)) is None


def test_of_the_same_cost_the_engines_own_options_come_first() -> None:
    start = knob("start", 1, kind="protocol")
    found = of(lambda o, h: 0.1 / len(o) if o else 9.0, start, ONE)
    assert found == ({"one": 1}, 8e-3)


def test_a_whole_recipe_is_the_last_resort_and_loses_what_it_does_not_need() -> None:
    asked = lambda o, h: 0.1 if o.get("a", {}).get("b") and o.get("d") else 9.0  # noqa: E731
    assert of(asked, ONE, WHOLE) == ({"a": {"b": 1}, "d": 1}, 8e-3)
    tuned = lambda o, h: 0.1 if o.get("three") and o.get("two") == 2 else 9.0  # noqa: E731
    assert of(tuned, ONE, knob("two", 1)) == ({"two": 2, "three": 3}, 8e-3)


def test_where_nothing_keeps_the_bar_the_least_worst_is_told() -> None:
    found, kitchen = cooked(lambda o, h: 5.0 if o.get("two") == 2 else 9.0)
    assert found is None
    told = best(kitchen)
    assert told is not None
    assert (told[0].options.get("two"), told[1], told[2]) == (2, 5.0, "x")
    _, lost = cooked(lambda o, h: inf)
    assert best(lost) is None


def test_a_front_has_no_point_that_costs_more_and_is_hardly_better() -> None:
    _, kitchen = cooked(lambda o, h: 9.0)
    kitchen.bar.known.clear()
    for h, x in [(8e-3, 9.0), (4e-3, 8.9), (2e-3, 3.0), (1e-3, 4.0), (5e-4, 1.0), (2.5e-4, inf)]:
        kitchen.bar.known[Candidate.of({}, h)] = {"x": (x, x)} if x < inf else {}
    assert [(c.step, x) for c, x, _ in front(kitchen)] == [(8e-3, 9.0), (2e-3, 3.0), (5e-4, 1.0)]


def test_what_one_setting_tells_the_others_must_tell_too() -> None:
    known: Known = {
        Candidate.of({}, 1.0): {"x": (0.1, 0.1), "force": (0.1, 0.1)},
        Candidate.of({"one": 1}, 1.0): {"x": (0.1, 0.1)},
    }
    bar = Bar(known, 1.0)
    assert bar.holds(Candidate.of({}, 1.0))
    assert bar.worst(Candidate.of({"one": 1}, 1.0)) == (inf, "force")


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


def cheapest(error: Error, *knobs: Knob) -> tuple[dict[str, Any], float]:
    found, _ = cooked(error, *knobs)
    assert found
    return dict(found.cheapest.choice.options), found.cheapest.step


def test_the_cheapest_may_change_more() -> None:
    """One option needs 0.25 ms; both do with 8 ms, and cost a thirty-second."""

    def error(o: Mapping[str, Any], h: float) -> float:
        return 0.1 if {"one", "two"} <= set(o) else 1000 * h if "one" not in o else 9.0

    assert of(error) == ({}, 5e-4)
    assert cheapest(error) == ({"one": 1, "two": 1}, 8e-3)


def test_the_cheapest_is_confirmed_at_the_next_finer_step() -> None:
    """With both it is within at 8 ms alone, by luck."""

    def error(o: Mapping[str, Any], h: float) -> float:
        both = {"one", "two"} <= set(o)
        return 0.1 if both and h == 8e-3 else 9.0 if o else 1000 * h

    assert cheapest(error) == ({}, 5e-4)


def test_what_costs_the_same_changes_less() -> None:
    found, _ = cooked(lambda o, h: 0.1 / (1 + len(o)) if "one" in o else 9.0)
    assert found
    assert found.cheapest is found.fewest


MANY = knob("many", 10.0, 100.0, 1e4, 1e6)


def test_a_number_is_the_mildest_that_does() -> None:
    """Any from 100 on is within, the more the better: 100 is enough."""

    def error(o: Mapping[str, Any], h: float) -> float:
        return 10.0 / o["many"] if "many" in o else 9.0

    assert of(error, MANY) == ({"many": 100.0}, 8e-3)
    whole = Knob("whole", (Value("whole", {"many": 1e6, "d": 1}),), kind="bundle")
    assert of(lambda o, h: error(o, h) if "d" in o else 9.0, MANY, whole) == (
        {"many": 100.0, "d": 1},
        8e-3,
    )


def smallest_error(kitchen: Kitchen, recipe: Recipe) -> tuple[float]:
    """The recipe of the smallest error in place of the cheapest."""
    return (kitchen.bar.worst(recipe.candidate)[0],)


@pytest.mark.mutant("the recipe of the smallest error in place of the cheapest")
def test_of_recipes_that_keep_the_bar_the_cheapest_is_taken(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """`one` is within at 8 ms, hardly; `two` at 1 ms alone, and there by far."""

    def error(o: Mapping[str, Any], h: float) -> float:
        return 0.4 if "one" in o else (1e-3 if h <= 2e-3 else 9.0) if "two" in o else 9.0

    assert of(error) == ({"one": 1}, 8e-3)
    monkeypatch.setattr(Kitchen, "rank", smallest_error)
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
    was = "rungs = [less.candidate, less.choice.at(less.step / 2)]"
    hasty = otherwise(searching, was, "rungs = [less.candidate]")
    monkeypatch.setattr(searching, "_lean", hasty._lean)
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


def holds(margin: float, factor: float, module: Any = bar) -> bool:
    """Of an error of 0.4 of what the case allows."""
    return module.Bar({PLAIN: {"x": (0.4, 0.4)}}, margin, {"x": factor}).holds(PLAIN)


@pytest.mark.mutant("the tolerance that is asked for, or the margin, left out")
def test_the_margin_and_the_tolerance_that_is_asked_for_are_kept() -> None:
    assert [holds(margin, 1.0) for margin in (1.0, 2.0, 3.0)] == [True, True, False]
    assert [holds(1.0, factor) for factor in (0.1, 2.0, 10.0)] == [True, True, False]
    assert holds(1.0, 10.0, otherwise(bar, " * self.scale.get(name, 1.0)", ""))
    assert holds(3.0, 1.0, otherwise(bar, "<= 1 / self.margin", "<= 1"))
