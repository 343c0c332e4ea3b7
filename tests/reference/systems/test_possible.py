"""What a system says of states and parameters that cannot be."""

import math

import numpy as np
import pytest
from given.machines import spatial
from given.machines.examples import example


def test_friction_cone_is_not_ignored():
    q, v = np.array([0.0, 0.25, 0.0]), np.zeros(3)
    steep = example("sliding_disk", beta=math.atan(1.2) + 1e-9)
    message = steep.possible("rolling", 0.0, q, v)
    assert message == "rolling needs friction 0.4, there is 0.4"
    assert example("sliding_disk", beta=math.atan(1.2) - 1e-9).possible("rolling", 0, q, v) is None
    block = example("sliding_block", beta=math.atan(0.6))
    assert block.possible("sticks", 0.0, np.zeros(1), np.zeros(1)) is not None
    assert block.possible("down", 0.0, np.zeros(1), np.zeros(1)) is None
    for name, t in (("growing_force", 6.1), ("dynamometer", 1.6), ("anisotropic_drift", 0.25)):
        assert "sticking against" in str(example(name).possible("stuck", t, *np.zeros((2, 1))))
    assert "sticking needs friction" in str(example("friction_cone").possible("sticks", 3.0, q, v))
    pulled = example("bearing", M=0.6)
    assert "sticking against" in str(pulled.possible("sticks", 0.0, *np.zeros((2, 1))))


def test_contact_that_is_open_or_penetrates_is_said():
    disk = example("bouncing_disk")
    assert "below the floor" in str(disk.possible("flight", 0.0, np.array([-0.01]), np.zeros(1)))
    block = example("sliding_block", beta=math.radians(100))
    assert "would have to pull" in str(block.possible("down", 0.0, np.zeros(1), np.zeros(1)))
    lifted = example("friction_cone", b_y=4.0)
    assert "would have to pull" in str(lifted.possible("down", 5.0, np.zeros(1), np.zeros(1)))
    wheel, q = example("sliding_disk", beta=math.radians(100)), np.array([0.0, 0.25, 0.0])
    for mode in wheel.modes:
        assert "would have to pull" in str(wheel.possible(mode, 0.0, q, np.zeros(3)))


