"""What holds of every machine in space, on scenes nobody chose: energies, forms, free bodies."""

from collections import Counter

import numpy as np
import pytest
from given.machine_laws import EXACT, LAWS, REDUCED
from given.random_space import MAKES, machine
from given.same_examples import examples
from given.space_machine import T
from hypothesis import given
from hypothesis import strategies as st

from textmech.cases.scene.quantity import table
from textmech.reference.formalisms import appell, chaplygin, voronets
from textmech.reports.compare.trial.ladder import wanted_reactions

few = examples(15)
SEEDS = st.integers(0, 10_000)


@pytest.mark.slow
@pytest.mark.parametrize("kind", MAKES)
@pytest.mark.parametrize("law", LAWS)
@few
@given(seed=SEEDS, driven=st.booleans())
def test_every_machine_obeys(law: str, kind: str, seed: int, *, driven: bool) -> None:
    """(2.60), (2.51), (2.23), (2.33), (2.19)."""
    made = machine(seed, kind, driven=driven)
    assert LAWS[law](made.mode, T, made.q, made.v()) < EXACT


@pytest.mark.slow
@pytest.mark.parametrize("kind", MAKES)
@pytest.mark.parametrize("form", [voronets, appell], ids=lambda form: form.__name__.split(".")[-1])
@few
@given(seed=SEEDS, driven=st.booleans())
def test_accelerations_without_multipliers(form, kind: str, seed: int, *, driven: bool) -> None:  # type: ignore[no-untyped-def]
    """(2.66), (2.80): the rates of a quaternion are bound, and so both apply to all."""
    made = machine(seed, kind, driven=driven)
    found = REDUCED[form](made.mode, T, made.q, made.v())
    assert found is not None
    assert found < EXACT


@pytest.mark.slow
@pytest.mark.parametrize("kind", MAKES)
def test_chaplygin_never_applies(kind: str) -> None:
    """(2.67) A quaternion's rates depend on each other, and it appears everywhere."""
    made = machine(1, kind)
    assert chaplygin.accelerations(made.mode, T, made.q, made.v()) is None


@pytest.mark.slow
@pytest.mark.parametrize("kind", MAKES)
def test_every_force_that_can_be_asked_for_is_told(kind: str) -> None:
    """Also what drives a slide, a hinge and a named freedom."""
    for seed in range(1, 40, 2):
        made = machine(seed, kind, driven=True)
        scene, told = made.mode.scene, made.mode.reactions(T, made.q, made.v())
        assert {*wanted_reactions(scene, table(scene))} <= told.keys()


@pytest.mark.slow
def test_the_machines_have_everything() -> None:
    """Negative control of the generator: each kind of joint, body, row and law, and all close."""
    made = [machine(seed, kind, driven=bool(seed % 2)) for kind in MAKES for seed in range(20)]
    joints = Counter(joint.kind for m in made for joint in m.joints.values())
    shapes = Counter(body.shape for m in made for body in m.bodies.values())
    rows = Counter(
        type(term).__name__
        for m in made
        for part in m.mode.permanent
        for terms in part.rows
        for term in terms
    )
    laws = {(type(f).__name__, f.signal.law) for m in made for f in m.mode.scene.signals()}
    assert min(joints[kind] for kind in ("hinge", "ball", "universal", "freedoms", "slide")) > 3
    assert shapes.keys() == {"rigid", "bar", "particle", "disk", "sphere"}
    assert rows.keys() == {"Along", "Line", "Dot", "Lowest", "Turn", "Given", "Heading"}
    assert min(rows.values()) > 3
    assert len(laws) == 6
    assert max(np.max(np.abs(m.mode.f(T, m.q)), initial=0.0) for m in made) < 1e-14  # m
