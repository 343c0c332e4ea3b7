"""Causes are the smallest sets that cure: of planted errors all of them, and no other."""

from collections.abc import Callable, Mapping, Sequence
from math import inf
from typing import Any

import pytest
from given.otherwise import otherwise

from textmech.reports.batch.search import cures as searching
from textmech.reports.batch.search.candidate import Candidate
from textmech.reports.batch.search.change import STEP, Field, Lever, halved
from textmech.reports.batch.search.cures import Cured, cures
from textmech.reports.batch.search.parallel_search import Known

Error = Callable[[Mapping[str, Any], float], float | tuple[float, float]]
"""Of options and a step; or of all samples, and of those away from instants."""
ONE, TWO, THREE = (Lever(name, {name: True}) for name in ("one", "two", "three"))
SHIPPED = 2e-3  # s


def cured(
    error: Error,
    *levers: Lever,
    finer: int = 16,
    rest: Lever | None = None,
    wholes: Sequence[Lever] = (),
) -> tuple[Cured, Known]:
    """What is found of one row, and all that was run for it."""
    known = Known()
    steps = halved(SHIPPED, SHIPPED / finer)
    field = Field(Candidate.of({}, SHIPPED), [*levers, STEP], steps, steps, rest, wholes)
    asking = cures(field, known, ["x"])
    while True:
        try:
            wanted = next(asking)
        except StopIteration as done:
            return done.value["x"], known
        for candidate in wanted:
            found = error(candidate.options, candidate.step)
            known[candidate] = {"x": found if isinstance(found, tuple) else (found, found)}


def names(found: Cured) -> set[tuple[str, ...]]:
    return {tuple(lever.words for lever in cure.turned) for cure in found.cures}


def test_all_cures_of_the_smallest_size_are_named() -> None:
    found, _ = cured(lambda o, h: 0.5 if o.get("one") or o.get("two") else 9.0, ONE, TWO, THREE)
    assert names(found) == {("one",), ("two",)}


def test_what_cures_only_together_is_named_together_and_no_larger_set_is_tried() -> None:
    found, known = cured(
        lambda o, h: 0.5 if o.get("one") and o.get("two") else 9.0, ONE, TWO, THREE
    )
    assert names(found) == {("one", "two")}
    assert max(len(candidate.options) for candidate in known) == 2


def test_a_knob_of_the_wrong_sign_changes_the_cure() -> None:
    """Planted: `two` takes 8.5 from the error; with the other sign it adds them."""

    def error(sign: int) -> Error:
        return lambda o, h: abs(9.0 - 6.0 * bool(o.get("one")) + sign * 8.5 * bool(o.get("two")))

    right, _ = cured(error(-1), ONE, TWO, finer=1)
    wrong, _ = cured(error(+1), ONE, TWO, finer=1)
    assert names(right) == {("two",)}
    assert names(wrong) == set()


def test_the_step_is_as_large_as_it_may_be_with_the_law_by_which_the_error_follows_it() -> None:
    found, _ = cured(lambda o, h: 10 * (h / SHIPPED) ** 2, ONE)
    (cure,) = found.cures
    assert names(found) == {("step",)}
    assert (cure.candidate.step, cure.law) == (SHIPPED / 4, "h^2")
    assert cure.error == pytest.approx(10 / 16)


def test_no_law_is_told_where_none_fits() -> None:
    found, _ = cured(lambda o, h: 10.0 if h == SHIPPED else 0.2 + 100 * h, ONE)
    assert [cure.law for cure in found.cures] == [""]


def test_the_law_of_a_knob_with_a_number() -> None:
    knob = Lever(
        "impratio 100", {"r": 100.0}, False, "r", {x: {"r": x} for x in (10.0, 30.0, 100.0)}
    )
    found, _ = cured(lambda o, h: 20 / o.get("r", 1.0), knob)
    assert [cure.law for cure in found.cures] == ["r^-1"]


def test_what_cures_at_one_step_alone_is_luck() -> None:
    """It must hold at the next finer step too."""
    found, _ = cured(lambda o, h: 0.5 if o.get("one") and h == SHIPPED else 9.0, ONE)
    assert names(found) == set()


def test_what_changes_nothing_at_either_end_is_dropped_and_what_does_at_one_is_kept() -> None:
    """Of seven; the cure's two do nothing alone: from afar an error saturates."""
    inert = [Lever(f"inert {i}", {f"inert {i}": True}) for i in range(5)]
    asked = lambda o, h: 0.5 if o.get("one") and o.get("two") else 9.0  # noqa: E731
    found, known = cured(asked, ONE, TWO, *inert, finer=1)
    assert names(found) == {("one", "two")}
    pairs = [c for c in known if len(c.options) == 2]
    assert all(set(c.options) <= {"one", "two"} for c in pairs)


