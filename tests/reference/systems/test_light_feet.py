"""The simplest walker before its limit: its gait, and how it comes to the published one."""

import math
from dataclasses import replace
from functools import cache
from itertools import pairwise

import numpy as np
import pytest
from given.examples import example
from given.walkers import ENTRIES, begun, returned

from textmech.reference.motion.cycle import Cycle, cycle
from textmech.reference.system import Array
from textmech.reference.systems.walkers.compass_walker import CompassWalker, LightFeet

G = 9.80665
SHIPPED: LightFeet = example("light_feet")  # type: ignore[assignment]
# Garcia et al. 1998, on a slope of 0.009, with the time in √(l/g).
PUBLISHED = np.array([0.200310900544287, 0.199832473004977 * math.sqrt(G)])


@cache
def gait(m: float) -> Cycle:
    """On feet of m [kg], whose area goes with m: in the limit they are points."""
    walker = replace(SHIPPED, m=m, J_f=SHIPPED.J_f * (m / SHIPPED.m) ** 2)

    def step(x: Array) -> Array:
        return returned(begun(walker, x), ENTRIES, until=1.6)[0]

    theta, rate = PUBLISHED
    return cycle(step, np.array([theta, rate, rate * math.cos(2 * theta)]))


@pytest.mark.slow
def test_the_shipped_walker_repeats_itself_and_is_stable() -> None:
    found = gait(SHIPPED.m)
    lean = SHIPPED.left0 - math.pi / 2
    assert found.error < 1e-14
    assert found.stable
    assert found.state == pytest.approx([lean, SHIPPED.w0, SHIPPED.u0], abs=1e-13)
    assert math.pi - SHIPPED.left0 == pytest.approx(SHIPPED.right0, abs=1e-15)


@pytest.mark.slow
def test_its_feet_without_mass_walk_as_published() -> None:
    """m/M → 0: an error of that order, and of its square when it is taken off."""
    places = [gait(m).state[:2] for m in (0.1, 0.05, 0.025)]
    apart = [np.abs(place - PUBLISHED).max() for place in places]
    assert apart[0] / apart[1] == pytest.approx(2.0, rel=0.02)
    assert apart[1] / apart[2] == pytest.approx(2.0, rel=0.01)
    first = [2 * finer - coarser for coarser, finer in pairwise(places)]
    second = (4 * first[1] - first[0]) / 3
    assert second == pytest.approx(PUBLISHED, abs=1e-7)


@pytest.mark.mutant(
    "simplest walker: mass of a leg 1 % up", "simplest walker: a leg with the inertia of a bar"
)
@pytest.mark.parametrize("mistake", ["c", "J"])
def test_a_leg_whose_mass_is_elsewhere_is_seen(
    mistake: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """1 % of the leg up, or the inertia of a bar: the walker is no longer where it was."""
    wrong = {"c": lambda walker: 0.99 * walker.l, "J": CompassWalker.J.fget}[mistake]
    monkeypatch.setattr(LightFeet, mistake, property(wrong))
    lean = SHIPPED.left0 - math.pi / 2
    after, _ = returned(SHIPPED, ENTRIES, until=1.6)
    assert abs(after[0] - lean) > 1e-4