@pytest.mark.parametrize(
    ("name", "changed", "words"),
    [
        ("sliding_block", {"mu_s": 0.3}, "μ_k ≤ μ_s"),
        ("sliding_block", {"mu_k": -0.1}, "μ_k ≤ μ_s"),
        ("growing_force", {"F_minus": 7.0}, "kinetic friction"),
        ("growing_force", {"b": 0.0}, "b > 0"),
        ("dynamometer", {"u": -1.0}, "u > 0"),
        ("dynamometer", {"Fs_plus": 2.0}, "kinetic friction"),
        ("bouncing_disk", {"e": 1.1}, "restitution"),
        ("bouncing_disk", {"y0": 0.1}, "above the floor"),
        ("smooth_dynamometer", {"F_plus": -3.0}, "negative"),
        ("bearing", {"M_k": 0.6}, "M_k ≤ M_s"),
        ("bearing", {"w0": -1.0}, "turn back"),
        ("stribeck_brake", {"v0": 0.0}, "v0 and v_s"),
        ("stribeck_brake", {"P": 6.0}, "held by Fs"),
        ("stribeck_drive", {"u": 0.0}, "must be positive"),
        ("stribeck_drive", {"F": 7.0}, "kinetic friction"),
        ("friction_cone", {"mu_s": 0.3}, "μ_k ≤ μ_s"),
        ("friction_cone", {"beta": 0.5}, "has to rest"),
        ("friction_cone", {"b_x": 0.1, "b_y": -1.0}, "presses the block"),
        ("friction_of_rest", {"mu_s": 0.2}, "kinetic friction"),
        ("ball_on_rope", {"x0": 0.9, "y0": 0.6}, "within the rope's length"),
        ("stopped_pendulum", {"e": 1.2}, "restitution"),
        ("stopped_pendulum", {"low": 0.5}, "bar start above it"),
        ("viscous_drift", {"A": 0.0}, "the force swings with A ≠ 0 and w > 0"),
        ("viscous_drift", {"w": 0.0}, "the force swings with A ≠ 0 and w > 0"),
        ("viscous_drift", {"w": -6.0}, "the force swings with A ≠ 0 and w > 0"),
        ("tipping_block", {"mu": 0.2}, "slides before it tips: mu > w/"),
        ("tipping_block", {"b": 0.0}, "the push grows"),
        ("sliding_ladder", {"phi0": 1.6}, "must lean on the wall"),
        ("cradle", {"x2": 0.1}, "must start apart"),
        ("cradle", {"e": 0.05}, "without end"),
        ("cradle", {"e": 1.1}, "without end"),
        ("stacked_blocks", {"v0": 1.0}, "pulled with b > 0 or thrown"),
        ("stacked_blocks", {"b": 0.0}, "pulled with b > 0 or thrown"),
        ("disk_on_disk", {"L": 0.7}, "starts on the drum"),
        ("disk_on_disk", {"theta0": 2.0}, "rolls down on the right"),
        ("sleigh", {"a": 0.0}, "knife edge"),
        ("rimless_wheel", {"n": 2.0}, "three whole spokes, not 2"),
        ("rimless_wheel", {"n": 8.4}, "three whole spokes, not 8.4"),
        ("rimless_wheel", {"w0": -1.0}, "down the slope"),
        ("rimless_wheel", {"n": 3.0, "J": 0.01}, "stop at once"),
        ("spring_mass_jump", {"vx0": -9.0}, "shortened at touch-down"),
        ("running_gait", {"vx0": -9.0}, "shortened at touch-down"),
        ("heavy_top", {"theta0": 0.0}, "0 < theta0 < π"),
        ("heavy_top", {"theta0": math.pi}, "0 < theta0 < π"),
        ("heavy_top", {"theta0": -0.1}, "0 < theta0 < π"),
        ("heavy_top", {"l": -0.05}, "l > 0"),
        ("tilting_disk", {"beta0": math.pi / 2}, "flat on the floor"),
        ("torque_free", {"A": 0.05}, "A > B > C"),
        ("torque_free", {"A": 0.11}, "sum of the other two"),
    ],
)
def test_impossible_parameters_are_refused(name: str, changed: dict[str, float], words: str):
    build = spatial.example if name in spatial.SPATIAL else example
    with pytest.raises(ValueError, match=words):
        build(name, **changed)


@pytest.mark.parametrize(
    ("name", "mode", "t", "q", "v", "message"),
    [
        ("sliding_ladder", "slides", 0.5, [1.0, -0.1], [0.0] * 2, "lies on the floor"),
        ("tipping_block", "tips", 0.5, [2.7], [0.0], "lies on its side"),
        ("tipping_block", "tips", 3.0, [2.0], [0.0], "sticking takes"),
        ("cradle", "free", 1.0, [0.0, 0.05, 0.63], [0.0] * 3, "overlap"),
        ("stacked_blocks", "together", 0.8, [0.0, 0.4], [0.0] * 2, "past the end"),
        ("stacked_blocks", "together", 0.8, [0.0, 0.1], [0.0] * 2, "sticking takes"),
        ("disk_on_disk", "rolls", 0.8, [0.6, 0.1, 0, 0], [0.0] * 4, "rolling takes"),
        ("disk_on_disk", "rolls", 0.8, [0.6, 1.0, 0, 0], [0, -9.0, 0, 0], "would have to pull"),
        ("disk_on_disk", "slips", 0.8, [0.6, 1.0, 0, 0], [0, 1.0, 0, 0], "slips uphill"),
        ("disk_on_disk", "flies", 0.8, [0.5, 1.0, 0, 0], [0.0] * 4, "in the drum"),
    ],
)
def test_where_it_ends_is_said(
    name: str, mode: str, t: float, q: list[float], v: list[float], message: str
) -> None:
    said = example(name).possible(mode, t, np.array(q), np.array(v))
    assert message in str(said)


def test_blocks_that_would_tip_are_said() -> None:
    high = example("stacked_blocks", h2=1.0, mu2=0.9)
    said = high.possible("left behind", 1.0, np.array([0.0, 0.1]), np.array([1.0, 0.5]))
    assert "a block tips" in str(said)
