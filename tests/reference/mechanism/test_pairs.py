"""Two bodies that touch, on a side that turns and on rims that move, against other derivations."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.pairs import PHI0, S0, TRAY, A, G, I, J, R, m
from scipy.integrate import solve_ivp

from textmech.cases.case import Case
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import ANGLE, OMEGA, VX, VY, X, Y
from textmech.reference.mechanism.constraints.constraint_terms import Apart, Around, Line
from textmech.reference.mechanism.kinematics.kinematics import Row
from textmech.reference.mechanism.modes.mechanism import BadStart
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve


def by_hand(times: np.ndarray) -> dict[str, np.ndarray]:
    """(2.44) of φ and s, the disk's place along the tray, a above its middle, with (2.16) taken in:

    T = ½ J φ̇² + ½ m ((ṡ − a φ̇)² + s² φ̇²) + ½ I (φ̇ − ṡ/R)², U = m g (s sin φ + a cos φ).
    """

    def growth(y: np.ndarray) -> np.ndarray:
        phi, s, w, u = y
        mass = [
            [J + m * A**2 + m * s**2 + I, -m * A - I / R],
            [-m * A - I / R, m + I / R**2],
        ]
        force = [
            -m * G * (s * np.cos(phi) - A * np.sin(phi)) - 2 * m * s * u * w,
            m * s * w**2 - m * G * np.sin(phi),
        ]
        return np.linalg.solve(mass, force)

    y = solve_ivp(
        lambda t, y: [*y[2:], *growth(y)], (0, times[-1]), [PHI0, S0, -1.0, 0.0], "DOP853", times,
        rtol=1e-13, atol=1e-13,
    ).y  # fmt: skip
    phi, s, w, u = y
    alpha, a = np.array([growth(row) for row in y.T]).T
    return {
        "x": s * np.cos(phi) - A * np.sin(phi),
        "y": s * np.sin(phi) + A * np.cos(phi),
        "phi": phi,
        "turned": phi - (s - S0) / R,
        "N": m * (G * np.cos(phi) + s * alpha + 2 * u * w - A * w**2),
        "F": m * (a - A * alpha - s * w**2 + G * np.sin(phi)),
    }


def tray(tmp_path: Path) -> Case:
    return scenes.typed(tmp_path, TRAY, tail=scenes.tail(0.3, 16))


@pytest.mark.slow
def test_a_disk_rolls_on_a_side_that_turns_as_derived_by_hand(tmp_path: Path) -> None:
    case = tray(tmp_path)
    solution = solve(case)
    motion, known = solution.trajectory, by_hand(case.times)
    disk = motion.states["disk"]
    assert all(check.holds for check in solution.checks)
    for column, name in ((X, "x"), (Y, "y"), (ANGLE, "turned")):
        np.testing.assert_allclose(disk[:, column], known[name], atol=1e-11)
    np.testing.assert_allclose(motion.states["tray"][:, ANGLE], known["phi"], atol=1e-11)
    np.testing.assert_allclose(motion.reactions["touch.normal"], known["N"], atol=1e-9)
    np.testing.assert_allclose(motion.reactions["touch.tangent"], known["F"], atol=1e-9)
    np.testing.assert_allclose(observe(case.scene, motion, "touch.gap"), 0.0, atol=1e-12)
    np.testing.assert_allclose(observe(case.scene, motion, "touch.slip"), 0.0, atol=1e-12)


def without_gamma(row: Any) -> Any:
    def lost(*given: Any) -> Row:
        found = row(*given)
        return Row(found.loads, found.g, 0.0)

    return lost


def without_turn(row: Any) -> Any:
    """The first body's turn does not move the second along."""

    def lost(self: Any, k: Any, ends: Any) -> Row:
        found, first = row(self, k, ends), ends[self.a].part
        loads = [(part, F, None if part is first else M) for part, F, M in found.loads]
        return Row(loads, found.g, found.gamma)

    return lost


@pytest.mark.mutant("γ of a side that turns left out")
def test_a_lost_curvature_of_a_side_that_turns_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = tray(tmp_path)
    known = by_hand(case.times)
    monkeypatch.setattr(Line, "row", without_gamma(Line.row))
    found = follow(scenes.mechanism(case), case.times[:4]).y
    places = found[:, [case_column(case, "disk.x"), case_column(case, "disk.y")]]
    off = np.abs(places - np.stack([known["x"], known["y"]], axis=1)[:4])
    assert off.max() > 1e-4


@pytest.mark.mutant("a side whose turn does not move what lies on it")
def test_a_lost_lever_of_a_side_that_turns_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Then what rolls with the side starts into it."""
    monkeypatch.setattr(Line, "row", without_turn(Line.row))
    with pytest.raises(BadStart, match="touch starts into the top of tray"):
        follow(scenes.mechanism(tray(tmp_path)), np.array([0.0, 0.1]))


def case_column(case: Case, name: str) -> int:
    return scenes.mechanism(case).base.where.names.index(name)


ROLLS = """\
scene:
  gravity: none
  bodies: {one: {disk: {mass: 1.3, radius: 0.2}}, two: {disk: {mass: 0.7, radius: 0.3}}}
  contacts: {touch: {between: [two, one], friction: 0.9}}
  forces: {coil: {spring: [one.center, two.center], stiffness: 300, rest_length: 0.2}}
