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
from textmech.reference.mechanism.constraints.space import blades, rolling
from textmech.reference.mechanism.constraints.space import constraint_jacobian as assembled
from textmech.reference.mechanism.constraints.space import constraint_terms as rows
from textmech.reference.mechanism.forces.space import action
from textmech.reference.mechanism.kinematics.space import attitude, coordinates, kinematics
from textmech.reference.mechanism.modes.space import mode
from textmech.reference.mechanism.modes.space.mode import SpatialMultibody

SEEN = 1e-3  # of the largest term: a mistake, and no rounding
Patch = Callable[[pytest.MonkeyPatch], None]


@cache
def drawn() -> list[tuple[Machine, Any]]:
    """Machines of each kind with their rates, some of them driven."""
    made = [machine(seed, kind, driven=seed % 2 == 1) for kind in MAKES for seed in range(4)]
    return [(each, each.v()) for each in made]


def worst(law: str) -> float:
    """The largest violation of a law by any of the machines."""
    return max(LAWS[law](made.mode, T, made.q, v) for made, v in drawn())


def in_ground_axes(patch: pytest.MonkeyPatch) -> None:
    """q̇ = ½ (0, ω) ∘ q: ω as if it stood in ground axes."""
    patch.setattr(
        coordinates, "rates",
        lambda q, omega: attitude.rates(q, kinematics.back(attitude.matrices(q), omega)),
    )  # fmt: skip


def transposed(patch: pytest.MonkeyPatch) -> None:
    """E for its inverse: from ground axes to those of the body."""
    patch.setattr(kinematics, "matrices", lambda q: attitude.matrices(q).swapaxes(1, 2))


def without_gyroscopic(patch: pytest.MonkeyPatch) -> None:
    """Without −ω × J ω of (2.33)."""
    patch.setattr(SpatialMultibody, "_gyroscopic", lambda self, v, Q: None)


def as_printed(patch: pytest.MonkeyPatch) -> None:
    """Erratum 1: in the second component of (2.33) the sign before J₁ⱼ ωⱼ ω₃."""
    right = SpatialMultibody._gyroscopic

    def printed(self: SpatialMultibody, v: Any, Q: Any) -> None:
        right(self, v, Q)
        for at, J in zip(self.where.spins, self._J, strict=True):
            Q[at[1]] += 2 * (J @ v[at])[0] * v[at[2]]

    patch.setattr(SpatialMultibody, "_gyroscopic", printed)


def long_energies(patch: pytest.MonkeyPatch) -> None:
    """ω of a quaternion that has not the length 1, as if it had."""
    patch.setattr(mode, "spin", lambda q, q_dot: attitude.spin(q, q_dot) * np.sum(q * q, axis=0))


def long_places(patch: pytest.MonkeyPatch) -> None:
    """E of such a quaternion, as if it had."""

    def stretched(q: Any) -> Any:
        return attitude.matrices(q) * np.sum(q * q, axis=1)[:, None, None]

    patch.setattr(kinematics, "matrices", stretched)


def without_arm(patch: pytest.MonkeyPatch) -> None:
    """The moment of a force about the centre is lost."""
    patch.setattr(action, "_cross", lambda a, b: 0.0 * b)


def at_the_centre(patch: pytest.MonkeyPatch) -> None:
    """The slip of the centre for that of the rim's point."""
    patch.setattr(rolling, "skew", lambda rho: 0.0 * attitude.skew(rho))


def on_the_other(patch: pytest.MonkeyPatch) -> None:
    """Reactions as the second part exerts them."""
    told = assembled.SpatialRows.reactions
    patch.setattr(
        assembled.SpatialRows, "reactions",
        lambda self, *at: {name: -x for name, x in told(self, *at).items()},
    )  # fmt: skip


def without_gamma(kind: Any) -> Patch:
    """What f_a v̇ is without its γ."""
    values = kind.values

    def lost(self: Any, t: Any, bodies: Any) -> Any:
        entries, g, gamma = values(self, t, bodies)
        return entries, g, 0.0 * gamma

    return lambda patch: patch.setattr(kind, "values", lost)


# The laws that see a mistake, and one that cannot, as it is of something else.
MISTAKES: dict[str, tuple[Patch, tuple[str, ...], str]] = {
    "spin in ground axes": (in_ground_axes, ("lagrangian",), "bodies"),
    "transposed attitude": (transposed, ("bodies", "lowest points"), "lengths"),
    "no gyroscopic moment": (without_gyroscopic, ("lagrangian", "bodies"), "lengths"),
    "(2.33) as printed": (as_printed, ("lagrangian", "bodies", "balance"), "lengths"),
    "energies of long quaternions": (long_energies, ("lengths",), "lagrangian"),
    "places of long quaternions": (long_places, ("lengths",), "lagrangian"),
    "a force without its arm": (without_arm, ("bodies",), "lengths"),
    "slip of the centre": (at_the_centre, ("lowest points", "bodies"), "lengths"),
    "reactions on the other": (on_the_other, ("bodies",), "multipliers"),
} | {
    f"no gamma of {kind.__name__}": (without_gamma(kind), ("lagrangian", "multipliers"), "bodies")
    for kind in (rows.Points, rows.Dots, rows.Lines, rolling.Rims, rolling.Drives, blades.Blades)
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
