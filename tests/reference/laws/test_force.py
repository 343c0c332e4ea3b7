"""Force laws against typed values."""

import numpy as np

from textmech.reference.laws.force import damper, spring, weight


def test_weight_points_along_gravity():
    np.testing.assert_array_equal(weight(2.0, (0.0, -9.5)), [0.0, -19.0])


def test_spring_pulls_when_stretched_and_pushes_when_compressed():
    np.testing.assert_allclose(spring(10.0, 2.0, (3.0, 4.0)), [18.0, 24.0], rtol=1e-15)
    np.testing.assert_allclose(spring(10.0, 6.0, (3.0, 4.0)), [-6.0, -8.0], rtol=1e-15)
    np.testing.assert_allclose(spring(10.0, 5.0, (3.0, 4.0)), [0.0, 0.0], atol=1e-15)


def test_spring_without_a_length_of_its_own_has_no_force_where_its_ends_meet():
    np.testing.assert_array_equal(spring(10.0, 0.0, (0.0, 0.0)), [0.0, 0.0])
    np.testing.assert_array_equal(spring(10.0, 0.0, (3.0, -4.0)), [30.0, -40.0])


def test_damper_pulls_while_it_lengthens_and_ignores_turning():
    np.testing.assert_allclose(damper(2.0, (3.0, 4.0), (0.3, 0.4)), [0.6, 0.8], rtol=1e-15)
    np.testing.assert_allclose(damper(2.0, (3.0, 4.0), (-0.3, -0.4)), [-0.6, -0.8], rtol=1e-15)
    np.testing.assert_allclose(damper(2.0, (3.0, 4.0), (-4.0, 3.0)), [0.0, 0.0], atol=1e-15)
