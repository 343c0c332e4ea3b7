"""The heavy top: its three ways to nutate, what stays, special motions, planted mistakes."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import spatial_laws as laws
from given.mutants import mutant
from given.spatial import SPATIAL, closed, example, only, states, variant

from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, Only, System
from textmech.reference.systems.elliptic import Amplitude, first
from textmech.reference.systems.tops.heavy_top import Nutation

m, l, A, C = (SPATIAL["heavy_top"][key] for key in ("m", "l", "A", "C"))
G = 9.80665
A_O = A + m * l * l


def precession(system: System, times: Array) -> Array:
    """ψ̇ (N,) [rad/s] by the closed form."""
    return np.array([closed(system, t)[1][0] for t in times.tolist()])


@pytest.mark.parametrize(
    ("name", "way"), [("cusp", 0), ("loops", -1), ("waves", None), ("falls deep", 1)]
)
def test_ways_to_nutate(name: str, way: int | None):
    """ψ̇ where the top is highest: zero (a cusp), backward (a loop), forward (a wave).

    The top of `waves` spins the other way round, and its precession with it.
    """
    psi_dot = precession(variant(name), np.linspace(0.0, 0.4, 801))
    if way is None:
        assert psi_dot.max() < 0.0
    elif way == 0:
        assert 0.0 <= psi_dot.min() < 1e-3 * psi_dot.max()
    else:
        assert np.sign(psi_dot.min()) == way


def test_cusps_come_back_to_rest():
    """Released without precession, it stands still again after each nutation, as high as before."""
    system, theta0 = variant("cusp"), math.radians(40)
    nutation = Nutation.of(A_O, C, m * G * l, theta0, (0.0, 0.0, 200.0))
    assert nutation is not None
    period = first(Amplitude(0.0, -1.0), nutation.k1) / nutation.rate  # 2 K/λ
    assert period == pytest.approx(2 * math.pi * A_O / (C * 200.0), rel=0.05)  # of a fast top
    for k in (1, 2, 5):
        q, v = closed(system, k * period)
        np.testing.assert_allclose([q[1], v[0], v[1]], [theta0, 0.0, 0.0], atol=1e-11)
        q, v = closed(system, (k - 0.5) * period)
        assert (q[1] > theta0 + 0.03, abs(v[1]) < 1e-11) == (True, True)


@pytest.mark.parametrize("name", ["cusp", "loops", "waves", "falls deep"])
def test_momenta_and_energy_stay(name: str):
    """D_z and D₃ (2.27) and the energy: to 1e-13 of their sizes over 1 s; attitudes are continuous.

    Without a jump of the sign, which means the same attitude.
    """
    system = variant(name)
    mode = system.modes["moving"]
    found = follow(system, np.linspace(0.0, 1.0, 41)).y
    kept = []
    for y in found:
        q, v = mode.parted(y)
        pose = mode.poses(0.0, q, v)["top"]
        D = mode.masses["top"].J @ np.array(pose[10:])
        D_O = laws.matrix(pose[3:7]) @ D + m * np.cross(pose[:3], pose[7:10])
        kept.append([D_O[2], D[2], mode.T(0.0, q, v) + mode.U(0.0, q)])
    change = np.abs(np.array(kept) - kept[0]).max(0)
    assert np.all(change <= 1e-13 * np.abs(kept[0]))
    fine = [mode.poses(0.0, *closed(system, t)) for t in np.linspace(0.0, 0.1, 201).tolist()]
    e = np.array([pose["top"][3:7] for pose in fine])
    assert (e[1:] * e[:-1]).sum(1).min() > 0.99


@pytest.mark.parametrize("fast", [False, True])
def test_steady_precession(fast: bool):
    """A_O ψ̇² cos θ − C ω₃ ψ̇ + m g l = 0: both roots keep θ, and the tip carries m g and m r ψ̇²."""
    theta, w3 = math.radians(40), 150.0
    half, root = C * w3, math.sqrt((C * w3) ** 2 - 4 * A_O * math.cos(theta) * m * G * l)
    psi_dot = (half + root) / (2 * A_O * math.cos(theta)) if fast else 2 * m * G * l / (half + root)
    system = example("heavy_top", theta0=theta, w1=0.0, w2=psi_dot * math.sin(theta), w3=w3)
    mode = system.modes["moving"]
    for t in (0.0, 0.7, 2.0):
        q, v = closed(system, t)
        np.testing.assert_allclose(q[:2], [psi_dot * t, theta], rtol=2e-13, atol=1e-15)
        forces = mode.reactions(t, np.asarray(q), np.asarray(v))
        r = l * math.sin(theta)
        inward = [-math.sin(q[0]), math.cos(q[0])]
        np.testing.assert_allclose(
            [forces["pivot.fx"], forces["pivot.fy"]],
            m * r * psi_dot**2 * np.array(inward), atol=1e-12 * m * r * psi_dot**2,
        )  # fmt: skip
        assert forces["pivot.fz"] == pytest.approx(m * G, rel=1e-13)


def test_without_spin_it_is_a_pendulum():
    """ω₂ = ω₃ = 0: it falls in a plane, A_O θ̇² / 2 = m g l (cos θ₀ − cos θ), and ψ stays."""
    theta0 = math.radians(40)
    system = example("heavy_top", theta0=theta0, w1=0.0, w2=0.0, w3=0.0)
    for t in (0.05, 0.2, 0.31):
        q, v = closed(system, t)
        speed = math.sqrt(2 * m * G * l * (math.cos(theta0) - math.cos(q[1])) / A_O)
        assert abs(v[1]) == pytest.approx(speed, rel=1e-12)
        assert (q[0], v[0]) == (0.0, 0.0)


def test_what_has_no_answer():
    """Upright or hanging, ψ and φ are not told apart."""
    for theta0 in (0.0, math.pi, -0.1):
        with pytest.raises(ValueError, match="0 < theta0 < π"):
            example("heavy_top", theta0=theta0)
    with pytest.raises(ValueError, match="l > 0"):
        example("heavy_top", l=-0.05)


def without_steiner(self: Any) -> float:
    """A_O without its Steiner term."""
    return self.A


def gyroscopic_term_lost(self: Any, t: float, q: Array, v: Array) -> Array:
    """C ω₃ left out, as if it did not spin."""
    return replace(only("heavy_top"), C=1e-30).accelerations(t, q, v)  # type: ignore[type-var]


def spin_without_precession(self: Any, t: Any, q: Any, v: Any) -> Any:
    """T with φ̇ in place of φ̇ + ψ̇ cos θ."""
    return (A_O * (v[1] ** 2 + (v[0] * np.sin(q[1])) ** 2) + C * v[2] ** 2) / 2


def attitude_of_another_order(self: Any, t: Any, q: Any, v: Any) -> Any:
    """φ first and ψ last."""
    sound: Any = only("heavy_top")
    pose = sound.poses(t, q, v)["top"]
    return {"top": (*pose[:5], -pose[5], *pose[6:])}


@pytest.mark.mutant("heavy top: {mistake}")
@pytest.mark.parametrize(
    ("mistake", "law"),
    [
        ({"accelerations": gyroscopic_term_lost}, laws.lagrangian("heavy_top")),
        ({"accelerations": gyroscopic_term_lost}, laws.free_bodies),
        ({"T": spin_without_precession}, laws.koenig),
        ({"T": spin_without_precession}, laws.lagrangian("heavy_top")),
        ({"poses": attitude_of_another_order}, laws.rates_of_poses),
        ({"poses": attitude_of_another_order}, laws.free_bodies),
        ({"_A_O": without_steiner}, laws.koenig),
        ({"_A_O": without_steiner}, laws.free_bodies),
    ],
)
def test_a_planted_mistake_is_seen(mistake: dict[str, Any], law: laws.Law):
    sound = only("heavy_top")
    assert not laws.broken(law(sound, states("heavy_top", 10)))
    assert laws.broken(law(mutant(sound, **mistake), states("heavy_top", 10)))


@pytest.mark.mutant("heavy top: A_O without its Steiner term")
def test_a_missing_steiner_term_leaves_the_closed_form():
    sound = only("heavy_top")
    lonely = mutant(sound, _A_O=without_steiner)
    times = np.linspace(0.0, 0.5, 6)
    known = np.array([np.concatenate(closed(Only(sound), t)) for t in times.tolist()])
    assert np.abs(follow(Only(sound), times).y - known).max() < 1e-10
    assert np.abs(follow(Only(lonely), times).y - known).max() > 1.0
