"""Generated mechanisms against what needs no multipliers: Voronets, Chaplygin and Appell."""

from types import ModuleType

import numpy as np
import pytest
from given import random_scenes, scenes
from given.multibody_laws import EXACT

from textmech.reference.certificate.laws import drawn
from textmech.reference.formalisms import appell, chaplygin, voronets
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.system import Array

FORMS = (voronets, chaplygin, appell)
STATES = 100
COUNT = 30  # random scenes

# Chaplygin's equations need coordinates that appear nowhere: of what is carried along, not of what
# turns.
ALL, TURNING = set(FORMS), {voronets, appell}
SHIPPED = {
    "bar_pendulum": ALL, "double_pendulum": ALL, "four_bar": TURNING, "rhombus": TURNING,
    "rolling_wheel.downhill": ALL, "slider_crank": TURNING, "towed_pendulum": ALL,
}  # fmt: skip


def apart(mode: Multibody, form: ModuleType, t: float, q: Array, v: Array) -> float | None:
    """Relative to the accelerations, or what each force alone would give; None: does not apply."""
    a, found = mode.accelerations(t, q, v), form.accelerations(mode, t, q, v)
    size = max(np.max(np.abs(a)), mode.terms(t, q, v)[0])
    return None if found is None else float(np.max(np.abs(found - a)) / size)


@pytest.mark.slow
@pytest.mark.parametrize("name", SHIPPED)
def test_shipped_mechanisms_at_random_states(name: str) -> None:
    mode, case = scenes.mechanism(scenes.SHIPPED[name]).base, scenes.SHIPPED[name]
    y = np.concatenate(mode.start())
    row = np.concatenate([y[: len(y) // 2], np.ones(len(y) // 2)])
    for form in FORMS:
        found = [
            apart(mode, form, *at)
            for at in drawn(mode, case.times, np.array([row] * len(case.times)), STATES)
        ]
        assert len(found) == STATES
        assert {x is not None for x in found} == {form in SHIPPED[name]}, form.__name__
        assert all(x is None or x < EXACT for x in found), form.__name__


@pytest.mark.slow
def test_random_scenes() -> None:
    applied = dict.fromkeys(FORMS, 0)
    for mode, random in random_scenes.mechanisms(COUNT):
        at = random_scenes.state(random, mode)
        for form in FORMS:
            found = apart(mode, form, *at)
            applied[form] += found is not None
            assert found is None or found < EXACT
    assert min(applied.values()) > COUNT // 3
