"""Causes are the smallest sets that cure: of planted errors all of them, and no other."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from math import inf
from typing import Any

import pytest
from given import scenes
from given.command.lines import LADDER, row
from given.command.planted_runs import Error, answered, recipe_search, runs
from given.otherwise import otherwise

from textmech import engines
from textmech.reports.compare.trial.start import first
from textmech.reports.compare.trial.trial import planned
from textmech.reports.front.show import advice
from textmech.reports.runs.cache.key import Keys
from textmech.reports.runs.cache.store import Store
from textmech.reports.runs.tasks import Pair
from textmech.reports.search.advice import advice_rows
from textmech.reports.search.advice.advice_rows import Advised, Requirement
from textmech.reports.search.advice.candidates import Candidates, Choice
from textmech.reports.search.advice.recipe import Recipe, Recipes
from textmech.reports.search.causes import cause_rows, causes
from textmech.reports.search.causes import cures as searching
from textmech.reports.search.causes.candidate import Candidate
from textmech.reports.search.causes.cause_rows import climbed
from textmech.reports.search.causes.change import STEP, Change, Field, halved
from textmech.reports.search.causes.cures import Cure, Cured, cured, law
from textmech.reports.tables.row import StepError

ONE, TWO, THREE = (Change(name, {name: True}) for name in ("one", "two", "three"))
SHIPPED = 2e-3  # s


def found(
    error: Error,
    *changes: Change,
    finer: int = 16,
    rest: Sequence[Change] = (),
    presets: Sequence[Change] = (),
) -> tuple[Cured, Iterable[Candidate]]:
    """The cures of one row, and all that was run for it; finer: times, 1 for its own step alone."""
    steps, step = halved(SHIPPED, SHIPPED / finer), [STEP] if finer > 1 else []
    field = Field(Candidate.of({}, SHIPPED), [*changes, *step], steps, steps, rest, presets)
    asked = runs()
    return answered(lambda: cured(field, asked, "x"), error), asked.known


def names(cures: Cured) -> set[tuple[str, ...]]:
    return {tuple(change.words for change in cure.changes) for cure in cures.cures}


LUCK = dict(zip(halved(SHIPPED, SHIPPED / 16), (9.0, 3.0, 0.9, 0.8, 2.0), strict=True))
CURES: Mapping[str, tuple[Error, set[tuple[str, ...]]]] = {
    "all of the smallest size": (
        lambda o, h: 0.5 if o.get("one") or o.get("two") else 9.0, {("one",), ("two",)}
    ),
    "what takes 8.5 from the error": (
        lambda o, h: abs(9.0 - 6.0 * bool(o.get("one")) - 8.5 * bool(o.get("two"))), {("two",)}
    ),
    "not what adds them": (
        lambda o, h: abs(9.0 - 6.0 * bool(o.get("one")) + 8.5 * bool(o.get("two"))), set()
    ),
    "of what diverges": (lambda o, h: 0.1 if o.get("one") else inf, {("one",)}),
    "not what diverges": (lambda o, h: inf, set()),
    "not luck at one step": (lambda o, h: 0.5 if o.get("one") and h == SHIPPED else 9.0, set()),
    "not luck between two steps": (lambda o, h: LUCK[max(h, SHIPPED / 16)], set()),
}  # fmt: skip


@pytest.mark.parametrize("what", CURES)
def test_a_cure_is(what: str) -> None:
    error, cures = CURES[what]
    assert names(found(error, ONE, TWO, THREE)[0]) == cures


def test_what_cures_only_together_is_named_together_and_no_larger_set_is_tried() -> None:
    cures, known = found(
        lambda o, h: 0.5 if o.get("one") and o.get("two") else 9.0, ONE, TWO, THREE
    )
    assert names(cures) == {("one", "two")}
    assert max(len(candidate.options) for candidate in known) == 2


def test_the_step_is_as_large_as_it_may_be_with_the_law_by_which_the_error_follows_it() -> None:
    cures, _ = found(lambda o, h: 10 * (h / SHIPPED) ** 2, ONE)
    (cure,) = cures.cures
    assert names(cures) == {("step",)}
    assert (cure.candidate.step, cure.law) == (SHIPPED / 4, "h^2")
    assert cure.error == pytest.approx(10 / 16)


def test_the_law_of_a_knob_with_a_number() -> None:
    knob = Change("impratio 100", {"r": 100.0}, "r", {x: {"r": x} for x in (10.0, 30.0, 100.0)})
    cures, _ = found(lambda o, h: 20 / o.get("r", 1.0), knob)
    assert [cure.law for cure in cures.cures] == ["r^-1"]


def test_what_changes_nothing_at_either_end_is_dropped_and_what_does_at_one_is_kept() -> None:
    """Of seven; the cure's two do nothing alone: from afar an error saturates."""
    inert = [Change(f"inert {i}", {f"inert {i}": True}) for i in range(5)]
    asked = lambda o, h: 0.5 if o.get("one") and o.get("two") else 9.0  # noqa: E731
    cures, known = found(asked, ONE, TWO, *inert, finer=1)
    assert names(cures) == {("one", "two")}
    pairs = [c for c in known if len(c.options) == 2]
    assert all(set(c.options) <= {"one", "two"} for c in pairs)


