"""Advice for real cases: recipes that are known by hand, and what is said meanwhile."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import pytest
from given import scenes
from given.command.planted_runs import recipe_search
from given.otherwise import otherwise

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.reports import advise as advise_frame
from textmech.reports.front.show.advice import advice_lines, shipped_lines, stopped_lines
from textmech.reports.runs.cache.key import Keys
from textmech.reports.runs.cache.store import temporary_store, usable
from textmech.reports.runs.request import Request
from textmech.reports.runs.selection import choose_engines
from textmech.reports.runs.tasks import Pair
from textmech.reports.search.advice import advise
from textmech.reports.search.advice import recipe as searching
from textmech.reports.search.advice.advice_rows import FEWEST, Advised, Requirement, rows
from textmech.reports.search.advice.advise import Listener, advised
from textmech.reports.search.causes.candidate import Candidate
from textmech.reports.search.causes.errors import Run, errors
from textmech.reports.tables import write
from textmech.reports.tables.row import Advice

# Advice for real cases: recipes that are known by hand, and what is said where there is none.

CASES = (
    "bar_pendulum", "four_bar", "sliding_block.below", "planar_bodies", "heavy_top.cusp",
    "growing_force",
)  # fmt: skip


def advice(asked: Requirement, *names: str, engines: tuple[str, ...] = ()) -> Mapping[str, Advice]:
    """By case and engine, the cheapest."""
    cases = [scenes.EVERY[name] for name in names]
    chosen = choose_engines(engines, ["shipped"])
    with advised(Request(cases, chosen, jobs=2, store=usable()), asked) as found:
        told = [row for one in found for row in rows(one)]
    return {f"{one.case} {one.engine}": one for one in told if one.want != FEWEST}


@pytest.fixture(scope="module")
def found() -> Mapping[str, Advice]:
    """The committed advice, which `test_advice_is_current` searches anew for these cases."""
    told = write.read(write.HERE / write.ADVICE, Advice)
    told = [one for one in told if one.case in CASES and one.tolerance is None]
    return {f"{one.case} {one.engine}": one for one in told if one.want != FEWEST}


@pytest.mark.parametrize(
    ("name", "settings", "times"),
    [
        ("bar_pendulum mujoco", "mujoco: {integrator: RK4, step: 0.01}", 0.8),
        ("bar_pendulum pymunk", "pymunk: {error_bias: 0.0, midpoint: true, step: 0.0025}", 4),
        ("four_bar pymunk", "pymunk: {error_bias: 0.0, midpoint: true, step: 0.0005}", 20),
        (
            "sliding_block.below mujoco",  # on a box geom, whose corners are four
            "mujoco: {cone: elliptic, impratio: 10.0, shapes: plain, step: 0.005}",
            0.4,
        ),
    ],
)
def test_recipes_that_are_known(
    found: Mapping[str, Advice], name: str, settings: str, times: float
) -> None:
    one = found[name]
    assert one.settings == settings
    assert one.cost == pytest.approx(times * (one.shipped_cost or 0.0))


@pytest.mark.slow
def test_a_step_finer_is_found_where_a_loop_cut_elsewhere_needs_it() -> None:
    """With 2 ms all that keeps a thousandth does so only with the loop cut where it is."""
    one = advice(Requirement(1e-3, 2.0), "opening_loop", engines=("mujoco",))["opening_loop mujoco"]
    assert one.settings == (
        "mujoco: {connect: {solimp: [0.9999, 0.9999, 0.001], solref: [8h, 1.0]}, "
        "integrator: RK4, step: 0.001}"
    )


def test_a_loop_needs_both_and_a_creeping_box_its_cone_and_impratio(
    found: Mapping[str, Advice],
) -> None:
    loop, creep = found["four_bar mujoco"], found["sliding_block.below mujoco"]
    assert "RK4" in loop.recipe
    assert "connect.solimp 0.9999" in loop.recipe
    assert creep.recipe == "cone elliptic + impratio 10"


def test_the_margin_is_kept(found: Mapping[str, Advice]) -> None:
    kept = [one for one in found.values() if one.recipe != "none"]
    assert len(kept) >= 7
    assert all(one.ratio is not None and one.ratio <= 0.5 for one in kept)


def test_what_is_refused_says_why(found: Mapping[str, Advice]) -> None:
    assert found["heavy_top.cusp pymunk"].remains.startswith("engine: ")
    assert found["planar_bodies mujoco"].remains.startswith("a claim about states")


def test_where_nothing_does_it_what_remains_is_said(found: Mapping[str, Advice]) -> None:
    """Both engines know one coefficient of friction."""
    one = found["growing_force mujoco"]
    assert (one.recipe, one.step) == ("none", None)
    assert "stays ×" in one.remains
    assert "one number for friction" in one.remains


SLIDES_OFF = """\
scene:
  bodies: {d: {disk: {mass: 3, radius: 0.5}}, p: {particle: {mass: 0.2}}}
  points: {O: [0, 0]}
  joints: {h: {pin: [ground.O, d.center]}}
  contacts: {c: {between: [p, d], friction: 0}}
