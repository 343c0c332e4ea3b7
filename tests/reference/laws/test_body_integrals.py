"""Momentum and angular momentum as sums over mass elements (2.21)–(2.30), of a body that moves."""

import numpy as np
from given.formal import EXACT, FORMAL, drawn
from given.laws import difference
from given.mass_points import Elements, elements
from given.turning_bodies import J

from textmech.cases.scene.frame import SPACE
from textmech.reference.formalisms.derivative import along
from textmech.reference.laws.momentum import angular_momentum
from textmech.reference.laws.rotation import axes
from textmech.reference.system import Array

MODE = FORMAL["free body"]
BODY = Elements(MODE)
STATES = list(drawn("free body", 10))
M = float(BODY.dm.sum())


def relative(t: float, q: Array, v: Array) -> tuple[Array, Array]:
    """x and ẋ (N, 3) from the centre of mass, in ground axes."""
    r, r_dot = BODY.r(t, q), BODY.r_dot(t, q, v)
    return r - BODY.dm @ r / M, r_dot - BODY.dm @ r_dot / M


def test_centre_of_mass() -> None:
    """(2.21) r_c = ∫ r dm / ∫ dm."""
    for t, q, v in STATES:
        pose = MODE.poses(t, q, v)["body"]
        assert difference(BODY.dm @ BODY.r(t, q) / M, pose[SPACE.place]) < EXACT


def test_momentum() -> None:
    """(2.22) p = ∫ ṙ dm = m ṙ_c."""
    for t, q, v in STATES:
        assert difference(BODY.dm @ BODY.r_dot(t, q, v), M * v[:3]) < EXACT


def test_rate_of_momentum() -> None:
    """(2.23) ṗ = F."""
    for t, q, v in STATES:
        pulled = BODY.dm @ BODY.r_ddot(t, q, v, MODE.accelerations(t, q, v))
        (load,) = MODE.loads(t, q, v)
        assert difference(pulled, load.force) < EXACT


def test_angular_momentum_about_the_centre() -> None:
    """(2.25), (2.29) D_c = ∫ x × ẋ dm = J_ik ω_i E_k."""
    for t, q, v in STATES:
        x, x_dot = relative(t, q, v)
        D_c = BODY.dm @ np.cross(x, x_dot)
        assert difference(D_c, J @ v[3:] @ axes(q[3:])) < EXACT


def test_moments_of_inertia() -> None:
    """(2.30) J₁₁ = ∫ (x₂² + x₃²) dm and so on, J₁₂ = −∫ x₁ x₂ dm and so on."""
    dm, x = elements(MODE.masses["body"])
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        assert difference(dm @ (x[:, j] ** 2 + x[:, k] ** 2), J[i, i]) < EXACT
        assert difference(-(dm @ (x[:, i] * x[:, j])), J[i, j]) < EXACT


def test_rate_of_angular_momentum() -> None:
    """(2.24), (2.26), (2.27) Ḋ₀ = M₀ and Ḋ_c = M_c, moments of forces and of a couple."""
    for t, q, v in STATES:
        a = MODE.accelerations(t, q, v)
        (load,) = MODE.loads(t, q, v)
        x, _ = relative(t, q, v)
        r_ddot = BODY.r_ddot(t, q, v, a)
        about_c = BODY.dm @ np.cross(x, r_ddot)
        assert difference(about_c, load.moment) < 10 * EXACT

        def D_0(q: Array, v: Array) -> Array:
            E = axes(q[3:])
            return angular_momentum(M, E.T @ J @ E, q[:3], v[:3], v[3:] @ E)

        M_0 = np.cross(q[:3], load.force) + load.moment
        assert difference(along(D_0, (q, v), (MODE.rates(t, q, v), a)), M_0) < 10 * EXACT
