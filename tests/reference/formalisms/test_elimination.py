"""The steps from the multipliers to Voronets (2.61)–(2.65) and to Appell (2.68)–(2.79)."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import sympy as sp
from given.laws import difference
from given.machines.formal import EXACT, FORMAL, drawn
from given.machines.mass_points import Elements

from textmech.reference.formalisms import appell, lagrange, voronets
from textmech.reference.formalisms.dependent import Dependent, dependent
from textmech.reference.system import Array, Mode

PLAIN = ["sleigh", "sleigh on a driven blade", "upright wheel"]  # v is q̇
At = tuple[float, Array, Array]
FEW = 100 * EXACT  # where α is about ten and its derivatives about a hundred


def each(*names: str) -> Iterator[tuple[Mode, Dependent, Elements, At]]:
    for name in names or PLAIN:
        mode = FORMAL[name]
        for t, q, v in drawn(name, 10):
            by = dependent(mode, t, q, len(v))
            assert by is not None
            yield mode, by, Elements(mode), (t, q, v)


def g(by: Dependent, body: Elements, t: float, q: Array) -> Array:
    """∂r/∂q^{a1} + ∂r/∂q^{a2} α (N, d, k)."""
    slopes = body.slopes(t, q)
    return slopes[..., by.a1] + slopes[..., by.a2] @ by.alpha(t, q)


def left(mode: Mode, at: At) -> Array:
    """d/dt ∂T/∂q̇ᵃ − ∂T/∂qᵃ − Q_a (m,)."""
    M = lagrange.mass_matrix(mode, *at[:2])
    return M @ mode.accelerations(*at) - lagrange.forces(mode, *at)


def test_dependent_rates() -> None:
    """(2.61) q̇^{a2} = α q̇^{a1} + γ, α = −(f_{a2})⁻¹ f_{a1}, γ = (f_{a2})⁻¹ g."""
    for mode, by, _, (t, q, v) in each():
        f = mode.f_a(t, q)
        alpha, gamma = by.solved(t, q)
        np.testing.assert_allclose(f[:, by.a2] @ alpha, -f[:, by.a1], atol=FEW)
        np.testing.assert_allclose(f[:, by.a2] @ gamma, mode.g(t, q), atol=FEW)
        np.testing.assert_allclose(alpha @ v[by.a1] + gamma, v[by.a2], atol=FEW)


def test_multipliers_of_dependent_rates() -> None:
    """(2.62) left sides = λ_{a2} α for a1 and −λ_{a2} for a2: λ_{a2} = −λ_b f_b^{a2} of (2.60)."""
    for mode, by, _, at in each():
        lam = lagrange.multipliers(mode, *at)[1] @ mode.f_a(*at[:2])[:, by.a2]
        size = np.abs(lagrange.forces(mode, *at)).max()
        assert difference(left(mode, at)[by.a2], lam, size) < FEW
        assert difference(left(mode, at)[by.a1], -lam @ by.alpha(*at[:2]), size) < FEW


def test_slopes_of_the_reduced_energy() -> None:
    """(2.63) ∂T'/∂q̇^{a1} = ∂T/∂q̇^{a1} + ∂T/∂q̇^{a2} α."""
    for mode, by, _, (t, q, v) in each():
        p = lagrange.momentum(mode, t, q, v)
        found = by.momentum(t, q, v[by.a1])
        assert difference(p[by.a1] + p[by.a2] @ by.alpha(t, q), found) < FEW


def test_brackets() -> None:
    """(2.64) dα_{a1}/dt − (∂α_d/∂q^{a1} + ∂α_d/∂q^c α^c_{a1}) q̇^d = β_{a1 d} q̇^d."""
    for _, by, _, (t, q, v) in each("sleigh", "upright wheel"):
        change = lagrange.derivative(by.alpha, (t, q), (1.0, v))
        _, bends = voronets.slopes_of(by, t, q, v[by.a1])
        alpha, slopes = by.alpha(t, q), np.einsum("cdm,d->cm", bends[:, :-1], v[by.a1])
        bracket = change - slopes[:, by.a1] - slopes[:, by.a2] @ alpha
        beta = voronets.beta(by, alpha, bends) @ v[by.a1]
        assert difference(bracket, beta, 1.0) < FEW


def test_beta_is_skew() -> None:
    """(2.65) β_{lk} = −β_{kl}."""
    for _, by, _, (t, q, v) in each():
        _, bends = voronets.slopes_of(by, t, q, v[by.a1])
        beta = voronets.beta(by, by.alpha(t, q), bends)
        np.testing.assert_array_equal(beta, -np.swapaxes(beta, 1, 2))
        assert np.abs(beta).max() > 1e-3


def test_dalembert_of_elements() -> None:
    """(2.68), (2.69), (2.71) ∫ r̈ dm · δr = ∫ dF · δr for δr = g δq^{a1}, δq^{a2} = α δq^{a1}."""
    for mode, by, body, at in each():
        t, q, _ = at
        ways = np.zeros((len(q), len(by.a1)))
        ways[by.a1], ways[by.a2] = np.eye(len(by.a1)), by.alpha(t, q)
        np.testing.assert_allclose(mode.f_a(t, q) @ ways, 0.0, atol=FEW)
        np.testing.assert_allclose(body.slopes(t, q) @ ways, g(by, body, t, q), atol=FEW)
        pulled = body.dm[:, None] * body.r_ddot(*at, mode.accelerations(*at))
        work = [np.einsum("nd,nda->a", X, g(by, body, t, q)) for X in (pulled, body.forces(*at))]
        assert difference(*work, scale=1.0) < FEW


