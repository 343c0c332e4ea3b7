"""The order that a plan declares is the one at which differences shrink, and its limit is right."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from given.closed_motions import damped, pendulum
from given.engine_scenes import shaken
from given.planning import NAMES, SETTINGS, TUNED, begun, moved, planned, ways, words
from given.scenes import SHIPPED

from textmech.cases.trajectory import ANGLE, Array, X, Y
from textmech.engines.engine import Engine, Realised

STEPS = (2e-3, 1e-3, 5e-4)
SETTLED = 0.05  # of an order: these steps are that far into the expansion; measured 0.036
ROUGH = {"mujoco.tuned": (8e-3, 4e-3, 2e-3)}  # where RK4 is above rounding


def order(run: Callable[[float], Array], steps: tuple[float, float, float]) -> float:
    """log2 of the ratio of neighbouring differences, in max-norm."""
    a, b, c = (run(step) for step in steps)
    return math.log2(np.max(np.abs(a - b)) / np.max(np.abs(b - c)))


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_a_pendulum_shows_the_declared_order(engine: Engine) -> None:
    scene, start = begun("bar_pendulum")
    times = np.linspace(0.0, 1.6, 6)

    def angle(h: float) -> Array:
        return moved(engine, scene, start, times, h).states["bar"][:, ANGLE]

    found = order(angle, ROUGH.get(words(engine), STEPS))
    assert found == pytest.approx(planned(engine, scene, start).exponents[0], abs=SETTLED)


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_a_fast_sine_shows_the_declared_order(engine: Engine) -> None:
    """Taken at the stages or at the middle of a step, where the setting is of a higher order."""
    scene, start = shaken()
    times = np.linspace(0.0, 0.8, 11)

    def place(h: float) -> Array:
        return moved(engine, scene, start, times, h).states["box"][:, X]

    found = order(place, ROUGH.get(words(engine), STEPS))
    assert found == pytest.approx(planned(engine, scene, start).exponents[0], abs=SETTLED)


# Of 1e-4 s [m], natively and by our law where there is one. In MuJoCo rounding, measured 6e-15;
# pymunk's damper acts after the kick, measured 9.9e-5, our law at the middle of a step, 1.3e-8.
DAMPED: dict[str, dict[Realised, float]] = {
    "mujoco": {"native": 2e-14},
    "pymunk": {"native": 3e-4, "law": 4e-8},
}
DAMPINGS = {"underdamped": 1.2, "critical": 12.0, "overdamped": 30.0}  # N s/m


def damper_error(name: str, variant: str, way: Realised, step: float) -> float:
    """m, over the whole case."""
    times = SHIPPED[f"spring_mass_damper.{variant}"].times
    scene, start = begun(f"spring_mass_damper.{variant}")
    y = moved(TUNED[name], scene, start, times, step, realised=way).states["mass"][:, Y]
    return float(np.abs(y - damped(times, DAMPINGS[variant])).max())


@pytest.mark.slow
@pytest.mark.parametrize("variant", DAMPINGS)
@pytest.mark.parametrize(
    ("name", "way"), [(name, way) for name, found in DAMPED.items() for way in found]
)
def test_a_damper_shows_the_declared_order(name: str, way: Realised, variant: str) -> None:
    scene, start = begun(f"spring_mass_damper.{variant}")
    assert ways(TUNED[name], scene, start) == tuple(DAMPED[name])
    ratio = damper_error(name, variant, way, 1e-3) / damper_error(name, variant, way, 5e-4)
    exponent = planned(TUNED[name], scene, start, way).exponents[0]
    assert math.log2(ratio) == pytest.approx(exponent, abs=SETTLED)
    assert damper_error(name, variant, way, 1e-4) < DAMPED[name][way]


@pytest.mark.slow
@pytest.mark.parametrize("variant", DAMPINGS)
def test_pymunks_own_damper_is_off_by_more_than_the_law(variant: str) -> None:
    law, native = (damper_error("pymunk", variant, way, 1e-4) for way in ("law", "native"))
    assert law < 5e-7 < native


# rad. Measured 5.8e-13, which is rounding of 1e5 steps, and 3.3e-11; pymunk's finest step: 5.7e-6.
LIMIT = {"mujoco": 2e-12, "pymunk": 1e-10}


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_limit_of_a_pendulum_is_the_textbook(name: str) -> None:
    """By Romberg with the declared exponents."""
    scene, start = begun("bar_pendulum")
    times, steps = SHIPPED["bar_pendulum"].times, (4e-4, 2e-4, 1e-4)
    u = [moved(TUNED[name], scene, start, times, h).states["bar"][:, ANGLE] for h in steps]
    p, q = planned(TUNED[name], scene, start).exponents[:2]
    first = [(2**p * u[i + 1] - u[i]) / (2**p - 1) for i in range(2)]
    limit = (2**q * first[1] - first[0]) / (2**q - 1)
    assert np.abs(limit - pendulum(times)[0]).max() < LIMIT[name]
