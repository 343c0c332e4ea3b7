"""The disk that rolls and tilts: where it is stable, what stays, special motions, mistakes."""

import math
from typing import Any

import numpy as np
import pytest
from given import spatial_laws as laws
from given.mutants import mutant
from given.spatial import example, only, states, steady, variant
from scipy.integrate import solve_ivp

from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, System
from textmech.reference.systems.rolling import tilting_ring
from textmech.reference.systems.rolling.tilting_ring import TiltingRing

m, R, G = 1.3, 0.25, 9.80665


def test_moments_of_a_disk_and_of_a_ring():
    """Exercise 2.2: m R²/4 about a diameter, m R²/2 about the axle, which is axis 2 of the body."""
    known = m * R * R * np.diag([0.25, 0.5, 0.25])
    np.testing.assert_allclose(only("tilting_disk").masses["disk"].J, known, rtol=1e-15)
    ring = only("tilting_ring").masses["disk"].J
    np.testing.assert_array_equal(ring, np.diag([0.03, 0.07, 0.03]))


@pytest.mark.parametrize("moments", [None, (0.03, 0.07)])
@pytest.mark.parametrize(("part", "stable"), [(0.95, False), (1.05, True)])
def test_limit_of_upright_rolling(moments: tuple[float, float] | None, part: float, stable: bool):
    """It stays upright if ω² > m g R A/(C (C + m R²)); a disk, if ω² > g/(3 R).

    Of a small tilt (A + m R²) β̈ = (m g R − (C + m R²) C/A ω²) β where A ω₃ = −C ω β: it grows, or
    swings, at this rate.
    """
    A, C = moments or (m * R * R / 4, m * R * R / 2)
    limit = math.sqrt(m * G * R * A / (C * (C + m * R * R)))
    if moments is None:
        assert limit == pytest.approx(math.sqrt(G / (3 * R)), rel=1e-14)
    omega, tilt = part * limit, 1e-6
    start = {"beta0": tilt, "w1": 0.0, "w2": omega, "w3": -C / A * omega * tilt}
    more = {"A": A, "C": C} if moments else {}
    system = example("tilting_ring" if moments else "tilting_disk", **start, **more)
    times = np.linspace(0.0, 4.0, 41)
    beta = follow(system, times).y[:, 3]
    stiff = ((C + m * R * R) * C / A * omega**2 - m * G * R) / (A + m * R * R)
    rate = math.sqrt(abs(stiff))
    known = tilt * (np.cos(rate * times) if stable else np.cosh(rate * times))
    assert (stiff > 0) == stable
    left_out = 10 * np.abs(known).max() ** 3  # of the third order: sin, tan and cos of a tilt
    np.testing.assert_allclose(beta, known, rtol=0.0, atol=left_out + 1e-9 * tilt)


def test_steady_circle():
    """The floor carries m g and turns the centre: side force m r Ω², nothing along the track."""
    system = variant("steady circle")
    mode, (_, q, v) = system.modes["moving"], system.start()
    beta, turn = math.radians(20), -1.2 / math.cos(math.radians(20))
    roll = v[3] - v[4] * math.tan(beta)
    centre = R * roll / turn + R * math.sin(beta)  # of a circle to the right, seen from its left
    forces = mode.reactions(0.0, q, v)
    assert forces["touch.normal"] == pytest.approx(m * G, rel=1e-14)
    assert forces["touch.fx"] == pytest.approx(0.0, abs=1e-14 * m * G)
    assert forces["touch.fy"] == pytest.approx(m * centre * turn**2, rel=1e-13)
    assert centre < 0.0
    assert forces["touch.fy"] < 0.0


def test_other_motions_have_no_closed_form():
    """Nor a circle whose ω₂ is off by 1e-12, to either side."""
    assert example("tilting_disk").closed_form(1.0) is None
    near = {"w1": 0.0, "w2": (1 + 1e-12) * steady(20.0, -1.2), "w3": -1.2}
    assert example("tilting_disk", **near, beta0=math.radians(20)).closed_form(1.0) is None


@pytest.mark.parametrize("degrees", [*range(5, 86, 5)])
def test_every_steady_circle_has_one(degrees: int):
    """Whatever its tilt: the moments cancel but for rounding, which is of their size."""
    for turn in (-0.3, -1.2, 2.7, 19.0):
        spin = {"w1": 0.0, "w2": steady(degrees, turn), "w3": turn}
        known = example("tilting_disk", **spin, beta0=math.radians(degrees)).closed_form(1.0)
        assert known is not None, turn


