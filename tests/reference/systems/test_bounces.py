"""A disk that bounces ever lower, where it is highest: e² of the height before."""

import math

import numpy as np
import pytest

from textmech.reference.motion.follow import follow
from textmech.reference.systems.contact.bouncing_disk import BouncingDisk

H, R, G = 0.8, 0.25, 9.80665  # the heights are those of the lowest point


@pytest.mark.parametrize("e", [0.5, 0.8])
def test_each_bounce_is_lower_by_the_square(e: float):
    """(2.18) h e²ᵏ at t₁ (1 + 2 e + … + 2 eᵏ⁻¹ + eᵏ): by the energy, and not by its own terms."""
    disk, t1 = BouncingDisk(m=1.3, R=R, e=e, y0=R + H), math.sqrt(2 * H / G)
    bounces = t1 * (1 + 2 * np.cumsum([0.0, e, e**2, e**3]))
    tops = bounces + t1 * e ** np.arange(1, 5)
    known = H * e ** (2 * np.arange(1, 5))
    closed = [disk.closed_form(t) for t in tops.tolist()]
    assert [float(q[0]) for q, _ in closed] == pytest.approx(known.tolist(), abs=1e-14)
    assert [float(v[0]) for _, v in closed] == pytest.approx([0.0] * 4, abs=1e-14)
    found = follow(disk, np.append(0.0, tops))
    np.testing.assert_allclose(found.y[1:, 0], known, atol=1e-13)
    events = disk.closed_events(float(tops[-1]))
    assert [t for _, t in events] == pytest.approx(bounces.tolist(), abs=1e-14)
    assert [event.time for event in found.events] == pytest.approx(bounces.tolist(), abs=1e-13)


@pytest.mark.mutant("of bounces that pile up the closed form tells no end")
@pytest.mark.parametrize("e", [0.001, 0.2, 0.5, 0.9])
def test_bounces_that_pile_up_are_told_up_to_the_ones_we_tell_apart(e: float) -> None:
    """As many as the integrator finds; the flight that is left is too short for either."""
    disk, t1 = BouncingDisk(m=1.3, R=R, e=e, y0=R + H), math.sqrt(2 * H / G)
    limit = t1 * (1 + e) / (1 - e)
    events = disk.closed_events(2 * limit)
    found = follow(disk, np.linspace(0.0, 2 * limit, 11)).events
    assert len(events) == len(found)
    # Of 132 bounces each adds the rounding of some 10 s.
    assert [t for _, t in events] == pytest.approx([event.time for event in found], abs=1e-11)
    # What is left is a geometric series of flights, the first of them shorter than 1e-6 s.
    assert 0.0 <= limit - events[-1][1] < 1e-6 / (1 - e)