@pytest.mark.parametrize("size", [3, 4, 5])
def test_large_sets_are_found(size: int) -> None:
    """Five are not proven to be the fewest: they are all that matter, together."""
    changes = [Change(f"{i}", {f"{i}": True}) for i in range(size)]
    cures, _ = found(lambda o, h: 0.5 if len(o) == size else 9.0 - len(o), *changes, finer=1)
    assert names(cures) == {tuple(f"{i}" for i in range(size))}


def test_of_large_sets_the_smallest_of_those_that_were_tried_is_named() -> None:
    """Three knobs and the step: with a fourth knob, which is inert, it cures as well."""
    changes = [Change(f"{i}", {f"{i}": True}) for i in range(3)]

    def error(o: Mapping[str, Any], h: float) -> float:
        three = all(o.get(f"{i}") for i in range(3))
        return 9.0 - len(o) - (7.0 if three and h < SHIPPED else 0.0)

    cures, _ = found(lambda o, h: error(o, h) if "inert" not in o else error(o, h) + 1, *changes)
    assert names(cures) == {("0", "1", "2", "step")}


@pytest.mark.mutant("the largest set of changes is told as the cause")
def test_of_sets_beyond_the_largest_the_one_with_the_fewest_changes_is_the_cause(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """Three knobs and the step cure; so do these and all the rest, of which nothing is needed."""
    changes, rest = (
        [Change(f"{i}", {f"{i}": True}) for i in range(3)],
        Change("rest", {"rest": True}),
    )

    def error(o: Mapping[str, Any], h: float) -> float:
        return 0.5 if all(o.get(f"{i}") for i in range(3)) and h < SHIPPED else 9.0 - len(o)

    assert names(found(error, *changes, rest=[rest])[0]) == {("0", "1", "2", "step")}
    most = otherwise(searching, "least = min((len(", "least = max((len(")
    monkeypatch.setattr(searching, "_cures", most._cures)
    assert names(found(error, *changes, rest=[rest])[0]) == {("0", "1", "2", "step", "rest")}


LANDS = [Change("lands", {"group": "lands"})]


def test_a_whole_recipe_is_tried_where_no_set_of_changes_cures() -> None:
    """It sets what the changes set, in a way that lies on no way to the tuned recipe."""
    group = Change("group", {"group": "rests"})
    lands = lambda o, h: 0.5 if o.get("group") == "lands" else 9.0  # noqa: E731
    cures, known = found(lands, group, presets=LANDS)
    assert names(cures) == {("lands",)}
    either = lambda o, h: 0.5 if "group" in o else 9.0  # noqa: E731
    cures, known = found(either, group, presets=LANDS)
    assert names(cures) == {("group",)}
    assert all(candidate.options.get("group") != "lands" for candidate in known)


def test_a_whole_recipe_may_need_a_smaller_step() -> None:
    lands = lambda o, h: 600 * h if o.get("group") == "lands" else 9.0  # noqa: E731
    cures, _ = found(lands, presets=LANDS)
    (cure,) = cures.cures
    assert names(cures) == {("lands", "step")}
    assert cure.candidate.step == SHIPPED / 2


@pytest.mark.mutant("no cause where a recipe for contacts cures that the start does not choose")
def test_without_whole_recipes_none_is_found() -> None:
    cures, _ = found(lambda o, h: 0.5 if o.get("group") == "lands" else 9.0)
    assert names(cures) == set()


def test_beside_an_instant_the_rest_may_still_be_cured() -> None:
    """The whole error first; where nothing cures that, what is not beside the instant."""
    rest, _ = found(lambda o, h: (1200.0, 0.3 if o.get("one") else 3.0), ONE, TWO)
    assert (names(rest), rest.elsewhere) == ({("one",)}, True)
    whole, _ = found(lambda o, h: (0.2, 0.1) if o.get("two") else (1200.0, 3.0), ONE, TWO)
    assert (names(whole), whole.elsewhere) == ({("two",)}, False)
    instant, _ = found(lambda o, h: (1200.0, 0.3), ONE, TWO)
    assert (names(instant), instant.elsewhere) == (set(), False)


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
    ],
)
def test_what_it_does_not_tell_is_run(steps: list[StepError]) -> None:
    assert climbed(BASE, [ROW], steps) == {}


