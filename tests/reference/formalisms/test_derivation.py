"""The steps from d'Alembert to Lagrange (2.37)–(2.43), (2.53)–(2.59), with mass points for dm."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest
import sympy as sp
from given.laws import difference
from given.machines.examples import only
from given.machines.formal import EXACT, FORMAL, drawn
from given.machines.mass_points import Elements

from textmech.reference.formalisms import lagrange
from textmech.reference.formalisms.derivative import along
from textmech.reference.laws.inertia import steiner
from textmech.reference.laws.rotation import axes
from textmech.reference.system import Array, Mode

PLAIN = ["sleigh", "sleigh on a driven blade", "upright wheel"]  # v is q̇
At = tuple[float, Array, Array]
t, *q = sp.symbols("t q1:4")
u, w = sp.symbols("u1:4"), sp.symbols("w1:4")  # q̇, q̈
r = sp.Function("r")(*q, t)  # a component of r(q, t)


def D(expression: Any) -> Any:
    """d/dt along the motion."""
    places = sum(sp.diff(expression, a) * b for a, b in zip(q, u, strict=True))
    rates = sum(sp.diff(expression, a) * b for a, b in zip(u, w, strict=True))
    return sp.diff(expression, t) + places + rates


def along_constraints(mode: Mode, at: At) -> Array:
    """δq (m, k) that f_a δq = 0 allows."""
    rows = mode.f_a(at[0], at[1])
    return np.linalg.svd(rows)[2][len(rows) :].T


def open_(mode: Mode, at: At) -> Array:
    """d/dt ∂T/∂q̇ᵃ − ∂T/∂qᵃ − Q_a (m,) at the accelerations by hand."""
    a = mode.accelerations(*at)
    return lagrange.mass_matrix(mode, *at[:2]) @ a - lagrange.forces(mode, *at)


def each() -> Iterator[tuple[Mode, Elements, At]]:
    for name in PLAIN:
        for at in drawn(name, 10):
            yield FORMAL[name], Elements(FORMAL[name]), at


def test_displacement() -> None:
    """(2.37) dr = ∂r/∂qᵃ dqᵃ + ∂r/∂t dt."""
    place = sp.sin(q[0] * t) * sp.exp(q[1]) + t * q[2] ** 2
    moving = dict(zip(q, [sp.Function(str(a))(t) for a in q], strict=True))
    rates = dict(zip(u, [sp.diff(a, t) for a in moving.values()], strict=True))
    whole = sp.diff(place.subs(moving), t)
    assert sp.simplify(whole - D(place).subs(rates).subs(moving)) == 0


def test_virtual_displacement() -> None:
    """(2.38) δr = ∂r/∂qᵃ δqᵃ, at a fixed time."""
    for _, body, (time, place, rates) in each():
        step = 1e-6
        moved = body.r(time, place + step * rates) - body.r(time, place - step * rates)
        assert difference(body.slopes(time, place) @ rates, moved / (2 * step)) < 1e-8


def test_dalembert() -> None:
    """(2.39) ∫ (dF − r̈ dm) · δr = 0 for all δr that the constraints allow, and for no others."""
    for mode, body, at in each():
        lost = body.forces(*at) - body.dm[:, None] * body.r_ddot(*at, mode.accelerations(*at))
        work = np.einsum("nd,nda->a", lost, body.slopes(*at[:2]))
        size = np.abs(body.forces(*at)).max()
        assert np.abs(work @ along_constraints(mode, at)).max() < EXACT * max(size, 1.0) * 10
        assert np.abs(work @ mode.f_a(at[0], at[1]).T).max() > 1e-9 * size


def test_helmholtz() -> None:
    """(2.40) r̈ ∂r/∂qᵃ = ½ d/dt ∂ṙ²/∂q̇ᵃ − ½ ∂ṙ²/∂qᵃ."""
    r_dot = D(r)
    for place, rate in zip(q, u, strict=True):
        right = D(sp.diff(r_dot**2, rate)) / 2 - sp.diff(r_dot**2, place) / 2
        assert sp.expand(D(r_dot) * sp.diff(r, place) - right) == 0


def test_generalized_forces() -> None:
    """(2.41) Q_a = ∫ dF · ∂r/∂qᵃ: −∂U/∂q − ∂D/∂q̇ + Q₄."""
    for mode, body, (time, place, rates) in each():
        Q = np.einsum("nd,nda->a", body.forces(time, place, rates), body.slopes(time, place))
        U = lagrange.gradient(lambda q, mode=mode, time=time: mode.U(time, q), place)
        brake = lagrange.gradient(lambda v, mode=mode, at=(time, place): mode.D(*at, v), rates)
        assert difference(mode.Q4(time, place, rates) - U - brake, Q) < EXACT


@pytest.mark.parametrize("name", FORMAL)
def test_kinetic_energy(name: str) -> None:
    """(2.42) T = ½ ∫ ṙ² dm."""
    mode = FORMAL[name]
    body = Elements(mode)
    for at in drawn(name, 10):
        T = (body.dm[:, None] * body.r_dot(*at) ** 2).sum() / 2
        assert difference(mode.T(*at[:2], mode.rates(*at)), T) < EXACT


def test_kinetic_energy_about_any_point() -> None:
    """(2.53) T = ½ m ṙ_Ω² + m ṙ_Ω · (ω × ΩC) + ½ J_ik^Ω ω_i ω_k."""
    mode = FORMAL["free body"]
    (mass,), a = mode.masses.values(), np.array([0.3, -0.2, 0.5])
    for time, place, v in drawn("free body", 10):
        E, omega = axes(place[3:]), v[3:]
        v_Omega = E @ v[:3] - np.cross(omega, a)  # in body axes, a = ΩC
        J = steiner(mass.J, mass.m, a)
        T = mass.m * (v_Omega @ v_Omega / 2 + v_Omega @ np.cross(omega, a)) + omega @ J @ omega / 2
        assert difference(mode.T(time, place, mode.rates(time, place, v)), T) < EXACT


def test_lagrange_along_constraints() -> None:
    """(2.43) (d/dt ∂T/∂q̇ᵃ − ∂T/∂qᵃ − Q_a) δqᵃ = 0."""
    for mode, _, at in each():
        left, terms = open_(mode, at), lagrange.forces(mode, *at)
        assert np.abs(left @ along_constraints(mode, at)).max() < EXACT * np.abs(terms).max() * 10


def test_constraints_in_two_parts() -> None:
    """(2.56), (2.57), (2.58) f_{a1} q̇^{a1} + f_{a2} q̇^{a2} = g, δq alike, and λ times that."""
    for name in PLAIN:
        mode = FORMAL[name]
        for time, place, rates in drawn(name, 10):
            f, a2 = mode.f_a(time, place), [0, 1][: len(mode.g(time, place))]
            a1 = [a for a in range(len(place)) if a not in a2]
            split = f[:, a1] @ rates[a1] + f[:, a2] @ rates[a2]
            assert np.abs(split - mode.g(time, place)).max() < EXACT * 10
            virtual = along_constraints(mode, (time, place, rates)).T
            for dq in virtual:
                parts = f[:, a1] @ dq[a1] + f[:, a2] @ dq[a2]
                assert np.abs(parts).max() < EXACT
                assert abs(lagrange.multipliers(mode, time, place, rates)[1] @ parts) < EXACT * 100


def test_multipliers_from_the_dependent_part() -> None:
    """(2.59) λ chosen so that the equations a2 hold: then those of a1 do."""
    for name in PLAIN:
        mode = FORMAL[name]
        for at in drawn(name, 10):
            f, left = mode.f_a(*at[:2]), open_(mode, at)
            a2 = [int(np.argmax(np.abs(f[0])))] if len(f) == 1 else [0, 1]
            lam = np.linalg.solve(f[:, a2].T, left[a2])
            size = np.abs(lagrange.forces(mode, *at)).max()
            assert np.abs(left - f.T @ lam).max() < EXACT * size * 10
            assert difference(lam, lagrange.multipliers(mode, *at)[1], size) < 10 * EXACT


def loses(mode: Mode, at: At, sign: float) -> float:
    """The largest of d/dt ∂L/∂q̇ − ∂L/∂q at the accelerations by hand, of its largest term.

    L = T − sign U.
    """
    time, place, rates = at

    def slope(t: Any, q: Any, v: Any) -> Any:
        return lagrange.slope(lambda t, q, v: mode.T(t, q, v) - sign * mode.U(t, q), t, q, v)

    a = mode.accelerations(*at)
    change = along(slope, (time, place, rates), (1.0, rates, a))
    force = lagrange.gradient(lambda q: mode.T(time, q, rates) - sign * mode.U(time, q), place)
    return float(np.abs(change - force).max() / max(np.abs(change).max(), np.abs(force).max()))


@pytest.mark.parametrize("name", ["bar_pendulum", "double_pendulum"])
def test_conservative(name: str) -> None:
    """(2.52) d/dt ∂L/∂q̇ᵃ − ∂L/∂qᵃ = 0, L = T − U: D = 0 and Q₄ = 0; seen with U turned round."""
    mode, random = only(name), np.random.default_rng(52)
    n = len(mode.coordinates)
    for _ in range(20):
        at = (0.0, random.uniform(-2.0, 2.0, n), random.uniform(-3.0, 3.0, n))
        assert loses(mode, at, 1.0) < EXACT * 10
        assert loses(mode, at, -1.0) > 1e-3
