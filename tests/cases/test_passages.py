"""Small parts of a scene: falls through zero, differences of attitudes, frames."""

import math
import pickle
from collections.abc import Callable, Sequence
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.cases.scene import Anchor, Scene, difference, planar_joint, rotation, shape, solid
from textmech.cases.scene import passages as module
from textmech.cases.scene.difference import deviation, from_reference
from textmech.cases.scene.frame import PLANE, SPACE, Frame
from textmech.cases.scene.observe import observe
from textmech.cases.scene.passages import passing, pieces, polynomial
from textmech.cases.scene.quantity import table
from textmech.cases.scene.rotation import about, product
from textmech.cases.trajectory import Array, Trajectory
from textmech.reference.certificate import agreement

# Falls through zero within a smooth piece: on a row, between rows, and not where it trembles.

STILL = 1e-9


def passages(times: Array, u: Array, corners: Sequence[float] = ()) -> list[float]:
    """When [s] u falls through zero within the pieces of one phase."""
    return [t for t, curve in crossings(times, u, corners) if curve]


def crossings(times: Array, u: Array, corners: Sequence[float] = ()) -> list[tuple[float, Any]]:
    record = Trajectory(times, {}, {}, phase=np.zeros(len(times), np.int64))
    smooth = pieces(record, u, corners)
    return [each for _, t, values in smooth for each in passing(t, values, STILL)]


@pytest.mark.parametrize("count", [11, 41, 101])
def test_a_zero_on_a_row_is_found_once(count: int) -> None:
    """A row may hold 0 or its rounding of either sign."""
    times = np.linspace(0.0, 1.0, count)
    for rounding in (0.0, 1e-16, -1e-16):
        u = 0.5 - times
        u[count // 2] = rounding
        assert passages(times, u) == pytest.approx([0.5], abs=1e-12)


def test_what_ends_at_zero_is_the_boundarys() -> None:
    times = np.linspace(0.0, 0.5, 11)
    assert passages(times, 0.5 - times) == []


@pytest.mark.parametrize("depth", [1e-6, 1e-4, 1e-2])
@pytest.mark.parametrize("samples", [150, 400])
def test_a_dip_between_rows_is_found(depth: float, samples: int) -> None:
    """1 − d − cos t falls through zero where cos t = 1 − d on its way up, before each 2 π k.

    Rows are 0.13 and 0.05 s apart, the curves of seventh degree: (0.13)⁸/8! is 2e-12 of a dip that
    may be 1e-6 deep and as flat.
    """
    times = np.linspace(0.1, 20.0, samples)
    known = [2 * math.pi * k - math.acos(1 - depth) for k in (1, 2, 3)]
    found = passages(times, 1 - depth - np.cos(times))
    assert found == pytest.approx(known, abs=1e-7 if samples == 150 else 1e-9)


def test_a_hump_between_rows_is_found() -> None:
    """cos t − 1 + d rises above zero around 2 π k only."""
    times = np.linspace(0.1, 14.0, 301)
    found = passages(times, np.cos(times) - 1 + 1e-6)
    known = [2 * math.pi * k + math.acos(1 - 1e-6) for k in (1, 2)]
    assert found == pytest.approx(known, abs=1e-10)


def test_what_trembles_does_not_fall() -> None:
    times = np.linspace(0.0, 1.0, 101)
    trembling = 1e-17 * np.where(np.arange(101) % 2, 1.0, -1.0)
    assert passages(times, trembling) == []


@pytest.mark.mutant("an event's time read from a curve through both sides of a corner")
def test_no_curve_goes_through_both_sides_of_a_corner() -> None:
    """As the speed of what a table pushes: zero is in the step before the corner, or behind it."""
    times = np.linspace(0.0, 1.0, 41)
    for zero, corner in ((0.59, 0.6), (0.61, 0.6), (0.03, 0.025), (0.97, 0.975)):
        bend = np.maximum(times - corner, 0.0) - max(zero - corner, 0.0)
        u = np.exp(zero) - np.exp(times) - 3.0 * bend
        assert passages(times, u, [corner]) == pytest.approx([zero], abs=1e-12)
        (through,) = passages(times, u)
        assert abs(through - zero) > 1e-4


def test_a_dip_beside_a_corner_is_found() -> None:
    """Of what bends at its least row: below zero on the one side, where the curve still falls."""
    times = np.linspace(0.0, 1.0, 11)
    before, after = (times - 0.55) ** 2 - 1e-4, 0.0024 + 2.0 * (times - 0.6)
    found = passages(times, np.where(times <= 0.6, before, after), [0.6])
    assert found == pytest.approx([0.54], abs=1e-9)


def jumping(t: np.ndarray, at: float) -> np.ndarray:
    """sin t, and 0.3 more from a corner on."""
    return np.sin(t) + 0.3 * (t >= at)


@pytest.mark.parametrize("over", [1e-6, 1e-3, 1e-2, 0.1])
def test_what_jumps_at_a_corner_is_not_beyond_it_before(over: float) -> None:
    """It rises to sin 0.6 and jumps: it passes what is below that, and nothing above."""
    t, at = np.linspace(0.0, 0.8, 17), 0.6
    level = np.sin(at) + over
    assert passages(t, level - jumping(t, at), [at]) == []
    below = np.sin(at) - 1e-3
    (found,) = passages(t, below - jumping(t, at), [at])
    assert found == pytest.approx(float(np.arcsin(below)), abs=1e-9)


@pytest.mark.mutant("a curve through both sides of a jump")
def test_a_curve_through_a_jump_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "JUMP", np.inf)
    t, at = np.linspace(0.0, 0.8, 17), 0.6
    assert passages(t, np.sin(at) + 1e-3 - jumping(t, at), [at]) != []


