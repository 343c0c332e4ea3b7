"""Two bodies that touch or strike each other, against other derivations."""

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.scenes.pairs import PHI0, S0, TRAY, A, G, I, J, R, m
from scipy.integrate import solve_ivp

from textmech.cases.case import Case
from textmech.cases.scene.observe import observe
from textmech.cases.scene.pair import Pair
from textmech.cases.trajectory import ANGLE, OMEGA, VX, VY, X, Y
from textmech.reference.mechanism.constraints.constraint import Constraint
from textmech.reference.mechanism.constraints.constraint_terms import Apart, Around, Line, Turning
from textmech.reference.mechanism.kinematics.coordinates import Coordinates
from textmech.reference.mechanism.kinematics.kinematics import Row
from textmech.reference.mechanism.modes import unilateral as generated
from textmech.reference.mechanism.modes.mechanism import BadStart
from textmech.reference.mechanism.modes.unilateral import pair_tangent
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


def tray() -> Case:
    return scenes.parsed(TRAY, tail=scenes.tail(0.3, 16))


@pytest.mark.slow
def test_a_disk_rolls_on_a_side_that_turns_as_derived_by_hand() -> None:
    case = tray()
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
def test_a_lost_curvature_of_a_side_that_turns_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    case = tray()
    known = by_hand(case.times)
    monkeypatch.setattr(Line, "row", without_gamma(Line.row))
    found = follow(scenes.mechanism(case), case.times[:4]).y
    places = found[:, [case_column(case, "disk.x"), case_column(case, "disk.y")]]
    off = np.abs(places - np.stack([known["x"], known["y"]], axis=1)[:4])
    assert off.max() > 1e-4


@pytest.mark.mutant("a side whose turn does not move what lies on it")
def test_a_lost_lever_of_a_side_that_turns_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Then what rolls with the side starts into it."""
    monkeypatch.setattr(Line, "row", without_turn(Line.row))
    with pytest.raises(BadStart, match="touch starts into the top of tray"):
        follow(scenes.mechanism(tray()), np.array([0.0, 0.1]))


def case_column(case: Case, name: str) -> int:
    return scenes.mechanism(case).base.where.names.index(name)


KEPT = ("momentum.x", "momentum.y", "momentum.angular")


def rolls(one: float, two: float) -> Case:
    """Two free disks on each other, pulled together."""
    spring = "{spring: [one.center, two.center], stiffness: 300, rest_length: 0.2}"
    changes = f"scene: {{forces: {{coil: {spring}}}}}"
    return scenes.scene("two_disks", changes, mu=0.9, w_one=one, w_two=two)


@pytest.mark.slow
def test_two_disks_that_slip_lose_energy_and_no_momentum() -> None:
    """Friction acts on both: the angular momentum about any point stays."""
    case = rolls(9.0, 2.0)
    motion = solve(case).trajectory
    for quantity in KEPT:
        samples = observe(case.scene, motion, quantity)
        np.testing.assert_allclose(samples, samples[0], atol=1e-11)
    slip, energy = (observe(case.scene, motion, q) for q in ("touch.slip", "energy.total"))
    assert slip[0] == pytest.approx(9.0 * 0.2 + 2.0 * 0.3)
    assert abs(slip[-1]) < 1e-12  # it has come to roll
    assert np.all(np.diff(energy) < 1e-12)
    assert energy[0] - energy[-1] > 0.01


@pytest.mark.mutant("γ of two rims left out ({term.name})")
@pytest.mark.parametrize("term", [Apart, Around])
def test_a_lost_curvature_of_rims_is_seen(term: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """γ is f_a q̈ᵃ of what goes on as it does: by a difference of f_a q̇ᵃ along the straight way."""
    mechanism = scenes.mechanism(rolls(6.0, -4.0))
    name, q, v = mechanism.start()
    mode = mechanism.modes[name]
    v = v + np.array([0.0, 0.4, 0.0, 0.0, -0.7, 0.0])  # around, and apart
    rates = [mode.rows(0.0, q + h * v, v)[0] @ v for h in (-1e-5, 1e-5)]
    known = -(rates[1] - rates[0]) / 2e-5
    np.testing.assert_allclose(mode.rows(0.0, q, v)[2], known, atol=1e-8)
    monkeypatch.setattr(term, "row", without_gamma(term.row))
    planted = scenes.mechanism(rolls(6.0, -4.0))
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


def test_what_stands_on_a_block_starts_with_it() -> None:
    case = scenes.parsed(CARRIED)
    _, q, v = scenes.mechanism(case).start()
    poses = scenes.mechanism(case).base.where.poses(q, v)
    lower, upper = np.array(poses["lower"]), np.array(poses["upper"])
    x, y = upper[:2] - lower[:2]
    assert -np.sin(0.3) * x + np.cos(0.3) * y == pytest.approx(0.15)  # along the normal
    assert upper[OMEGA] == pytest.approx(0.7)
    moves = upper[[VX, VY]] - lower[[VX, VY]]
    np.testing.assert_allclose(moves, 0.7 * np.array([-y, x]), atol=1e-12)


MASSES, RADII = np.array([1.3, 0.7]), np.array([0.2, 0.3])
OBLIQUE = f"""
initial:
  one: {{vx: 1.0, vy: 0.4}}
  two: {{x: 0.8, y: 0.1, vx: -0.5, vy: 0.2}}
