"""Lagrange's equations where q̇ = N v + n₀: Hamel's form, against Newton's and Euler's by hand."""

from typing import Any

import numpy as np
import pytest
from given.formal import EXACT, FORMAL, drawn
from given.laws import difference
from given.mutants import mutant
from given.turning_bodies import J, unit

from textmech.reference.formalisms import energy, lagrange
from textmech.reference.formalisms.derivative import along
from textmech.reference.laws.rotation import axes
from textmech.reference.system import Mode


def lagrangian(mode: Mode, name: str) -> float:
    """(2.60) The largest difference of v̇."""
    found = [
        difference(mode.accelerations(*at), lagrange.multipliers(mode, *at)[0])
        for at in drawn(name)
    ]
    return max(found)


def powers(mode: Mode, name: str) -> float:
    """(2.51) The power that is not accounted for, relative to the largest one."""
    worst = 0.0
    for t, q, v in drawn(name):
        q_dot, a = mode.rates(t, q, v), mode.accelerations(t, q, v)
        q_ddot = lagrange.derivative(mode.rates, (t, q, v), (1.0, q_dot, a))
        terms = [
            *(lagrange.momentum(mode, t, q, q_dot) * q_ddot),
            *(lagrange.gradient(lambda q, t=t: mode.U(t, q), q) * q_dot),
            *(np.asarray(mode.Q4(t, q, v)) * v),
        ]
        worst = max(worst, abs(energy.power_balance(mode, t, q, v)) / np.abs(terms).max())
    return worst


@pytest.mark.parametrize("name", FORMAL)
def test_equations_by_hand_are_those_of_the_energies(name: str) -> None:
    assert lagrangian(FORMAL[name], name) < EXACT


@pytest.mark.parametrize("name", FORMAL)
def test_power_is_balanced(name: str) -> None:
    assert powers(FORMAL[name], name) < EXACT


@pytest.mark.parametrize("name", [name for name in FORMAL if "own velocities" not in name])
def test_multipliers_are_the_reactions(name: str) -> None:
    """The blade's side force is λ; an upright wheel's reactions have their own test."""
    mode = FORMAL[name]
    for t, q, v in drawn(name, 10):
        lam = lagrange.multipliers(mode, t, q, v)[1]
        assert len(lam) == len(mode.g(t, q))
        if name.startswith("sleigh"):
            assert difference(lam, [mode.reactions(t, q, v)["blade.side"]]) < EXACT


@pytest.mark.mutant("{name}: rates from ω in ground axes")
@pytest.mark.parametrize("name", ["free body", "top"])
@pytest.mark.parametrize("law", [lagrangian, powers])
def test_rates_from_a_spin_in_ground_axes_are_seen(name: str, law: Any) -> None:
    """ω of q̇ = ½ q ∘ (0, ω) stands in body axes."""
    sound = FORMAL[name]

    def rates(self: Mode, t: Any, q: Any, v: Any) -> Any:
        return sound.rates(t, q, np.concatenate([v[:-3], axes(q[-4:]) @ v[-3:]]))

    assert law(mutant(sound, rates=rates), name) > EXACT


@pytest.mark.slow
@pytest.mark.mutant("{name}: gyroscopic term left out")
@pytest.mark.parametrize("name", ["free body", "top"])
def test_a_lost_gyroscopic_term_is_seen_by_the_equations(name: str) -> None:
    """It has no power: that balance cannot see it."""
    sound = FORMAL[name]

    def accelerations(self: Mode, t: float, q: Any, v: Any) -> Any:
        still = np.concatenate([v[:-3], 0.0 * v[-3:]])
        return sound.accelerations(t, q, still)

    lost = mutant(sound, accelerations=accelerations)
    assert lagrangian(lost, name) > 1e-3
    assert powers(lost, name) < EXACT


@pytest.mark.slow
@pytest.mark.mutant("(2.33) as printed, erratum 1")
def test_the_printed_equations_of_euler_are_seen() -> None:
    """Erratum 1: as printed, the second component has the wrong sign before J₁ⱼ ωⱼ ω₃."""
    sound = FORMAL["free body"]

    def accelerations(self: Mode, t: float, q: Any, v: Any) -> Any:
        printed = np.array([0.0, 2 * (J @ v[3:])[0] * v[5], 0.0])
        a = sound.accelerations(t, q, v)
        return np.concatenate([a[:3], a[3:] + np.linalg.solve(J, printed)])

    mode = mutant(sound, accelerations=accelerations)
    assert lagrangian(mode, "free body") > 1e-3
    assert powers(mode, "free body") > 1e-3


def test_a_mode_whose_velocities_are_its_rates_has_no_rate_matrix() -> None:
    t, q, v = next(drawn("upright wheel"))
    assert lagrange.rate_matrix(FORMAL["upright wheel"], t, q, v) is None


def test_the_rate_matrix_of_a_quaternion_is_half_of_an_orthonormal_one() -> None:
    q = unit(np.random.default_rng(3))
    N = lagrange.rate_matrix(FORMAL["top"], 0.0, q, np.ones(3))
    assert N is not None
    np.testing.assert_allclose(4 * N.T @ N, np.eye(3), atol=1e-15)
    np.testing.assert_allclose(q @ N, 0.0, atol=1e-16)
    E_dot = along(axes, (q,), (N @ [1.0, 2.0, 3.0],))
    np.testing.assert_allclose(E_dot @ axes(q).T, _skew([1.0, 2.0, 3.0]), atol=1e-14)


def _skew(omega: list[float]) -> Any:
    """(2.4) ω₂₃ = ω₁, ω₃₁ = ω₂, ω₁₂ = ω₃."""
    a, b, c = omega
    return np.array([[0.0, c, -b], [-c, 0.0, a], [b, -a, 0.0]])