@pytest.mark.parametrize("size", [3, 4, 5])
def test_large_sets_are_found(size: int) -> None:
    """Five are not proven to be the fewest: they are all that matter, together."""
    levers = [Lever(f"{i}", {f"{i}": True}) for i in range(size)]
    found, _ = cured(lambda o, h: 0.5 if len(o) == size else 9.0 - len(o), *levers, finer=1)
    assert names(found) == {tuple(f"{i}" for i in range(size))}


def test_of_large_sets_the_smallest_of_those_that_were_tried_is_named() -> None:
    """Three knobs and the step: with a fourth knob, which is inert, it cures as well."""
    levers = [Lever(f"{i}", {f"{i}": True}) for i in range(3)]

    def error(o: Mapping[str, Any], h: float) -> float:
        three = all(o.get(f"{i}") for i in range(3))
        return 9.0 - len(o) - (7.0 if three and h < SHIPPED else 0.0)

    found, _ = cured(lambda o, h: error(o, h) if "inert" not in o else error(o, h) + 1, *levers)
    assert names(found) == {("0", "1", "2", "step")}


@pytest.mark.mutant("the largest set of changes is told as the cause")
def test_of_sets_beyond_the_largest_the_one_with_the_fewest_changes_is_the_cause(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Three knobs and the step cure; so do these and all the rest, of which nothing is needed."""
    levers, rest = [Lever(f"{i}", {f"{i}": True}) for i in range(3)], Lever("rest", {"rest": True})

    def error(o: Mapping[str, Any], h: float) -> float:
        return 0.5 if all(o.get(f"{i}") for i in range(3)) and h < SHIPPED else 9.0 - len(o)

    assert names(cured(error, *levers, rest=rest)[0]) == {("0", "1", "2", "step")}
    most = otherwise(searching, "least = min(len(", "least = max(len(")
    monkeypatch.setattr(searching, "_fewest", most._fewest)
    assert names(cured(error, *levers, rest=rest)[0]) == {("0", "1", "2", "step", "rest")}


LANDS = [Lever("lands", {"group": "lands"})]


def test_a_whole_recipe_is_tried_where_no_set_of_changes_cures() -> None:
    """It sets what the changes set, in a way that lies on no way to the tuned recipe."""
    group = Lever("group", {"group": "rests"})
    lands = lambda o, h: 0.5 if o.get("group") == "lands" else 9.0  # noqa: E731
    found, known = cured(lands, group, wholes=LANDS)
    assert names(found) == {("lands",)}
    either = lambda o, h: 0.5 if "group" in o else 9.0  # noqa: E731
    found, known = cured(either, group, wholes=LANDS)
    assert names(found) == {("group",)}
    assert all(candidate.options.get("group") != "lands" for candidate in known)


def test_a_whole_recipe_may_need_a_smaller_step() -> None:
    lands = lambda o, h: 600 * h if o.get("group") == "lands" else 9.0  # noqa: E731
    found, _ = cured(lands, wholes=LANDS)
    (cure,) = found.cures
    assert names(found) == {("lands", "step")}
    assert cure.candidate.step == SHIPPED / 2


@pytest.mark.mutant("no cause where a recipe for contacts cures that the start does not choose")
def test_without_whole_recipes_none_is_found() -> None:
    found, _ = cured(lambda o, h: 0.5 if o.get("group") == "lands" else 9.0)
    assert names(found) == set()


def test_beside_an_instant_the_rest_may_still_be_cured() -> None:
    """The whole error first; where nothing cures that, what is not beside the instant."""
    rest, _ = cured(lambda o, h: (1200.0, 0.3 if o.get("one") else 3.0), ONE, TWO)
    assert (names(rest), rest.elsewhere) == ({("one",)}, True)
    whole, _ = cured(lambda o, h: (0.2, 0.1) if o.get("two") else (1200.0, 3.0), ONE, TWO)
    assert (names(whole), whole.elsewhere) == ({("two",)}, False)
    instant, _ = cured(lambda o, h: (1200.0, 0.3), ONE, TWO)
    assert (names(instant), instant.elsewhere) == (set(), False)


def test_what_diverges_cures_nothing_and_a_diverged_row_is_cured() -> None:
    found, _ = cured(lambda o, h: 0.1 if o.get("one") else inf, ONE, TWO)
    assert names(found) == {("one",)}
    none, _ = cured(lambda o, h: inf, ONE, TWO)
    assert names(none) == set()


def test_what_is_within_between_two_steps_that_are_not_is_luck() -> None:
    errors = (9.0, 3.0, 0.9, 0.8, 2.0)
    at = dict(zip(halved(SHIPPED, SHIPPED / 16), errors, strict=True))
    found, _ = cured(lambda o, h: at[h], ONE)
    assert names(found) == set()
