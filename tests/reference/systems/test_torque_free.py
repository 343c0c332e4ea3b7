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
from textmech.reference.system import Array, Mode
from textmech.reference.systems.tops.torque_free import Polhode

A, B, C = (SPATIAL["torque_free"][key] for key in "ABC")
STARTS = {
    "about axis 1": (3.0, 2.0, 1.0),
    "about axis 3": (-1.0, 2.0, 3.0),
    "near axis 1": (5.0, 0.05, 0.02),
    "near axis 2": (1e-6, 5.0, 3e-6),
    "near axis 3": (0.02, 0.05, -5.0),
}


def momentum(mode: Mode, q: Array, v: Array) -> Array:
    """(2.29) D_c = J ω in ground axes, (3,), and twice the energy of the turning."""
    pose = mode.poses(0.0, q, v)["body"]
    D = mode.masses["body"].J @ v[3:]
    return np.array([*(laws.matrix(pose[3:7]) @ D), D @ v[3:]])


@pytest.mark.parametrize("start", STARTS)
def test_momentum_energy_and_length_stay(start: str):
    """D in ground axes, energy, |e| over 10 s; of a pose |e| is 1 whatever that of the state is.

    To 1e-12 and 1e-13 in the followed motion, which drifts by 1e-14 a second; to rounding in the
    closed form.
    """
    system = example("torque_free", **dict(zip(("w1", "w2", "w3"), STARTS[start], strict=True)))
    mode, times = system.modes["moving"], np.linspace(0.0, 10.0, 21)
    known = [closed(system, t) for t in times.tolist()]
    followed = [mode.parted(y) for y in follow(system, times).y]
    for rows, margin, length in (
        (followed, 1e-12, 1e-13),
        (known, 2e-14, 2e-15),
    ):
        kept = np.array([momentum(mode, q, v) for q, v in rows])
        D, E2 = kept[:, :3], kept[:, 3]
        assert np.abs(D - D[0]).max() <= margin * np.linalg.norm(D[0])
        assert np.abs(E2 - E2[0]).max() <= margin * E2[0]
        assert max(abs(float(np.linalg.norm(q[3:])) - 1.0) for q, _ in rows) <= length
        poses = [mode.poses(0.0, q, v)["body"][3:7] for q, v in rows]
        assert max(abs(float(np.linalg.norm(e)) - 1.0) for e in poses) <= 4e-16


@pytest.mark.parametrize("start", STARTS)
def test_the_closed_form_obeys_the_equations(start: str):
    """Its slope is (q̇, v̇), by differences extrapolated twice: 1e-10 is what these leave."""
    system = example("torque_free", **dict(zip(("w1", "w2", "w3"), STARTS[start], strict=True)))
    mode, h = system.modes["moving"], 2e-3

    def at(t: float) -> Array:
        return np.concatenate(closed(system, t))

    for t in (0.1, 1.7, 3.3, 6.1):
        d = [(at(t + s) - at(t - s)) / (2 * s) for s in (h, h / 2, h / 4)]
        e = [(4 * d[1] - d[0]) / 3, (4 * d[2] - d[1]) / 3]
        q, v = mode.parted(at(t))
        slope = [*mode.rates(t, q, v), *mode.accelerations(t, q, v)]
        assert laws.difference((16 * e[1] - e[0]) / 15, slope) < 1e-10


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


@pytest.mark.parametrize(("axis", "small"), [(0, (1, 2)), (2, (0, 1))])
def test_small_motions_about_the_stable_axes(axis: int, small: tuple[int, int]):
    """λ² → ω² (I − I′)(I − I″)/(I′ I″) about axes 1 and 3."""
    moments, w = (A, B, C), [1e-6, 1e-6, 1e-6]
    w[axis] = 5.0
    I, one, two = moments[axis], moments[small[0]], moments[small[1]]
    known = 5.0 * math.sqrt((I - one) * (I - two) / (one * two))
    solution = Polhode.of(moments, (w[0], w[1], w[2]), (0.0, 0.0, 0.0))
    assert solution is not None
    assert solution.rate == pytest.approx(known, rel=1e-11)
    assert 1 - solution.k1 < 1e-12


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


@pytest.mark.parametrize(
    ("changed", "words"), [({"A": 0.05}, "A > B > C"), ({"A": 0.11}, "sum of the other two")]
)
def test_a_tensor_that_no_body_has_is_refused(changed: dict[str, float], words: str):
    with pytest.raises(ValueError, match=words):
        example("torque_free", **changed)
