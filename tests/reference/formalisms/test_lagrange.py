"""Lagrange's equations, Hamel's form, generalized potentials: against those by hand."""

import tracemalloc
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given.laws import difference
from given.machines.examples import only
from given.machines.formal import EXACT, FORMAL, drawn
from given.machines.states import states
from given.machines.turning_bodies import J, unit
from given.mutants import mutant
from given.scenes import typed

from textmech.reference.formalisms import appell, energy, lagrange, newton_euler
from textmech.reference.formalisms import lagrangian as one_function
from textmech.reference.formalisms.chaplygin import ignorable
from textmech.reference.formalisms.derivative import along
from textmech.reference.laws.rotation import axes
from textmech.reference.solve import mechanism
from textmech.reference.system import Array, Mode

# What the formalisms refuse, and that their derivatives are exact.


@pytest.mark.parametrize("name", ["rolling_wheel", "four_bar"])
def test_constrained_coordinates_are_refused_by_the_unconstrained_equations(name: str):
    t, q, v = next(states(name, "moving"))
    with pytest.raises(ValueError, match=r"multipliers \(2\.60\)"):
        lagrange.accelerations(only(name), t, q, v)


def test_a_function_that_drops_the_complex_step_is_not_taken_for_a_constant():
    with pytest.raises(TypeError, match="lost its complex step"):
        lagrange.derivative(lambda q: abs(q[0]), (np.array([0.3]),), (np.array([1.0]),))
    assert lagrange.derivative(lambda q: 7.0, (np.array([0.3]),), (np.array([1.0]),)) == 0.0


def test_reactions_of_a_flat_rhombus_are_refused():
    with pytest.raises(ValueError, match="undetermined"):
        newton_euler.accelerations(only("rhombus"), 0.0, np.array([0.0, np.pi]), np.zeros(2))


def test_complex_step_is_exact_for_the_momentum():
    """p is linear in v: its slope is the mass matrix, whatever the size of v."""
    mode = only("double_pendulum")
    t, q, v = next(states("double_pendulum", "moving"))
    M = lagrange.mass_matrix(mode, t, q)
    np.testing.assert_allclose(M, M.T, rtol=1e-14)
    p = along(lambda q: lagrange.momentum(mode, t, q, v), (q,), (np.zeros(2),))
    np.testing.assert_allclose(p, 0.0)
    np.testing.assert_allclose(lagrange.momentum(mode, t, q, v), M @ v, rtol=1e-13)


# Lagrange's equations where q̇ = N v + n₀: Hamel's form, against Newton's and Euler's by hand.


def lagrangian(mode: Mode, name: str) -> float:
    """(2.60) The largest difference of v̇."""
    found = [
        difference(mode.accelerations(*at), lagrange.multipliers(mode, *at)[0])
        for at in drawn(name)
    ]
    return max(found)


def powers(mode: Mode, name: str) -> float:
    """(2.51) The power that is not accounted for, relative to the largest one."""
    worst = 0.0
    for t, q, v in drawn(name):
        q_dot, a = mode.rates(t, q, v), mode.accelerations(t, q, v)
        q_ddot = lagrange.derivative(mode.rates, (t, q, v), (1.0, q_dot, a))
        terms = [
            *(lagrange.momentum(mode, t, q, q_dot) * q_ddot),
            *(lagrange.gradient(lambda q, t=t: mode.U(t, q), q) * q_dot),
            *(np.asarray(mode.Q4(t, q, v)) * v),
        ]
        worst = max(worst, abs(energy.power_balance(mode, t, q, v)) / np.abs(terms).max())
    return worst


@pytest.mark.parametrize("name", FORMAL)
def test_equations_by_hand_are_those_of_the_energies(name: str) -> None:
    assert lagrangian(FORMAL[name], name) < EXACT


@pytest.mark.parametrize("name", FORMAL)
def test_power_is_balanced(name: str) -> None:
    assert powers(FORMAL[name], name) < EXACT


