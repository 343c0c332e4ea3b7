"""The torque-free body: what stays, where it is stable, and what a mistake in (2.33) does."""

import math
from typing import Any

import mpmath
import numpy as np
import pytest
from given import spatial_laws as laws
from given.mutants import mutant
from given.spatial import SPATIAL, closed, example, only, states

from textmech.reference.motion.follow import follow
from textmech.reference.system import Array
from textmech.reference.systems.tops.torque_free import Polhode

A, B, C = (SPATIAL["torque_free"][key] for key in "ABC")
STARTS = {
    "about axis 1": (3.0, 2.0, 1.0),
    "about axis 3": (-1.0, 2.0, 3.0),
    "near axis 1": (5.0, 0.05, 0.02),
    "near axis 2": (1e-6, 5.0, 3e-6),
    "near axis 3": (0.02, 0.05, -5.0),
}


def test_near_the_middle_axis_the_closed_form_keeps_what_the_followed_motion_loses():
    """Beside axis 2 a difference grows e^{λt}, λ = 2.04/s, and so do the integrator's.

    Until it has turned over once, in 7 s, all is well: what grows began small. On its way to the
    second turn the followed motion loses eleven digits. ω by the same functions to 40 digits shows
    that the closed form is right all the time.
    """
    w, times = STARTS["near axis 2"], np.linspace(0.0, 20.0, 26)
    system = example("torque_free", w1=w[0], w2=w[1], w3=w[2])
    known = np.array([closed(system, t)[1][3:] for t in times.tolist()])
    exact = np.array([jacobi(w, t) for t in times.tolist()])
    assert np.abs(known - exact).max() < 1e-14
    lost = np.abs(follow(system, times).y[:, 10:] - exact).max(1)
    assert lost[times < 8.0].max() < 5e-13
    assert 1e-6 < lost.max() < 1e-3


def jacobi(w: tuple[float, ...], t: float) -> list[float]:
    """ω about axis 3 by the formulas of Landau and Lifshitz as printed (there I₁ < I₂ < I₃)."""
    with mpmath.workdps(40):
        I1, I2, I3 = (mpmath.mpf(x) for x in (C, B, A))
        w3, w2, w1 = (mpmath.mpf(x) for x in w)
        E2 = I1 * w1**2 + I2 * w2**2 + I3 * w3**2
        M2 = (I1 * w1) ** 2 + (I2 * w2) ** 2 + (I3 * w3) ** 2
        swapped = M2 < E2 * I2
        if swapped:
            I1, I3, w1, w3 = I3, I1, w3, w1
        rate = mpmath.sqrt((I3 - I2) * (M2 - E2 * I1) / (I1 * I2 * I3))
        m = (I2 - I1) * (E2 * I3 - M2) / ((I3 - I2) * (M2 - E2 * I1))
        a = mpmath.sqrt((E2 * I3 - M2) / (I1 * (I3 - I1)))
        b = mpmath.sqrt((E2 * I3 - M2) / (I2 * (I3 - I2)))
        c = mpmath.sqrt((M2 - E2 * I1) / (I3 * (I3 - I1)))
        # Their axes are (3, 2, 1) of ours, a left-handed order: time runs the other way.
        sense = -1
        phase = mpmath.ellipf(mpmath.atan2(sense * w2 / b, w1 / a), m)
        u = rate * mpmath.mpf(t) + phase
        sn, cn, dn = (mpmath.ellipfun(f, u, m=m) for f in ("sn", "cn", "dn"))
        found = [c * dn, sense * b * sn, a * cn]
        return [float(x) for x in (found[::-1] if swapped else found)]


@pytest.mark.parametrize(("part", "about_first"), [(1.001, True), (0.999, False)])
def test_either_side_of_the_separatrix(part: float, about_first: bool):
    """A (A − B) ω₁² = C (B − C) ω₃² divides motions about axis 1 from those about axis 3.

    Its closed form holds beside it too, where the followed motion has lost a digit or two.
    """
    w1 = part * math.sqrt(C * (B - C) / (A * (A - B)))
    solution = Polhode.of((A, B, C), (w1, 2.0, 1.0), (0.0, 0.0, 0.0))
    assert solution is not None
    assert solution.about_first == about_first
    system = example("torque_free", w1=w1, w2=2.0, w3=1.0)
    times = np.linspace(0.0, 6.0, 13)
    known = np.array([np.concatenate(closed(system, t)) for t in times.tolist()])
    np.testing.assert_allclose(follow(system, times).y, known, rtol=0.0, atol=1e-10)


