"""What the reference says of its own error: of each observed quantity, and it is true."""

import math
from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.examples import only
from given.refused import refused
from given.typed_scenes import PENDULUM

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import at_event, table
from textmech.reference.certificate.agreement import Check
from textmech.reference.certificate.errors import EPS, ERROR, SHARE, beyond
from textmech.reference.formalisms import lagrange
from textmech.reference.solve import Solution, solve

# What is ordinary but fast, small, slow, long or sensitive: changes of a pendulum 0.8 m long.
ORDINARY = {
    "from 170 degrees": {"ANGLE": "80 deg", "DURATION": "10"},
    "from 179 degrees": {"ANGLE": "89 deg", "DURATION": "10"},
    "1 mm, 1 mg": {"LENGTH": "1.0e-3", "MASS": "1.0e-6", "FORCE": "1.0e-8"},
    "1 km, 1000 t": {"LENGTH": "1.0e3", "MASS": "1.0e6", "FORCE": "1.0e4", "DURATION": "100"},
    "1 microradian": {"ANGLE": "-90 deg", "RATE": "1.0e-6", "SMALL": "1.0e-8", "DURATION": "5"},
    "1000 km away": {"PLACE": "1.0e6"},
}


def pendulum(tmp_path: Path, changes: dict[str, str]) -> Case:
    text, duration = PENDULUM, float(changes.get("DURATION", "1"))
    usual = {"ANGLE": "24.6 deg", "RATE": "0", "LENGTH": "0.8", "MASS": "1.2", "FORCE": "0.5"}
    for word, value in ({**usual, "SMALL": "1.0e-2", "PLACE": "0"} | changes).items():
        text = text.replace(word, value)
    return scenes.typed(tmp_path, text, tail=scenes.tail(duration, 26))


def known(solution: Solution) -> dict[str, float]:
    """What each observed quantity is certified to."""
    return {
        check.name.removeprefix(ERROR): check.certified
        for check in solution.checks
        if check.certified is not None
    }


@pytest.mark.slow
@pytest.mark.parametrize("name", ORDINARY)
def test_an_ordinary_scene_is_certified(tmp_path: Path, name: str) -> None:
    """Each of them was once refused by a bound that was one number for all motions."""
    solution = solve(pendulum(tmp_path, ORDINARY[name]))
    assert [check for check in solution.checks if not check.holds] == []


@pytest.mark.slow
def test_every_bounded_quantity_has_an_error() -> None:
    for name, case in scenes.SHIPPED.items():
        trajectory, found = scenes.solved(name).trajectory, known(scenes.solved(name))
        names = {quantity for quantity in case.allow if quantity in table(case.scene)}
        times = {f"{event}.time" for event in case.events} & case.allow.keys()
        states = {name: at for name in case.allow if (at := at_event(name, case.events))}
        assert found.keys() == names | times | states.keys(), name
        for state, at in states.items():  # as everywhere in the motion, and not known better
            size = np.max(np.abs(observe(case.scene, trajectory, at.quantity)))
            assert EPS * size <= found[state] <= 1e-9 * size, (name, state)
        for quantity in names:
            size = np.max(np.abs(observe(case.scene, trajectory, quantity)))
            assert found[quantity] >= EPS * size, (name, quantity)


@pytest.mark.slow
def test_a_bound_that_cannot_be_certified_is_a_mistake_in_its_place(tmp_path: Path) -> None:
    case = pendulum(tmp_path, {"SMALL": "1.0e-15"})
    mistake = refused(case)
    assert (mistake.where, mistake.line) == ("allow.bar.angle", 8)
    assert "1e-15 asks more than can be certified: the reference knows this to" in mistake.what
    least = float(mistake.what.split("give at least ")[1].split(",")[0])
    solve(replace(case, allow={"bar.angle": least}))
    with pytest.raises(CaseError):
        solve(replace(case, allow={"bar.angle": least / 3}))


@pytest.mark.slow
def test_a_reach_that_cannot_be_certified_is_told_by_itself(tmp_path: Path) -> None:
    case = pendulum(tmp_path, {})
    case = replace(case, reach={"mujoco": {"bar.angle": 1e-15}, "pymunk": {"bar.angle": 1e-6}})
    assert refused(case).where == "reach.mujoco.bar.angle"


