"""A motion that ends before its time says in which mode, when, and about where it was."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.typed_scenes import PARALLELOGRAM, SPRING, time_to_flat

from textmech.cases.case import Case
from textmech.reference.integrators.march import IntegrationError
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.motion import stuck as watching
from textmech.reference.motion.follow import follow
from textmech.reference.motion.stuck import Stuck, Watched
from textmech.reference.system import Array, Mode, Only

# The spring of SPRING along a guide, and a disk that slides for (v + R ω)/(3 μ g) and then rolls.
BESIDE = """\
scene:
  points: {O: [0, 0]}
  bodies: {wheel: {disk: {mass: 1.3, radius: 0.25}}, dot: {particle: {mass: 0.7}}}
  joints: {guide: {slide: [ground.O, dot.center], along: [1, 0]}}
  contacts: {touch: {between: [wheel, ground.floor], friction: 0.4}}
  forces: {coil: {spring: [ground.O, dot.center], stiffness: 3, rest_length: 0.5}}
initial: {wheel: {x: 0, y: 0.25, angle: 0, vx: -3, omega: OMEGA}, dot: {x: 2}}
allow: {wheel.x: 1.0e-3, dot.x: 1.0e-2}
"""
FLAT = np.arccos(-0.5 / 1.5) / np.sqrt(3 / 0.7)  # s: there 0.5 m + 1.5 m cos(√(c/m) t) is zero


def stuck(case: Case) -> tuple[PlanarMechanism, Stuck]:
    mechanism = scenes.mechanism(case)
    with pytest.raises(Stuck) as caught:
        follow(mechanism, case.times)
    return mechanism, caught.value


@pytest.mark.slow
def test_a_flat_parallelogram(tmp_path: Path):
    mechanism, failure = stuck(scenes.typed(tmp_path, PARALLELOGRAM))
    [name] = mechanism.modes
    assert failure.mode is mechanism.modes[name]
    assert failure.time == pytest.approx(time_to_flat(), abs=1e-6)  # measured 4e-8
    angles = failure.q[[2, 5, 8]]
    np.testing.assert_allclose(np.sin(angles), 0.0, atol=1e-5)  # measured 4e-7
    # Both cranks still turn alike, as well as rates are known so near: of their 3.6e-7 rad the
    # loop's constraint, kept to 1e-9 rad, leaves 0.3 % open, and as much of the rates.
    assert failure.v[2] == pytest.approx(failure.v[8], rel=1e-2)


def test_a_spring_that_loses_its_length(tmp_path: Path):
    text = SPRING.replace("START", "-2").replace("scene:\n", "scene:\n  gravity: none\n")
    mechanism, failure = stuck(scenes.typed(tmp_path, text))
    [name] = mechanism.modes
    assert failure.mode is mechanism.modes[name]
    assert failure.time == pytest.approx(FLAT, abs=1e-4)
    np.testing.assert_allclose(failure.q, 0.0, atol=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize(("omega", "mode"), [(-20, "touch sticks"), (-40, "touch slides -")])
def test_beside_a_contact_it_is_the_mode_of_that_time(tmp_path: Path, omega: int, mode: str):
    """The disk rolls from 0.68 s on, or not before 1.1 s."""
    case = scenes.typed(tmp_path, BESIDE.replace("OMEGA", str(omega)))
    mechanism, failure = stuck(case)
    assert failure.mode is mechanism.modes[mode]
    assert failure.time == pytest.approx(FLAT, abs=1e-4)
    places = mechanism.base.poses(0.0, failure.q, failure.v)
    assert abs(places["dot"][0]) < 1e-3
    assert places["wheel"][1] == pytest.approx(0.25, abs=1e-12)


class Wall(Mode):
    """q̈ = 1/(1 − t), which nobody can follow beyond t = 1."""

    coordinates = ("x",)

    def start(self) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        return np.array([1.0 / (1.0 - t) if t < 1.0 else np.nan])


def test_a_written_mode_is_told_as_well():
    """x = (1 − t) ln(1 − t) + t, so that x is 1 there."""
    system = Only(Wall())
    with pytest.raises(Stuck) as caught:
        follow(system, np.array([0.0, 0.5, 2.0]))
    assert caught.value.mode is system.mode
    assert caught.value.time == pytest.approx(1.0, abs=1e-5)
    assert caught.value.q == pytest.approx([1.0], abs=1e-3)


class Falling(Mode):
    """A place that goes evenly."""

    coordinates = ("x",)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        return np.zeros(1)


@pytest.mark.parametrize("pace", [1e-3, 0.0])
def test_who_looks_ahead_does_not_seem_to_stand_still(
    pace: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """In 20 s at 1 ms a call, once asked for the end: it goes on; at none it is stuck."""
    monkeypatch.setattr(watching, "WATCHED", 100)
    y = np.zeros(2)
    watched = Watched(Falling(), 20.0, y)
    watched(20.0, y)

    def goes_on() -> None:
        for k in range(1000):
            watched(pace * k, y)

    if pace:
        goes_on()
    else:
        with pytest.raises(IntegrationError, match="shrink to nothing"):
            goes_on()
