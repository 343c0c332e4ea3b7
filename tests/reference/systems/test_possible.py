"""What a system says of states and parameters that cannot be."""

import math

import numpy as np
import pytest
from given.examples import example


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
    ],
)
def test_impossible_parameters_are_refused(name: str, changed: dict[str, float], words: str):
    with pytest.raises(ValueError, match=words):
        example(name, **changed)
