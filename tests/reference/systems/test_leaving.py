"""Bodies that leave one of two planes: when they do is known, how they go on is not."""

import math

import numpy as np
import pytest
from given.events import LOCATED, event_errors
from given.examples import duration, example

from textmech.reference.motion.follow import follow

G = 9.80665
NAMES = {"sliding_ladder": "top opens", "tipping_block": "tips"}


@pytest.mark.parametrize(("name", "event"), NAMES.items())
def test_it_leaves_when_it_must(name: str, event: str) -> None:
    system, until = example(name), duration(name)
    times = np.linspace(0.0, until, 41)
    found = follow(system, times)
    assert [e.name for e in found.events] == [event]
    assert max(event_errors(system, system, until)) <= LOCATED
    for t, mode, y in zip(times.tolist(), found.modes, found.y, strict=True):
        assert system.possible(mode, t, *np.split(y, 2)) is None


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


@pytest.mark.slow
def test_the_work_of_the_push_is_the_energy_of_the_block() -> None:
    """(2.45) T + U rises by ∫ b t ẋ_P dt, by Simpson's rule over the motion."""
    system = example("tipping_block")
    times = np.linspace(0.0, 1.0, 4001)
    found = follow(system, times)
    alpha, rate = found.y.T
    along = math.hypot(0.3, 0.6) * np.sin(alpha) * rate
    power = 12.0 * times * along
    work = (power[0] + power[-1] + 4 * power[1::2].sum() + 2 * power[2:-1:2].sum()) / 12000
    mode = system.modes["tips"]
    energies = [mode.T(0.0, y[:1], y[1:]) + mode.U(0.0, y[:1]) for y in (found.y[0], found.y[-1])]
    assert energies[1] - energies[0] == pytest.approx(work, rel=1e-8)


@pytest.mark.parametrize(
    ("name", "changed", "message"),
    [
        ("tipping_block", {"mu": 0.2}, "slides before it tips: mu > w/"),
        ("tipping_block", {"b": 0.0}, "the push grows"),
        ("sliding_ladder", {"phi0": 1.6}, "must lean on the wall"),
    ],
)
def test_what_it_is_not_for_is_said(name: str, changed: dict[str, float], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        example(name, **changed)


@pytest.mark.parametrize(
    ("name", "mode", "q", "message"),
    [
        ("sliding_ladder", "slides", [1.0, -0.1], "lies on the floor"),
        ("tipping_block", "tips", [2.7], "lies on its side"),
        ("tipping_block", "tips", [2.0], "sticking takes"),
    ],
)
def test_where_it_ends_is_said(name: str, mode: str, q: list[float], message: str) -> None:
    system = example(name)
    t = 3.0 if message == "sticking takes" else 0.5
    assert message in str(system.possible(mode, t, np.array(q), np.zeros(len(q))))
