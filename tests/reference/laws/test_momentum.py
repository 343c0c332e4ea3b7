"""Inertia, momentum and angular momentum: as sums over masses, and along motions."""

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from pathlib import Path

import numpy as np
import pytest
from given.laws import difference, momenta
from given.laws.momenta import Acting, Point, System, planar, samples
from given.machines.formal import EXACT, FORMAL, drawn
from given.machines.mass_points import Elements, elements
from given.machines.spring_pair import FREE, pair
from given.machines.turning_bodies import J as BODY_J
from given.scenes import mechanism, typed

from textmech.cases.case import Case
from textmech.cases.scene.frame import SPACE
from textmech.reference.formalisms.derivative import along
from textmech.reference.laws import momentum
from textmech.reference.laws.inertia import bar, disk, rotated, steiner, tensor
from textmech.reference.laws.momentum import angular_momentum, moment_change, spin_rate
from textmech.reference.laws.rotation import axes
from textmech.reference.motion.bodies import Answer
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array

# Inertias against integrals over the body, and what happens to them elsewhere.


def points_of_bar(m: float, l: float) -> tuple[Array, Array]:
    """Gauss points along axis 1 and their masses: exact for polynomials."""
    node, weight = np.polynomial.legendre.leggauss(4)
    x = np.zeros((4, 3))
    x[:, 0] = node * l / 2
    return m * weight / 2, x


def points_of_disk(m: float, R: float) -> tuple[Array, Array]:
    """Gauss points in the radius, evenly spaced ones around: exact for squares."""
    node, weight = np.polynomial.legendre.leggauss(4)
    r, ring = R * (node + 1) / 2, m * weight * (node + 1) / 2  # dm = 2 m r dr / R²
    phi = np.arange(8) * np.pi / 4
    x = np.stack(
        [np.outer(r, np.cos(phi)), np.outer(r, np.sin(phi)), np.zeros((4, 8))], axis=-1
    ).reshape(-1, 3)
    return np.repeat(ring / 8, 8), x


BODIES = {"bar": (bar(1.3, 0.8), *points_of_bar(1.3, 0.8)),
          "disk": (disk(1.3, 0.8), *points_of_disk(1.3, 0.8))}  # fmt: skip


def some_axes() -> Array:
    """Rows: three orthonormal axes along nothing in particular."""
    E = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    return E * np.linalg.det(E)


@pytest.mark.parametrize("body", BODIES)
def test_formula_is_the_integral(body: str):
    J, m, x = BODIES[body]
    assert m.sum() == pytest.approx(1.3, rel=1e-14)
    np.testing.assert_allclose(J, tensor(m, x), rtol=1e-14, atol=1e-16)


@pytest.mark.parametrize("body", BODIES)
def test_steiner_is_the_integral_about_another_point(body: str):
    J, m, x = BODIES[body]
    a = np.array([0.3, -0.7, 0.2])
    np.testing.assert_allclose(steiner(J, m.sum(), a), tensor(m, x - a), rtol=1e-13)


@pytest.mark.parametrize("body", BODIES)
def test_rotation_is_the_integral_in_other_axes(body: str):
    J, m, x = BODIES[body]
    E = some_axes()
    np.testing.assert_allclose(rotated(J, E), tensor(m, x @ E.T), rtol=1e-13, atol=1e-15)


def test_bar_about_its_end():
    end = steiner(bar(1.2, 0.8), 1.2, np.array([0.4, 0.0, 0.0]))
    assert end[2, 2] == pytest.approx(1.2 * 0.8**2 / 3, rel=1e-15)


def test_products_of_inertia_carry_the_minus_sign():
    m, x = np.array([2.0]), np.array([[1.0, 3.0, 0.0]])
    assert tensor(m, x)[0, 1] == -6.0


# Angular momentum: the laws (2.24)–(2.28), (2.33) against sums over moving masses.

RANDOM = np.random.default_rng(4)
MASSES = RANDOM.uniform(0.1, 1.0, 12)
X = RANDOM.normal(size=(12, 3))
X -= MASSES @ X / MASSES.sum()  # from the centre of mass
M = float(MASSES.sum())
J = tensor(MASSES, X)
R, V, A, OMEGA, SPIN = RANDOM.normal(size=(5, 3))  # of the centre: r, ṙ, r̈; ω, ω̇


def test_angular_momentum_about_the_origin_is_the_sum():
    velocities = V + np.cross(OMEGA, X)
    total = (MASSES[:, None] * np.cross(R + X, velocities)).sum(axis=0)
    np.testing.assert_allclose(angular_momentum(M, J, R, V, OMEGA), total, rtol=1e-13)


def test_eulers_equations_are_the_moment_of_the_accelerations():
    accelerations = np.cross(SPIN, X) + np.cross(OMEGA, np.cross(OMEGA, X))
    M_c = (MASSES[:, None] * np.cross(X, accelerations)).sum(axis=0)
    np.testing.assert_allclose(spin_rate(J, OMEGA, M_c), SPIN, rtol=1e-12)