initial: {d: {angle: 0}, p: {x: 0.03, y: 0.4990991885387}}
allow: {p.x: 1.0e-3, c.normal: 0.1}
"""


@pytest.mark.slow
def test_what_would_need_our_adapter_is_named_where_there_is_no_recipe(tmp_path: Path) -> None:
    """`run --causes` says that tips that reflect cure it, and nobody can paste those."""
    case = scenes.typed(tmp_path, SLIDES_OFF, tail=scenes.tail(0.6, 25))
    engines = choose_engines(["pymunk"], ["shipped"])
    with advised(Request([case], engines, jobs=2), Requirement(None, 2.0)) as (one,):
        lines = list(advice_lines(one))
    where = next(i for i, line in enumerate(lines) if line.startswith("  no recipe: "))
    assert lines[where + 1].strip().startswith("not tried, for it takes our adapter")
    assert lines[where + 1].endswith(": tips that reflect")


@pytest.mark.slow
def test_advice_as_a_frame() -> None:
    found = advise_frame("bar_pendulum", engines=["mujoco"])
    assert list(found.columns)[:4] == ["case", "theme", "engine", "tolerance"]
    assert found.settings.tolist() == ["mujoco: {integrator: RK4, step: 0.01}"]


# A recipe holds wherever a loop is cut, or it is none.

HARD = {"integrator": "RK4", "connect": {"solimp": [0.9999, 0.9999, 0.001]}}


@pytest.mark.slow
def test_each_joint_is_once_the_last() -> None:
    (engine,) = choose_engines(["mujoco.shipped"], [])
    with temporary_store() as store:
        key = Keys.now(store)

        def orders(name: str) -> list[str]:
            case = scenes.EVERY[name]
            pair = Pair(case, engine, store, key.solution(case))
            return ["".join(other.case.scene.joints) for other in advise._cut_elsewhere(pair)]

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
            max(whole for whole, _ in errors(Run(each, candidate)).values())
            for each in [pair, *advise._cut_elsewhere(pair)]
        ]
    assert here < 0.1
    assert 1 < max(others) < 3


@pytest.mark.mutant("a recipe that does not hold where a loop is cut elsewhere")
def test_it_is_not_taken_then() -> None:
    candidate = Candidate.of({}, 1e-3)

    def passes(module: Any, elsewhere: float) -> bool:
        search = recipe_search({candidate: {"x": 0.1}}, 2.0, module=module)
        search.elsewhere[candidate] = elsewhere
        return search.passes(candidate)

    assert [passes(searching, x) for x in (0.9, 1.1, float("nan"))] == [True, False, False]
    was = "return here and self.elsewhere.get(candidate, 0.0) <= 1.0"
    assert passes(otherwise(searching, was, "return here"), 1.1)


def test_what_changes_nothing_is_left_out_with_it() -> None:
    """Or each setting of the solver would be asked of other cuts after the one before."""
    soft, alike, other = (Candidate.of({"tolerance": x}, 1e-3) for x in (1e-8, 1e-9, 1e-10))
    finer = Candidate.of({"tolerance": 1e-9}, 5e-4)
    worst = {soft: 0.1, alike: 0.10001, other: 0.2, finer: 0.1}
    search = recipe_search({candidate: {"x": x} for candidate, x in worst.items()}, 2.0)
    search.leave_out({soft: 1.5})
    assert [search.passes(c) for c in (soft, alike, other, finer)] == [False, False, True, True]
    assert search.elsewhere == {soft: 1.5, alike: 1.5}


# What is said while advice is searched for: shipped at once, and on Ctrl-C the nearest so far.

ASKED = Requirement(None, 2.0)
STILL = """\
scene:
  gravity: none
  bodies: {ball: {particle: {mass: 2.0}}}
initial: {ball: {x: 0, y: 0, vx: 0, vy: 0}}
duration: 1.0
samples: SAMPLES
allow: {ball.x: 1.0e-3}
"""


def interrupted(monkeypatch: pytest.MonkeyPatch) -> tuple[list[str], list[str]]:
    """The lines before the search, and those after it was interrupted."""
    heard: dict[str, list[str]] = {"begun": [], "stopped": []}

    def note(word: str, lines: Any) -> Any:
        def say(ready: Sequence[Advised]) -> None:
            heard[word] += [line for one in ready for line in lines(one)]

        return say

    def search(*given: object) -> None:
        assert heard["begun"]  # it was said before
        raise KeyboardInterrupt

    monkeypatch.setattr(advise, "_searched", search)
    listener = Listener(note("begun", shipped_lines), note("stopped", stopped_lines))
    cases, engines = [scenes.EVERY["leaking_pendulum"]], choose_engines(["mujoco"], ["shipped"])
    with (
        pytest.raises(KeyboardInterrupt),
        advised(Request(cases, engines, jobs=1), ASKED, listener),
    ):
        pass
    return heard["begun"], heard["stopped"]


@pytest.mark.slow
def test_shipped_is_told_before_the_search_and_the_nearest_after_it(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    begun, stopped = interrupted(monkeypatch)
    assert begun[1].startswith("leaking_pendulum in mujoco 4")
    assert begun[1].endswith(", as shipped, 2 ms")
    assert begun[2].startswith("    energy lost: ")
    assert begun[3].startswith("    worst: energy.total ×1.2")
    assert stopped[1].endswith("interrupted after 1 run; the nearest so far")
    assert "    to paste" in stopped


def refusals(case: Case, module: Any = advise) -> list[str]:
    """Why each engine has no advice on the case."""
    engines = choose_engines([], ["shipped"])
    with module.advised(Request([case], engines, jobs=1), ASKED) as found:
        return [one.way.because for one in found]


@pytest.mark.slow
@pytest.mark.mutant("a mistaken file is refused by the engine whose step misses its samples")
def test_a_mistaken_file_is_refused_with_its_place(tmp_path: Path) -> None:
    """Of 26 samples each step meets all, and of 24 neither does."""
    for samples in ("26", "24"):
        case = scenes.typed(tmp_path, STILL.replace("SAMPLES", samples), tail="")
        with pytest.raises(CaseError) as caught:
            refusals(case)
        assert [mistake.where for mistake in caught.value.mistakes] == ["allow.ball.x"]
    blamed = otherwise(advise, "if wrong[other.key]", "if False")
    whys = refusals(case, blamed)
    assert len(whys) == 2
    assert all(why.startswith("there is no reference: ") for why in whys)
