"""The smooth law of dry friction (2.95) holds all that acts along a slide, gravity too."""

import math
from dataclasses import replace

import numpy as np
import pytest
from given.engine_scenes import RESTS, THREE, guided
from given.planning import NAMES, TUNED, moved

from textmech.cases.scene import Bounds, Smooth
from textmech.cases.trajectory import ANGLE


@pytest.mark.parametrize("name", NAMES)
def test_a_block_stays_on_a_slope(name: str) -> None:
    """Its weight is 1.70 N along a slide at 10°: less than 3 N, so that friction cancels it.

    If gravity were no part of what friction holds, it would creep at the band's edge: 2.5e-4 m.
    """
    slope, times = math.radians(10), np.linspace(0.0, 0.5, 6)
    scene = guided(None, THREE, Bounds(2.0, 2.0), Smooth(5e-4, 1e5))
    guide = scene.joints["guide"]
    down = replace(guide.shifts[0], axis=(math.cos(slope), -math.sin(slope)))
    guide = replace(guide, freedoms=(down,))
    scene = replace(scene, joints={"guide": guide})
    run = moved(TUNED[name], scene, RESTS, times, 5e-4, realised="law")
    assert np.abs(run.states["block"][:, :ANGLE]).max() < 1e-12