def enough(
    module: Any = cause_rows, errors: Sequence[float] = (1.0, 2.0, 4.0), **ladder: Any
) -> list[tuple[float | None, float | None]]:
    """errors: at the steps of the row's ladder, of which 2 are allowed."""
    steps = [replace(step, error=x) for step, x in zip(STEPS, errors, strict=True)]
    told = replace(LADDER, **({"case": "b", "quantity": "x", "usable_step": 1e-3} | ladder))
    return [(one.step, one.error_after) for one in module.by_ladder([ROW], steps, [told])]


@pytest.mark.mutant("a lucky step above one that is beyond is small enough")
@pytest.mark.mutant("one start within a step tells that a step is small enough")
def test_the_step_that_is_small_enough_is_that_of_the_rows_own_ladder() -> None:
    """The largest from which on all starts keep what is allowed."""
    assert enough() == [(1e-3, 2.0)]
    assert enough(usable_step=5e-4) == [(5e-4, 1.0)]
    others: list[dict[str, Any]] = [
        {"ladder": "following"},
        {"setting": "tuned"},
        {"usable_step": None},
    ]
    assert [enough(**other) for other in others] == [[], [], []]
    within = "max(h for (*at, h), x in errors.items() if (*at,) == _at(row) and x <= row.allowed)"
    hasty = otherwise(cause_rows, "step = usable.get(_at(row))", f"step = {within}")
    assert enough(hasty, errors=(1.0, 2.1, 0.0), usable_step=5e-4) == [(2e-3, 0.0)]
    assert enough(hasty, usable_step=5e-4) == [(1e-3, 2.0)]


# What is told of a cure and of a recipe: its price, and of cures the cheapest first.

OWN = 2e-3  # s: MuJoCo's as shipped
AS_SHIPPED = Candidate.of({}, OWN)
RK4 = Change("RK4", {"integrator": "RK4"})
FOUR = Candidate.of({"integrator": "RK4"}, OWN)  # four evaluations a step
EIGHTH = AS_SHIPPED.at(OWN / 8)


@pytest.fixture(scope="module")
def pair(tmp_path_factory: pytest.TempPathFactory) -> Pair:
    case, store = scenes.SHIPPED["bar_pendulum"], Store(tmp_path_factory.mktemp("store"))
    found = Pair(case, engines.make("mujoco", "shipped"), store, Keys.now(store).solution(case))
    store.put(found.key, scenes.solved(case.name))
    return found


def priced(pair: Pair, costs: Any = causes, rows: Any = cause_rows) -> list[tuple[str, float]]:
    """Two cures, the dearer one found first, as rows say them."""
    cures = Cured([Cure((STEP,), EIGHTH, 0.5, ""), Cure((RK4,), FOUR, 0.5, "")])
    found = rows.by_search(row(ratio=3.0), cures, costs._cost(pair, AS_SHIPPED))
    return [(cause.cure, cause.cost) for cause in found]


