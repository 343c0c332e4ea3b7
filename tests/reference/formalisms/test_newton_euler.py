"""A force at a point, and a moment, about a centre: no written system has a moment to show it."""

import numpy as np

from textmech.reference.formalisms.newton_euler import wrench


def test_wrench():
    """(2.26) M_c = x × F + M, x from the centre to the point."""
    np.testing.assert_array_equal(wrench((2.0, 3.0), (1.0, 1.0), (4.0, 5.0), 6.0), [4.0, 5.0, 3.0])
    np.testing.assert_array_equal(wrench((2.0, 3.0), (2.0, 3.0), (0.0, 0.0), -6.0), [0, 0, -6.0])
