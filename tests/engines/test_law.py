"""The engines' writing of the force laws meets the typed values, as the reference's must."""

import json
from pathlib import Path
from typing import Any

import pytest

from cases.scene import Anchor, Damper, Signal, Spring
from engines.law import tension, value

TABLE = json.loads((Path(__file__).parent / "law_table.json").read_text())
ENDS = (Anchor("ground", "O"), Anchor("mass", "center"))


@pytest.mark.parametrize("row", TABLE["signals"], ids=str)
def test_signal(row: dict[str, Any]) -> None:
    signal = Signal(
        law=row["law"],
        amplitude=tuple(row["amplitude"]),
        angular_frequency=row.get("angular_frequency", 0.0),
        phase=row.get("phase", 0.0),
    )
    assert value(signal, row["t"]) == pytest.approx(tuple(row["value"]), rel=1e-12, abs=1e-15)


@pytest.mark.parametrize("row", TABLE["springs"], ids=str)
def test_spring_pulls_when_stretched(row: dict[str, float]) -> None:
    spring = Spring("coil", *ENDS, row["stiffness"], row["rest_length"])
    for rate in (0.0, 7.0):
        assert tension(spring, row["length"], rate) == pytest.approx(row["tension"], rel=1e-12)


@pytest.mark.parametrize("row", TABLE["dampers"], ids=str)
def test_damper_pulls_when_lengthening(row: dict[str, float]) -> None:
    damper = Damper("oil", *ENDS, row["damping"])
    for length in (0.1, 2.0):
        assert tension(damper, length, row["rate"]) == pytest.approx(row["tension"], rel=1e-12)
