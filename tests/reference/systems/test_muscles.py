"""Hand-written muscles: an inner state is a coordinate with a rate of its own, and no velocity."""

from typing import Any

import numpy as np
import pytest
from given.laws import difference
from given.machines.muscles import PARAMETERS, drawn, muscle
from given.mutants import mutant

from textmech.reference.formalisms import energy, lagrange, newton_euler, voronets
from textmech.reference.motion.follow import follow
from textmech.reference.motion.stuck import Stuck
from textmech.reference.system import Mode, Only

EXACT = 1e-12  # of the largest term
LOADS = [name for name in PARAMETERS if name.endswith("load")]
CLOSED = [name for name in PARAMETERS if name != "muscle_load"]


def violated(mode: Mode, name: str) -> float:
    """(2.60), (2.51), (2.23) and where it is free (2.66), relative to the largest term."""
    worst = 0.0
    for t, q, v in drawn(name):
        a = mode.accelerations(t, q, v)
        force = np.abs(mode.U(t, q) / 0.01)
        found, _ = lagrange.multipliers(mode, t, q, v)
        worst = max(worst, difference(a, found, 1.0))
        worst = max(worst, abs(energy.power_balance(mode, t, q, v)) / force)
        worst = max(worst, newton_euler.balance(mode, t, q, v, a).share())
        if (other := voronets.accelerations(mode, t, q, v)) is not None:
            worst = max(worst, difference(a, other, 1.0))
    return worst


def apart(mode: Mode, known: Mode) -> float:
    """From a closed form, along the motion [m, m/s]."""
    times = np.linspace(0.0, 0.4, 21)
    rows = [known.closed_form(t) for t in times.tolist()]
    closed = np.array([np.concatenate(row) for row in rows if row is not None])
    return float(np.abs(follow(Only(mode), times).y - closed).max())


@pytest.mark.parametrize("name", PARAMETERS)
def test_laws(name: str) -> None:
    assert violated(muscle(name), name) < EXACT


@pytest.mark.parametrize("name", CLOSED)
def test_motion_is_the_closed_form(name: str) -> None:
    assert apart(muscle(name), muscle(name)) < 1e-12


def test_a_very_flat_hyperbola_is_a_line() -> None:
    """a, b → ∞ with (F₀ + a)/b kept: the linear muscle, whose closed form is known."""
    a = 1e9
    hill = muscle("muscle_load", a=a, b=(a + 1000.0) / 2000.0)
    assert apart(hill, muscle("linear_muscle_load")) < 1e-6


@pytest.mark.mutant("{name}: {wrong} 5 % off")
@pytest.mark.parametrize("name", PARAMETERS)
@pytest.mark.parametrize("wrong", ["F0", "b", "cs"])
def test_another_muscle_is_seen(name: str, wrong: str) -> None:
    known = muscle(name)
    off = muscle(name, **{wrong: 1.05 * PARAMETERS[name][wrong]})
    if name in CLOSED:
        assert apart(off, known) > 1e-5
    else:
        end = [follow(Only(mode), np.array([0.0, 0.1])).y[-1] for mode in (off, known)]
        assert np.abs(end[0] - end[1]).max() > 1e-5


@pytest.mark.slow
@pytest.mark.mutant(
    "{name}: energy of the spring beside left out",
    "{name}: energy of the spring in series left out",
    "{name}: the whole length in the spring in series",
    "{name}: one of its loads left out",
)
@pytest.mark.parametrize("name", LOADS)
def test_lost_terms_are_seen_by_the_laws(name: str) -> None:
    sound: Any = muscle(name)
    lost: dict[str, Any] = {
        "no spring beside": lambda self, t, q: (
            sound.U(t, q) - sound.cp * (-q[0] - sound.L) ** 2 / 2
        ),
        "no series": lambda self, t, q: sound.U(t, q) - sound.cs * (-q[0] - q[1]) ** 2 / 2,
        "the whole in series": lambda self, t, q: sound.U(t, q * np.array([1.0, 0.0])),
    }
    for U in lost.values():
        assert violated(mutant(sound, U=U), name) > 1e-4
    loads = lambda self, t, q, v: sound.loads(t, q, v)[:-1]  # noqa: E731
    assert violated(mutant(sound, loads=loads), name) > 1e-4


@pytest.mark.mutant("{name}: what contracts does so the other way")
@pytest.mark.parametrize("name", CLOSED)
def test_what_contracts_the_other_way_is_seen(name: str) -> None:
    """No law asks how fast it does: its rate is given, as a drive's. The closed form knows."""
    sound = muscle(name)

    def rates(self: Mode, t: Any, q: Any, v: Any) -> Any:
        return sound.rates(t, q, v) * np.array([1.0, -1.0])

    wrong = mutant(sound, rates=rates)
    assert violated(wrong, name) < EXACT
    try:
        assert apart(wrong, sound) > 1e-3
    except Stuck:
        assert name == "muscle_isometric"  # it runs to F = −a, beyond which there is no law
