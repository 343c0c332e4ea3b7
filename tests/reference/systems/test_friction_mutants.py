"""Mistakes planted in systems that rub: bearings, falling friction, the cone, the dynamometer."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import laws
from given.events import LOCATED, event_errors
from given.examples import duration, example
from given.mutants import mutant, with_mode

from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, System


def off(system: System, other: System, until: float) -> float:
    """How far a motion is from the closed form of another system."""
    times = np.linspace(0.0, until, 31)
    closed = [system.closed_form(t) for t in times.tolist()]
    known = np.array([np.concatenate(c) for c in closed if c is not None])
    return float(np.max(np.abs(follow(other, times).y - known)))


PLANTED: dict[str, tuple[str, str, dict[str, Any]]] = {
    "dry friction that drives": ("bearing", "turns", {"M_k": -0.3}),
    "oil that drives": ("bearing", "turns", {"d": -0.05}),
    "a lost drive": ("bearing", "turns", {"M": 0.0}),
    "inertia 5 % off": ("bearing", "turns", {"R": 0.3 * 1.05**0.5}),
    "friction that does not fall": ("stribeck_brake", "forward", {"falls": None}),
    "friction that falls over another speed": (
        "stribeck_brake", "forward", {"falls": (-3.0, 0.525)},
    ),
    "friction of the other way": ("friction_cone", "down", {"sigma": -1}),
    "a lift that friction does not feel": ("friction_cone", "down", {"b_y": 0.0}),
    "a slope the other way": ("friction_cone", "down", {"beta": -0.17}),
    "a block of another mass": ("friction_of_rest", "forward", {"m": 1.05}),
}  # fmt: skip


@pytest.mark.mutant("what rubs: {what}")
@pytest.mark.parametrize("what", PLANTED)
def test_a_mistake_in_what_slides_leaves_the_closed_form(what: str) -> None:
    name, mode, changed = PLANTED[what]
    system, until = example(name), duration(name) / 2 if name == "friction_of_rest" else 1.9
    sound: Any = system.modes[mode]
    assert off(system, system, until) < 1e-11
    assert off(system, with_mode(system, mode, replace(sound, **changed)), until) > 1e-3


SEEN: dict[str, tuple[str, str, dict[str, Any], Callable[..., float]]] = {
    "oil that drives": ("bearing", "turns", {"d": -0.05}, laws.free_cut),
    "dry friction that drives": ("bearing", "turns", {"M_k": -0.3}, laws.power),
    "friction of the other way": ("friction_cone", "up", {"sigma": 1}, laws.free_cut),
    "a lift that friction does not feel": ("friction_cone", "up", {"b_y": 0.0}, laws.power),
    "friction that falls over another speed": (
        "stribeck_drive", "backward", {"falls": (3.0, 0.525)}, laws.free_cut,
    ),
    "the falling part of friction with the wrong sign": (
        "stribeck_drive", "forward", {"falls": (3.0, 0.5)}, laws.power,
    ),
}  # fmt: skip


@pytest.mark.mutant("what rubs: {what}, in the accelerations alone")
@pytest.mark.parametrize("what", SEEN)
def test_a_mistake_in_the_accelerations_breaks_a_law(what: str) -> None:
    name, mode, changed, law = SEEN[what]
    system = example(name)
    sound: Any = system.modes[mode]
    wrong = replace(sound, **changed)
    mixed = mutant(sound, accelerations=lambda self, t, q, v: wrong.accelerations(t, q, v))
    assert not laws.broken(law, law(system, (name, mode)))
    assert laws.broken(law, law(with_mode(system, mode, mixed), (name, mode)))


@pytest.mark.mutant("guards of {name} that fall 1e-6 too early")
@pytest.mark.parametrize("name", ["bearing", "friction_cone", "friction_of_rest", "stribeck_brake"])
def test_an_event_that_is_early_is_seen(name: str) -> None:
    """By 1e-6 of what the guard is of."""
    system = example(name)

    def guards(self: System, mode: str) -> Any:
        return [replace(g, g=lambda t, q, v, g=g: g.g(t, q, v) - 1e-6) for g in system.guards(mode)]

    until = duration(name)
    assert max(event_errors(system, system, until)) <= LOCATED
    assert max(event_errors(system, mutant(system, guards=guards), until)) > 1e3 * LOCATED


def test_static_bounds_of_the_cone() -> None:
    """(2.89) tan ρ in both directions, and the slope in favour of one: by statics alone."""
    m, g, mu = 2.0, 9.80665, 0.5
    for beta, b_x, b_y in ((0.1, 4.0, 1.0), (0.1, -4.0, 1.0), (0.0, -4.0, -1.5)):
        block = example("friction_cone", beta=beta, b_x=b_x, b_y=b_y)
        events = block.closed_events(5.0)
        assert events is not None
        ((_, t),) = events
        along = m * g * np.sin(beta) + b_x * t
        assert abs(along) == pytest.approx(mu * (m * g * np.cos(beta) - b_y * t), rel=1e-14)


def test_falling_friction_has_a_speed_that_it_keeps() -> None:
    """F(v) = P: slower it stops, faster it runs away."""
    speed = 0.5 * np.log(3.0 / 1.0)
    stays = example("stribeck_brake", P=4.0, v0=speed)
    times: Array = np.linspace(0.0, 0.5, 6)
    np.testing.assert_allclose(follow(stays, times).y[:, 1], speed, rtol=1e-12)
    for v0, events in ((speed - 0.01, 1), (speed + 0.01, 0)):
        found = follow(example("stribeck_brake", P=4.0, v0=v0), np.linspace(0.0, 3.0, 7))
        assert len(found.events) == events
