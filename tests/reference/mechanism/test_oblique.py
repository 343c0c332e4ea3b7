"""Two disks that strike obliquely, with friction and spin: Coulomb's impulse by hand."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.cases.case import Case
from textmech.cases.scene.observe import observe
from textmech.cases.scene.pair import Pair
from textmech.reference.mechanism.constraints.constraint import Constraint
from textmech.reference.mechanism.constraints.constraint_terms import Turning
from textmech.reference.mechanism.kinematics.coordinates import Coordinates
from textmech.reference.mechanism.modes import unilateral as generated
from textmech.reference.mechanism.modes.unilateral import along
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve

M, R = np.array([1.3, 0.7]), np.array([0.2, 0.3])
TEXT = """\
scene:
  gravity: none
  bodies: {one: {disk: {mass: 1.3, radius: 0.2}}, two: {disk: {mass: 0.7, radius: 0.3}}}
  contacts: {touch: {between: [two, one], friction: MU, restitution: 0.6}}
initial:
  one: {x: 0, y: 0, angle: 0, vx: 1.0, vy: 0.4, omega: SPIN}
  two: {x: 0.8, y: 0.1, angle: 0, vx: -0.5, vy: 0.2, omega: -2.0}
events: {strikes: {touch.gap: falls to zero}}
allow: {one.x: 1.0e-2, one.angle: 1.0e-2, two.y: 1.0e-2, two.angle: 1.0e-2}
"""


def oblique(tmp_path: Path, mu: float, spin: float) -> Case:
    text = TEXT.replace("MU", str(mu)).replace("SPIN", str(spin))
    return scenes.typed(tmp_path, text, tail=scenes.tail(0.6, 13))


def by_hand(mu: float, spin: float) -> tuple[float, np.ndarray, np.ndarray, bool]:
    """When they meet, the velocities after it and the spins, and whether the slip ends.

    Λ_n = (1 + e) v_n/(1/m + 1/m'); Λ_t stops the slip, s/(1/m + 1/m' + R²/J + R'²/J'), if that is
    within μ Λ_n.
    """
    place, rate = np.array([0.8, 0.1]), np.array([-1.5, -0.2])
    a, b, c = rate @ rate, 2 * place @ rate, place @ place - 0.25
    t = float(-b - np.sqrt(b**2 - 4 * a * c)) / float(2 * a)
    n = (place + t * rate) / 0.5
    along = np.array([n[1], -n[0]])
    spins, J = np.array([spin, -2.0]), M * R**2 / 2
    slip = rate @ along + R @ spins
    blow = 1.6 * -(rate @ n) / np.sum(1 / M)
    stops = -slip / np.sum(1 / M + R**2 / J)
    held = bool(abs(stops) <= mu * blow)
    rubs = stops if held else -np.sign(slip) * mu * blow
    impulse = blow * n + rubs * along
    velocities = np.array([[1.0, 0.4], [-0.5, 0.2]]) + np.outer([-1, 1], impulse) / M[:, None]
    return t, velocities, spins + R * rubs / J, held


@pytest.mark.parametrize(
    ("mu", "spin", "held"),
    [
        (0.0, 6.0, False),
        (0.1, 6.0, True),
        (0.1, -9.0, False),
        (0.1, 40.0, False),
        (0.9, -9.0, True),
    ],
)
def test_the_blow_is_coulombs(mu: float, spin: float, held: bool, tmp_path: Path) -> None:
    case = oblique(tmp_path, mu, spin)
    solution = solve(case)
    motion = solution.trajectory
    assert all(check.holds for check in solution.checks)
    t, velocities, spins, known = by_hand(mu, spin)
    assert known is held
    for body, velocity, omega in zip(("one", "two"), velocities, spins, strict=True):
        np.testing.assert_allclose(motion.states[body][-1, 3:5], velocity, atol=1e-12)
        assert motion.states[body][-1, 5] == pytest.approx(omega, abs=1e-11)
        before = motion.states[body][0, :2] + t * motion.states[body][0, 3:5]
        place = before + (case.duration - t) * velocity
        np.testing.assert_allclose(motion.states[body][-1, :2], place, atol=1e-12)
    for quantity in ("momentum.x", "momentum.y", "momentum.angular"):
        samples = observe(case.scene, motion, quantity)
        np.testing.assert_allclose(samples, samples[0], atol=1e-12)


def one_lever(pair: Pair, where: Coordinates) -> Constraint:
    """The mutant: the other rim's turn is counted the other way."""
    slip = along(pair, where)
    around, own, other = slip.rows[0]
    assert isinstance(other, Turning)
    return replace(slip, rows=((around, own, Turning(other.p, -other.axis)),))


@pytest.mark.mutant("turn of the other rim counted the other way in a blow")
def test_a_wrong_lever_of_the_blow_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    case, (_, velocities, spins, _) = oblique(tmp_path, 0.9, 6.0), by_hand(0.9, 6.0)
    known = np.column_stack([velocities, spins]).ravel()
    right = follow(scenes.mechanism(case), case.times).y[-1, 6:]
    monkeypatch.setattr(generated, "along", one_lever)
    wrong = follow(scenes.mechanism(case), case.times).y[-1, 6:]
    assert np.abs(right - known).max() < 1e-11
    assert np.abs(wrong - known).max() > 0.1
