"""From free bodies to generalized coordinates (2.9)–(2.20): what is bound, what can be solved."""

import numpy as np
import pytest
from given import scenes
from given.laws import difference
from given.machines.examples import example, only
from given.machines.formal import FORMAL, drawn
from given.machines.mass_points import Elements
from given.machines.states import states

from textmech.reference.formalisms import voronets
from textmech.reference.formalisms.dependent import dependent
from textmech.reference.formalisms.derivative import along
from textmech.reference.formalisms.lagrange import derivative
from textmech.reference.laws.rotation import axes
from textmech.reference.system import Mode

PLANE = 3  # parameters of a free body there; 6 in space
WRITTEN = {  # the cases of hand-written systems with fewer coordinates than their bodies
    "bar_pendulum": "bar_pendulum", "double_pendulum": "double_pendulum", "rhombus": "rhombus",
}  # fmt: skip


def test_a_free_body_has_six_parameters() -> None:
    """(2.9) X_i of three of them, E_ij of three others: E is orthonormal whatever they are."""
    for t, q, v in drawn("free body", 5):
        E = axes(FORMAL["free body"].poses(t, q, v)["body"][3:7])
        np.testing.assert_allclose(E @ E.T, np.eye(3), atol=1e-15)
        rates = [FORMAL["free body"].rates(t, q, way) for way in np.eye(6)]
        assert np.linalg.matrix_rank(rates) == 6
        assert (
            np.linalg.matrix_rank([along(lambda q: axes(q[3:]), (q,), (r,)).ravel() for r in rates])
            == 3
        )


@pytest.mark.parametrize("name", WRITTEN)
def test_coordinates_meet_the_constraints_of_the_bodies(name: str) -> None:
    """(2.10), (2.11) Z_m(x) = 0 of rank M, x = x(q) with Z(x(q)) ≡ 0, and n = 3 K − M."""
    free, mode = scenes.mechanism(scenes.SHIPPED[WRITTEN[name]]).base, only(name)
    for t, q, v in states(name, "moving", 10):
        place, rates = free.place(mode.poses(t, q, v))
        Z, bound = free.f(t, place), free.f_a(t, place)
        assert np.max(np.abs(Z)) < 1e-14
        assert np.max(np.abs(bound @ rates)) < 1e-12
        M = np.linalg.matrix_rank(bound)
        assert len(bound) == M
        assert len(q) == PLANE * len(free.masses) - M


def test_points_follow_from_the_coordinates() -> None:
    """(2.12) r = r(x_i, q, t): the distances of its points are those of the body."""
    for name in ("free body", "top", "upright wheel", "sleigh"):
        body = Elements(FORMAL[name])
        for (t, q, _), (s, p, _) in zip(drawn(name, 5), drawn(name, 6), strict=False):
            one, other = body.r(t, q), body.r(s, 0.5 * p if name == "sleigh" else p)
            apart = [np.linalg.norm(r[:, None] - r, axis=-1) for r in (one, other)]
            assert difference(*apart) < 1e-12


def test_more_parameters_than_freedoms() -> None:
    """(2.13), (2.14) m parameters and f(q) = 0 of rank r: n = m − r."""
    mode = only("four_bar")
    for t, q, _ in states("four_bar", "moving", 10):
        slopes = [derivative(lambda q, t=t: mode.f(t, q), (q,), (way,)) for way in np.eye(3)]
        assert np.linalg.matrix_rank(slopes) == 2
        assert len(q) - 2 == 1
        np.testing.assert_allclose(np.transpose(slopes), mode.f_a(t, q), atol=1e-15)


def bent(mode: Mode, t: float, q: np.ndarray, v: np.ndarray) -> float:
    """The largest β (2.65): 0 if and only if the constraints can be integrated (Frobenius)."""
    by = dependent(mode, t, q, len(v))
    assert by is not None
    _, bends = voronets.slopes_of(by, t, q, v[by.a1])
    return float(np.abs(voronets.beta(by, by.alpha(t, q), bends)).max())


@pytest.mark.parametrize("name", ["upright wheel", "sleigh"])
def test_on_a_plane_rolling_cannot_be_integrated(name: str) -> None:
    """(2.15), (2.19), (2.20) ẋ = R φ̇ cos θ, ẏ = R φ̇ sin θ (Example 2.2), and a blade's edge."""
    assert min(bent(FORMAL[name], *at) for at in drawn(name, 10)) > 1e-3


def test_on_a_line_rolling_can() -> None:
    """(2.16), (2.17), (2.18) ẋ_c = R φ̇, ẏ_c = 0 (Example 2.1), as any (2.14)."""
    for at in (("rolling_wheel", "moving"), ("sliding_disk", "rolling"), ("four_bar", "moving")):
        mode = example(at[0]).modes[at[1]]
        assert max(bent(mode, *state) for state in states(*at, 10)) < 1e-12
