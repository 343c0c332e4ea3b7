"""Declared differences follow from the equations: they are no copies of what an engine did."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from given import scenes
from given.one_number import one_number

from textmech.cases.case import Case
from textmech.cases.find import shipped
from textmech.cases.load import load
from textmech.cases.observe import observe
from textmech.reports.events.times import reference_events

Applied = Callable[[float, float], float]
NARROW = 1.03  # high over low: 1 % to either side, and what was rounded
# The one number of each case [N]: the kinetic one; of two that differ, 2.5 is their mean.
ONE = {
    "growing_force": 3.0,
    "growing_force_smooth": 3.0,
    "dynamometer": 3.0,
    "dynamometer_smooth": 3.0,
    "anisotropic_drift": 2.5,
}


def applied(case: Case) -> Applied:
    """The force on the block beside friction [N], typed here from the book's examples."""
    p = case.parameters
    if "b" in p:
        return lambda t, x: -p["b"] * t
    if "c" in p:
        return lambda t, x: p["c"] * (p["u"] * t - x)
    return lambda t, x: p["A"] * math.sin(p["w"] * t)


def expected(case: Case) -> dict[str, float]:
    """How far the motion with one number of friction is from the case's own."""
    wanted = scenes.solved(case.name).trajectory
    bound = ONE[case.name]
    x, v, slips, stops = one_number(applied(case), case.parameters["m"], bound, case.times)
    off = {
        name: float(np.max(np.abs(found - observe(case.scene, wanted, name))))
        for name, found in (("block.x", x), ("block.vx", v))
    }
    off["scale.force"] = case.parameters.get("c", 0.0) * off["block.x"]
    for name, found in (("slips", slips), ("stops", stops)):
        if name in case.events:
            assert wanted.record is not None
            times = reference_events(case.scene, wanted.record, case.events[name])
            pairs = zip(times.tolist(), found, strict=False)
            off[f"{name}.time"] = max(abs(a - b) for a, b in pairs)
            off[f"{name}.count"] = abs(len(times) - len(found))
    return off


@pytest.mark.whole
@pytest.mark.parametrize("name", ONE)
def test_one_number_of_friction_costs_what_is_declared(name: str) -> None:
    case = scenes.SHIPPED[name]
    off = expected(case)
    declared = {
        (setting, quantity): deviation.by
        for setting, of in case.deviates.items()
        for quantity, deviation in of.items()
    }
    assert {setting for setting, _ in declared} == {"mujoco.tuned", "pymunk.tuned"}
    for (_, quantity), by in declared.items():
        assert by is not None
        low, high = by
        assert low <= off[quantity] <= high, quantity
        assert high <= NARROW * low or quantity.endswith(".count"), quantity


def test_no_other_interval_is_declared() -> None:
    """But for the elastic bounce and an energy, whose numbers are derived beside them."""
    found = {
        case.name
        for path in shipped().values()
        for case in load(path)
        for of in case.deviates.values()
        if any(deviation.by is not None for deviation in of.values())
    }
    assert found == {*ONE, "bouncing_disk.elastic", "planar_bodies"}


def test_an_energy_that_is_counted_twice_is_off_by_itself() -> None:
    """Σ ½ m v² + ½ J ω², typed here for the bar, the disk and the rectangle."""
    case = scenes.CLAIMS["planar_bodies"]
    p = case.parameters
    assert case.states is not None
    drawn = case.states.drawn(case.scene)
    J = {
        "rod": (p["m_bar"], p["m_bar"] * p["l"] ** 2 / 12),
        "wheel": (p["m_disk"], p["m_disk"] * p["R"] ** 2 / 2),
        "box": (p["m_box"], p["m_box"] * (p["w"] ** 2 + p["h"] ** 2) / 12),
    }
    T = np.zeros(case.samples)
    for name, (m, inertia) in J.items():
        vx, vy, omega = (drawn[f"{name}.{q}"][:, 1] for q in ("x", "y", "angle"))
        T += (m * (vx**2 + vy**2) + inertia * omega**2) / 2
    for setting in ("pymunk.shipped", "pymunk.tuned"):
        by = case.deviates[setting]["energy.kinetic"].by
        assert by is not None
        assert by[0] <= np.max(T) <= by[1] <= NARROW * by[0]


def test_the_elastic_bounces_numbers_follow_from_its_duration() -> None:
    (case,) = [c for c in load(shipped()["bouncing_disk"]) if c.name.endswith("elastic")]
    g, fall = 9.81, case.parameters["y0"] - case.parameters["R"]
    assert isinstance(case.step, dict)
    late, v = 16 * case.step["mujoco"], math.sqrt(2 * g * fall)
    least = {"bounces.time": late, "wheel.y": 2 * late * v, "wheel.vy": 2 * late * g}
    for quantity, lowest in least.items():
        deviation = case.deviates["mujoco.tuned"][quantity]
        assert deviation.by is not None
        low, high = deviation.by
        assert low == pytest.approx(lowest, rel=5e-3)
        assert high <= 1.2 * low * 1.005
