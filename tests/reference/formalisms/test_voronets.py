"""Voronets, Chaplygin and Appell: what is left when the multipliers are gone."""

from collections.abc import Callable
from types import ModuleType
from typing import Any

import numpy as np
import pytest
from given.laws import At, difference
from given.machines.examples import MODES, example
from given.machines.formal import EXACT, FORMAL, drawn
from given.machines.states import states
from given.mutants import mutant

from textmech.reference.formalisms import appell, chaplygin, voronets
from textmech.reference.formalisms.dependent import Dependent, dependent
from textmech.reference.system import Mode

FORMS = {"voronets": voronets, "chaplygin": chaplygin, "appell": appell}
# Which apply to a mode: the ingredients tell. Chaplygin's need coordinates that appear nowhere, as
# many as there are dependent rates: those of a quaternion appear everywhere.
APPLY = {
    "free body": {"voronets", "appell"},
    "top": {"voronets", "appell"},
} | {name: set(FORMS) for name in FORMAL if "sleigh" in name or "wheel" in name}
FREE, BOUND = {"appell"}, {"voronets", "appell"}
SHIPPED: dict[At, set[str]] = dict.fromkeys(MODES, FREE) | {
    ("four_bar", "moving"): BOUND,
    ("rolling_wheel", "moving"): set(FORMS),
    **{(name, "moving"): set(FORMS) for name in ("driven_edge", "knife_edge", "sleigh")},
    ("sliding_disk", "rolling"): set(FORMS),
    ("sliding_disk", "slips backward"): set(FORMS),
    ("sliding_disk", "slips forward"): set(FORMS),
    ("stacked_blocks", "together"): set(FORMS),
    ("stacked_blocks", "on top"): set(FORMS),
    ("ball_on_rope", "swings"): BOUND,
    ("disk_on_disk", "rolls"): BOUND,
    ("disk_on_disk", "slips"): BOUND,
}
NOTHING_FREE = ("rest", "rests", "stuck", "sticks")
HELD = ("driven_knee", "moving"), ("tipping_block", "stands")
# Where one leg stands, or leans, no place appears: one rate gives the other.
WALKERS = ("compass_walker", "light_feet")
LEANS = [at for at in MODES if at[0] in WALKERS or at == ("sliding_ladder", "leans")]
SHIPPED |= {at: set(FORMS) for at in LEANS}
SHIPPED |= {at: set() for at in MODES if at[1] in NOTHING_FREE or at in HELD}


def apart(form: ModuleType, mode: Mode, at: Any) -> float | None:
    """From the accelerations by hand, relative to them or 1 m/s²; None if it does not apply."""
    found = form.accelerations(mode, *at)
    return None if found is None else difference(mode.accelerations(*at), found, 1.0)


def worst(form: ModuleType, name: str, count: int, mode: Mode | None = None) -> float:
    """Of the modes of `given.machines.formal`."""
    found = [apart(form, mode or FORMAL[name], at) for at in drawn(name, count)]
    return max(x for x in found if x is not None)


@pytest.mark.slow
@pytest.mark.parametrize("name", FORMAL)
def test_formalisms_agree(name: str) -> None:
    for key, form in FORMS.items():
        found = [apart(form, FORMAL[name], at) for at in drawn(name)]
        assert {x is not None for x in found} == {key in APPLY[name]}, key
        assert all(x is None or x < EXACT for x in found), key


@pytest.mark.slow
@pytest.mark.parametrize("at", MODES, ids=".".join)
def test_formalisms_agree_on_written_systems(at: At) -> None:
    mode = example(at[0]).modes[at[1]]
    for key, form in FORMS.items():
        found = [apart(form, mode, state) for state in states(*at, 100)]
        assert {x is not None for x in found} == {key in SHIPPED[at]}, key
        assert all(x is None or x < EXACT for x in found), key


Planted = Callable[[pytest.MonkeyPatch], None]


def _sign_of_beta(patch: pytest.MonkeyPatch) -> None:
    beta = voronets.beta
    patch.setattr(voronets, "beta", lambda *at: -beta(*at))


def _without_drives(patch: pytest.MonkeyPatch) -> None:
    drives = voronets.drives
    patch.setattr(voronets, "drives", lambda *at: 0.0 * drives(*at))


def _momentum_of_the_reduced_energy(patch: pytest.MonkeyPatch) -> None:
    """T' has no q̇^{a2} (erratum 7)."""
    patch.setattr(voronets, "momentum", lambda mode, t, q, q_dot, **_: 0.0 * q_dot)


