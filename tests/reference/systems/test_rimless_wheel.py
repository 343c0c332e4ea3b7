"""The rimless wheel: its impact, its limit cycle and the multiplier, how it rocks to rest."""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given.events import LOCATED, event_errors
from given.examples import PARAMETERS, example
from given.mutants import mutant

from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, Guard, System
from textmech.reference.systems.walkers.rimless_wheel import RimlessWheel, SpokeSteps

WHEEL = PARAMETERS["rimless_wheel"]


def steps(**changed: float) -> SpokeSteps:
    p = {**WHEEL, **changed}
    return SpokeSteps(p["n"], p["l"], p["J"] / (p["m"] * p["l"] ** 2), p["gamma"])


def struck(wheel: System, until: float) -> list[float]:
    """φ̇ just after each strike, by the motion."""
    found = follow(wheel, np.linspace(0.0, until, 3))
    return [float(change.after[1]) for change in found.changes]


def test_impact_keeps_the_angular_momentum_about_the_new_tip():
    """m r × v + J ω before and after, r and v of the hub from the two tips in turn."""
    wheel: Any = example("rimless_wheel")
    change = follow(wheel, np.linspace(0.0, 0.3, 3)).changes[0]
    momenta = []
    for name, y in (("spoke 1", change.before), ("spoke 2", change.after)):
        x, y_c, _, vx, vy, omega = wheel.modes[name].poses(0.0, y[:1], y[1:])["wheel"]
        tip = 3 * WHEEL["l"] * math.sin(math.pi / 8)
        momenta.append(WHEEL["m"] * ((x - tip) * vy - y_c * vx) + WHEEL["J"] * omega)
    assert momenta[1] == pytest.approx(momenta[0], rel=1e-14)


@pytest.mark.parametrize("w0", [3.3, 2.2, 6.0])
def test_motion_comes_to_the_limit_cycle_with_its_multiplier(w0: float):
    """(ω⁺² − ω*²)/(ω² − ω*²) = η², by the followed motion; measured 2e-13."""
    after = np.array([w0, *struck(example("rimless_wheel", w0=w0), 1.6)])
    cycle = steps().limit_cycle()
    apart = after**2 - cycle**2
    assert len(after) > 4
    assert apart[1:] == pytest.approx(apart[:-1] * steps().kept ** 2, rel=1e-10)


@pytest.mark.slow
def test_too_slow_it_rocks_to_rest_on_two_spokes():
    """Each strike keeps η; the rocking lasts 0.6842 s and ends with a mode of its own."""
    wheel = example("rimless_wheel", w0=0.5)
    found = follow(wheel, np.linspace(0.0, 1.0, 11))
    assert found.phases[-1] == "rests 0"
    assert found.y[-1] == pytest.approx([0.0, 0.0], abs=1e-15)
    assert found.changes[-1].time == pytest.approx(_rocking(0.5), rel=1e-6)
    assert wheel.closed_events(1.0) is None
    assert wheel.closed_form(1.0) is None


def _rocking(omega: float) -> float:
    """How long [s] it rocks: back and forth on a spoke twice ∫ dθ/φ̇, η less each time."""
    one, total, forth = steps(), 0.0, True
    for _ in range(80):  # the last one lasts 1e-8 of the first
        total += 2 * _until_it_turns(omega, one, forth=forth)
        omega, forth = omega * one.kept, not forth
    return total


def _until_it_turns(omega: float, one: SpokeSteps, *, forth: bool) -> float:
    """∫ ds/√(ω² − 2 κ sin(δ − s/2) sin(s/2)) = ∫ dx 2 x/…, with s = end − x², to where it turns."""
    kappa = 2 * 9.80665 / WHEEL["l"] / (1 + one.rho)
    delta = one.between / 2 - (one.gamma if forth else -one.gamma)

    def left(s: Any) -> Any:
        return omega**2 - 2 * kappa * np.sin(delta - s / 2) * np.sin(s / 2)

    low, high = 0.0, delta
    for _ in range(80):
        middle = (low + high) / 2
        low, high = (middle, high) if left(middle) > 0 else (low, middle)
    nodes, weights = np.polynomial.legendre.leggauss(60)
    x = math.sqrt(low) / 2 * (nodes + 1)
    # left(low − x²) without its cancellation near the end
    drop = 2 * kappa * np.sin(x**2 / 2) * np.sin(delta - low + x**2 / 2)
    return float(np.sum(weights * 2 * x / np.sqrt(drop)) * math.sqrt(low) / 2)


def _with_eta(wheel: RimlessWheel, eta: float) -> System:
    def guards(self: System, mode: str) -> Sequence[Guard]:
        def then(g: Guard) -> Any:
            def struck(t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
                mode, q, _ = g.then(t, q, v)
                return mode, q, eta * v

            return struck

        return [replace(g, then=then(g)) for g in wheel.guards(mode)]

    return mutant(wheel, guards=guards)


@pytest.mark.mutant(
    "rimless wheel: cos α for cos 2α in its impact",
    "rimless wheel: J left out of its impact",
    "rimless wheel: an impact that loses nothing",
)
def test_another_impact_is_seen():
    """η with cos α in place of cos 2α, without J, or all of the speed kept."""
    wheel: Any = example("rimless_wheel")
    ml2 = WHEEL["m"] * WHEEL["l"] ** 2
    angle = math.pi / WHEEL["n"]
    wrong = [
        (WHEEL["J"] + ml2 * math.cos(angle)) / (WHEEL["J"] + ml2),
        math.cos(2 * angle),
        1.0,
    ]
    assert max(event_errors(wheel, wheel, 1.0)) <= LOCATED
    for eta in wrong:
        late = event_errors(wheel, _with_eta(wheel, eta), 0.6)
        assert max(late) > 1e-2


@pytest.mark.mutant("rimless wheel: another {name}")
@pytest.mark.parametrize("name", ["n", "l", "J", "gamma", "w0"])
def test_a_parameter_that_is_off_is_seen_in_the_strikes(name: str):
    changed = WHEEL[name] + 1 if name == "n" else 1.05 * WHEEL[name]
    wheel = example("rimless_wheel")
    assert max(event_errors(wheel, example("rimless_wheel", **{name: changed}), 0.5)) > 1e-4


def test_modes_that_cannot_be_are_said():
    def says(wheel: System, mode: str, phi: float, phi_dot: float) -> str:
        return str(wheel.possible(mode, 0.0, np.array([phi]), np.array([phi_dot])))

    wheel = example("rimless_wheel")
    assert says(wheel, "spoke 1", 0.3, 3.0) == "None"
    assert "would have to pull" in says(wheel, "spoke 1", 0.3, 9.0)
    assert "next tip is in the floor" in says(wheel, "spoke 1", 0.9, 1.0)
    assert "needs friction" in says(example("rimless_wheel", mu=0.1), "spoke 1", 0.0, 0.1)
