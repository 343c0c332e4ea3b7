"""A motion that would never end ends with the budget, at the same evaluation everywhere."""

import numpy as np
import pytest

from textmech.reference.integrators.budget import Endless, budget
from textmech.reference.integrators.explicit import DormandPrince
from textmech.reference.integrators.march import integrate


def swing(t: float, y: np.ndarray) -> np.ndarray:
    return np.array([y[1], -1e4 * y[0]])


def motion(evaluations: float) -> DormandPrince:
    method = DormandPrince(swing, 2, 1e-12)
    with budget(evaluations):
        integrate(method, [0.0, 1.0, 2.0], [1.0, 0.0], most=10**6)
    return method


def test_what_fits_is_not_hindered() -> None:
    assert motion(np.inf).evaluations == motion(1e5).evaluations > 1000


def test_what_does_not_ends_and_says_where_it_was() -> None:
    with pytest.raises(Endless, match="more than 1e\\+03 evaluations") as caught:
        motion(1000)
    assert 0.0 < caught.value.time < 2.0


def test_motions_share_one_budget() -> None:
    needed = motion(np.inf).evaluations
    method = DormandPrince(swing, 2, 1e-12)
    with budget(1.5 * needed):
        integrate(method, [0.0, 1.0, 2.0], [1.0, 0.0], most=10**6)
        with pytest.raises(Endless):
            integrate(method, [0.0, 1.0, 2.0], [1.0, 0.0], most=10**6)


def test_a_budget_ends_with_its_block() -> None:
    with pytest.raises(Endless):
        motion(10)
    integrate(DormandPrince(swing, 2, 1e-12), [0.0, 1.0, 2.0], [1.0, 0.0], most=10**6)