def test_options_are_all_that_a_file_of_settings_needs() -> None:
    """A cure of the recommended setting is put upon its options, and shipped is none of them."""
    field = Field(Candidate.of({"solref": [0.005, 1.0]}, OWN), [RK4], [OWN], [OWN])
    cures = Cured([Cure((RK4,), field.candidate((RK4,)), 0.5, "")])
    (cause,) = cause_rows.by_search(row(ratio=3.0), cures, lambda candidate: 4.0)
    assert cause.options == "{integrator: RK4, solref: [0.005, 1.0]}"


@pytest.mark.slow
@pytest.mark.mutant("a cure's cost upside down")
@pytest.mark.mutant("a cure's place by how dear it is")
def test_the_cheapest_cure_is_first_with_its_cost_over_the_rows_own(pair: Pair) -> None:
    assert priced(pair) == [("RK4", 4.0), ("step", 8.0)]
    was = "cost(one.options, one.step) / cost(base.options, base.step)"
    now = "cost(base.options, base.step) / cost(one.options, one.step)"
    assert priced(pair, costs=otherwise(causes, was, now)) != priced(pair)
    dearest = otherwise(cause_rows, "lambda cure: cost(", "lambda cure: -cost(")
    assert priced(pair, rows=dearest) == priced(pair)[::-1]


@pytest.fixture(scope="module")
def advised(pair: Pair) -> Advised:
    """RK4 at half of its own step: eight times as dear as shipped."""
    dear = pair.engine.cost(pair.case.scene, first(pair.reference()))  # type: ignore[attr-defined]
    choice = Choice({"integrator": "RK4"}, 1)
    half = Recipe(choice, choice.at(OWN / 2))
    known, listed = {AS_SHIPPED: {"x": 9.0}, half.candidate: {"x": 0.25}}, [OWN, OWN / 2]
    search = recipe_search(known, 2.0, candidates=Candidates([], listed, OWN, {}))
    search = replace(search, cost=lambda c: dear(c.options, c.step))
    way = planned(pair.engine, pair.case.scene, first(pair.reference()))[0]
    return Advised(pair, Requirement(None, 2.0), way, search, Recipes(half, half))


def costs(found: Advised, module: Any = advice_rows) -> tuple[float | None, float | None]:
    (told,) = module.rows(found)
    return told.cost, told.shipped_cost


@pytest.mark.slow
@pytest.mark.mutant("the cost of shipped told as the recipe's")
def test_a_recipe_costs_what_it_costs_and_not_what_shipped_does(advised: Advised) -> None:
    assert costs(advised) == (8 / OWN, 1 / OWN)
    was = "cost=search.cost(recipe.candidate)"
    wrong = otherwise(advice_rows, was, "cost=empty.shipped_cost")
    assert costs(advised, wrong) != costs(advised)


@pytest.mark.slow
def test_what_holds_at_one_step_alone_is_said_to(advised: Advised) -> None:
    """The least step that is tried is within; nothing finer says that it is no accident."""
    (told,) = advice_rows.rows(replace(advised, recipes=None))
    assert (told.recipe, told.ratio) == ("none", 0.25)
    assert told.remains.endswith("and the next finer step does not confirm it")
    assert advised.search
    elsewhere = {Candidate.of({"integrator": "RK4"}, OWN / 2): 3.0}
    search = replace(advised.search, elsewhere=elsewhere)
    (told,) = advice_rows.rows(replace(advised, search=search, recipes=None))
    assert told.remains.endswith("and not where a loop is cut elsewhere")


def printed(found: Advised, module: Any = advice) -> str:
    """The line of the price."""
    patched: Any = module
    (line,) = [line for line in patched.advice_lines(found) if "costs ×" in line]
    return line


@pytest.mark.slow
@pytest.mark.mutant("the printed cost upside down")
def test_the_printed_cost_is_the_recipes_over_shippeds(
    advised: Advised, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(advice, "ratio", lambda *_: 7.5)
    monkeypatch.setattr(advice, "plain", lambda _: [])
    assert printed(advised) == "    costs ×8 of shipped, measured here ×7.5"
    was = "one.search.cost(candidate) / one.search.cost(one.shipped)"
    now = "one.search.cost(one.shipped) / one.search.cost(candidate)"
    wrong = otherwise(advice, was, now)
    wrong.ratio, wrong.plain = (lambda *_: 7.5), lambda _: []
    assert "×0.12 of shipped" in printed(advised, wrong)


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
