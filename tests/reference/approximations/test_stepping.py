"""The literal law in small steps, and Karnopp's band in place of v = 0."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from given.machines.examples import example

from textmech.reference.approximations.approximation import Karnopp, arrest, boxcars, stepped
from textmech.reference.laws.friction import Dry, stiction
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array

# The literal law in small steps approaches the motion from event to event, with order 1.

Law = Callable[[Dry, float, float], float]
BOOK = Dry(3.0, 3.0, 6.0, 6.0)
UNEVEN = Dry(F_minus=3.0, F_plus=1.0, Fs_minus=4.0, Fs_plus=1.5)  # of the drift's example
STEPS = (1e-3, 5e-4, 2.5e-4, 1.25e-4)
SAMPLES = 100  # in the duration
G = 9.80665

# m, F_a(t, x), friction, v at the start, duration: typed again, not taken from the systems.
PULLS = {
    "growing_force": (1.0, lambda t, x: -t, BOOK, 0.0, 10.0),
    "dynamometer": (1.0, lambda t, x: 4 * t - 2 * x, BOOK, 0.0, 10.0),
    "anisotropic_drift": (
        1.0, lambda t, x: 5 * math.sin(2 * math.pi * t), UNEVEN, 0.0, 5.0,
    ),
    "sliding_block": (
        1.4, lambda t, x: 1.4 * G * math.sin(math.radians(20)),
        Dry(*(mu * 1.4 * G * math.cos(math.radians(20)) for mu in (0.4, 0.4, 0.5, 0.5))),
        -2.0, 1.0,
    ),
}  # fmt: skip


def literal(name: str, h: float, law: Law = stiction) -> tuple[Array, list[tuple[str, float]]]:
    """x and v at the samples, and the events."""
    m, F_a, dry, v0, duration = PULLS[name]
    steps = round(duration / h)
    rows = stepped(m, F_a, lambda v, f: law(dry, v, f), start=(0.0, v0), h=h, steps=steps)
    return rows[:: steps // SAMPLES], arrest(rows, h)


def error(name: str, h: float, law: Law = stiction) -> float:
    known = follow(example(name), np.linspace(0.0, PULLS[name][-1], SAMPLES + 1)).y
    return float(np.abs(literal(name, h, law)[0] - known)[:, 0].max())


@pytest.mark.slow
@pytest.mark.parametrize("name", ["growing_force", "dynamometer", "anisotropic_drift"])
def test_literal_law_approaches_the_motion_with_order_1(name: str):
    errors = [error(name, h) for h in STEPS]
    # The step in which an event falls is cut short or not: the errors scatter about h.
    order = np.polyfit(np.log(STEPS), np.log(errors), 1)[0]
    assert 0.75 < order < 1.35, errors
    assert errors[-1] < 30 * STEPS[-1]


def test_literal_law_under_a_constant_force_errs_in_the_step_of_the_stop_only():
    """v loses up to a h there, 5.6 m/s² h, and x up to half of that in a step."""
    for h in STEPS:
        assert error("sliding_block", h) < 5.6 * h**2 / 2


@pytest.mark.slow
@pytest.mark.parametrize("name", PULLS)
def test_literal_law_has_the_same_events(name: str):
    times = np.linspace(0.0, PULLS[name][-1], SAMPLES + 1)
    known = [(e.name, e.time) for e in follow(example(name), times).events]
    found = [e for e in literal(name, STEPS[-1])[1] if e[1] < times[-1]]
    if name == "sliding_block":  # thrown, it moves from the start
        assert known[0][0] == found[0][0] == "stops"
    assert [name for name, _ in found] == [name for name, _ in known]
    assert [t for _, t in found] == pytest.approx([t for _, t in known], abs=5 * STEPS[-1])


@pytest.mark.mutant("dry friction stepped, {name}: {mistake}")
@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "mistake", "law"),
    [
        ("dynamometer", "sign of (2.89)", lambda d, v, f: -stiction(d, v, f)),
        ("dynamometer", "no stick mode", lambda d, v, f: stiction(d, v or f, f)),
        ("dynamometer", "stiction of F₊", lambda d, v, f: stiction(Dry(3, 3, 3, 3), v, f)),
        ("anisotropic_drift", "F₋ for F₊", lambda d, v, f: stiction(Dry(1, 3, 1.5, 4), v, f)),
        ("sliding_block", "sign of (2.89)", lambda d, v, f: -stiction(d, v, f) if v else -f),
    ],
)
def test_mistakes_in_the_law_are_seen(name: str, mistake: str, law: Law):
    assert error(name, STEPS[0], law) > 10 * error(name, STEPS[0]), mistake


def test_slip_of_a_disk_is_a_block_of_a_third_of_its_mass():
    """(2.87): m ṡ/3 = m g sin β/3 + F_fr, so (2.88) with (2.89) says when it rolls."""
    disk = example("sliding_disk")
    m, mu, beta = 1.3, 0.4, math.radians(10)
    F = mu * m * G * math.cos(beta)
    h, F_a = 1e-4, m * G * math.sin(beta) / 3
    slip = -3.0 - 0.25 * 20.0
    rows = stepped(
        m / 3, lambda t, x: F_a, lambda v, f: stiction(Dry(F, F, F, F), v, f),
        start=(0.0, slip), h=h, steps=10_000,
    )  # fmt: skip
    [(name, time)] = arrest(rows, h)
    assert name == "stops"
    assert time == pytest.approx(disk.closed_events(1.0)[0][1], abs=2 * h)  # type: ignore[index]


# The band in place of v = 0, by Karnopp's own rule, taken literally, and as a boxcar.


def _karnopp(*, literal: bool, Delta: float) -> Karnopp:
    pull = example("dynamometer").modes["stuck"].pull  # type: ignore[attr-defined]
    return Karnopp(1.0, pull, BOOK, Delta, literal)


def test_karnopp_by_his_own_rule_is_the_exact_law_for_small_bands():
    """Erratum 15. The stop comes Δ/|v̇| early, Δ²/(2 |v̇|) short; |v̇| is 3 m/s² there."""
    times, Delta = np.linspace(0.0, 10.0, 51), 5e-4
    exact = follow(example("dynamometer"), times)
    found = follow(_karnopp(literal=False, Delta=Delta), times)
    assert [e.name for e in found.events] == [e.name for e in exact.events]
    late = [a.time - b.time for a, b in zip(found.events, exact.events, strict=True)]
    assert late == pytest.approx([0.0, -Delta / 3, 0.0, -Delta / 3], abs=1e-7)
    assert np.abs(found.y - exact.y)[:, 0].max() == pytest.approx(2 * Delta**2 / 6, rel=0.01)


@pytest.mark.slow
def test_karnopp_taken_literally_keeps_its_speed_while_it_sticks():
    times, Delta = np.linspace(0.0, 10.0, 2001), 5e-4
    exact = follow(example("dynamometer"), times)
    found = follow(_karnopp(literal=True, Delta=Delta), times)
    sticks = found.y[(times > 4.8) & (times < 6.2)]
    np.testing.assert_allclose(sticks[:, 1], Delta, rtol=1e-12)
    assert np.abs(found.y - exact.y)[:, 0].max() == pytest.approx(8.7e-4, rel=0.01)


@pytest.mark.slow
def test_boxcar_form_approaches_karnopp_taken_literally():
    times = np.linspace(0.0, 10.0, 101)
    known = follow(_karnopp(literal=True, Delta=5e-4), times).y
    errors = []
    for h in STEPS:
        rows = boxcars(1.0, lambda t, x: 4 * t - 2 * x, BOOK, Delta=5e-4, h=h, steps=round(10 / h))
        errors.append(np.abs(rows[:: round(0.1 / h)] - known)[:, 0].max())
    assert 0.75 < np.polyfit(np.log(STEPS), np.log(errors), 1)[0] < 1.35, errors