@pytest.mark.parametrize("name", [name for name in FORMAL if "own velocities" not in name])
def test_multipliers_are_the_reactions(name: str) -> None:
    """The blade's side force is λ; an upright wheel's reactions have their own test."""
    mode = FORMAL[name]
    for t, q, v in drawn(name, 10):
        lam = lagrange.multipliers(mode, t, q, v)[1]
        assert len(lam) == len(mode.g(t, q))
        if name.startswith("sleigh"):
            assert difference(lam, [mode.reactions(t, q, v)["blade.side"]]) < EXACT


@pytest.mark.mutant("{name}: rates from ω in ground axes")
@pytest.mark.parametrize("name", ["free body", "top"])
@pytest.mark.parametrize("law", [lagrangian, powers])
def test_rates_from_a_spin_in_ground_axes_are_seen(name: str, law: Any) -> None:
    """ω of q̇ = ½ q ∘ (0, ω) stands in body axes."""
    sound = FORMAL[name]

    def rates(self: Mode, t: Any, q: Any, v: Any) -> Any:
        return sound.rates(t, q, np.concatenate([v[:-3], axes(q[-4:]) @ v[-3:]]))

    assert law(mutant(sound, rates=rates), name) > EXACT


@pytest.mark.slow
@pytest.mark.mutant("{name}: gyroscopic term left out")
@pytest.mark.parametrize("name", ["free body", "top"])
def test_a_lost_gyroscopic_term_is_seen_by_the_equations(name: str) -> None:
    """It has no power: that balance cannot see it."""
    sound = FORMAL[name]

    def accelerations(self: Mode, t: float, q: Any, v: Any) -> Any:
        still = np.concatenate([v[:-3], 0.0 * v[-3:]])
        return sound.accelerations(t, q, still)

    lost = mutant(sound, accelerations=accelerations)
    assert lagrangian(lost, name) > 1e-3
    assert powers(lost, name) < EXACT


@pytest.mark.slow
@pytest.mark.mutant("(2.33) as printed, erratum 1")
def test_the_printed_equations_of_euler_are_seen() -> None:
    """Erratum 1: as printed, the second component has the wrong sign before J₁ⱼ ωⱼ ω₃."""
    sound = FORMAL["free body"]

    def accelerations(self: Mode, t: float, q: Any, v: Any) -> Any:
        printed = np.array([0.0, 2 * (J @ v[3:])[0] * v[5], 0.0])
        a = sound.accelerations(t, q, v)
        return np.concatenate([a[:3], a[3:] + np.linalg.solve(J, printed)])

    mode = mutant(sound, accelerations=accelerations)
    assert lagrangian(mode, "free body") > 1e-3
    assert powers(mode, "free body") > 1e-3


def test_a_mode_whose_velocities_are_its_rates_has_no_rate_matrix() -> None:
    t, q, v = next(drawn("upright wheel"))
    assert lagrange.rate_matrix(FORMAL["upright wheel"], t, q, v) is None


def test_the_rate_matrix_of_a_quaternion_is_half_of_an_orthonormal_one() -> None:
    q = unit(np.random.default_rng(3))
    N = lagrange.rate_matrix(FORMAL["top"], 0.0, q, np.ones(3))
    assert N is not None
    np.testing.assert_allclose(4 * N.T @ N, np.eye(3), atol=1e-15)
    np.testing.assert_allclose(q @ N, 0.0, atol=1e-16)
    E_dot = along(axes, (q,), (N @ [1.0, 2.0, 3.0],))
    np.testing.assert_allclose(E_dot @ axes(q).T, _skew([1.0, 2.0, 3.0]), atol=1e-14)


def _skew(omega: list[float]) -> Any:
    """(2.4) ω₂₃ = ω₁, ω₃₁ = ω₂, ω₁₂ = ω₃."""
    a, b, c = omega
    return np.array([[0.0, c, -b], [-c, 0.0, a], [b, -a, 0.0]])


# Generalized potentials (2.48): a charge whose force is a term of the momentum, or a force.


