"""The smooth law (2.95) as a system: what it prints, how it is integrated, and what it is not."""

from typing import Any

import numpy as np
import pytest
from given.examples import example, only
from given.mutants import mutant
from scipy.integrate import solve_ivp

from textmech.reference.integrators.implicit import radau
from textmech.reference.laws.friction import Dry, smooth
from textmech.reference.motion.follow import follow
from textmech.reference.motion.stuck import slope


@pytest.mark.parametrize("name", ["smooth_dynamometer", "smooth_growing_force"])
def test_smooth_mode_within_its_band_is_the_printed_law(name: str):
    system = only(name)
    dry, random = Dry(3.0, 3.0, 6.0, 6.0), np.random.default_rng(2)
    for _ in range(200):
        t, v = random.uniform(5.9999, 6.0001), random.uniform(-1e-3, 1e-3)
        x = 0.0 if "growing" in name else random.uniform(8.9999, 9.0001)
        F_a = -t if "growing" in name else 4 * t - 2 * x
        printed = F_a + smooth(dry, 5e-4, 1e5, v, F_a)
        written = system.accelerations(t, np.array([x]), np.array([v]))[0]
        # A times the rounding of F_a, 1e-15 of 15 N: what the steep edges make of it.
        assert written == pytest.approx(printed, abs=2e-9)


def missed(mode: Any) -> float:
    """N: (2.23) m v̇ against the force along the slide and the friction that it tells."""
    random, worst = np.random.default_rng(7), 0.0
    for _ in range(50):
        t, x, v = random.uniform((0.0, -2.0, -1e-3), (8.0, 6.0, 1e-3))  # in the band, and out of it
        at = t, np.array([x]), np.array([v])
        acting = mode.r * t - mode.c * x
        held = mode.reactions(*at)["guide.fx"]
        worst = max(worst, abs(mode.m * mode.accelerations(*at)[0] - acting - held))
    return worst


@pytest.mark.parametrize("name", ["smooth_dynamometer", "smooth_growing_force"])
def test_friction_that_is_told_is_that_which_brakes(name: str):
    """No cut finds it: it is an applied force, and no law but this one asks for it."""
    assert missed(only(name)) < 1e-8  # A times the rounding of 15 N, on the edges


@pytest.mark.mutant("smooth friction told of a spring that pushes where it pulls")
def test_friction_of_another_force_is_seen():
    sound: Any = only("smooth_dynamometer")
    told = lambda self, t, q, v: sound.reactions(t, -q, v)  # noqa: E731
    assert missed(mutant(sound, reactions=told)) > 1.0


@pytest.mark.slow
@pytest.mark.parametrize("name", ["smooth_dynamometer", "smooth_growing_force"])
def test_smooth_law_by_stiff_integrators(name: str):
    system, times = example(name), np.linspace(0.0, 6.6, 34)  # as far as a slip after a stick
    assert system.modes["moving"].stiff
    found = follow(system, times)
    assert found.events == ()
    f = slope(system.modes["moving"])
    seven = radau(f, times, np.zeros(2), stages=7, tolerance=1e-15).y
    other = solve_ivp(
        f, (0.0, 6.6), np.zeros(2), method="Radau", t_eval=times, rtol=1e-13, atol=1e-16,
        max_step=0.05,
    )  # fmt: skip
    assert np.abs(found.y - seven).max() <= 1e-9
    assert np.abs(found.y - other.y.T).max() <= 1e-9


@pytest.mark.slow
def test_smooth_law_is_another_model():
    """Erratum 15: it never rests, and by 10 s it is 7.6e-4 m from the exact law."""
    times = np.linspace(0.0, 10.0, 2001)
    exact, found = (follow(example(n), times).y for n in ("dynamometer", "smooth_dynamometer"))
    assert np.abs(found - exact)[:, 0].max() == pytest.approx(7.6e-4, rel=0.02)
    sticks = found[(times > 4.85) & (times < 6.2), 1]
    assert 0.87 * 5e-4 < sticks.min() < sticks.max() < 5e-4
