"""Every mode of every hand-written system against the chapter's formalisms."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from given import gimbals, laws, muscles, robots, wheels
from given.examples import MODES, PARAMETERS, VARIANTS, example
from given.spatial import SPATIAL
from given.states import states

from textmech.reference.formalisms import lagrange
from textmech.reference.systems import SYSTEMS

ASKED = [
    pytest.param(at, law, id=f"{'.'.join(at)}-{law.__name__}")
    for at in MODES
    for law in laws.LAWS
    if at in laws.ONLY.get(law, MODES)
]
STATED_IN_PARAMETERS = (laws.start,)  # what a variant changes


def test_every_system_is_tested():
    """Those in space by their own files."""
    rooms = (wheels.PARAMETERS, wheels.FROM_ABOVE, robots.PARAMETERS, gimbals.PARAMETERS)
    assert set(SYSTEMS) == set().union(PARAMETERS, SPATIAL, muscles.PARAMETERS, *rooms)


@pytest.mark.slow
@pytest.mark.parametrize(("at", "law"), ASKED)
def test_mode_obeys(at: laws.At, law: laws.Law):
    violation = law(example(at[0]), at)
    assert not laws.broken(law, violation), violation


@pytest.mark.parametrize("at", MODES, ids=".".join)
def test_laws_left_out_have_nothing_to_say(at: laws.At):
    system = example(at[0])
    mode = system.modes[at[1]]
    t, q, v = next(states(*at))
    assert len(mode.g(t, q)) == len(mode.f_a(t, q)) == len(lagrange.multipliers(mode, t, q, v)[1])
    starting = at[1] == system.start()[0]
    found = {
        laws.multipliers: len(mode.f_a(t, q)) > 0,
        laws.constraints: len(mode.f_a(t, q)) > 0,
        laws.reactions: bool(mode.reactions(t, q, v)),
        laws.start: starting,
        laws.closed_form: starting and system.closed_form(t) is not None,
    }
    assert found == {law: at in laws.ONLY[law] for law in found}


@pytest.mark.slow
@pytest.mark.parametrize("variant", VARIANTS)
def test_variant_obeys(variant: str):
    name, changed, _ = VARIANTS[variant]
    for at in [at for at in MODES if at[0] == name]:
        for law in laws.LAWS:
            if at in laws.ONLY.get(law, MODES) and law not in STATED_IN_PARAMETERS:
                violation = law(example(name, **changed), at)
                assert not laws.broken(law, violation), (at, law.__name__, violation)


@pytest.mark.parametrize("at", MODES, ids=".".join)
def test_complex_step_equals_central_difference(at: laws.At):
    """The complex step fails silently on abs, norm or max; a difference does not."""
    mode, h = example(at[0]).modes[at[1]], 1e-5
    t, q, v = next(states(*at))
    random = np.random.default_rng(2)
    dq, dv = random.normal(size=(2, len(q)))

    def poses(t: Any, q: Any, v: Any) -> Any:
        return np.array(list(mode.poses(t, q, v).values()))

    ingredients: list[Callable[[Any, Any, Any], Any]] = [
        poses, mode.T, mode.D, mode.Q4,
        lambda t, q, v: mode.U(t, q),
        lambda t, q, v: mode.f(t, q),
        lambda t, q, v: mode.f_a(t, q),
    ]  # fmt: skip
    if at[0].startswith("smooth"):
        ingredients.remove(mode.Q4)  # it casts to float; no formalism differentiates Q₄
    for function in ingredients:
        ahead = np.asarray(function(t + h, q + h * dq, v + h * dv))
        behind = np.asarray(function(t - h, q - h * dq, v - h * dv))
        exact = lagrange.derivative(function, (t, q, v), (1.0, dq, dv))
        np.testing.assert_allclose(exact, (ahead - behind) / (2 * h), rtol=1e-7, atol=1e-7)
