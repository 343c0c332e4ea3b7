"""A rest that noise interrupts: what only trembles at its threshold is one rest."""

import numpy as np
import pytest

from textmech.reports.compare.events import rests as reading
from textmech.reports.compare.events.rests import rests

STOP = 0.61803  # s, from as many m/s


@pytest.mark.mutant("noise at the threshold of rest counts twice")
def test_what_only_trembles_at_the_threshold_rests_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """It stops, is stirred by 3 % of its largest speed, and rests again: that is one rest."""
    t = np.linspace(0.0, 2.0, 2001)
    stirred = np.where((t > 0.8) & (t < 0.85), 0.03 * STOP, 0.0)
    u = np.clip(STOP - t, 0.0, None) + stirred
    ((stop, start),) = rests(t, u)
    assert (stop, start) == (pytest.approx(STOP, abs=1e-12), None)
    monkeypatch.setattr(reading, "HIGH", reading.LOW)
    assert len(rests(t, u)) == 2
