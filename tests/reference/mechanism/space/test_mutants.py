"""Mistakes planted in the mechanism generated in space, and the laws that must see each.

The laws are asked of machines that were drawn before: their places and rates are sound.
"""

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np
import pytest
from given.machine_laws import EXACT, LAWS, REDUCED
from given.random_space import MAKES, machine
from given.space_machine import Machine, T

from textmech.reference.formalisms import appell, voronets
from textmech.reference.mechanism.constraints import constraint_terms as terms
from textmech.reference.mechanism.constraints.equation_table import Table
from textmech.reference.mechanism.forces import action
from textmech.reference.mechanism.kinematics import attitude, spatial_coordinates
from textmech.reference.mechanism.kinematics.frame import SPACE, Vec
from textmech.reference.mechanism.kinematics.kinematics import Row
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody

SEEN = 1e-3  # of the largest term: a mistake, and no rounding
Patch = Callable[[pytest.MonkeyPatch], None]


@cache
def drawn() -> list[tuple[Machine, Any]]:
    """Machines of each kind with their rates, some of them driven."""
    made = [machine(seed, kind, driven=seed % 2 == 1) for kind in MAKES for seed in range(4)]
    return [(each, each.v()) for each in made]


def worst(law: str) -> float:
    """The largest violation of a law by any of the machines, each made anew."""
    anew = {id(made): SpatialMultibody(made.mode.scene, made.mode.start()) for made, _ in drawn()}
    return max(LAWS[law](anew[id(made)], T, made.q, v) for made, v in drawn())


def in_ground_axes(patch: pytest.MonkeyPatch) -> None:
    """q̇ = ½ (0, ω) ∘ q: ω as if it stood in ground axes."""

    def turned(q: Any, omega: Any) -> Any:
        return attitude.rates(q, np.einsum("kji,kj->ki", attitude.matrices(q), omega))

    patch.setattr(spatial_coordinates, "rates", turned)


def transposed(patch: pytest.MonkeyPatch) -> None:
    """E for its inverse: from ground axes to those of the body."""
    rotation = type(SPACE).rotation

    def inverse(self: Any, maths: Any, e: Any) -> Any:
        w, x, y, z = e
        return rotation(self, maths, (w, -x, -y, -z))

    patch.setattr(type(SPACE), "rotation", inverse)


def without_gyroscopic(patch: pytest.MonkeyPatch) -> None:
    """Without −ω × J ω of (2.33)."""
    patch.setattr(action.Gyroscopic, "loads", lambda self, k: [])


def as_printed(patch: pytest.MonkeyPatch) -> None:
    """Erratum 1: in the second component of (2.33) the sign before J₁ⱼ ωⱼ ω₃."""
    right = action.Gyroscopic.loads

    def printed(self: Any, k: Any) -> Any:
        ((part, F, M),) = right(self, k)
        assert M is not None
        J, omega = k.scene.bodies[self.name].tensor.tolist(), part.omega
        wrong = 2.0 * ((Vec(J[0]) @ omega) * omega[2])
        return [(part, F, M + Vec((0.0, wrong, 0.0)))]

    patch.setattr(action.Gyroscopic, "loads", printed)


def long_energies(patch: pytest.MonkeyPatch) -> None:
    """ω of a quaternion that has not the length 1, as if it had."""

    def stretched(q: Any, q_dot: Any) -> Any:
        return attitude.spin(q, q_dot) * np.sum(q * q, axis=0)

    patch.setattr(spatial_coordinates, "spin", stretched)


def long_places(patch: pytest.MonkeyPatch) -> None:
    """E of such a quaternion, as if it had."""
    rotation = type(SPACE).rotation

    def stretched(self: Any, maths: Any, e: Any) -> Any:
        squared = e[0] * e[0] + e[1] * e[1] + e[2] * e[2] + e[3] * e[3]
        return tuple(column * squared for column in rotation(self, maths, e))

    patch.setattr(type(SPACE), "rotation", stretched)


def without_arm(patch: pytest.MonkeyPatch) -> None:
    """The moment of a force about the centre is lost."""
    patch.setattr(action, "pushed", lambda k, p, F: (p.part, F, None))


def changed(kind: Any, change: Callable[[Row], Row]) -> Patch:
    """Rows of a kind with a mistake."""
    sound = kind.row
    return lambda patch: patch.setattr(kind, "row", lambda *given: change(sound(*given)))


def without_moment(row: Row) -> Row:
    """The slip of the centre for that of the rim's point."""
    return Row([(part, F, None) for part, F, _ in row.loads], row.g, row.gamma)


def without_gamma(row: Row) -> Row:
    """What f_a v̇ is without its γ."""
    return Row(row.loads, row.g, 0.0)


def on_the_other(patch: pytest.MonkeyPatch) -> None:
    """Reactions as the second part exerts them."""
    told = Table.reactions
    patch.setattr(
        Table, "reactions", lambda self, *at: {name: -x for name, x in told(self, *at).items()}
    )


# The laws that see a mistake, and one that cannot, as it is of something else.
MISTAKES: dict[str, tuple[Patch, tuple[str, ...], str]] = {
    "spin in ground axes": (in_ground_axes, ("lagrangian",), "bodies"),
    "transposed attitude": (transposed, ("bodies", "lowest points"), "lengths"),
    "no gyroscopic moment": (without_gyroscopic, ("lagrangian", "bodies"), "lengths"),
    "(2.33) as printed": (as_printed, ("lagrangian", "bodies", "balance"), "lengths"),
    "energies of long quaternions": (long_energies, ("lengths",), "lagrangian"),
    "places of long quaternions": (long_places, ("lengths",), "lagrangian"),
    "a force without its arm": (without_arm, ("bodies",), "lengths"),
    "slip of the centre": (
        changed(terms.Lowest, without_moment), ("lowest points", "bodies"), "lengths",
    ),
    "reactions on the other": (on_the_other, ("bodies",), "multipliers"),
} | {
    f"no gamma of {kind.__name__}": (
        changed(kind, without_gamma), ("lagrangian", "multipliers"), "bodies",
    )
    for kind in (terms.Along, terms.Dot, terms.Line, terms.Lowest, terms.Given, terms.Heading)
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("law", LAWS)
def test_the_laws_hold_where_nothing_is_planted(law: str) -> None:
    assert worst(law) < EXACT


@pytest.mark.slow
@pytest.mark.mutant("{mistake}")
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_planted_mistake_is_seen(mistake: str, monkeypatch: pytest.MonkeyPatch) -> None:
    plant, laws, blind = MISTAKES[mistake]
    drawn()
    plant(monkeypatch)
    for law in laws:
        assert worst(law) > SEEN, law
    assert worst(blind) < EXACT


@pytest.mark.slow
@pytest.mark.mutant("sign of β in (2.65), in what rolls and in what has a blade")
@pytest.mark.parametrize("kind", MAKES)
def test_the_sign_of_beta_is_seen(kind: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """(2.65): where rates cannot be integrated; elsewhere β is zero. Appell knows no β."""
    right = voronets.beta
    monkeypatch.setattr(voronets, "beta", lambda *at: -right(*at))
    mine = [(made, v) for made, v in drawn() if kind == made.kind]
    by = {form: [REDUCED[form](m.mode, T, m.q, v) or 0.0 for m, v in mine] for form in REDUCED}
    assert max(by[appell]) < EXACT
    if kind in ("rolling", "blade"):
        assert max(by[voronets]) > SEEN
    else:
        assert max(by[voronets]) < EXACT
