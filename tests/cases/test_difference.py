"""How far attitudes are apart: a quaternion and its opposite are one attitude, everywhere."""

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.cases.scene import difference, rotation
from textmech.cases.scene.difference import apart, from_reference
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import table
from textmech.cases.scene.rotation import about, product
from textmech.cases.trajectory import Array, Trajectory
from textmech.reference.certificate import agreement

AXIS = np.array([0.36, -0.48, 0.8])
ANGLES = np.array([0.0, 1e-12, 1e-6, 0.3, 2.0, 3.1])
EPS = 4 * float(np.finfo(float).eps)  # of four products each


def attitudes(count: int, seed: int = 5) -> Array:
    found = np.random.default_rng(seed).normal(size=(count, 4))
    unit: Array = found / np.linalg.norm(found, axis=1, keepdims=True)
    return unit


def turned(reference: Array) -> Array:
    """Each turned on by one of ANGLES about AXIS of the body."""
    return product(reference, np.array([about((0.36, -0.48, 0.8), angle) for angle in ANGLES]))


def signs(count: int) -> Array:
    """Both, in no order."""
    drawn: Array = np.random.default_rng(2).choice([-1.0, 1.0], size=(count, 1))
    assert {-1.0, 1.0} == set(drawn.ravel().tolist())
    return drawn


def far() -> tuple[float, float]:
    """How far both differences are from the known turn, in any sign of either quaternion."""
    one = attitudes(len(ANGLES))
    other = turned(one)
    angle = turn = 0.0
    for a, b in ((1, 1), (-1, 1), (1, -1), (-1, -1), (1, signs(len(ANGLES)))):
        found = from_reference(b * other, a * one)
        turn = max(turn, float(np.max(np.abs(found - ANGLES[:, None] * AXIS))))
        angle = max(angle, float(np.max(np.abs(apart(a * one, b * other) - ANGLES))))
    return angle, turn


def test_the_turn_between_two_attitudes() -> None:
    """Its angle is known to the rounding of a cosine's sine: at 3.1 rad as at 1e-12."""
    assert max(far()) < EPS


def test_numbers_are_told_as_they_are() -> None:
    one, other = np.array([1.0, -2.0]), np.array([1.5, -2.25])
    assert apart(one, other).tolist() == [0.5, 0.25]
    assert from_reference(one, other) is one


@pytest.mark.mutant("turn from the reference by the sign of the quaternion")
def test_an_opposite_quaternion_taken_for_a_turn_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the choice of the sign it is a turn by 2π − φ the other way."""
    monkeypatch.setattr(difference, "np", numpy_with(where=_of_numbers))
    assert far()[1] > 3.0


@pytest.mark.mutant("turn from the reference halved")
def test_half_of_the_turn_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    half = lambda y, x: np.arctan2(y, x) / 2  # noqa: E731
    monkeypatch.setattr(difference, "np", numpy_with(arctan2=half))
    assert far()[1] > 1.0


@pytest.mark.mutant("angle between attitudes by the sign of the quaternion")
def test_an_angle_of_more_than_half_a_turn_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(rotation, "np", numpy_with(abs=lambda x: x))
    assert far()[0] > 3.0


def numpy_with(**names: Callable[..., Any]) -> SimpleNamespace:
    """numpy as one module sees it, with another function of a name."""
    return SimpleNamespace(**(vars(np) | names))


def _of_numbers(condition: Any, yes: Any, no: Any) -> Any:
    """Chooses between numbers, and never between quaternions."""
    return no if np.shape(no)[-1:] == (4,) else np.where(condition, yes, no)


SPATIAL = [name for name, case in scenes.SHIPPED.items() if case.scene.frame is SPACE]


def opposite(motion: Trajectory) -> Trajectory:
    """The same with the other quaternion of each attitude, or of some."""
    states = {}
    for name, rows in motion.states.items():
        states[name] = rows.copy()
        states[name][:, SPACE.attitude] *= signs(len(rows))
    return replace(motion, states=states, record=None)


@pytest.mark.slow
@pytest.mark.parametrize("name", SPATIAL)
def test_what_is_observed_does_not_know_the_sign_of_a_quaternion(name: str) -> None:
    """Angles of joints are counted, which no sign may change; but for rounding of the sums."""
    case, motion = scenes.SHIPPED[name], scenes.solved(name).trajectory
    other = opposite(motion)
    for quantity in (q for q in case.allow if q in table(case.scene)):
        own = observe(case.scene, motion, quantity)
        size = 1.0 + float(np.max(np.abs(own)))
        assert np.max(apart(own, observe(case.scene, other, quantity))) < 1e-13 * size, quantity


@pytest.mark.slow
def test_the_certificate_compares_attitudes() -> None:
    motion = scenes.solved("heavy_top.loops").trajectory
    assert agreement.difference(motion, opposite(motion)) < EPS


@pytest.mark.slow
@pytest.mark.mutant("certificate: opposite quaternions taken for other attitudes")
def test_a_certificate_that_compares_quaternions_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    motion = scenes.solved("heavy_top.loops").trajectory
    always = lambda condition, yes, no: yes  # noqa: E731
    monkeypatch.setattr(agreement, "np", numpy_with(where=always))
    assert agreement.difference(motion, opposite(motion)) > 1.0
