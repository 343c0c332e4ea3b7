"""Bodies that leave one of two planes: when they do is known, how they go on is not."""

import math

import numpy as np
import pytest
from given.examples import duration, example

from textmech.reference.motion.follow import follow

G = 9.80665
NAMES = {"sliding_ladder": "top opens", "tipping_block": "tips"}


@pytest.mark.parametrize("name", NAMES)
def test_what_was_held_by_nothing_at_the_end_is_held_by_nothing(name: str) -> None:
    """The force falls to zero without a jump, and the accelerations go on where they were."""
    system = example(name)
    (event,) = follow(system, np.linspace(0.0, duration(name), 3)).events
    q, v = np.split(event.before, 2)
    before, after = (mode.accelerations(event.time, q, v) for mode in system.modes.values())
    np.testing.assert_allclose(before, after, atol=1e-10)


def test_the_ladder_leaves_at_two_thirds_of_its_height() -> None:
    """A textbook's number, whatever its mass and length; then it goes on at ẋ = ⅓ √(2 …)."""
    system = example("sliding_ladder", m=0.7, l=3.1)
    (event,) = follow(system, np.linspace(0.0, 1.5, 4)).events
    high = math.sin(math.radians(70))
    assert math.sin(event.after[1]) == pytest.approx(2 / 3 * high, rel=1e-12)
    assert event.after[2] ** 2 == pytest.approx(G * 3.1 * high**3 / 9, rel=1e-12)  # ẋ² = g l s³/9
