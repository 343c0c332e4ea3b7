"""Generalized potentials (2.48): a charge whose force is a term of the momentum, or a force."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
import pytest
from given.examples import only
from given.formal import EXACT
from given.laws import difference
from given.mutants import mutant

from textmech.reference.formalisms import appell, energy, lagrange, lagrangian
from textmech.reference.system import Array, Mode


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


def drawn(count: int = 30) -> Iterator[tuple[float, Array, Array]]:
    random = np.random.default_rng(4)
    for _ in range(count):
        yield random.uniform(0.0, 2.0), random.uniform(1.0, 2.0, 2), random.uniform(-5.0, 5.0, 2)


def missed(mode: Mode) -> float:
    """(2.44), (2.51) and the balance of power, relative to the accelerations."""
    worst = 0.0
    for t, q, v in drawn():
        a = mode.accelerations(t, q, v)
        worst = max(worst, difference(a, lagrange.accelerations(mode, t, q, v)))
        worst = max(worst, np.abs(lagrangian.unbalanced(mode, t, q, v, a)).max() / np.abs(a).max())
        terms = np.abs(a) * np.abs(v)
        worst = max(worst, abs(energy.power_balance(mode, t, q, v)) / terms.max())
    return worst


@pytest.mark.parametrize("name", MODES)
def test_by_a_force_and_by_the_lagrangian(name: str) -> None:
    """d/dt ∂L/∂q̇ᵃ − ∂L/∂qᵃ = −∂D/∂q̇ᵃ (2.51), and without D = 0 (2.52)."""
    mode = MODES[name]
    assert missed(mode) < EXACT
    d = mode.d if isinstance(mode, Damped) else 0.0
    for t, q, v in drawn(5):
        a = mode.accelerations(t, q, v)
        found = lagrangian.left_side(mode, t, q, v, a)
        assert np.abs(found + d * v).max() < 1e-12 * np.abs(a).max() * 2


@pytest.mark.mutant("Lagrangian (2.51) without the dissipation of a damper")
def test_a_lost_dissipation_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Only where a V and a D stand in one mode: one with a V alone has none to lose."""
    monkeypatch.setattr(lagrangian, "gradient", _without_velocities(lagrangian.gradient))
    assert missed(MODES["betatron"]) < EXACT
    assert missed(MODES["in a gas"]) > 1e-2


def _without_velocities(gradient: Any) -> Any:
    """D's slope is the one gradient that is taken by v and of `unbalanced`."""
    return lambda f, x: 0.0 * x if "unbalanced" in f.__qualname__ else gradient(f, x)


def test_appell_knows_its_force_too() -> None:
    mode = MODES["in a force"]
    for at in drawn(5):
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
