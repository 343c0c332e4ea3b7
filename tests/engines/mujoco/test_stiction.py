"""Our law of dry friction in MuJoCo: a block that stops is not braked past its stop."""

import numpy as np
import pytest
from given.engine_scenes import guided, thrown
from given.planning import TUNED, moved

from textmech.cases.scene import Bounds
from textmech.cases.trajectory import VX, Array
from textmech.engines.mujoco.callbacks import friction_law

H, BRAKES = 1e-3, 3.0  # s; N on 1 kg
TIMES = np.linspace(0.0, 40 * H, 41)


def speeds(part: float) -> Array:
    """At every step, of a block that would stop at that part of the eleventh."""
    v = BRAKES * H * (10 + part)
    bounds = Bounds(BRAKES, BRAKES)
    run = moved(TUNED["mujoco"], guided(None, bounds, bounds), thrown(v), TIMES, H, realised="law")
    return run.states["block"][:, VX]


@pytest.mark.mutant("the same force all step long up to half a step before a stop")
def test_what_stops_within_a_step_rests_at_its_end(monkeypatch: pytest.MonkeyPatch) -> None:
    """The speed is a multiple of what a step takes but for the last part, and then rounding's."""
    for part in (0.6, 0.9):
        found = speeds(part)
        assert found[:11] == pytest.approx(BRAKES * H * (10 + part - np.arange(11)), rel=1e-9)
        assert np.max(np.abs(found[11:])) < 1e-9 * found[0]  # 2e-14
    monkeypatch.setattr(friction_law, "_FAR", 0.5)
    assert speeds(0.6)[11] < -0.3 * BRAKES * H
