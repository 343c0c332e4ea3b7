"""Events of friction against roots to thirty digits, phase by phase."""

from collections.abc import Iterator
from typing import Any

import mpmath
import numpy as np
import pytest
from given.events import LOCATED
from given.examples import example

from textmech.reference.motion.follow import follow


def test_dynamometer_against_roots_to_thirty_digits():
    """Sinusoid and straight line: v = 0 by bisection in mpmath, phase by phase."""
    with mpmath.workdps(30):
        omega, t, x, known = mpmath.sqrt(2), mpmath.mpf(0), mpmath.mpf(0), []
        for _ in range(2):
            slips = (6 + 2 * x) / 4

            def v(s: Any) -> Any:
                return (
                    2
                    - 2 * mpmath.cos(omega * s)
                    + mpmath.mpf(3) / 2 * omega * mpmath.sin(omega * s)
                )

            tau = mpmath.findroot(v, (3.0, 3.5), solver="anderson")
            t = slips + tau
            z = mpmath.mpf(3) / 2 * mpmath.cos(omega * tau) + 2 / omega * mpmath.sin(omega * tau)
            x = 2 * t - mpmath.mpf(3) / 2 - z
            known += [float(slips), float(t)]
    found = follow(example("dynamometer"), np.linspace(0.0, 10.0, 11)).events
    assert [e.time for e in found] == pytest.approx(known, abs=LOCATED, rel=0)


def _drift_events(periods: int) -> Iterator[tuple[str, Any]]:
    """A sin ωt with A = 5, ω = 2π, F₋ = 3, F₊ = 1, F_s₋ = 4, F_s₊ = 1.5, m = 1, root by root."""
    A, w = mpmath.mpf(5), 2 * mpmath.pi

    def speed(t: Any, since: Any, F: Any) -> Any:
        return A / w * (mpmath.cos(w * since) - mpmath.cos(w * t)) + F * (t - since)

    def halt(since: Any, F: Any, near: tuple[float, float]) -> Any:
        bracket = [since + s for s in near]
        return mpmath.findroot(lambda t: speed(t, since, F), bracket, solver="anderson")

    for k in range(periods):
        slips = k + mpmath.asin(mpmath.mpf(3) / 10) / w
        yield "slips", slips
        turns = halt(slips, -1, (0.3, 0.9))
        force = A * mpmath.sin(w * turns)
        if force >= -4:
            yield "stops", turns
            backward = k + mpmath.mpf(1) / 2 + mpmath.asin(mpmath.mpf(4) / 5) / w
            if backward < turns:
                continue
            yield "slips", backward
            turns = backward
        yield "stops", halt(turns, 3, (0.05, 0.6))


def test_drift_against_roots_to_thirty_digits():
    system = example("anisotropic_drift")
    found = follow(system, np.linspace(0.0, 5.0, 51))
    with mpmath.workdps(30):
        known = [(name, float(t)) for name, t in _drift_events(6) if t <= 5]
    assert [e.name for e in found.events] == [name for name, _ in known]
    assert [e.time for e in found.events] == pytest.approx([t for _, t in known], abs=1e-10, rel=0)
    per_period = np.diff(found.y[::10, 0])
    assert np.ptp(per_period[1:]) < 1e-12  # the same way every period, to +x where it is easier
    assert per_period[1] > 0.1
