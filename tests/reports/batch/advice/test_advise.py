"""Advice for real cases: recipes that are known by hand, and what is said where there is none."""

from collections.abc import Mapping
from pathlib import Path

import pytest
from given import scenes

from textmech.reports import advise
from textmech.reports.batch.advice.advice_rows import FEWEST, Requirement, rows
from textmech.reports.batch.advice.advise import advised
from textmech.reports.batch.cache.store import usable
from textmech.reports.batch.selection import choose_engines
from textmech.reports.data.row import Advice
from textmech.reports.show.advice import advice_lines, ratio

CASES = ("bar_pendulum", "four_bar", "sliding_block.below", "planar_bodies", "heavy_top.cusp")


def advice(asked: Requirement, *names: str, engines: tuple[str, ...] = ()) -> Mapping[str, Advice]:
    """By case and engine, the cheapest."""
    cases = [scenes.EVERY[name] for name in names]
    chosen = choose_engines(engines, ["shipped"])
    with advised(cases, chosen, asked, progress=lambda *_: None, jobs=2, store=usable()) as found:
        told = [row for one in found for row in rows(one)]
    return {f"{one.case} {one.engine}": one for one in told if one.want != FEWEST}


@pytest.fixture(scope="module")
def found() -> Mapping[str, Advice]:
    return advice(Requirement(None, 2.0), *CASES)


@pytest.mark.slow
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


@pytest.mark.slow
def test_a_loop_needs_both_and_a_creeping_box_its_cone_and_impratio(
    found: Mapping[str, Advice],
) -> None:
    loop, creep = found["four_bar mujoco"], found["sliding_block.below mujoco"]
    assert "RK4" in loop.recipe
    assert "connect.solimp 0.9999" in loop.recipe
    assert creep.recipe == "cone elliptic + impratio 10"


@pytest.mark.slow
def test_the_margin_is_kept(found: Mapping[str, Advice]) -> None:
    kept = [one for one in found.values() if one.recipe != "none"]
    assert len(kept) >= 7
    assert all(one.ratio is not None and one.ratio <= 0.5 for one in kept)


@pytest.mark.slow
def test_what_is_refused_says_why(found: Mapping[str, Advice]) -> None:
    assert found["heavy_top.cusp pymunk"].remains.startswith("engine: ")
    assert found["planar_bodies mujoco"].remains.startswith("a claim about states")


@pytest.mark.slow
def test_where_nothing_does_it_what_remains_is_said() -> None:
    """Both engines know one coefficient of friction."""
    found = advice(Requirement(None, 2.0), "growing_force", engines=("mujoco",))
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
    with advised([case], engines, Requirement(None, 2.0), progress=lambda *_: None, jobs=2) as (
        one,
    ):
        lines = list(advice_lines(one))
    where = next(i for i, line in enumerate(lines) if line.startswith("  no recipe: "))
    assert lines[where + 1].strip().startswith("not tried, for it takes our adapter")
    assert lines[where + 1].endswith(": tips that reflect")


@pytest.mark.slow
def test_another_tolerance_asks_for_another_step() -> None:
    """A thousandth, or a tenth, of each quantity's size, whatever the case allows."""
    strict, loose = (
        advice(Requirement(t, 2.0), "bar_pendulum", engines=("pymunk",))["bar_pendulum pymunk"]
        for t in (1e-3, 1e-1)
    )
    assert loose.step is not None
    assert strict.step is None or strict.step < loose.step
    assert (strict.tolerance, loose.tolerance) == (1e-3, 1e-1)


@pytest.mark.slow
def test_a_finer_step_costs_more_time() -> None:
    """Ten times as many steps: a ratio near ten, on any machine."""
    asked = Requirement(None, 2.0)
    engines = choose_engines(["pymunk"], ["shipped"])
    cases = [scenes.EVERY["bar_pendulum"]]
    with advised(cases, engines, asked, progress=lambda *_: None, jobs=2) as (one,):
        assert one.kitchen is not None
        measured = ratio(one.pair, one.shipped.at(1e-3), one.shipped)
    assert measured is not None
    assert 5 < measured < 20


@pytest.mark.slow
def test_advice_as_a_frame() -> None:
    found = advise("bar_pendulum", engines=["mujoco"])
    assert list(found.columns)[:4] == ["case", "theme", "engine", "tolerance"]
    assert found.settings.tolist() == ["mujoco: {integrator: RK4, step: 0.01}"]
