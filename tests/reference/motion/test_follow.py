"""What is kept of a motion: samples, changes, and on demand its steps."""

import numpy as np
from given.watched import Oscillator, Watched

from textmech.reference.motion.follow import follow
from textmech.reference.systems.bouncing_disk import BouncingDisk


def test_sample_on_an_event_holds_the_state_after_it():
    disk = BouncingDisk(m=1.0, R=0.25, e=1.0, y0=0.75)
    times = [t for _, t in disk.closed_events(3.0)]
    found = follow(disk, np.array([0.0, *times]))
    assert len(found.events) == len(times)
    for row, e in zip(found.y[1:], found.events, strict=True):
        np.testing.assert_array_equal(row, e.after)
        assert row[1] > 0.0 > e.before[1]


def test_change_without_a_name_is_no_event():
    times = np.linspace(0.0, 3.0, 4)
    found = follow(Watched([(None, lambda t, x, v: x)], Oscillator(), "off"), times)
    assert found.events == ()
    assert [(c.mode_before, c.mode_after) for c in found.changes] == [("on", "off")]
    assert found.modes == ("on", "on", "off", "off")
