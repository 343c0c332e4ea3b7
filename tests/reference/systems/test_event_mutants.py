"""Mistakes planted in modes and guards: the events or the laws that see them."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import laws
from given.events import LOCATED, event_errors
from given.examples import duration, example
from given.mutants import mutant, with_mode

from textmech.reference.motion.follow import follow
from textmech.reference.motion.zeno import ZenoError
from textmech.reference.system import Array, Guard, System


@pytest.mark.mutant("guards of {name} that fall at a threshold of 1e-6, not at zero")
@pytest.mark.parametrize("name", ["sliding_disk", "sliding_block", "dynamometer"])
def test_threshold_in_place_of_the_event_is_seen(name: str):
    """`stays zero` within 1e-6 m/s instead of g = 0."""
    system = example(name)

    def guards(self: System, mode: str) -> Sequence[Guard]:
        return [replace(g, g=lambda t, q, v, g=g: g.g(t, q, v) - 1e-6) for g in system.guards(mode)]

    assert max(event_errors(system, system, duration(name))) <= LOCATED
    assert max(event_errors(system, mutant(system, guards=guards), duration(name))) > 1e3 * LOCATED


@pytest.mark.mutant("{name} without its stick mode")
@pytest.mark.parametrize("name", ["sliding_block", "dynamometer"])
def test_missing_stick_mode_is_seen(name: str):
    """Where it should stick it goes on sliding, the other way."""
    system = example(name)
    other = {"up": "down", "down": "up", "forward": "backward", "backward": "forward"}

    def guards(self: System, mode: str) -> Sequence[Guard]:
        def on(t: float, q: Array, v: Array) -> tuple[str, Array, Array]:
            return other[mode], q, np.zeros(1)

        return [replace(g, then=on) if g.event == "stops" else g for g in system.guards(mode)]

    with pytest.raises(ZenoError):  # it chatters between the two
        event_errors(system, mutant(system, guards=guards), duration(name))


@pytest.mark.mutant("friction that drives {name}, against (2.89)", "F₋ and F₊ of {name} exchanged")
@pytest.mark.slow
@pytest.mark.parametrize("name", ["growing_force", "dynamometer"])
def test_sign_in_2_89_is_seen(name: str):
    """Friction that drives instead of braking; and the bound of the other side."""
    system = example(name, Fs_minus=6.0, Fs_plus=5.0)
    fed = system
    for mode in ("forward", "backward"):
        wrong: Any = system.modes[mode]
        fed = with_mode(fed, mode, replace(wrong, F_fr=-wrong.F_fr))
    times = np.linspace(0.0, 10.0, 31)
    closed = [system.closed_form(t) for t in times.tolist()]
    known = np.array([np.concatenate(c) for c in closed if c is not None])
    assert np.abs(follow(system, times).y - known).max() < 1e-10
    assert np.abs(follow(fed, times).y - known).max() > 1.0
    swapped = example(name, Fs_minus=5.0, Fs_plus=6.0)
    assert max(event_errors(system, swapped, 4.0 if name == "dynamometer" else 10.0)) > 0.1


@pytest.mark.mutant("sign of friction in {name}, mode {mode}")
@pytest.mark.parametrize(
    ("name", "mode"), [("sliding_disk", "slips forward"), ("sliding_block", "down")]
)
def test_sign_of_friction_in_one_mode_is_seen_by_the_laws(name: str, mode: str):
    system = example(name)
    sound: Any = system.modes[mode]
    wrong = replace(sound, sigma=-1)
    mixed = mutant(sound, accelerations=lambda self, t, q, v: wrong.accelerations(t, q, v))
    for law in (laws.free_cut, laws.power):
        assert not laws.broken(law, law(system, (name, mode)))
        assert laws.broken(law, law(with_mode(system, mode, mixed), (name, mode)))