def test_velocities_of_elements() -> None:
    """(2.70), (2.72) ṙ = g q̇^{a1}, and ∂r/∂q^{a2} γ more where a blade is driven."""
    for _, by, body, (t, q, v) in each():
        driven = body.slopes(t, q)[..., by.a2] @ by.solved(t, q)[1]
        found = g(by, body, t, q) @ v[by.a1] + driven
        assert difference(body.r_dot(t, q, v), found) < FEW


def test_accelerations_of_elements() -> None:
    """(2.73) r̈ = ∂²r/∂t² + ∂²r/∂t∂qᵃ q̇ᵃ + ∂g/∂t q̇ + ∂g/∂q^c q̇^c q̇ + g q̈, g and r of q and t."""
    t, *q = sp.symbols("t q1:3")
    u, w = sp.symbols("u1:3"), sp.symbols("w1")
    r, alpha = sp.Function("r")(*q, t), sp.Function("alpha")(*q, t)
    way = sp.diff(r, q[0]) + sp.diff(r, q[1]) * alpha
    r_dot = sp.diff(r, t) + way * u[0]  # (2.72), with u₂ = α u₁ put in
    rates = [u[0], alpha * u[0]]
    along = sum(sp.diff(r_dot, a) * b for a, b in zip(q, rates, strict=True))
    whole = sp.diff(r_dot, t) + along + sp.diff(r_dot, u[0]) * w
    mixed = sum(sp.diff(r, t, a) * b for a, b in zip(q, rates, strict=True))
    turned = sum(sp.diff(way, a) * b for a, b in zip(q, rates, strict=True)) * u[0]
    book = sp.diff(r, t, 2) + mixed + sp.diff(way, t) * u[0] + turned + way * w
    assert sp.expand(whole - book) == 0
    assert sp.diff(whole, w) == way  # (2.74)


def test_slopes_of_accelerations() -> None:
    """(2.74) ∂r̈/∂q̈^{a1} = g_{a1}, of the elements and of the centre."""
    for mode, by, body, at in each():
        k, still = len(by.a1), mode.accelerations(*at)
        for a, way in enumerate(np.eye(k)):
            more = by.changed(*at, way) - by.changed(*at, 0.0 * way)
            moved = body.r_ddot(*at, still + more) - body.r_ddot(*at, still)
            assert difference(g(by, body, *at[:2])[..., a], moved, 10.0) < FEW
        d = body.r(*at[:2]).shape[1]
        centre = np.tensordot(body.dm, g(by, body, *at[:2]), 1) / body.dm.sum()
        assert difference(appell.free_accelerations(by, *at)[0, :d], centre, 1.0) < FEW


def energies(mode: Mode, by: Dependent, body: Elements, at: At, q_ddot: Array) -> tuple[float, ...]:
    """S of the elements, and of the bodies."""
    a = by.changed(*at, q_ddot)
    S = (body.dm[:, None] * body.r_ddot(*at, a) ** 2).sum() / 2
    rates = appell.body_accelerations(mode, *at, a)
    gyro = np.array([appell.gyroscopic(*pair) for pair in _bodies(mode, at)])
    return float(S), float(appell.energy(mode, rates, gyro))


def _bodies(mode: Mode, at: At) -> list[Any]:
    poses = mode.poses(*at)
    return [(mass, poses[name]) for name, mass in mode.masses.items()]


def test_energy_of_accelerations() -> None:
    """(2.77) S = ½ ∫ r̈² dm is that of the bodies, but for what has no q̈."""
    random = np.random.default_rng(6)
    for mode, by, body, at in each(*PLAIN, "free body", "top"):
        one, other, none = (*random.normal(size=(2, len(by.a1))), np.zeros(len(by.a1)))
        found = [energies(mode, by, body, at, x) for x in (one, other, none)]
        (S, mine), (T, yours), (U, ours) = found
        assert difference(S - U, mine - ours, abs(U)) < FEW
        assert difference(T - U, yours - ours, abs(U)) < FEW
        assert abs(S - T) > 1e-6 * abs(U)


def test_slopes_of_the_energy() -> None:
    """(2.75), (2.76), (2.79) ∫ r̈ · ∂r̈/∂q̈ dm = ∂S/∂q̈ (erratum 2), ∫ dF · g = Π, Π − ∂S/∂q̈ = 0."""
    for mode, by, body, at in each():
        t, q, _ = at
        pulled = body.dm[:, None] * body.r_ddot(*at, mode.accelerations(*at))
        slopes = np.einsum("nd,nda->a", pulled, g(by, body, t, q))
        size = max(np.abs(by.forces(*at)).max(), 1.0)
        Pi = np.einsum("nd,nda->a", body.forces(*at), g(by, body, t, q))
        assert difference(Pi, by.forces(*at), size) < FEW  # (2.78)
        assert difference(slopes, by.forces(*at), size) < FEW
        q_ddot = mode.accelerations(*at)[by.a1]
        for a, way in enumerate(np.eye(len(by.a1))):
            ahead, behind = (energies(mode, by, body, at, q_ddot + s * way)[0] for s in (1, -1))
            assert difference((ahead - behind) / 2, slopes[a], 10 * size) < FEW
