"""A recipe holds wherever a loop is cut, or it is none."""

from dataclasses import replace

import pytest
from given import scenes
from given.otherwise import otherwise

from textmech.reports.batch.advice import advise as cuts
from textmech.reports.batch.advice import criterion as bars
from textmech.reports.batch.advice.criterion import Bar
from textmech.reports.batch.cache.key import Keys
from textmech.reports.batch.cache.store import temporary_store
from textmech.reports.batch.search.candidate import Candidate
from textmech.reports.batch.search.errors import Run, errors
from textmech.reports.batch.search.parallel_search import Known
from textmech.reports.batch.selection import choose_engines
from textmech.reports.batch.tasks import Pair

HARD = {"integrator": "RK4", "connect": {"solimp": [0.9999, 0.9999, 0.001]}}


@pytest.mark.slow
def test_each_joint_is_once_the_last() -> None:
    (engine,) = choose_engines(["mujoco.shipped"], [])
    with temporary_store() as store:
        key = Keys.now(store)

        def orders(name: str) -> list[str]:
            case = scenes.EVERY[name]
            pair = Pair(case, engine, store, key.solution(case))
            return ["".join(other.case.scene.joints) for other in cuts._others(pair)]

        assert orders("four_bar") == ["BCDA", "CDAB", "DABC"]
        assert orders("double_pendulum") == []


@pytest.mark.slow
def test_what_keeps_the_bar_here_may_not_elsewhere() -> None:
    """The closing pin as soft as shipped: within by far cut at D, and twice too far off at A."""
    (engine,) = choose_engines(["mujoco.shipped"], [])
    case, candidate = scenes.EVERY["four_bar"], Candidate.of(HARD, 2e-3)
    with temporary_store() as store:
        pair = Pair(case, engine, store, Keys.now(store).solution(case))
        here, *others = [
            Bar({candidate: errors(Run(each, candidate))}, 1.0).worst(candidate)[0]
            for each in [pair, *cuts._others(pair)]
        ]
    assert here < 0.1
    assert 1 < max(others) < 3


@pytest.mark.mutant("a recipe that does not hold where a loop is cut elsewhere")
def test_it_is_not_taken_then() -> None:
    candidate = Candidate.of({}, 1e-3)

    def holds(module: object, elsewhere: float) -> bool:
        bar = module.Bar({candidate: {"x": (0.1, 0.1)}}, 2.0)  # type: ignore[attr-defined]
        return replace(bar, elsewhere={candidate: elsewhere}).holds(candidate)

    assert holds(bars, 0.9)
    assert not holds(bars, 1.1)
    assert not holds(bars, float("nan"))
    blind = otherwise(
        bars, "return here and self.elsewhere.get(candidate, 0.0) <= 1.0", "return here"
    )
    assert holds(blind, 1.1)


def test_what_changes_nothing_is_left_out_with_it() -> None:
    """Or each setting of the solver would be asked of other cuts after the one before."""
    soft, alike, other = (Candidate.of({"tolerance": x}, 1e-3) for x in (1e-8, 1e-9, 1e-10))
    finer = Candidate.of({"tolerance": 1e-9}, 5e-4)
    worst = {soft: 0.1, alike: 0.10001, other: 0.2, finer: 0.1}
    bar = Bar(Known({candidate: {"x": (x, x)} for candidate, x in worst.items()}), 2.0)
    bar.leave_out({soft: 1.5})
    assert [bar.holds(c) for c in (soft, alike, other, finer)] == [False, False, True, True]
    assert bar.elsewhere == {soft: 1.5, alike: 1.5}
