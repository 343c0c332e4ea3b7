"""The engines' writing of the force laws meets the typed values, as the reference's must."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from textmech.cases.scene import (
    Anchor,
    Bounds,
    Damper,
    DryFriction,
    Signal,
    Smooth,
    Spring,
    Stribeck,
    Torsion,
    TorsionDamper,
)
from textmech.engines.law import dry_friction, smooth_friction, tension, turning
from textmech.engines.signal import acting, derivative, in_time, rate, value

TABLE = json.loads((Path(__file__).parent / "law_table.json").read_text())
ENDS = (Anchor("ground", "O"), Anchor("mass", "center"))


def _signal(row: dict[str, Any]) -> Signal:
    numbers = {key: row[key] for key in ("angular_frequency", "phase") if key in row}
    lists = {key: tuple(row[key]) for key in ("amplitude", "times", "values") if key in row}
    return Signal(row["law"], **lists, **numbers)


@pytest.mark.parametrize("row", TABLE["signals"], ids=str)
def test_signal(row: dict[str, Any]) -> None:
    signal = _signal(row)
    assert value(signal, row["t"]) == pytest.approx(tuple(row["value"]), rel=1e-12, abs=1e-15)
    assert in_time(signal)(row["t"]) == value(signal, row["t"])
    if "rate" in row:
        assert rate(signal, row["t"]) == pytest.approx(tuple(row["rate"]), rel=1e-12, abs=1e-15)


@pytest.mark.parametrize("row", TABLE["means"], ids=str)
def test_what_acts_in_a_step_with_a_corner_is_the_mean(row: dict[str, Any]) -> None:
    told = acting(_signal(row), row["step"])
    assert told(row["t"]) == pytest.approx(row["mean"], rel=1e-12)


@pytest.mark.parametrize("law", ["step", "pulse"])
def test_what_jumps_has_no_rate(law: Any) -> None:
    """No kind is taken for another one that has none."""
    with pytest.raises(KeyError):
        derivative(Signal(law, (1.0,), times=(0.2, 0.5)))


def test_the_derivative_of_a_law_is_its_rate() -> None:
    """Of a table the sum of steps, at all times but its corners."""
    for row in TABLE["signals"]:
        signal = _signal(row)
        if signal.law in ("step", "pulse"):
            continue
        for t in (0.1, 1.2, 2.5, 7.0):
            parts = [value(part, t) for part in derivative(signal)]
            total = [sum(each) for each in zip(*parts, strict=True)] or [0.0] * len(
                signal.amplitude
            )
            assert total == pytest.approx(rate(signal, t), rel=1e-12, abs=1e-12)


@pytest.mark.parametrize("row", TABLE["springs"], ids=str)
def test_spring_pulls_when_stretched(row: dict[str, float]) -> None:
    spring = Spring("coil", *ENDS, row["stiffness"], row["rest_length"])
    for speed in (0.0, 7.0):
        assert tension(spring, row["length"], speed) == pytest.approx(row["tension"], rel=1e-12)


@pytest.mark.parametrize("row", TABLE["one_sided"], ids=str)
def test_a_one_sided_spring_acts_on_one_side(row: dict[str, Any]) -> None:
    numbers = row["stiffness"], row["rest_length"]
    spring = Spring("leg", *ENDS, *numbers, only=row["only"])
    assert tension(spring, row["length"], 7.0) == pytest.approx(row["tension"], rel=1e-12)
    shared = spring.tension(np.array([row["length"]]), np.zeros(1))
    assert shared == pytest.approx([row["tension"]], rel=1e-12)
    both = Spring("coil", *ENDS, *numbers)
    assert (tension(both, row["length"], 0.0) == tension(spring, row["length"], 0.0)) == bool(
        row["tension"] or row["length"] == row["rest_length"]
    )


@pytest.mark.parametrize("row", TABLE["dampers"], ids=str)
def test_damper_pulls_when_lengthening(row: dict[str, float]) -> None:
    damper = Damper("oil", *ENDS, row["damping"])
    for length in (0.1, 2.0):
        assert tension(damper, length, row["rate"]) == pytest.approx(row["tension"], rel=1e-12)


@pytest.mark.parametrize("row", TABLE["torsion"], ids=str)
def test_a_torsion_spring_turns_back(row: dict[str, float]) -> None:
    spring = Torsion("wire", "hinge", row["stiffness"], row["rest_angle"])
    for speed in (0.0, 7.0):
        assert turning(spring, row["angle"], speed) == pytest.approx(row["torque"], rel=1e-12)


@pytest.mark.parametrize("row", TABLE["torsion_dampers"], ids=str)
def test_a_torsion_damper_brakes(row: dict[str, float]) -> None:
    damper = TorsionDamper("oil", "hinge", row["damping"])
    for angle in (0.1, 2.0):
        assert turning(damper, angle, row["rate"]) == pytest.approx(row["torque"], rel=1e-12)


FRICTION = DryFriction(static=Bounds(6.0, 2.0), kinetic=Bounds(3.0, 1.0))


@pytest.mark.parametrize("row", TABLE["dry_friction"], ids=str)
def test_dry_friction_holds_up_to_its_bound_and_brakes_beyond(row: dict[str, float]) -> None:
    assert dry_friction(FRICTION, row["speed"], row["applied"]) == row["force"]


@pytest.mark.parametrize("row", TABLE["falling_friction"], ids=str)
def test_falling_friction_is_static_friction_at_rest(row: dict[str, float]) -> None:
    falling = replace(FRICTION, stribeck=Stribeck(0.5))
    assert dry_friction(falling, row["speed"], row["applied"]) == pytest.approx(row["force"])


@pytest.mark.parametrize("row", TABLE["smooth_friction"], ids=str)
def test_smooth_friction(row: dict[str, float]) -> None:
    force = smooth_friction(FRICTION, row["speed"], row["applied"], smooth=Smooth(5e-4, 1e5))
    assert force == pytest.approx(row["force"], abs=1e-12)