@pytest.mark.mutant("moments of a steady circle that cancel exactly, or not at all")
def test_a_circle_that_rounding_takes_away_is_seen(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(tilting_ring, "STEADY", 0.0)
    lost = 0
    for degrees in range(5, 86, 5):
        try:
            test_every_steady_circle_has_one(degrees)
        except AssertionError:
            lost += 1
    assert lost > 3


MOTIONS: dict[str, dict[str, float]] = {  # start, and how long it is followed
    "disturbed circle": {"beta0": 20.0, "w1": 0.3, "w2": steady(20.0, -1.2), "w3": -1.2},
    "slow, falls": {"beta0": 2.0, "w1": 0.0, "w2": 2.2, "w3": 0.0},
    "near-flat spin": {"beta0": 80.0, "w1": 0.0, "w2": -0.5, "w3": 5.0},
}


def motion(name: str) -> System:
    start = MOTIONS[name]
    return example("tilting_disk", **{**start, "beta0": math.radians(start["beta0"])})


@pytest.mark.parametrize("name", MOTIONS)
def test_spins_follow_the_tilt(name: str):
    """ω₂ and ω₃ are functions of β (Appell): linear equations, solved by another integrator in β.

    (C + m R²) dω₂/dβ = −m R² ω₃, A dω₃/dβ = A ω₃ tan β − C ω₂; 1e-11 is what that one has.
    """
    system, A, C = motion(name), m * R * R / 4, m * R * R / 2

    def slope(beta: float, w: Array) -> list[float]:
        return [-m * R * R * w[1] / (C + m * R * R), w[1] * math.tan(beta) - C / A * w[0]]

    y = follow(system, np.linspace(0.0, 2.0, 21)).y
    for row in y[1:]:
        span = (y[0, 3], row[3])
        w = solve_ivp(slope, span, y[0, 8:], "DOP853", rtol=1e-13, atol=1e-13).y[:, -1]
        np.testing.assert_allclose(row[8:], w, atol=1e-11 * np.abs(y[:, 8:]).max())


def changed(**terms: float) -> Any:
    """Accelerations with some terms of (2.33) taken `terms` times."""

    def accelerations(self: TiltingRing, t: float, q: Array, v: Array) -> Array:
        a = TiltingRing.accelerations(self, t, q, v)
        _, _, w1, w2, w3 = v
        square, tan = self.m * self.R**2, math.tan(q[3])
        a[2] += (terms.get("gyro", 1.0) - 1) * self.C * w2 * w3 / (self.A + square)
        a[2] -= (terms.get("turning", 1.0) - 1) * self.A * w3 * w3 * tan / (self.A + square)
        a[4] += (terms.get("axes", 1.0) - 1) * w3 * tan * w1
        return a

    told = [f"the {name} term of (2.33) taken {times:g} times" for name, times in terms.items()]
    accelerations.__doc__ = ", ".join(told)
    return accelerations


def centre_slips_not(self: TiltingRing, t: Any, q: Any) -> Any:
    """The centre's speed in place of the touching point's: ẋ_c = R φ̇ cos θ."""
    rows = np.array(TiltingRing.f_a(self, t, q))
    rows[0, 4] += self.R * np.sin(q[3]) * np.cos(q[2]) / np.cos(q[3])
    return rows


@pytest.mark.mutant("tilting ring: {mistake}")
@pytest.mark.parametrize(
    ("mistake", "law"),
    [
        ({"accelerations": changed(gyro=0.0)}, laws.lagrangian("tilting_ring")),
        ({"accelerations": changed(gyro=0.0)}, laws.free_bodies),
        ({"accelerations": changed(gyro=-1.0)}, laws.energy),
        ({"accelerations": changed(turning=0.0)}, laws.lagrangian("tilting_ring")),
        ({"accelerations": changed(turning=0.0)}, laws.energy),
        ({"accelerations": changed(axes=0.0)}, laws.free_bodies),
        ({"f_a": centre_slips_not}, laws.rolling),
    ],
)
def test_a_planted_mistake_is_seen(mistake: dict[str, Any], law: laws.Law):
    sound = only("tilting_ring")
    assert not laws.broken(law(sound, states("tilting_ring", 10)))
    assert laws.broken(law(mutant(sound, **mistake), states("tilting_ring", 10)))
