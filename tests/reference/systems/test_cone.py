"""How steep a slope a disk rolls on: tan β up to 3 μ, as its friction is a third of the drive."""

import math

import numpy as np
import pytest

from textmech.reference.motion.follow import follow
from textmech.reference.systems.contact.sliding_disk import SlidingDisk


@pytest.mark.parametrize(("mu", "sticks"), [(0.4, True), (0.334, True), (0.332, False)])
def test_a_disk_released_at_45_degrees(mu: float, sticks: bool):
    """With 2 μ in place of 3 μ that of 0.4 would slide; x = ½ a t², a = ⅔ g sin β if it rolls."""
    disk = SlidingDisk(m=1.0, R=0.2, mu=mu, beta=math.pi / 4, v0=0.0, w0=0.0)
    found = follow(disk, np.linspace(0.0, 1.0, 5))
    drive = math.sqrt(0.5) * 9.80665
    a = 2 / 3 * drive if sticks else (1 - mu) * drive
    np.testing.assert_allclose(abs(found.y[-1, 0]), a / 2, rtol=1e-13)
    assert found.events == ()
