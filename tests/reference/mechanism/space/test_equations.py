"""M v̇ − λ_b f_aᵇ = Q with f_aᵇ v̇ᵃ = γᵇ of two bodies, beside a solution with more digits."""

from typing import Any

import numpy as np
import pytest

from textmech.reference.mechanism.modes import spatial_mode as equations
from textmech.reference.mechanism.modes.spatial_mode import Equations

N, R = 12, 7
EVEN, SLENDER = np.diag([0.02, 0.03, 0.04]), np.diag([0.02, 0.02, 1e-13])


def lost(**given: Any) -> float:
    """The largest error of v̇ or λ, relative to them, of four sets of rows."""
    return max(lost_of(np.random.default_rng(seed), **given) for seed in range(4))


def lost_of(
    random: np.random.Generator, *, J: Any = EVEN, mass: float = 1.0, apart: float = 1.0
) -> float:
    """The last two rows may be nearly one."""
    M = np.zeros((N, N))
    for at, block in ((0, mass * np.eye(3)), (3, J), (6, np.eye(3)), (9, EVEN)):
        M[at : at + 3, at : at + 3] = block
    rows, Q, gamma = random.normal(size=(R, N)), random.normal(size=N), random.normal(size=R)
    rows[-1], gamma[-1] = rows[-2] + apart * rows[-1], gamma[-2] + apart * gamma[-1]
    found = Equations(M, np.array([J, EVEN]), R).solve(rows, gamma, Q)
    known = np.split(solved(np.block([[M, -rows.T], [rows, np.zeros((R, R))]]), Q, gamma), [N])
    return max(
        float(np.max(np.abs(x - y)) / np.max(np.abs(y))) for x, y in zip(found, known, strict=True)
    )


def solved(matrix: Any, *right: Any) -> Any:
    """Refined by residuals of 80 bits."""
    long, wanted = matrix.astype(np.longdouble), np.concatenate(right).astype(np.longdouble)
    x = np.zeros_like(wanted)
    for _ in range(10):
        x = x + np.linalg.solve(matrix, (wanted - long @ x).astype(float))
    return x


CASES: list[tuple[dict[str, Any], float]] = [
    ({}, 2e-15),
    ({"J": SLENDER}, 2e-15),
    ({"J": np.diag([0.02, 0.02, 0.0])}, 2e-15),  # a neighbour keeps it from turning about itself
    ({"J": 1e-10 * EVEN}, 2e-15),
    ({"mass": 1e-10}, 2e-15),
    ({"mass": 1e10}, 2e-15),
    # ε / apart is 2e-10: up to ten of it on six processors; who trusts its pivots loses 2e-5.
    ({"apart": 1e-6}, 1e-8),
]


@pytest.mark.parametrize(("given", "bound"), CASES)
def test_no_more_is_lost_than_must_be(given: dict[str, Any], bound: float) -> None:
    assert lost(**given) < bound


def test_a_free_body_has_no_multipliers() -> None:
    free = Equations(np.diag([2.0] * 3), np.zeros((0, 3, 3)), 0)
    a, multipliers = free.solve(np.zeros((0, 3)), np.zeros(0), np.ones(3))
    np.testing.assert_array_equal(a, 0.5)
    assert multipliers.shape == (0,)


@pytest.mark.mutant("pivots of the equations in space trusted however narrow")
@pytest.mark.parametrize("case", [1, 3, 4, 6])
def test_narrow_pivots_are_not_trusted(case: int, monkeypatch: pytest.MonkeyPatch) -> None:
    given, bound = CASES[case]
    monkeypatch.setattr(equations, "NARROW", 0.0)
    assert lost(**given) > 10 * bound


@pytest.mark.mutant("equations in space without refinement")
def test_without_refinement_digits_are_lost(monkeypatch: pytest.MonkeyPatch) -> None:
    kept = lost(mass=1e-3)
    monkeypatch.setattr(equations, "TURNS", 0)
    assert lost(mass=1e-3) > 3 * kept