@dataclass(frozen=True)
class Betatron(Mode):
    """A charge in a field that grows: B = b t, so that E = ½ b (y, −x) drives it round."""

    m: float = 1.3
    e: float = 0.7
    b: float = 2.0

    coordinates = ("x", "y")

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """m r̈ = e (E + ṙ × B), E = −∂A/∂t of A = ½ B (−y, x)."""
        k = self.e * self.b / self.m
        return k * np.array([q[1] / 2 + t * v[1], -q[0] / 2 - t * v[0]])

    def T(self, t: Any, q: Any, v: Any) -> Any:
        return self.m * (v[0] ** 2 + v[1] ** 2) / 2

    def V(self, t: Any, q: Any, v: Any) -> Any:
        return self.e * self.b * t * (q[1] * v[0] - q[0] * v[1]) / 2

    def poses(self, t: Any, q: Any, v: Any) -> Any:
        return {"charge": (q[0], q[1], 0.0, v[0], v[1], 0.0)}


class Polar(Betatron):
    """The same by v = (v_r, v_φ), so that q̇ = N v."""

    def rates(self, t: Any, q: Any, v: Any) -> Any:
        r = np.sqrt(q[0] ** 2 + q[1] ** 2)
        cos, sin = q[0] / r, q[1] / r
        return np.array([cos * v[0] - sin * v[1], sin * v[0] + cos * v[1]])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """v̇_r = v_φ²/r + a_r, v̇_φ = −v_r v_φ/r + a_φ, a of the plain coordinates."""
        r = float(np.hypot(*q))
        cos, sin = q / r
        x, y = super().accelerations(t, q, self.rates(t, q, v))
        turning = np.array([v[1] ** 2, -v[0] * v[1]]) / r
        return turning + np.array([cos * x + sin * y, cos * y - sin * x])


class Damped(Betatron):
    """The same in a viscous gas: a V and a D in one mode."""

    d: float = 0.9

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """m r̈ = e (E + ṙ × B) − d ṙ."""
        return super().accelerations(t, q, v) - self.d / self.m * v

    def D(self, t: Any, q: Any, v: Any) -> Any:
        return self.d * (v[0] ** 2 + v[1] ** 2) / 2


MODES: dict[str, Mode] = {
    "betatron": Betatron(), "by polar velocities": Polar(), "in a force": only("charge_in_field"),
    "in a gas": Damped(),
}  # fmt: skip


def drawn_potential(count: int = 30) -> Iterator[tuple[float, Array, Array]]:
    random = np.random.default_rng(4)
    for _ in range(count):
        yield random.uniform(0.0, 2.0), random.uniform(1.0, 2.0, 2), random.uniform(-5.0, 5.0, 2)


def missed(mode: Mode) -> float:
    """(2.44), (2.51) and the balance of power, relative to the accelerations."""
    worst = 0.0
    for t, q, v in drawn_potential():
        a = mode.accelerations(t, q, v)
        worst = max(worst, difference(a, lagrange.accelerations(mode, t, q, v)))
        worst = max(
            worst, np.abs(one_function.unbalanced(mode, t, q, v, a)).max() / np.abs(a).max()
        )
        terms = np.abs(a) * np.abs(v)
        worst = max(worst, abs(energy.power_balance(mode, t, q, v)) / terms.max())
    return worst


@pytest.mark.parametrize("name", MODES)
def test_by_a_force_and_by_the_lagrangian(name: str) -> None:
    """d/dt ∂L/∂q̇ᵃ − ∂L/∂qᵃ = −∂D/∂q̇ᵃ (2.51), and without D = 0 (2.52)."""
    mode = MODES[name]
    assert missed(mode) < EXACT
    d = mode.d if isinstance(mode, Damped) else 0.0
    for t, q, v in drawn_potential(5):
        a = mode.accelerations(t, q, v)
        found = one_function.left_side(mode, t, q, v, a)
        assert np.abs(found + d * v).max() < 1e-12 * np.abs(a).max() * 2


@pytest.mark.mutant("Lagrangian (2.51) without the dissipation of a damper")
def test_a_lost_dissipation_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Only where a V and a D stand in one mode: one with a V alone has none to lose."""
    monkeypatch.setattr(one_function, "gradient", _without_velocities(one_function.gradient))
    assert missed(MODES["betatron"]) < EXACT
    assert missed(MODES["in a gas"]) > 1e-2


def _without_velocities(gradient: Any) -> Any:
    """D's slope is the one gradient that is taken by v and of `unbalanced`."""
    return lambda f, x: 0.0 * x if "unbalanced" in f.__qualname__ else gradient(f, x)


