"""A pin in a slot, the joint that leaves both freedoms, against equations derived by hand."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes
from scipy.integrate import solve_ivp

from textmech.cases.scene.joint import FREEDOMS
from textmech.cases.trajectory import ANGLE, OMEGA, VX, X
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.solve import solve

G = 9.80665
M, L, PHI0, OMEGA0, V0 = 1.2, 0.8, 0.3, 1.5, 0.4
SCENE = f"""\
scene:
  points: {{O: [0.1, 0]}}
  bodies: {{rod: {{bar: {{mass: {M}, length: {L}}}}}}}
  joints: {{guide: {{slot: [ground.O, rod.start], along: [1, 0]}}}}
initial: {{rod: {{x: 0.5, angle: {PHI0}, vx: {V0}, omega: {OMEGA0}}}}}
allow: {{rod.x: 1.0e-2, rod.angle: 1.0e-2, guide.fx: 1.0, guide.fy: 1.0, guide.gap: 1.0e-4}}
"""


def by_hand(t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Angle, rate and the slot's upward force [N] on the rod.

    The smooth slot pushes only across: ẍ_c = 0. About the centre J φ̈ = −F (l/2) cos φ, and with
    y_c = (l/2) sin φ: F = m (g + ÿ_c), so that
    (J + m l²/4 cos² φ) φ̈ = m l/2 cos φ ((l/2) sin φ φ̇² − g).
    """
    r, J = L / 2, M * L**2 / 12

    def rates(t: float, y: np.ndarray) -> list[float]:
        phi, omega = y
        c, s = np.cos(phi), np.sin(phi)
        return [omega, M * r * c * (r * s * omega**2 - G) / (J + M * r**2 * c**2)]

    y = solve_ivp(rates, (0, t[-1]), [PHI0, OMEGA0], "DOP853", t, rtol=1e-13, atol=1e-13).y
    phi, omega = y
    alpha = np.array([rates(0.0, row)[1] for row in y.T])
    F = M * (G + r * (np.cos(phi) * alpha - np.sin(phi) * omega**2))
    return phi, omega, F


@pytest.mark.slow
def test_a_rod_in_a_slot_moves_as_derived_by_hand(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, SCENE)
    solution = solve(case)
    assert all(check.holds for check in solution.checks)
    rod, found = solution.trajectory.states["rod"], solution.trajectory.reactions
    phi, omega, F = by_hand(case.times)
    np.testing.assert_allclose(rod[:, ANGLE], phi, atol=1e-10)
    np.testing.assert_allclose(rod[:, OMEGA], omega, atol=1e-9)
    np.testing.assert_allclose(rod[:, X], 0.5 + V0 * case.times, atol=1e-11)
    np.testing.assert_allclose(rod[:, VX], V0, atol=1e-11)
    np.testing.assert_allclose(found["guide.fy"], F, atol=1e-8)
    np.testing.assert_allclose(found["guide.fx"], 0.0, atol=1e-8)


@pytest.mark.mutant("a slot that holds the {lost} of its pin")
@pytest.mark.parametrize("lost", ["turn", "shift"])
def test_without_one_of_its_freedoms_it_moves_differently(
    lost: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The mutant: the word in the table is all that the generated reference knows."""
    case = scenes.typed(tmp_path, SCENE)
    t, q, v = 0.0, np.array([0.5, 0.1, PHI0]), np.array([V0, 0.0, 0.0])
    free = Multibody(case.scene, (q, v)).accelerations(t, q, v)
    left = tuple(freedom for freedom in FREEDOMS["slot"] if freedom.kind != lost)
    monkeypatch.setitem(FREEDOMS, "slot", left)
    held = Multibody(scenes.typed(tmp_path, SCENE).scene, (q, v)).accelerations(t, q, v)
    assert np.abs(free - held).max() > 1e-2