@pytest.mark.mutant("a curve of weights in an order drawn by chance")
def test_a_curve_hangs_on_its_points_alone() -> None:
    """To the last bit, whatever state chance is in; uneven points, as those of an integrator."""
    x = np.sort(np.random.default_rng(5).random(8))
    values = set()
    for seed in range(20):
        np.random.seed(seed)  # scipy would draw from this one
        values.add(polynomial(x, np.sin(x))(0.4321))
    assert len(values) == 1


def test_a_curve_has_its_points(recwarn: pytest.WarningsRecorder) -> None:
    """Without a warning, though 0 is divided by 0 on the way, as at 1 of what is 2 at 0 and 1."""
    for x in ([0.0, 1.0], [0.25, 0.5, 0.75], list(np.linspace(0.0, 8e-3, 8))):
        for y in (np.cos(x), np.full(len(x), 2.0)):
            at = polynomial(np.array(x), y)
            assert [at(t) for t in x] == y.tolist()
    assert not recwarn.list


@pytest.mark.parametrize("count", [11, 21, 34, 51, 101, 201])
@pytest.mark.parametrize("zero", [0.3, 0.31, 0.4142, 0.5003, 0.77])
def test_the_size_of_what_passes_zero_turns_back_there(count: int, zero: float) -> None:
    """|sin 3 (t − t₀)|, as a speed: a curve through both sides would tell any depth."""
    times = np.linspace(0.0, 1.0, count) ** 1.1
    u = np.abs(np.sin(3.0 * (times - zero)))
    assert passages(times, u) == []
    found = [t for t, _ in crossings(times, u)]
    assert found == pytest.approx([zero], abs=1e-3 if count < 30 else 1e-6)  # few rows tell less


@pytest.mark.mutant("a kink at zero passed by a curve through both of its sides")
def test_a_curve_through_a_kink_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(module, "_mirrored", lambda *_: None)
    with pytest.raises(AssertionError):
        test_the_size_of_what_passes_zero_turns_back_there(51, 0.4142)


# How far attitudes are apart: a quaternion and its opposite are one attitude, everywhere.

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
        angle = max(angle, float(np.max(np.abs(deviation(a * one, b * other) - ANGLES))))
    return angle, turn


def test_the_turn_between_two_attitudes() -> None:
    """Its angle is known to the rounding of a cosine's sine: at 3.1 rad as at 1e-12."""
    assert max(far()) < EPS


def test_numbers_are_told_as_they_are() -> None:
    one, other = np.array([1.0, -2.0]), np.array([1.5, -2.25])
    assert deviation(one, other).tolist() == [0.5, 0.25]
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
        assert np.max(deviation(own, observe(case.scene, other, quantity))) < 1e-13 * size, quantity


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


# What a frame tells of a scene's elements, and which scene they may stand in.


@pytest.mark.parametrize("frame", [PLANE, SPACE])
def test_a_frame_is_itself_in_another_process(frame: Frame) -> None:
    """So that `is` may be asked of it."""
    assert pickle.loads(pickle.dumps(frame)) is frame


def test_a_turned_vector() -> None:
    """By 30° about the axis out of the plane, as an angle and as a quaternion."""
    half = np.radians(15.0)
    flat = PLANE.turned(np.array([[2 * half]]), (0.6, 0.2))
    turned = SPACE.turned(np.array([[np.cos(half), 0.0, 0.0, np.sin(half)]]), (0.6, 0.2, 0.1))
    np.testing.assert_allclose(turned, [[*flat[0], 0.1]], atol=1e-15)
    np.testing.assert_allclose(flat, [[0.3 * 3**0.5 - 0.1, 0.3 + 0.1 * 3**0.5]], atol=1e-15)


@pytest.mark.mutant("an element of the plane in a scene of space, and the other way round")
def test_a_scene_takes_no_element_of_another_frame() -> None:
    ball = solid.sphere(name="ball", mass=1.0, radius=0.1, points={})
    disk = shape.disk(name="disk", mass=1.0, radius=0.1, points={})
    pin = planar_joint("pin", "pin", Anchor("ground", "O"), Anchor("ball", "center"))
    down = (0.0, 0.0, -9.8)
    assert Scene(down, {}, {"ball": ball}, {}, {}, {}, frame=SPACE).bodies == {"ball": ball}
    with pytest.raises(ValueError, match="'disk' is not of the scene's frame, SPACE"):
        Scene(down, {}, {"disk": disk}, {}, {}, {}, frame=SPACE)
    with pytest.raises(ValueError, match="'pin' is not of the scene's frame, SPACE"):
        Scene(down, {}, {"ball": ball}, {"pin": pin}, {}, {}, frame=SPACE)
    with pytest.raises(ValueError, match="'ball' is not of the scene's frame, PLANE"):
        Scene((0.0, -9.8), {}, {"ball": ball}, {}, {}, {})