@pytest.mark.mutant("Voronets, {name}: {plant}")
@pytest.mark.parametrize(
    ("plant", "name"),
    [
        (_sign_of_beta, "sleigh"),
        (_sign_of_beta, "sleigh on a driven blade"),
        (_without_drives, "sleigh on a driven blade"),
        (_momentum_of_the_reduced_energy, "sleigh"),
    ],
)
def test_mistake_in_voronets_is_seen(
    plant: Planted, name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert worst(voronets, name, 10) < EXACT
    plant(monkeypatch)
    assert worst(voronets, name, 10) > 1e-3


def test_the_upright_wheel_does_not_see_the_sign_of_beta(monkeypatch: pytest.MonkeyPatch) -> None:
    """Erratum 7: its centre of mass goes along the heading, across which β acts."""
    _sign_of_beta(monkeypatch)
    assert worst(voronets, "upright wheel", 10) < EXACT


def test_beta_of_the_sleigh_by_hand() -> None:
    """(2.65) ẏ = tan θ ẋ: β_xθ = ∂ tan θ/∂θ = 1/cos² θ = −β_θx."""
    t, q, _ = next(drawn("sleigh"))
    by = dependent(FORMAL["sleigh"], t, q, 3, [1])
    assert by is not None
    np.testing.assert_allclose(by.alpha(t, q), [[np.tan(q[2]), 0.0]], rtol=1e-14, atol=1e-15)
    beta = 1 / np.cos(q[2]) ** 2
    _, bends = voronets.slopes_of(by, t, q, np.ones(2))
    found = voronets.beta(by, by.alpha(t, q), bends)
    np.testing.assert_allclose(found, [[[0.0, beta], [-beta, 0.0]]], rtol=1e-13, atol=1e-15)


@pytest.mark.parametrize("among", [[0], [1], [0, 1]])
def test_the_choice_of_dependent_rates_is_free(among: list[int]) -> None:
    mode = FORMAL["sleigh on a driven blade"]
    for t, q, v in drawn("sleigh on a driven blade", 10):
        if min(abs(np.sin(q[2] + 0.3 * t * t)), abs(np.cos(q[2] + 0.3 * t * t))) < 0.1:
            continue  # near there ẋ or ẏ says nothing of the other
        for form in (voronets, appell):
            found = form.accelerations(mode, t, q, v, among)
            assert found is not None
            assert difference(mode.accelerations(t, q, v), found, 1.0) < 10 * EXACT


def test_what_is_not_determined_cannot_be_dependent() -> None:
    """A blade says nothing of how the sleigh turns."""
    at = next(drawn("sleigh"))
    for form in (voronets, appell):
        assert form.accelerations(FORMAL["sleigh"], *at, [2]) is None
    assert voronets.accelerations(FORMAL["sleigh"], *at, []) is None


def test_constraints_that_say_the_same_twice_determine_nothing() -> None:
    sound = FORMAL["sleigh"]

    def f_a(self: Mode, t: Any, q: Any) -> Any:
        return np.concatenate([sound.f_a(t, q), 2.0 * sound.f_a(t, q)])

    t, q, v = next(drawn("sleigh"))
    assert dependent(mutant(sound, f_a=f_a), t, q, len(v)) is None


def test_chaplygin_needs_what_depends_on_nothing_that_it_leaves_out() -> None:
    """A sleigh whose blade turns with its place, or that is heavier farther along."""
    sound = FORMAL["sleigh"]

    def f_a(self: Mode, t: Any, q: Any) -> Any:
        return sound.f_a(t, q + np.array([0.0, 0.0, q[0] + 2 * q[1]]))

    def T(self: Mode, t: Any, q: Any, v: Any) -> Any:
        return sound.T(t, q, v) * (1 + (q[0] + 2 * q[1]) ** 2)

    at = next(drawn("sleigh"))
    assert chaplygin.ignorable(sound, *at) == [0, 1]
    for changed in (mutant(sound, f_a=f_a), mutant(sound, T=T)):
        assert chaplygin.accelerations(changed, *at) is None


@pytest.mark.parametrize("share", [1e-3, 1e-10])
@pytest.mark.parametrize("part", ["T", "f_a"])
def test_a_small_dependence_is_one(part: str, share: float) -> None:
    """Chaplygin's equations would be wrong by as much, and pass for another law."""
    sound = FORMAL["sleigh"]
    changed = {
        "T": lambda self, t, q, v: sound.T(t, q, v) * (1 + share * (q[0] + 2 * q[1])),
        "f_a": lambda self, t, q: sound.f_a(t, q + share * np.array([0, 0, 1]) * (q[0] + 2 * q[1])),
    }
    for at in drawn("sleigh", 10):
        mode = mutant(sound, **{part: changed[part]})
        assert chaplygin.ignorable(mode, *at) == []
        assert chaplygin.accelerations(mode, *at) is None


@pytest.mark.mutant("a dependence of 1e-10 taken for none")
def test_a_coarse_sense_of_dependence_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(chaplygin, "ROUNDING", 1e-8)
    for part in ("T", "f_a"):
        with pytest.raises(AssertionError):
            test_a_small_dependence_is_one(part, 1e-10)


def test_rates_of_the_independent_ones_meet_the_constraints() -> None:
    for name in ("sleigh on a driven blade", "upright wheel", "free body"):
        mode = FORMAL[name]
        for t, q, v in drawn(name, 5):
            q_dot, by = mode.rates(t, q, v), dependent(mode, t, q, len(v))
            assert isinstance(by, Dependent)
            np.testing.assert_allclose(by.rates(t, q, q_dot[by.a1]), q_dot, atol=1e-13)
            np.testing.assert_allclose(by.velocities(t, q, q_dot[by.a1]), v, atol=1e-13)


@pytest.mark.mutant("Appell: gyroscopic part of the energy left out")
def test_appell_needs_the_gyroscopic_part_of_the_energy(monkeypatch: pytest.MonkeyPatch) -> None:
    gyroscopic = appell.gyroscopic
    monkeypatch.setattr(appell, "gyroscopic", lambda mass, pose: 0.0 * gyroscopic(mass, pose))
    assert worst(appell, "top", 3) > 1e-3
