"""Causes are the smallest sets that cure: of planted errors all of them, and no other."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from math import inf
from typing import Any

import pytest
from given import scenes
from given.command.lines import LADDER, row
from given.otherwise import otherwise

from textmech import engines
from textmech.reports.compare.trial.start import first
from textmech.reports.compare.trial.trial import planned
from textmech.reports.front.show import advice
from textmech.reports.runs.cache.key import Keys
from textmech.reports.runs.cache.store import Store
from textmech.reports.runs.tasks import Pair
from textmech.reports.search.advice import advice_rows as advised
from textmech.reports.search.advice.advice_rows import Advised, Requirement
from textmech.reports.search.advice.candidates import Choice, Menu
from textmech.reports.search.advice.criterion import Bar
from textmech.reports.search.advice.recipe import Kitchen, Recipe, Recipes
from textmech.reports.search.causes import cause_rows as told
from textmech.reports.search.causes import cures as searching
from textmech.reports.search.causes.candidate import Candidate
from textmech.reports.search.causes.cause_rows import climbed
from textmech.reports.search.causes.change import STEP, Field, Lever, halved
from textmech.reports.search.causes.cures import Cure, Cured, cures, law
from textmech.reports.search.causes.parallel_search import Known
from textmech.reports.tables.row import StepError

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


# A power law is told where the errors follow one, and nowhere else.


@pytest.mark.parametrize(
    ("errors", "words"),
    [
        ({4e-3: 16.0, 2e-3: 4.0, 1e-3: 1.0}, "h^2"),
        ({4e-3: 4.2, 2e-3: 2.0, 1e-3: 1.0}, "h^1"),  # 10 % may be missing
        ({8e-3: 99.0, 5e-4: 2.0, 4e-3: 16.0, 2e-3: 4.0, 1e-3: 1.0, 25e-5: 1 / 16}, ""),
        (
            {9e-3: 3.0, 8e-3: 64.0, 4e-3: 16.0, 2e-3: 4.0, 1e-3: 1.0, 5e-4: 0.25},
            "h^2",
        ),  # the finest 5
        ({4e-3: 5.0, 2e-3: 4.0, 1e-3: 1.0}, ""),  # it bends
        ({4e-3: 1.0, 2e-3: 1.0, 1e-3: 1.0}, ""),  # it makes no difference
        ({2e-3: 4.0, 1e-3: 1.0}, ""),  # two points are always on a line
        ({4e-3: 16.0, 2e-3: float("inf"), 1e-3: 1.0}, ""),
        ({4e-3: 16.0, 2e-3: 4.0, 1e-3: 0.0}, ""),
    ],
)
def test_a_law(errors: dict[float, float], words: str) -> None:
    assert law("h", errors) == words


# What a ladder tells is not run again, and is not taken for more than it is.

BASE = Candidate.of({}, 2e-3)
ROW = row(ratio=2.0, case="b", quantity="x", unit="m", error=4.0, allowed=2.0)
STEPS = [
    StepError("b", "mujoco", "shipped", "native", "held", "x", "m", step, error)
    for step, error in ((5e-4, 1.0), (1e-3, 2.0), (2e-3, 4.0))
]


def changed(**other: Any) -> list[StepError]:
    """The same steps of another quantity, say."""
    return [replace(step, **other) for step in STEPS]


def test_its_errors_at_smaller_steps_are_known() -> None:
    assert climbed(BASE, [ROW], STEPS) == {
        BASE.at(1e-3): {"x": (1.0, 1.0)},
        BASE.at(5e-4): {"x": (0.5, 0.5)},
    }


@pytest.mark.parametrize(
    "steps",
    [
        [],
        changed(quantity="y"),  # a count has no ladder
        STEPS + changed(ladder="following"),  # the held one has other numbers
        STEPS[:2],  # one diverged
        STEPS + changed(quantity="y")[1:],  # the finest of one quantity is another step
    ],
)
def test_what_it_does_not_tell_is_run(steps: list[StepError]) -> None:
    assert climbed(BASE, [ROW], steps) == {}


def enough(
    steps: list[StepError], module: Any = told, largest: float | None = 2e-3
) -> list[tuple[float, float]]:
    """largest: the step up to which the ladder is usable, whatever its errors are."""
    rung = replace(LADDER, case="b", quantity="x", usable_step=largest)
    return [(step, error) for _, step, error in module.usable([ROW], steps, [rung])]


@pytest.mark.mutant("a lucky step above one that is beyond is small enough")
def test_the_step_that_is_small_enough() -> None:
    """The largest from which on, downward, all keep what is allowed; of the row's own ladder."""
    assert enough(STEPS) == enough(STEPS[::-1]) == [(1e-3, 2.0)]
    for other in ({"error": 3.0}, {"ladder": "following"}, {"setting": "tuned"}):
        assert enough(changed(**other)) == []
    lucky = [STEPS[0], replace(STEPS[1], error=2.1), replace(STEPS[2], error=0.0)]
    assert enough(lucky) == [(5e-4, 1.0)]
    hasty = otherwise(told, "takewhile(lambda one:", "filter(lambda one:")
    assert enough(lucky, hasty) == [(2e-3, 0.0)]