def test_free_body_keeps_its_energy_but_not_as_printed():
    """Erratum 1: as printed, the second component has the wrong sign before J₁ⱼ ωⱼ ω₃."""
    D = J @ OMEGA
    assert abs(D @ spin_rate(J, OMEGA, np.zeros(3))) < 1e-13
    gyro = np.cross(OMEGA, D)
    gyro[1] -= 2 * D[0] * OMEGA[2]
    gain = D @ np.linalg.solve(J, -gyro)
    np.testing.assert_allclose(gain, 2 * D[0] * OMEGA[1] * OMEGA[2], rtol=1e-12)


def test_moving_point_needs_velocities_relative_to_it():
    """(2.28) with D_A from relative velocities; from absolute ones the law is another one.

    D_A (absolute) = D_A (relative) + m a × v_A, and a × v_A changes by −v_A × v_C more.
    """
    r_A, v_A, a_A = np.random.default_rng(5).normal(size=(3, 3))
    accelerations = A + np.cross(SPIN, X) + np.cross(OMEGA, np.cross(OMEGA, X))
    arm = R + X - r_A
    M_A = (MASSES[:, None] * np.cross(arm, accelerations)).sum(axis=0)
    relative = (MASSES[:, None] * np.cross(arm, accelerations - a_A)).sum(axis=0)
    np.testing.assert_allclose(moment_change(M_A, M, a_A, R - r_A), relative, rtol=1e-12)
    velocities = V + np.cross(OMEGA, X)
    absolute = M_A + (MASSES[:, None] * np.cross(velocities - v_A, velocities)).sum(axis=0)
    np.testing.assert_allclose(M_A - M * np.cross(v_A, V), absolute, rtol=1e-12)


# Momentum and angular momentum as sums over mass elements (2.21)–(2.30), of a body that moves.

MODE = FORMAL["free body"]
BODY = Elements(MODE)
STATES = list(drawn("free body", 10))
BODY_M = float(BODY.dm.sum())


def relative(t: float, q: Array, v: Array) -> tuple[Array, Array]:
    """x and ẋ (N, 3) from the centre of mass, in ground axes."""
    r, r_dot = BODY.r(t, q), BODY.r_dot(t, q, v)
    return r - BODY.dm @ r / BODY_M, r_dot - BODY.dm @ r_dot / BODY_M


def test_centre_of_mass() -> None:
    """(2.21) r_c = ∫ r dm / ∫ dm."""
    for t, q, v in STATES:
        pose = MODE.poses(t, q, v)["body"]
        assert difference(BODY.dm @ BODY.r(t, q) / BODY_M, pose[SPACE.place]) < EXACT


def test_momentum() -> None:
    """(2.22) p = ∫ ṙ dm = m ṙ_c."""
    for t, q, v in STATES:
        assert difference(BODY.dm @ BODY.r_dot(t, q, v), BODY_M * v[:3]) < EXACT


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
        assert difference(D_c, BODY_J @ v[3:] @ axes(q[3:])) < EXACT


def test_moments_of_inertia() -> None:
    """(2.30) J₁₁ = ∫ (x₂² + x₃²) dm and so on, J₁₂ = −∫ x₁ x₂ dm and so on."""
    dm, x = elements(MODE.masses["body"])
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        assert difference(dm @ (x[:, j] ** 2 + x[:, k] ** 2), BODY_J[i, i]) < EXACT
        assert difference(-(dm @ (x[:, i] * x[:, j])), BODY_J[i, j]) < EXACT


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
            return angular_momentum(BODY_M, E.T @ BODY_J @ E, q[:3], v[:3], v[3:] @ E)

        M_0 = np.cross(q[:3], load.force) + load.moment
        assert difference(along(D_0, (q, v), (MODE.rates(t, q, v), a)), M_0) < 10 * EXACT


# The laws of momentum (2.22)–(2.28) in integral form, along motions of free pairs of bodies.

TIMES = samples(0.5, 32)
BARS = """\
scene:
  bodies: {one: {bar: {mass: 1.2, length: 0.8}}, two: {bar: {mass: 0.7, length: 0.5}}}
  joints: {elbow: {pin: [one.end, two.start]}}
initial:
  one: {x: 0, y: 1, angle: 20 deg, vx: 0.5, vy: 3, omega: 4}
  two: {angle: -70 deg, omega: -6}
allow: {one.x: 1.0e-2}
"""


