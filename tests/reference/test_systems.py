"""Every hand-written system against the chapter's formalisms, and against its closed form."""

import math
from collections.abc import Callable
from typing import Any

import mpmath
import numpy as np
import pytest
from given import laws, switching_examples
from given.examples import PARAMETERS, example, states
from scipy.special import ellipj

from textmech.reference.formalisms import lagrange, newton_euler
from textmech.reference.formalisms.derivative import along
from textmech.reference.systems import SYSTEMS
from textmech.reference.systems.bar_pendulum import jacobi

VARIANTS = {
    "resting": ("rolling_wheel", {"beta": 0.0, "F": 0.0}),
    "pushed": ("rolling_wheel", {"beta": 0.0}),
    "downhill": ("rolling_wheel", {"F": 0.0}),
    "free": ("spring_mass_damper", {"d": 0.0}),
    "critical": ("spring_mass_damper", {"d": 12.0}),
    "overdamped": ("spring_mass_damper", {"d": 30.0}),
}
_RATIOS = ("cd", "sd", "nd")  # Glaisher's cn/dn, sn/dn, 1/dn


def test_every_system_is_tested():
    assert set(SYSTEMS) == set(PARAMETERS) | set(switching_examples.PARAMETERS)


@pytest.mark.parametrize(
    ("name", "law"),
    [
        pytest.param(name, law, id=f"{name}-{law.__name__}")
        for name in PARAMETERS
        for law in laws.LAWS
        if name in laws.ONLY.get(law, PARAMETERS)
    ],
)
def test_system_obeys(name: str, law: laws.Law):
    violation = law(example(name), name, states(name))
    assert not laws.broken(law, violation), violation


@pytest.mark.parametrize("name", PARAMETERS)
def test_laws_left_out_have_nothing_to_say(name: str):
    system = example(name)
    t, q, v = next(states(name))
    found = {
        laws.multipliers: len(system.f_a(t, q)) > 0,
        laws.constraints: len(system.f(t, q)) > 0,
        laws.reactions: bool(system.reactions(t, q, v)),
        laws.closed_form: system.closed_form(t) is not None,
    }
    assert found == {law: name in laws.ONLY[law] for law in found}


@pytest.mark.parametrize("variant", VARIANTS)
def test_variant_obeys(variant: str):
    name, changed = VARIANTS[variant]
    for law in (laws.equations, laws.free_cut, laws.power, laws.closed_form):
        violation = law(example(name, **changed), name, states(name))
        assert not laws.broken(law, violation), (law.__name__, violation)


@pytest.mark.parametrize("name", PARAMETERS)
def test_complex_step_equals_central_difference(name: str):
    """The complex step fails silently on abs, norm or max; a difference does not."""
    system, h = example(name), 1e-5
    t, q, v = next(states(name))
    random = np.random.default_rng(2)
    dq, dv = random.normal(size=(2, len(q)))

    def poses(t: Any, q: Any, v: Any) -> Any:
        return np.array(list(system.poses(t, q, v).values()))

    ingredients: list[Callable[[Any, Any, Any], Any]] = [
        poses, system.T, system.D, system.Q4,
        lambda t, q, v: system.U(t, q),
        lambda t, q, v: system.f(t, q),
        lambda t, q, v: system.f_a(t, q),
    ]  # fmt: skip
    for function in ingredients:
        ahead = np.asarray(function(t + h, q + h * dq, v + h * dv))
        behind = np.asarray(function(t - h, q - h * dq, v - h * dv))
        exact = lagrange.derivative(function, (t, q, v), (1.0, dq, dv))
        np.testing.assert_allclose(exact, (ahead - behind) / (2 * h), rtol=1e-7, atol=1e-7)


@pytest.mark.parametrize("name", ["rolling_wheel", "four_bar"])
def test_constrained_coordinates_are_refused_by_the_unconstrained_equations(name: str):
    t, q, v = next(states(name))
    with pytest.raises(ValueError, match=r"multipliers \(2\.60\)"):
        lagrange.accelerations(example(name), t, q, v)


def test_a_function_that_drops_the_complex_step_is_not_taken_for_a_constant():
    with pytest.raises(TypeError, match="lost its complex step"):
        lagrange.derivative(lambda q: abs(q[0]), (np.array([0.3]),), (np.array([1.0]),))
    assert lagrange.derivative(lambda q: 7.0, (np.array([0.3]),), (np.array([1.0]),)) == 0.0


def test_reactions_of_a_flat_rhombus_are_refused():
    with pytest.raises(ValueError, match="undetermined"):
        newton_euler.accelerations(example("rhombus"), 0.0, np.array([0.0, np.pi]), np.zeros(2))


@pytest.mark.parametrize("degrees", [24.6, -200.0, -89.0, 89.0, 89.999, 271.0, -269.999])
def test_bar_pendulum_closed_form_against_mpmath(degrees: float):
    """To 1e-13 over 10 s, if it is not released near the top.

    There the rounding of the angle of release, 1e-16 of 1, moves the later fall by
    1e-16 / cos(θ₀/2) s and more.
    """
    phi0 = math.radians(degrees)
    system = example("bar_pendulum", phi0=phi0)
    with mpmath.workdps(40):
        theta0 = mpmath.mpf(phi0) + mpmath.pi / 2
        theta0 -= 2 * mpmath.pi * mpmath.nint(theta0 / (2 * mpmath.pi))
        k, k1 = mpmath.sin(theta0 / 2), mpmath.cos(theta0 / 2)
        Omega = mpmath.sqrt(3 * mpmath.mpf(9.80665) / (2 * mpmath.mpf(0.8)))
        for t in np.linspace(0.0, 10.0, 21):
            cd, sd, nd = (mpmath.ellipfun(f, Omega * mpmath.mpf(t), m=k**2) for f in _RATIOS)
            theta = 2 * mpmath.asin(k * cd)
            rate = -2 * Omega * k * k1**2 * sd * nd / mpmath.sqrt(1 - (k * cd) ** 2)
            known = system.closed_form(float(t))
            assert known is not None
            margin = 1e-13 + 3e-15 / float(k1)
            assert abs(known[0][0] - (mpmath.mpf(phi0) + theta - theta0)) < margin
            assert abs(known[1][0] - rate) < Omega * margin


def test_jacobi_functions_against_scipy_and_at_the_ends_of_the_modulus():
    for u in np.linspace(-20, 20, 81):
        sn, cn, _, _ = ellipj(u, 0.36)
        assert jacobi(u, 0.6, 0.8) == pytest.approx((sn, cn), abs=1e-14)
        assert jacobi(u, 0.0, 1.0) == pytest.approx((math.sin(u), math.cos(u)), abs=1e-14)


def test_complex_step_is_exact_for_the_momentum():
    """p is linear in v: its slope is the mass matrix, whatever the size of v."""
    system = example("double_pendulum")
    t, q, v = next(states("double_pendulum"))
    M = lagrange.mass_matrix(system, t, q)
    np.testing.assert_allclose(M, M.T, rtol=1e-14)
    p = along(lambda q: lagrange.momentum(system, t, q, v), (q,), (np.zeros(2),))
    np.testing.assert_allclose(p, 0.0)
    np.testing.assert_allclose(lagrange.momentum(system, t, q, v), M @ v, rtol=1e-13)