def test_a_turn_about_a_principal_axis_lasts():
    """Also exactly about axis 1 or 3; about axis 2 there is no closed form to give."""
    for w in ((4.0, 0.0, 0.0), (0.0, 0.0, -4.0)):
        system = example("torque_free", w1=w[0], w2=w[1], w3=w[2], psi0=0.0, theta0=0.0, phi0=0.0)
        q, v = closed(system, 1.3)
        half = 4.0 * 1.3 / 2
        np.testing.assert_allclose(v[3:], w, rtol=1e-15)
        turned = [math.cos(half), *(math.sin(half) * np.sign(w))]
        np.testing.assert_allclose(q[3:], turned, atol=2e-15)
    assert example("torque_free", w1=0.0, w2=4.0, w3=0.0).closed_form(1.0) is None


def test_the_length_of_the_quaternion_has_no_meaning():
    """Not for the poses, T, nor v̇: what puts |e| right changes no energy. T of ė alone would."""
    mode = only("torque_free")
    for t, q, v in states("torque_free", 5):
        longer = np.concatenate([q[:3], 1.01 * q[3:]])
        np.testing.assert_allclose(
            mode.poses(t, longer, v)["body"], mode.poses(t, q, v)["body"], atol=1e-14
        )
        kinetic = [mode.T(t, x, mode.rates(t, x, v)) for x in (q, longer)]
        assert kinetic[1] == pytest.approx(kinetic[0], rel=1e-14)
        assert mode.T(t, q, 1.01 * mode.rates(t, q, v)) != pytest.approx(kinetic[0], rel=1e-3)
        np.testing.assert_array_equal(mode.accelerations(t, longer, v), mode.accelerations(t, q, v))


def as_printed(self: Any, t: float, q: Array, v: Array) -> Array:
    """(2.33) with the minus sign before J₁ⱼ ωⱼ ω₃ of its second component (erratum 1)."""
    w1, w2, w3 = v[3:]
    gyro = np.cross(v[3:], [A * w1, B * w2, C * w3]) - [0.0, 2 * A * w1 * w3, 0.0]
    return np.array([0.0, 0.0, -self.gravity, *(-gyro / [A, B, C])])


def gyroscopic_term_lost(self: Any, t: float, q: Array, v: Array) -> Array:
    """J ω̇ = M_c in body axes."""
    return np.array([0.0, 0.0, -self.gravity, 0.0, 0.0, 0.0])


def other_sign(self: Any, t: float, q: Array, v: Array) -> Array:
    """J ω̇ = ω × J ω: energy stays, momentum does not."""
    w1, w2, w3 = v[3:]
    gyro = np.cross(v[3:], [A * w1, B * w2, C * w3])
    return np.array([0.0, 0.0, -self.gravity, *(gyro / [A, B, C])])


def turned_by_ground_axes(self: Any, t: Any, q: Any, v: Any) -> Any:
    """ė = ½ (0, ω) ∘ e: right for ω in ground axes."""
    w, x, y, z = q[3:]
    w1, w2, w3 = v[3:]
    e_dot = [
        -x * w1 - y * w2 - z * w3, w * w1 + z * w2 - y * w3,
        w * w2 + x * w3 - z * w1, w * w3 + y * w1 - x * w2,
    ]  # fmt: skip
    return np.concatenate([v[:3], np.array(e_dot) / 2])


@pytest.mark.mutant("torque-free body: {mistake}")
@pytest.mark.parametrize(
    ("mistake", "law"),
    [
        ({"accelerations": as_printed}, laws.energy),
        ({"accelerations": as_printed}, laws.free_bodies),
        ({"accelerations": gyroscopic_term_lost}, laws.free_bodies),
        ({"accelerations": gyroscopic_term_lost}, laws.lagrangian("torque_free")),
        ({"accelerations": other_sign}, laws.free_bodies),
        ({"accelerations": other_sign}, laws.lagrangian("torque_free")),
        ({"rates": turned_by_ground_axes}, laws.rates_of_poses),
        ({"rates": turned_by_ground_axes}, laws.koenig),
    ],
)
def test_a_planted_mistake_is_seen(mistake: dict[str, Any], law: laws.Law):
    sound = only("torque_free")
    assert not laws.broken(law(sound, states("torque_free", 10)))
    assert laws.broken(law(mutant(sound, **mistake), states("torque_free", 10)))
