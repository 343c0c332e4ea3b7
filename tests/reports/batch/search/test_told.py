"""What is told of a cure and of a recipe: its price, and of cures the cheapest first."""

from dataclasses import replace
from typing import Any

import pytest
from given import scenes
from given.lines import row
from given.otherwise import otherwise

from textmech import engines
from textmech.reports.batch.advice import advice_rows as advised
from textmech.reports.batch.advice.advice_rows import Advised, Requirement
from textmech.reports.batch.advice.candidates import Choice, Menu
from textmech.reports.batch.advice.criterion import Bar
from textmech.reports.batch.advice.recipe import Kitchen, Recipe, Recipes
from textmech.reports.batch.cache.key import Keys
from textmech.reports.batch.cache.store import Store
from textmech.reports.batch.search import cause_rows as told
from textmech.reports.batch.search.candidate import Candidate
from textmech.reports.batch.search.change import STEP, Field, Lever
from textmech.reports.batch.search.cures import Cure, Cured
from textmech.reports.batch.tasks import Pair
from textmech.reports.compare.trial.start import first
from textmech.reports.compare.trial.trial import planned
from textmech.reports.show import advice

OWN = 2e-3  # s: MuJoCo's as shipped
SHIPPED = Candidate.of({}, OWN)
RK4 = Lever("RK4", {"integrator": "RK4"})
FOUR = Candidate.of({"integrator": "RK4"}, OWN)  # four evaluations a step
EIGHTH = SHIPPED.at(OWN / 8)


@pytest.fixture(scope="module")
def pair(tmp_path_factory: pytest.TempPathFactory) -> Pair:
    case, store = scenes.SHIPPED["bar_pendulum"], Store(tmp_path_factory.mktemp("store"))
    found = Pair(case, engines.make("mujoco", "shipped"), store, Keys.now(store).solution(case))
    store.put(found.key, scenes.solved(case.name))
    return found


def causes(pair: Pair, module: Any = told) -> list[tuple[str, float | None]]:
    """Two cures, the dearer one found first, as rows say them."""
    field = Field(SHIPPED, [RK4, STEP], [OWN, OWN / 8], [OWN, OWN / 8])
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
    known = {SHIPPED: {"x": (9.0, 9.0)}, half.candidate: {"x": (0.25, 0.25)}}
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
    return module.ratio(pair, SHIPPED.at(OWN / 10), SHIPPED)


@pytest.mark.mutant("a measured price upside down")
def test_a_measured_price_is_of_the_candidate_over_the_other(
    pair: Pair, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(advice, "_seconds", advice._seconds)  # put back afterwards
    assert seconds(pair) == pytest.approx(10.0, rel=0.1)  # but for the first step, which is begun
    wrong = otherwise(advice, "(mine - built) / (others - too)", "(others - too) / (mine - built)")
    assert seconds(pair, wrong) == pytest.approx(0.1, rel=0.1)