initial:
  one: {x: 0, y: 0, angle: 0, vx: 0.3, vy: 0, omega: W}
  two: {x: 0.3, y: 0.4, angle: 0, vx: 0.3, vy: 0, omega: U}
allow: {one.x: 1.0e-2, two.x: 1.0e-2, touch.normal: 1.0}
"""
KEPT = ("momentum.x", "momentum.y", "momentum.angular", "energy.total")


def rolls(tmp_path: Path, one: float, two: float) -> Case:
    """Two free disks on each other, pulled together."""
    text = ROLLS.replace("W", str(one)).replace("U", str(two))
    return scenes.typed(tmp_path, text)


@pytest.mark.slow
def test_two_disks_roll_around_each_other_and_lose_nothing(tmp_path: Path) -> None:
    """R ω₁ + R' ω₂ = 0 at the start: no slip. All that free bodies keep, they keep."""
    case = rolls(tmp_path, 6.0, -4.0)
    solution = solve(case)
    motion = solution.trajectory
    assert all(check.holds for check in solution.checks)
    for quantity in KEPT:
        samples = observe(case.scene, motion, quantity)
        np.testing.assert_allclose(samples, samples[0], atol=1e-11)
    np.testing.assert_allclose(observe(case.scene, motion, "touch.slip"), 0.0, atol=1e-12)
    assert np.ptp(motion.states["two"][:, X]) > 0.1


@pytest.mark.slow
def test_two_disks_that_slip_lose_energy_and_no_momentum(tmp_path: Path) -> None:
    """Friction acts on both: the angular momentum about any point stays."""
    case = rolls(tmp_path, 9.0, 2.0)
    motion = solve(case).trajectory
    for quantity in KEPT[:3]:
        samples = observe(case.scene, motion, quantity)
        np.testing.assert_allclose(samples, samples[0], atol=1e-11)
    slip, energy = (observe(case.scene, motion, q) for q in ("touch.slip", "energy.total"))
    assert slip[0] == pytest.approx(9.0 * 0.2 + 2.0 * 0.3)
    assert abs(slip[-1]) < 1e-12  # it has come to roll
    assert np.all(np.diff(energy) < 1e-12)
    assert energy[0] - energy[-1] > 0.01


@pytest.mark.mutant("γ of two rims left out ({term.name})")
@pytest.mark.parametrize("term", [Apart, Around])
def test_a_lost_curvature_of_rims_is_seen(
    term: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """γ is f_a q̈ᵃ of what goes on as it does: by a difference of f_a q̇ᵃ along the straight way."""
    mechanism = scenes.mechanism(rolls(tmp_path, 6.0, -4.0))
    name, q, v = mechanism.start()
    mode = mechanism.modes[name]
    v = v + np.array([0.0, 0.4, 0.0, 0.0, -0.7, 0.0])  # around, and apart
    rates = [mode.rows(0.0, q + h * v, v)[0] @ v for h in (-1e-5, 1e-5)]
    known = -(rates[1] - rates[0]) / 2e-5
    np.testing.assert_allclose(mode.rows(0.0, q, v)[2], known, atol=1e-8)
    monkeypatch.setattr(term, "row", without_gamma(term.row))
    planted = scenes.mechanism(rolls(tmp_path, 6.0, -4.0))
    mode = planted.modes[planted.start()[0]]
    assert np.abs(mode.rows(0.0, q, v)[2] - known).max() > 0.1


CARRIED = """\
scene:
  gravity: none
  bodies:
    lower: {block: {mass: 2, width: 0.8, height: 0.2}}
    upper: {block: {mass: 1, width: 0.2, height: 0.1}}
  contacts:
    left: {between: [upper.lower_left, lower.top], friction: 0.5}
    right: {between: [upper.lower_right, lower.top], friction: 0.5}
initial:
  lower: {x: 0, y: 0, angle: 0.3, vx: 1.0, vy: 0.5, omega: 0.7}
  upper: {x: 0.1, angle: 0.3, on: [lower_left, lower_right]}
allow: {lower.x: 1.0e-2}
"""


def test_what_stands_on_a_block_starts_with_it(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, CARRIED)
    _, q, v = scenes.mechanism(case).start()
    poses = scenes.mechanism(case).base.where.poses(q, v)
    lower, upper = np.array(poses["lower"]), np.array(poses["upper"])
    x, y = upper[:2] - lower[:2]
    assert -np.sin(0.3) * x + np.cos(0.3) * y == pytest.approx(0.15)  # along the normal
    assert upper[OMEGA] == pytest.approx(0.7)
    moves = upper[[VX, VY]] - lower[[VX, VY]]
    np.testing.assert_allclose(moves, 0.7 * np.array([-y, x]), atol=1e-12)