@pytest.mark.slow
def test_a_chaotic_motion_asks_for_a_shorter_duration() -> None:
    """Two bars that turn over: an error grows tenfold in half a second."""
    case = scenes.SHIPPED["double_pendulum"]
    with pytest.raises(CaseError) as caught:
        solve(_wild(case))
    for mistake in caught.value.mistakes:
        assert mistake.where.startswith("allow.")
        assert "or a shorter duration" in mistake.what


def _wild(case: Case) -> Case:
    angles = {"a0": math.radians(80), "b0": math.radians(100)}
    bars = {
        name: replace(place, given={**place.given, "angle": angles[key]})
        for (name, place), key in zip(case.initial.items(), angles, strict=True)
    }
    allow = {"upper.angle": 1e-2, "lower.angle": 1e-2}
    return replace(
        case, parameters={**case.parameters, **angles}, initial=bars, allow=allow, reach={},
        duration=25.0, samples=26,
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("degrees", [-30.0, 70.0, 80.0])
def test_the_stated_error_is_true(tmp_path: Path, degrees: float) -> None:
    """Against elliptic functions: never more than three times what is stated."""
    case = pendulum(tmp_path, {"ANGLE": f"{degrees} deg", "DURATION": "10", "MASS": "1"})
    solution = solve(case)
    closed = [
        only("bar_pendulum", phi0=math.radians(degrees)).closed_form(t) for t in case.times.tolist()
    ]
    angles = np.array([float(state[0][0]) for state in closed if state is not None])
    apart = np.max(np.abs(angles - observe(case.scene, solution.trajectory, "bar.angle")))
    assert apart <= 3 * known(solution)["bar.angle"]


@pytest.mark.parametrize("size", [1e-9, 1e-3, 1.0, 1e6])
def test_momentum_keeps_its_digits(size: float) -> None:
    """A fixed width of 1 m/s lost nine of them beside 1e-9 m/s."""
    mode, q, v = only("four_bar"), np.array([1.2, 0.3, 1.7]), size * np.array([1.0, -2.0, 0.5])
    matrix = lagrange.mass_matrix(mode, 0.0, q)
    np.testing.assert_allclose(lagrange.momentum(mode, 0.0, q, v), matrix @ v, rtol=1e-13)


@pytest.mark.slow
@pytest.mark.parametrize("part", [0.9, 1.1])
def test_the_share_is_one_per_cent(tmp_path: Path, part: float) -> None:
    case = pendulum(tmp_path, {"ANGLE": "80 deg", "DURATION": "10"})
    allow = part * known(solve(case))["bar.angle"] / SHARE
    asked = partial(solve, replace(case, allow={"bar.angle": allow}))
    if part > 1:
        assert asked().holds
    else:
        with pytest.raises(CaseError, match="asks more than can be certified"):
            asked()


KNOWN = Check(f"{ERROR}bar.angle", 0.5, SHARE, 5e-3, "rad")
LATE = Check("implicit integrator: events", 1e-3, 1e-10)
OTHERWISE = Check("generated events", math.inf, 1e-10)
NEVER = Check(f"{ERROR}turns.time", math.inf, SHARE, math.inf, "s")


@pytest.mark.parametrize("broken", [[KNOWN, LATE], [KNOWN, LATE, OTHERWISE, NEVER]])
def test_events_of_a_motion_that_is_not_known_are_no_second_mistake(
    tmp_path: Path, broken: list[Check]
) -> None:
    """A chaotic motion that switches: it is told at `allow`, and no row of events FAILS."""
    case = replace(pendulum(tmp_path, {}), allow={"bar.angle": 1e-2, "turns.time": 1e-3})
    places = [mistake.where for mistake in beyond(case, broken)]
    assert places == [f"allow.{c.name.removeprefix(ERROR)}" for c in broken if c in (KNOWN, NEVER)]
    assert all("a shorter duration" in mistake.what for mistake in beyond(case, broken))


@pytest.mark.parametrize(
    "broken",
    [[LATE], [OTHERWISE, NEVER], [NEVER], [KNOWN, Check("generated motion", 1.0, 1e-9)],
     [KNOWN, LATE, Check("closed form", 1.0, 1e-12)]],
)  # fmt: skip
def test_answers_that_differ_in_a_motion_that_is_known_are_no_mistake_of_the_case(
    tmp_path: Path, broken: list[Check]
) -> None:
    case = replace(pendulum(tmp_path, {}), allow={"bar.angle": 1e-2, "turns.time": 1e-3})
    assert beyond(case, broken) == []
