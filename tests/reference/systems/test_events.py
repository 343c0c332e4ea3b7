"""Motions and events of the hand-written systems against their closed forms."""

import numpy as np
import pytest
from given.events import LOCATED, event_errors
from given.examples import SMOOTH, VARIANTS, duration, example

from textmech.reference.motion.follow import follow
from textmech.reference.systems.friction.dynamometer import Dynamometer


@pytest.mark.slow
@pytest.mark.parametrize("variant", VARIANTS)
def test_motion_and_events_meet_the_closed_form(variant: str):
    name, changed, names = VARIANTS[variant]
    system, times = example(name, **changed), np.linspace(0.0, duration(name), 41)
    found = follow(system, times)
    assert [event.name for event in found.events] == names
    if name not in SMOOTH:
        assert max(event_errors(system, system, times[-1]), default=0.0) <= LOCATED
    for t, mode, y in zip(times.tolist(), found.modes, found.y, strict=True):
        known = system.closed_form(t)
        assert known is not None
        np.testing.assert_allclose(y, np.concatenate(known), rtol=0, atol=1e-12 * (1 + t**3))
        assert system.possible(mode, t, *np.split(y, 2)) is None


def test_published_phase_times_of_example_2_4():
    found = follow(example("dynamometer"), np.linspace(0.0, 10.0, 11)).events
    assert [round(e.time, 6) for e in found] == [1.5, 4.790544, 6.290544, 9.581087]


def test_spring_of_the_dynamometer():
    """Fig 2.24: at the first slip the force is F_s₊; where it stops, 2 F₊ − F_s₊ = 0."""
    system = example("dynamometer")
    assert isinstance(system, Dynamometer)
    forces = []
    for event in follow(system, np.linspace(0.0, 10.0, 11)).events:
        end, force = system.spring(event.time, event.after[:1])
        assert end == 2.0 * event.time
        forces.append(force)
    assert forces == pytest.approx([6.0, 0.0, 6.0, 0.0], abs=1e-12)
