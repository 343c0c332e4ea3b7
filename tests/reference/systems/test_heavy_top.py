"""The heavy top: its three ways to nutate, what stays, special motions, planted mistakes."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import spatial_laws as laws
from given.mutants import mutant
from given.spatial import SPATIAL, closed, example, only, states

from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, Only

m, l, A, C = (SPATIAL["heavy_top"][key] for key in ("m", "l", "A", "C"))
G = 9.80665
A_O = A + m * l * l


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