def test_appell_knows_its_force_too() -> None:
    mode = MODES["in a force"]
    for at in drawn_potential(5):
        found = appell.accelerations(mode, *at)
        assert found is not None
        assert difference(mode.accelerations(*at), found) < EXACT


@pytest.mark.mutant("potential of a magnetic force, {name}: {planted}")
@pytest.mark.parametrize("name", MODES)
@pytest.mark.parametrize(
    ("planted", "V"),
    {
        "−e, erratum 6": lambda V, t, q, v: -V(t, q, v),
        "half of it": lambda V, t, q, v: V(t, q, v) / 2,
        "y ẋ + x ẏ": lambda V, t, q, v: V(t, q * np.array([-1.0, 1.0]), v),
        "none": lambda V, t, q, v: 0.0,
    }.items(),
)
def test_another_potential_is_seen(name: str, planted: str, V: Any) -> None:
    sound = MODES[name]
    wrong = mutant(sound, V=lambda self, t, q, v: V(sound.V, t, q, v))
    assert missed(wrong) > 1e-3


@pytest.mark.mutant("a magnetic force with power")
def test_a_magnetic_force_with_power_is_seen() -> None:
    sound: Any = MODES["in a force"]

    def accelerations(self: Mode, t: float, q: Array, v: Array) -> Array:
        return sound.accelerations(t, q, v) + 0.01 * v

    assert missed(mutant(sound, accelerations=accelerations)) > 1e-4


# What the equations of many rates take of memory, and that it changes no answer.


def chain(bars: int) -> str:
    """A scene of so many bars that hang on each other."""
    lines = [
        "scene:\n  points: {O: [0, 0]}\n  bodies:",
        *(f"    b{k}: {{bar: {{mass: {1 + k / 7}, length: 0.1}}}}" for k in range(bars)),
        "  joints:",
        "    j0: {pin: [ground.O, b0.start]}",
        *(f"    j{k}: {{pin: [b{k - 1}.end, b{k}.start]}}" for k in range(1, bars)),
        "initial: {" + ", ".join(f"b{k}: {{angle: {-80 + k} deg}}" for k in range(bars)) + "}",
        "allow: {b0.angle: 1.0e-3}\n",
    ]
    return "\n".join(lines)


def peak(call: Callable[[], Any]) -> tuple[Any, int]:
    """The call's value, and how many bytes it had at once."""
    tracemalloc.start()
    try:
        return call(), tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.mutant("all pairs of a mechanism's rates are looked at at once")
def test_pairs_of_rates_are_looked_at_in_blocks() -> None:
    """All at once, those of 150 rates are 108 MB, and many times that with what is added up."""
    n = 150
    T = lambda t, q, v: sum(k * rate * rate for k, rate in enumerate(v, start=1)) / 2  # noqa: E731
    M, size = peak(lambda: lagrange.curvature(T, 0.0, np.zeros(n), n))
    assert np.allclose(M, np.diag(np.arange(1.0, n + 1.0)), atol=1e-12)
    assert size < 8 * 8 * lagrange.NUMBERS  # eight arrays of so many numbers


@pytest.mark.mutant("a block of rates is put in another's place")
@pytest.mark.parametrize("rates", [1, 3, 7])
def test_blocks_change_no_bit(rates: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    system = mechanism(typed(tmp_path, chain(bars=12)))
    mode, q, v = system.start()
    whole = lagrange.mass_matrix(system.modes[mode], 0.0, q)
    monkeypatch.setattr(lagrange, "NUMBERS", rates * 4 * len(v) ** 2)
    assert np.array_equal(lagrange.mass_matrix(system.modes[mode], 0.0, q), whole)


@pytest.mark.mutant("all derivatives of a mechanism's constraints are kept at once")
def test_what_no_coordinate_changes_is_found_in_little_memory(tmp_path: Path) -> None:
    """n derivatives of n r constraints each are mostly zeros: 90 × 90 × 60 here."""
    system = mechanism(typed(tmp_path, chain(bars=30)))
    mode, q, v = system.start()
    found, size = peak(lambda: ignorable(system.modes[mode], 0.0, q, v))
    assert size < 90 * 90 * 60 * 8
    assert found == [k for k in range(90) if k % 3 != 2]  # all but the angles