@pytest.mark.mutant("one start within a step tells that a step is small enough")
def test_of_what_strikes_every_start_has_to_keep_it() -> None:
    assert enough(STEPS, largest=5e-4) == [(5e-4, 1.0)]
    assert enough(STEPS, largest=None) == []
    lucky = otherwise(told, " and one.step <= largest.get(_at(one), 0.0)", "")
    assert enough(STEPS, lucky, largest=5e-4) == [(1e-3, 2.0)]


# What is told of a cure and of a recipe: its price, and of cures the cheapest first.

OWN = 2e-3  # s: MuJoCo's as shipped
AS_SHIPPED = Candidate.of({}, OWN)
RK4 = Lever("RK4", {"integrator": "RK4"})
FOUR = Candidate.of({"integrator": "RK4"}, OWN)  # four evaluations a step
EIGHTH = AS_SHIPPED.at(OWN / 8)


@pytest.fixture(scope="module")
def pair(tmp_path_factory: pytest.TempPathFactory) -> Pair:
    case, store = scenes.SHIPPED["bar_pendulum"], Store(tmp_path_factory.mktemp("store"))
    found = Pair(case, engines.make("mujoco", "shipped"), store, Keys.now(store).solution(case))
    store.put(found.key, scenes.solved(case.name))
    return found


def causes(pair: Pair, module: Any = told) -> list[tuple[str, float | None]]:
    """Two cures, the dearer one found first, as rows say them."""
    field = Field(AS_SHIPPED, [RK4, STEP], [OWN, OWN / 8], [OWN, OWN / 8])
    found = Cured([Cure((STEP,), EIGHTH, 0.5, ""), Cure((RK4,), FOUR, 0.5, "")])
    rows = module.searched(module.Unexplained(pair, field, []), row(ratio=3.0), found)
    return [(cause.cure, cause.cost) for cause in rows]


def test_options_are_all_that_a_file_of_settings_needs(pair: Pair) -> None:
    """A cure of the recommended setting is put upon its options, and shipped is none of them."""
    stiff = {"solref": [0.005, 1.0]}
    base = Candidate.of(stiff, OWN)
    field = Field(base, [RK4, STEP], [OWN, OWN / 8], [OWN, OWN / 8])
    found = Cured([Cure((RK4,), field.candidate((RK4,)), 0.5, "")])
    (cause,) = told.searched(told.Unexplained(pair, field, []), row(ratio=3.0), found)
    assert cause.options == "{integrator: RK4, solref: [0.005, 1.0]}"


@pytest.mark.slow
@pytest.mark.mutant("a cure's {named}")
@pytest.mark.parametrize(
    ("named", "was", "now"),
    [
        (
            "cost upside down",
            "self._cost(candidate.options, candidate.step) / base",
            "base / self._cost(candidate.options, candidate.step)",
        ),
        ("place by how dear it is", "asked.cost(cure.candidate))\n    return",
         "-asked.cost(cure.candidate))\n    return"),
    ],
)  # fmt: skip
def test_the_cheapest_cure_is_first_with_its_cost_over_the_rows_own(
    pair: Pair, named: str, was: str, now: str
) -> None:
    assert causes(pair) == [("RK4", 4.0), ("step", 8.0)]
    assert causes(pair, otherwise(told, was, now)) != causes(pair)


