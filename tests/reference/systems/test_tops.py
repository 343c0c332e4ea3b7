"""Tops, a body that nothing turns, a gimbal: special motions, what stays, planted mistakes."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import mpmath
import numpy as np
import pytest
from given.laws import LIMIT, cut_bodies, difference
from given.laws import spatial_laws as laws
from given.machines.gimbals import GIMBAL, VARIANTS, gimbal
from given.machines.gimbals import states as states_gimbal
from given.machines.spatial import SPATIAL, closed, example, only, states
from given.mutants import in_ground_axes, mutant, sound

from textmech.reference.formalisms import energy, lagrange
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, Mode, Only
from textmech.reference.systems.bodies.torque_free import Polhode
from textmech.reference.systems.elliptic import Amplitude, amplitude, first, third

# Elliptic functions and integrals of the closed forms, by another library with more digits.

K1 = (1.0, 0.8, 0.1, 1e-3, 1e-7)  # from circles to the neighbourhood of the separatrix
ANGLES = (-3.1, -math.pi / 2, -0.4, 0.0, 1e-9, 1.2, math.pi / 2, 2.5, math.pi)
COUNTED = [*((angle, 0) for angle in ANGLES), (0.7, 2), (-2.0, -3)]


@pytest.mark.parametrize("k1", K1)
def test_integrals_of_the_first_and_third_kind(k1: float):
    """F, and (Π − F)/n, counted over turns; p = 1 − n on both sides of 1."""
    with mpmath.workdps(30):
        m = 1 - mpmath.mpf(k1) ** 2
        for phi, turns in COUNTED:
            am = Amplitude(math.sin(phi), math.cos(phi), turns)
            whole = mpmath.mpf(phi) + 2 * mpmath.pi * turns
            F = mpmath.ellipf(whole, m)
            assert first(am, k1) == pytest.approx(float(F), rel=5e-15, abs=1e-300)
            for p in (0.03, 2.5):
                n = 1 - mpmath.mpf(p)
                known = (mpmath.ellippi(n, whole, m) - F) / n
                assert third(am, k1, p) == pytest.approx(float(known), rel=2e-14, abs=1e-35)


@pytest.mark.parametrize("k1", K1)
@pytest.mark.parametrize("u", [-40.0, -1.3, 0.0, 0.2, 7.0, 55.0])
def test_the_amplitude_is_the_inverse_of_the_first_integral(u: float, k1: float):
    """F(am u) = u, also where the angle is so near 90° that its own digits do not tell."""
    am = amplitude(u, k1)
    assert am.sin**2 + am.cos**2 == pytest.approx(1.0, abs=5e-16)
    assert first(am, k1) == pytest.approx(u, rel=1e-14, abs=1e-15)


@pytest.mark.parametrize("k1", K1[:-1])
def test_jacobi_functions_keep_their_digits(k1: float):
    """sn and cn to 1e-14 of themselves, also a cn of 1e-3 beside a quarter of the period."""
    with mpmath.workdps(30):
        m = 1 - mpmath.mpf(k1) ** 2
        K = mpmath.ellipk(m)
        for part in (0.1, 0.5, 0.9, 1.2, -1.7):
            u = float(part * K)
            sn, cn = (mpmath.ellipfun(f, mpmath.mpf(u), m=m) for f in ("sn", "cn"))
            am = amplitude(u, k1)
            assert (am.sin, am.cos) == pytest.approx((float(sn), float(cn)), rel=1e-14)


def test_turns_are_counted():
    """A circle: am(u) = u."""
    assert amplitude(20.0, 1.0) == pytest.approx((math.sin(20.0), math.cos(20.0), 3), abs=1e-14)


# The heavy top: its three ways to nutate, what stays, special motions, planted mistakes.

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
def test_a_planted_mistake_in_the_top_is_seen(mistake: dict[str, Any], law: laws.Law):
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


# The torque-free body: what stays, where it is stable, and what a mistake in (2.33) does.

FREE_A, B, FREE_C = (SPATIAL["torque_free"][key] for key in "ABC")


@pytest.mark.parametrize(("part", "about_first"), [(1.001, True), (0.999, False)])
def test_either_side_of_the_separatrix(part: float, about_first: bool):
    """A (A − B) ω₁² = C (B − C) ω₃² divides motions about axis 1 from those about axis 3.

    Its closed form holds beside it too, where the followed motion has lost a digit or two.
    """
    w1 = part * math.sqrt(FREE_C * (B - FREE_C) / (FREE_A * (FREE_A - B)))
    solution = Polhode.starting((FREE_A, B, FREE_C), (w1, 2.0, 1.0), (0.0, 0.0, 0.0))
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
    gyro = np.cross(v[3:], [FREE_A * w1, B * w2, FREE_C * w3]) - [0.0, 2 * FREE_A * w1 * w3, 0.0]
    return np.array([0.0, 0.0, -self.gravity, *(-gyro / [FREE_A, B, FREE_C])])


def gyroscopic_term_of_the_body_lost(self: Any, t: float, q: Array, v: Array) -> Array:
    """J ω̇ = M_c in body axes."""
    return np.array([0.0, 0.0, -self.gravity, 0.0, 0.0, 0.0])


def other_sign(self: Any, t: float, q: Array, v: Array) -> Array:
    """J ω̇ = ω × J ω: energy stays, momentum does not."""
    w1, w2, w3 = v[3:]
    gyro = np.cross(v[3:], [FREE_A * w1, B * w2, FREE_C * w3])
    return np.array([0.0, 0.0, -self.gravity, *(gyro / [FREE_A, B, FREE_C])])


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
        ({"accelerations": gyroscopic_term_of_the_body_lost}, laws.free_bodies),
        ({"accelerations": gyroscopic_term_of_the_body_lost}, laws.lagrangian("torque_free")),
        ({"accelerations": other_sign}, laws.free_bodies),
        ({"accelerations": other_sign}, laws.lagrangian("torque_free")),
        ({"rates": turned_by_ground_axes}, laws.rates_of_poses),
        ({"rates": turned_by_ground_axes}, laws.koenig),
    ],
)
def test_a_planted_mistake_in_the_free_body_is_seen(mistake: dict[str, Any], law: laws.Law):
    sound = only("torque_free")
    assert not laws.broken(law(sound, states("torque_free", 10)))
    assert laws.broken(law(mutant(sound, **mistake), states("torque_free", 10)))


# The sprung gimbal: second derivations, its closed form, and planted mistakes.


def equations(mode: Mode) -> float:
    """(2.44) of T, U, D and Q₄."""
    return max(
        difference(mode.accelerations(t, q, v), lagrange.accelerations(mode, t, q, v))
        for t, q, v in states_gimbal()
    )


def power(mode: Mode) -> float:
    """(2.51) relative to what the motor, the springs and the dampers could do."""
    return max(abs(energy.power_balance(mode, t, q, v)) for t, q, v in states_gimbal()) / 30.0


def cut_free(mode: Mode) -> float:
    """Its loads and cuts balance, and have the moment that it states: torques and a couple."""
    worst = 0.0
    for t, q, v in states_gimbal():
        left, found = cut_bodies.solved(mode, t, q, v, mode.accelerations(t, q, v))
        held = mode.reactions(t, q, v)
        ((across,), (load,)) = mode.cuts(t, q)[0].moments, mode.loads(t, q, v)
        moment = np.asarray(load.moment) + found["gimbal.couple"] * np.array(across)
        own = cut_bodies.force(held, "gimbal", "mx my mz")
        worst = max(
            worst, left, difference(moment, own), abs(found["gimbal.fz"] - held["gimbal.fz"])
        )
    return worst


def moves(mode: Mode) -> float:
    """`poses` moves as it says, and has the energy T."""
    return cut_bodies.moves(mode, states_gimbal())


def apart(mode: Mode) -> float:
    """Followed motion against the closed form, relative to the largest angle and rate."""
    times = np.linspace(0.0, 2.0, 21)
    y = follow(Only(mode), times).y
    known = np.array([np.concatenate(mode.closed_form(t) or ()) for t in times.tolist()])
    return max(difference(y[:, :2], known[:, :2]), difference(y[:, 2:], known[:, 2:]))


def start(mode: Mode) -> float:
    """How far the start is from the typed one: two turns, and ω in body axes."""
    q, v = mode.start()
    pose = mode.poses(0.0, q, v)["globe"]
    c20, s20, c15, s15 = (f(math.radians(a)) for a in (20, 15) for f in (math.cos, math.sin))
    attitude = [c20 * c15 + 0.8 * s20 * s15, -0.6 * c20 * s15, -0.6 * s20 * s15,
                s20 * c15 - 0.8 * c20 * s15]  # fmt: skip
    spin = np.array(pose[10:]) @ [0.6, 0.0, 0.8]  # along n₂: κ θ̇ + φ̇
    typed = [*np.radians([40, -30]), 0.7, -1.0, *attitude, 0.8 * 0.7 - 1.0]
    return float(np.max(np.abs(np.array([*q, *v, *pose[3:7], spin]) - typed)))


LAWS: list[Callable[[Any], float]] = [equations, power, cut_free, moves, apart, start]


@pytest.mark.parametrize("law", LAWS, ids=lambda law: law.__name__)
def test_gimbal_obeys(law: Callable[[Mode], float]) -> None:
    assert law(gimbal()) < LIMIT


@pytest.mark.slow
@pytest.mark.parametrize("name", VARIANTS)
def test_motion_is_the_closed_form(name: str) -> None:
    assert apart(gimbal(**VARIANTS[name])) < LIMIT


def of_crossed_axes(self: Any, t: float, q: Any, v: Any) -> Any:
    """As if κ were zero."""
    one, two = self._torques(t, q, v)
    return np.array([one / self.J, two / self.J])


def without_turning(self: Any, t: float, q: Any, v: Any) -> Any:
    """Without θ̇ φ̇ n₁ × n₂."""
    held, n2 = sound(self, "reactions")(t, q, v), self._second(q)
    lost = self.J * v[0] * v[1]
    return held | {
        "gimbal.mx": held["gimbal.mx"] + lost * n2[1],
        "gimbal.my": held["gimbal.my"] - lost * n2[0],
    }


def backward(self: Any, t: Any, q: Any, v: Any) -> Any:
    """φ about −n₂."""
    turned = np.array([1.0, -1.0])
    return sound(self, "poses")(t, q * turned, v * turned)


def each_about_its_axis(self: Any, t: float, q: Any, v: Any) -> Any:
    """Loads as if M₁ n₁ + M₂ n₂ did not turn the other axis too."""
    (load,), (one, two) = sound(self, "loads")(t, q, v), self._torques(t, q, v)
    n2 = self._second(q)
    return [
        type(load)(load.body, load.at, load.force, (two * n2[0], two * n2[1], one + two * n2[2]))
    ]


MISTAKES: dict[str, tuple[dict[str, Any], Callable[[Mode], float]]] = {
    "coupling lost": ({"accelerations": of_crossed_axes}, equations),
    "coupling lost, as a motion": ({"accelerations": of_crossed_axes}, apart),
    "coupling lost, as power": ({"accelerations": of_crossed_axes}, power),
    "turning axis lost": ({"reactions": without_turning}, cut_free),
    "φ counted backward": ({"poses": backward}, moves),
    "ω in ground axes": ({"poses": in_ground_axes}, moves),
    "torques along the axes": ({"loads": each_about_its_axis}, cut_free),
    "spring pushes": ({"U": lambda self, t, q: -type(gimbal()).U(self, t, q)}, equations),
    "damper drives": ({"D": lambda self, t, q, v: -type(gimbal()).D(self, t, q, v)}, equations),
    "motor on the wrong axis": (
        {"Q4": lambda self, t, q, v: type(gimbal()).Q4(self, t, q, v)[::-1]},
        equations,
    ),
}


@pytest.mark.mutant("sprung gimbal: {mistake}")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_planted_mistake_in_the_gimbal_is_seen(mistake: str) -> None:
    methods, law = MISTAKES[mistake]
    assert law(mutant(gimbal(), **methods)) > 1e3 * LIMIT


@pytest.mark.mutant("sprung gimbal: J of a hollow globe everywhere")
def test_a_moment_of_inertia_that_is_wrong_everywhere_is_seen() -> None:
    """The laws agree on any; the closed form knows that of a homogeneous globe."""
    wrong: Any = {"J": property(lambda self: 2 * self.m * self.R**2 / 3)}
    hollow = mutant(gimbal(), **wrong)
    assert max(law(hollow) for law in LAWS if law is not apart) < LIMIT
    assert apart(hollow) > 1e-2


@pytest.mark.mutant("sprung gimbal: {parameter} 5 % off")
@pytest.mark.parametrize("parameter", GIMBAL)
def test_each_parameter_is_in_the_motion(parameter: str) -> None:
    """5 % off in the explicit accelerations or at the start."""
    off: Any = gimbal(**{parameter: 1.05 * GIMBAL[parameter]})
    planted = mutant(gimbal(), accelerations=lambda self, t, q, v: off.accelerations(t, q, v))
    assert max(equations(planted), start(off)) > 1e-4
