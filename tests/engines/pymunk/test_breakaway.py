"""The mean of the law of dry friction over one step, against integrals done by hand."""

from functools import partial

import pytest

from textmech.cases.fields.friction import Bounds, DryFriction, Smooth
from textmech.engines.law import smooth_under
from textmech.engines.pymunk.callbacks.friction import bound, mean_friction, smooth_mean

LAW = DryFriction(Bounds(6.0, 2.0), Bounds(3.0, 1.0))  # forward, backward [N]
H, M = 0.5, 2.0  # s, kg


def line(begin: float, end: float, ahead: float) -> float:
    """A force [N] that grows through the step."""
    return begin + (end - begin) * ahead / H


def mean(speed: float, begin: float, end: float) -> float:
    return mean_friction(LAW, speed, M, partial(line, begin, end), H)


@pytest.mark.parametrize(
    ("begin", "end", "friction"),
    [
        (4.0, 5.9, -4.95),  # it holds
        (5.9, 6.3, -(0.25 * 5.95 + 0.75 * 3.0)),  # from 6 N on, a quarter of the step, it slides
        (5.0, 7.0, -(0.5 * 5.5 + 0.5 * 3.0)),
        (6.5, 7.0, -3.0),  # it slides all the time
        (-1.0, -3.0, 0.5 * 1.5 + 0.5 * 1.0),  # from −2 N on, the other way
        (-1.0, -1.9, 1.45),
        (6.2, 6.4, -3.0),
    ],
)
def test_from_rest(begin: float, end: float, friction: float) -> None:
    """The force that grows while it slides belongs to the slide alone."""
    assert mean(0.0, begin, end) == pytest.approx(friction, abs=1e-13)


@pytest.mark.parametrize(
    ("speed", "force", "friction"),
    [
        (1.0, 2.0, -3.0),  # Δv = −0.25 m/s: it goes on
        (-1.0, 2.0, 1.0),  # Δv = 0.75 m/s
        (0.1, 2.0, -(2.0 + 0.1 * M / H)),  # it stops, and 2 N do not move it
        (-0.1, 2.0, -2.0 + 0.1 * M / H),
        (0.1, -3.0, -1 / 15 * 3.0 + 14 / 15 * 1.0),  # at 6 N it stops after a fifteenth
        (-0.1, 7.0, 1 / 20 * 1.0 - 19 / 20 * 3.0),  # at 8 N after a twentieth; then 3 N brake
    ],
)
def test_while_it_moves(speed: float, force: float, friction: float) -> None:
    assert mean(speed, force, force) == pytest.approx(friction, abs=1e-13)


def test_what_pymunk_may_use_of_it() -> None:
    """Held: the static bound; braked: the law's force; what turns back late in a step: a push."""
    told = partial(bound, LAW, mass=M, step=H)
    assert told(0.0, applied=partial(line, 4.0, 5.0)) == (6.0, 0.0)
    assert told(0.0, applied=partial(line, -1.0, -1.5)) == (2.0, 0.0)
    assert told(1.5, applied=partial(line, 2.0, 2.0)) == (3.0, 0.0)
    limit, push = told(1.2, applied=partial(line, -3.0, -3.0))  # after 4/5 of the step
    assert (limit, push) == (0.0, pytest.approx(-0.8 * 3.0 + 0.2 * 1.0, abs=1e-13))


SMOOTH = Smooth(1e-3, 1e4)  # m/s, s/m: A F h / m is 150, far beyond what explicit steps bear


@pytest.mark.parametrize(
    ("speed", "applied"),
    [
        (0.0, 4.0),  # it creeps
        (1e-4, -1.5),
        (-1e-3, 3.0),  # at the edge of the band
        (5e-4, -4.0),
        (0.0, 7.0),  # it breaks loose
        (0.1, 2.0),  # it slides
    ],
)
def test_the_smooth_law_is_that_of_the_middle_of_the_step(speed: float, applied: float) -> None:
    """F = F_fr((v₀ + v)/2) with m (v − v₀) = h (F_a + F), which is no law of the engine's."""
    step = 0.01
    force = smooth_mean(LAW, SMOOTH, speed, M, applied, step)
    after = speed + step * (applied + force) / M
    law = smooth_under(LAW, SMOOTH, applied)
    # a speed is known to 1e-9 of the band, and the law's slope is at most A (7 N + 3 N)/2
    assert force == pytest.approx(law((speed + after) / 2), abs=5e-8)