@pytest.fixture(scope="module")
def found(pair: Pair) -> Advised:
    """RK4 at half of its own step: eight times as dear as shipped."""
    dear = pair.engine.cost(pair.case.scene, first(pair.reference()))  # type: ignore[attr-defined]
    cost = lambda c: dear(c.options, c.step)  # noqa: E731
    half = Recipe(Choice(("RK4",), {"integrator": "RK4"}), OWN / 2)
    known = {AS_SHIPPED: {"x": (9.0, 9.0)}, half.candidate: {"x": (0.25, 0.25)}}
    kitchen = Kitchen(Menu([], [OWN, OWN / 2], OWN, {}), Bar(known, 2.0), cost)  # type: ignore[arg-type]
    way = planned(pair.engine, pair.case.scene, first(pair.reference()))[0]
    return Advised(pair, Requirement(None, 2.0), way, kitchen, Recipes(half, half))


def costs(found: Advised, module: Any = advised) -> tuple[float | None, float | None]:
    (told,) = module.rows(found)
    return told.cost, told.shipped_cost


@pytest.mark.slow
@pytest.mark.mutant("the cost of shipped told as the recipe's")
def test_a_recipe_costs_what_it_costs_and_not_what_shipped_does(found: Advised) -> None:
    assert costs(found) == (8 / OWN, 1 / OWN)
    was = "cost=kitchen.cost(recipe.candidate)"
    assert costs(found, otherwise(advised, was, "cost=empty.shipped_cost")) != costs(found)


@pytest.mark.slow
def test_what_holds_at_one_step_alone_is_said_to(found: Advised) -> None:
    """The least step that is tried is within; nothing finer says that it is no accident."""
    (told,) = advised.rows(replace(found, recipes=None))
    assert (told.recipe, told.ratio) == ("none", 0.25)
    assert told.remains.endswith("and the next finer step does not confirm it")
    assert found.kitchen
    candidate = Candidate.of({"integrator": "RK4"}, OWN / 2)
    found.kitchen.bar.elsewhere[candidate] = 3.0
    (told,) = advised.rows(replace(found, recipes=None))
    assert told.remains.endswith("and not where a loop is cut elsewhere")
    found.kitchen.bar.elsewhere.clear()


def printed(found: Advised, module: Any = advice) -> str:
    """The line of the price."""
    patched: Any = module
    (line,) = [line for line in patched.advice_lines(found) if "costs ×" in line]
    return line


@pytest.mark.slow
@pytest.mark.mutant("the printed cost upside down")
def test_the_printed_cost_is_the_recipes_over_shippeds(
    found: Advised, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(advice, "ratio", lambda *_: 7.5)
    monkeypatch.setattr(advice, "plain", lambda _: [])
    assert printed(found) == "    costs ×8 of shipped, measured here ×7.5"
    was = "one.kitchen.cost(candidate) / one.kitchen.cost(one.shipped)"
    now = "one.kitchen.cost(one.shipped) / one.kitchen.cost(candidate)"
    wrong = otherwise(advice, was, now)
    wrong.ratio, wrong.plain = (lambda *_: 7.5), lambda _: []
    assert "×0.12 of shipped" in printed(found, wrong)


def seconds(pair: Pair, module: Any = advice) -> float:
    """A run of ten times the steps over one, on a clock by which a step takes a second."""

    def spent(trial: Any, end: float) -> float:
        return 0.3 + end / trial.step  # building it takes some time too

    module._seconds = spent
    return module.ratio(pair, AS_SHIPPED.at(OWN / 10), AS_SHIPPED)


@pytest.mark.mutant("a measured price upside down")
def test_a_measured_price_is_of_the_candidate_over_the_other(
    pair: Pair, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(advice, "_seconds", advice._seconds)  # put back afterwards
    assert seconds(pair) == pytest.approx(10.0, rel=0.1)  # but for the first step, which is begun
    wrong = otherwise(advice, "(mine - built) / (others - too)", "(others - too) / (mine - built)")
    assert seconds(pair, wrong) == pytest.approx(0.1, rel=0.1)