events: {{strikes: {{touch.gap: falls to zero}}}}
{scenes.tail(0.6, 13)}"""


def oblique(mu: float, spin: float) -> Case:
    return scenes.scene("two_disks", OBLIQUE, mu=mu, e=0.6, w_one=spin, w_two=-2.0)


def blow_by_hand(mu: float, spin: float) -> tuple[float, np.ndarray, np.ndarray, bool]:
    """When they meet, the velocities after it and the spins, and whether the slip ends.

    Λ_n = (1 + e) v_n/(1/m + 1/m'); Λ_t stops the slip, s/(1/m + 1/m' + R²/J + R'²/J'), if that is
    within μ Λ_n.
    """
    place, rate = np.array([0.8, 0.1]), np.array([-1.5, -0.2])
    a, b, c = rate @ rate, 2 * place @ rate, place @ place - 0.25
    t = float(-b - np.sqrt(b**2 - 4 * a * c)) / float(2 * a)
    n = (place + t * rate) / 0.5
    along = np.array([n[1], -n[0]])
    spins, J = np.array([spin, -2.0]), MASSES * RADII**2 / 2
    slip = rate @ along + RADII @ spins
    blow = 1.6 * -(rate @ n) / np.sum(1 / MASSES)
    stops = -slip / np.sum(1 / MASSES + RADII**2 / J)
    held = bool(abs(stops) <= mu * blow)
    rubs = stops if held else -np.sign(slip) * mu * blow
    impulse = blow * n + rubs * along
    velocities = np.array([[1.0, 0.4], [-0.5, 0.2]]) + np.outer([-1, 1], impulse) / MASSES[:, None]
    return t, velocities, spins + RADII * rubs / J, held


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
def test_the_blow_is_coulombs(mu: float, spin: float, held: bool) -> None:
    case = oblique(mu, spin)
    solution = solve(case)
    motion = solution.trajectory
    assert all(check.holds for check in solution.checks)
    t, velocities, spins, known = blow_by_hand(mu, spin)
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
    slip = pair_tangent(pair, where)
    around, own, other = slip.rows[0]
    assert isinstance(other, Turning)
    return replace(slip, rows=((around, own, Turning(other.p, -other.axis)),))


@pytest.mark.mutant("turn of the other rim counted the other way in a blow")
def test_a_wrong_lever_of_the_blow_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    case, (_, velocities, spins, _) = oblique(0.9, 6.0), blow_by_hand(0.9, 6.0)
    known = np.column_stack([velocities, spins]).ravel()
    right = follow(scenes.mechanism(case), case.times).y[-1, 6:]
    monkeypatch.setattr(generated, "pair_tangent", one_lever)
    wrong = follow(scenes.mechanism(case), case.times).y[-1, 6:]
    assert np.abs(right - known).max() < 1e-11
    assert np.abs(wrong - known).max() > 0.1