def bars(case: Case) -> System:
    """Two pinned bars thrown into the air, generated from their scene."""
    generated = mechanism(case)
    motion = Answer(generated, follow(generated, TIMES)).trajectory(TIMES)
    bodies = {
        name: planar(m, m * l**2 / 12, motion.states[name])
        for name, m, l in (("one", 1.2, 0.8), ("two", 0.7, 0.5))
    }
    g = np.array([0.0, -9.80665, 0.0])
    weights = [Acting(b.r, np.tile(b.m * g, (len(TIMES), 1))) for b in bodies.values()]
    return System(TIMES, bodies, weights)


@cache
def in_space() -> System:
    """Two bodies and a spring, tumbling and falling."""
    return pair(TIMES, follow(FREE, TIMES).y)


@pytest.fixture(scope="module")
def in_the_plane(tmp_path_factory: pytest.TempPathFactory) -> System:
    path: Path = tmp_path_factory.mktemp("bars")
    return bars(typed(path, BARS))


@pytest.mark.parametrize("law", momenta.LAWS)
def test_a_pair_of_bars_obeys(law: Callable[[System], float], in_the_plane: System):
    assert law(in_the_plane) <= momenta.LIMIT


@pytest.mark.slow
@pytest.mark.parametrize("law", momenta.LAWS)
def test_two_bodies_in_space_obey(law: Callable[[System], float]):
    assert law(in_space()) <= momenta.LIMIT


@pytest.mark.slow
def test_each_body_changes_by_the_force_between_them():
    """What the laws leave out inside: alone, one of the pair obeys none of them."""
    s = in_space()
    alone = replace(s, bodies={"one": s.bodies["one"]}, forces=s.forces[:1])
    for law in momenta.LAWS:
        assert law(alone) > 1e-3


def absolute(s: System) -> float:
    """(2.28) with absolute velocities in D_A, which the printed text leaves open."""
    A = momenta.wandering(s.times)
    by = s.moment(A.r) + s.m * np.cross(A.a, s.centre - A.r)
    return s.law(s.D(A.r, 0.0), by)


def uncorrected(s: System) -> float:
    """Ḋ_A = M_A for a point that is not fixed."""
    A = momenta.wandering(s.times)
    return s.law(s.D(A.r, A.v), s.moment(A.r))


def about_the_origin_with_M_c(s: System) -> float:
    """Ḋ₀ = M_c."""
    return s.law(s.D(0.0, 0.0), s.moment(s.centre))


@pytest.mark.slow
@pytest.mark.mutant("{wrong}")
@pytest.mark.parametrize("wrong", [absolute, uncorrected, about_the_origin_with_M_c])
def test_another_law_does_not_hold(wrong: Callable[[System], float], in_the_plane: System):
    assert wrong(in_the_plane) > 1e-2
    assert wrong(in_space()) > 1e-2


@pytest.mark.slow
def test_the_point_must_move_as_its_acceleration_says(monkeypatch: pytest.MonkeyPatch):
    """A centre of mass, too, is a moving point: there M_A + m r̈_A × a = M_c."""
    s = in_space()
    force = np.sum([f.force for f in s.forces], axis=0)
    monkeypatch.setattr(momenta, "wandering", lambda times: Point(s.centre, s.p / s.m, force / s.m))
    assert momenta.about_a_moving_point(s) <= momenta.LIMIT


def factors_exchanged(M_A: Array, m: float, a_A: Array, a: Array) -> Array:
    """(2.28) with the factors of its last term exchanged."""
    return M_A + m * np.cross(a, a_A)


def spin_only(m: float, J: Array, r: Array, v: Array, omega: Array) -> Array:
    """(2.24) without the part of the centre."""
    return J @ omega


def steiner_only(m: float, J: Array, r: Array, v: Array, omega: Array) -> Array:
    """(2.24) without the body's own turning."""
    return np.cross(r, m * v)


@pytest.mark.mutant("{wrong}")
@pytest.mark.parametrize(
    ("name", "wrong", "law"),
    [
        ("moment_change", factors_exchanged, momenta.about_a_moving_point),
        ("angular_momentum", spin_only, momenta.about_the_origin),
        ("angular_momentum", steiner_only, momenta.about_the_origin),
        ("angular_momentum", steiner_only, momenta.about_the_centre),
    ],
)
def test_a_planted_mistake_is_seen(
    name: str,
    wrong: Callable[..., Array],
    law: Callable[[System], float],
    in_the_plane: System,
    monkeypatch: pytest.MonkeyPatch,
):
    assert getattr(momenta, name) is getattr(momentum, name)
    monkeypatch.setattr(momenta, name, wrong)
    for s in (in_the_plane, in_space()):
        assert law(s) > 1e-3


@pytest.mark.mutant("J ω in body axes added to moments in ground axes")
def test_spin_in_body_axes_is_seen():
    """J ω of body axes added to moments in ground axes."""
    s = in_space()
    turned = {
        name: replace(b, R=np.tile(np.eye(3), (len(TIMES), 1, 1))) for name, b in s.bodies.items()
    }
    assert momenta.about_the_centre(replace(s, bodies=turned)) > 1e-3
