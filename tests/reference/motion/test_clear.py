"""Steps in which no guard comes near zero: seen without a step to each state inside."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from given.watched import Oscillator, Plain, Watched

from textmech.reference.integrators.explicit import DormandPrince
from textmech.reference.motion import event_location as crossing
from textmech.reference.motion import follow as module
from textmech.reference.motion.event_location import clear
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array

G = Callable[[float, Array, Array], float]


def swing(t: float) -> Array:
    """x and ẋ of ẍ = −x."""
    return np.array([math.cos(t), -math.sin(t)])


def is_clear(g: G, begin: float, h: float) -> bool:
    """Of one guard in a step of that motion."""
    f = lambda t, y: np.array([y[1], -y[0]])  # noqa: E731
    return clear([lambda t, y: g(t, *np.split(y, 2))], f, begin, h, swing(begin), swing(begin + h))


@pytest.mark.parametrize("h", [0.1, 0.4, 0.8])
@pytest.mark.parametrize("depth", [0.0, 1e-9, 0.02, -1e-9])
def test_a_turn_at_zero_is_never_clear(h: float, depth: float):
    """x + 1 − depth turns at t = π, wherever in the step that is; `depth` is of what it changes."""
    for part in np.linspace(0.02, 0.98, 25).tolist():
        begin = math.pi - part * h
        change = max(1.0 - math.cos(part * h), 1.0 - math.cos((1.0 - part) * h))
        assert not is_clear(lambda t, x, v, c=change: x[0] + 1.0 - depth * c, begin, h)


@pytest.mark.parametrize("h", [0.1, 0.4, 0.8])
def test_what_stays_a_fifth_of_its_change_above_is_clear(h: float):
    change = 1.0 - math.cos(h / 2)
    assert is_clear(lambda t, x, v: x[0] + 1.0 + 0.2 * change, math.pi - h / 2, h)
    assert is_clear(lambda t, x, v: 1.0 + 1e-3 * t, 0.0, h)


def test_what_is_no_number_is_not_clear():
    assert not is_clear(lambda t, x, v: math.nan, 0.0, 0.1)


def test_what_cannot_be_computed_is_not_clear():
    def g(t: float, x: Array, v: Array) -> float:
        return math.sqrt(x[0] - 0.5)

    assert is_clear(g, 0.0, 0.1)
    assert not is_clear(g, 1.0, 0.1)


def attempts(monkeypatch: pytest.MonkeyPatch, g: Plain) -> tuple[int, int]:
    """Steps of the motion, and attempts of the integrator for them."""
    calls, attempt = [0], DormandPrince.attempt

    def counted(self: DormandPrince, *given: object) -> Array:
        calls[0] += 1
        return attempt(self, *given)  # type: ignore[arg-type]

    monkeypatch.setattr(DormandPrince, "attempt", counted)
    found = follow(Watched([("g", g)], Oscillator()), np.linspace(0.0, 6.0, 31))
    return found.steps, calls[0]


def test_a_guard_that_is_far_costs_no_steps(monkeypatch: pytest.MonkeyPatch):
    """But in the first step of a mode, in which it may begin at zero."""
    steps, calls = attempts(monkeypatch, lambda t, x, v: 2.0 + x)
    assert calls <= steps + 3


def test_a_guard_that_comes_near_is_asked_at_exact_states(monkeypatch: pytest.MonkeyPatch):
    steps, calls = attempts(monkeypatch, lambda t, x, v: x + 1.0 + 1e-6)
    assert calls > steps + 9


@pytest.mark.mutant("steps that are always held for free of events")
def test_a_look_that_is_always_clear_misses_events(monkeypatch: pytest.MonkeyPatch):
    watched = Watched([("g", lambda t, x, v: x)], Oscillator())
    times = np.linspace(0.0, 6.0, 31)
    assert len(follow(watched, times).events) == 1
    monkeypatch.setattr(module, "clear", lambda *given: True)
    assert not follow(watched, times).events


@pytest.mark.mutant("guards looked at only at the ends of a step")
def test_a_look_at_the_ends_alone_loses_a_dip(monkeypatch: pytest.MonkeyPatch):
    """Planted: what the tests above see."""
    monkeypatch.setattr(crossing, "LOOKS", (((0.0, 1.0), 0.1),))
    assert is_clear(lambda t, x, v: x[0] + 1.0, math.pi - 0.2, 0.5)
