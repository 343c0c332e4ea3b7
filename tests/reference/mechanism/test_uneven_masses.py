"""Masses that differ by many powers of ten: what a light link would lose in common coordinates."""

from dataclasses import replace
from pathlib import Path

import mpmath
import numpy as np
import pytest
from given import random_scenes, scenes

from textmech.cases.fields import number
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Body, Scene
from textmech.reference.formalisms.energy import power_balance
from textmech.reference.integrators.explicit import dormand_prince
from textmech.reference.mechanism.modes import blow
from textmech.reference.mechanism.modes import impact as impacts
from textmech.reference.mechanism.modes import mode as module
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve
from textmech.reference.system import Array

PENDULUM = """\
scene:
  points: {O: [0, 0]}
  bodies: {rod: {bar: {mass: LIGHT, length: 1}}, bob: {particle: {mass: HEAVY}}}
  joints: {top: {pin: [ground.O, rod.start]}, knot: {pin: [rod.end, bob.center]}}
initial: {rod: {angle: 30 deg}}
allow: {rod.angle: 1.0e-3}
"""
THROWN = """\
scene:
  bodies: {rod: {bar: {mass: 1.0e-6, length: 1}}, bob: {particle: {mass: 1}}}
  joints: {knot: {pin: [rod.end, bob.center]}}
  contacts: {touch: {between: [bob, ground.floor], friction: 0, restitution: 1}}
initial: {rod: {angle: 30 deg, omega: 3}, bob: {x: 0, y: 1, vx: 0, vy: 0}}
events: {bounces: {touch.gap: falls to zero}}
allow: {bob.y: 1.0e-3}
"""


def exact(mode: Multibody, t: float, q: Array, v: Array) -> Array:
    """(2.60) M q̈ − f_aᵇ λ_b = Q, f_aᵇ q̈ᵃ = γᵇ with fifty digits, from the same numbers."""
    rows, _, gamma = mode.rows(t, q, v)
    n, r = len(q), len(rows)
    matrix, right = mpmath.zeros(n + r, n + r), mpmath.zeros(n + r, 1)
    Q = mode.applied(t, q, v)
    with mpmath.workdps(50):
        for i in range(n):
            matrix[i, i], right[i] = mode.where.masses[i], Q[i]
        for k in range(r):
            right[n + k] = gamma[k]
            for i in range(n):
                matrix[n + k, i], matrix[i, n + k] = rows[k, i], -rows[k, i]
        solution = mpmath.lu_solve(matrix, right)
    return np.array([float(x) for x in solution[:n]])


def uneven(scene: Scene, random: np.random.Generator) -> Scene:
    """The same bodies with masses from a tenth of a gram to ten tons, and nothing but weight."""

    def other(body: Body) -> Body:
        factor = 10.0 ** random.uniform(-4.0, 4.0)
        inertia = tuple(J * factor for J in body.inertia)
        return replace(body, mass=body.mass * factor, inertia=inertia)

    return replace(scene, bodies={k: other(b) for k, b in scene.bodies.items()}, forces={})


def errors(count: int) -> list[float]:
    """Of the accelerations of random mechanisms, relative to the largest, or to gravity."""
    found = []
    for base, random in random_scenes.mechanisms(count, seed=7):
        mode = Multibody(uneven(base.scene, random), base.start())
        if len(mode.f_a(0.0, mode.start()[0])) >= len(mode.coordinates):
            continue  # held: nothing is left to move
        t, q, v = random_scenes.state(random, mode)
        known = exact(mode, t, q, v)
        size = max(np.abs(known).max(), 9.80665)
        found.append(float(np.abs(mode.accelerations(t, q, v) - known).max() / size))
    return found


@pytest.mark.slow
def test_accelerations_of_uneven_mechanisms():
    assert len(found := errors(40)) > 15
    assert max(found) < 1e-12


@pytest.mark.slow
@pytest.mark.mutant("accelerations of uneven masses without refinement")
def test_without_refinement_digits_are_lost(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(module, "TURNS", 0)
    assert max(errors(40)) > 1e-10


@pytest.mark.parametrize(("light", "heavy"), [(1e-6, 1.0), (1e-3, 1e6), (1e6, 1e-3)])
def test_a_pendulum_of_a_rod_and_a_bob(tmp_path: Path, light: float, heavy: float):
    """(m_b + m_r/3) l φ̈ = −(m_b + m_r/2) g cos φ: one degree of freedom knows it as well."""
    text = PENDULUM.replace("LIGHT", str(light)).replace("HEAVY", str(heavy))
    case = scenes.typed(tmp_path, text)
    mechanism = scenes.mechanism(case)
    found = follow(mechanism, case.times)
    pull = 9.80665 * (heavy + light / 2) / (heavy + light / 3)
    known = dormand_prince(
        lambda t, y: np.array([y[1], -pull * np.cos(y[0])]), case.times, [np.pi / 6, 0.0]
    )
    phi = mechanism.base.coordinates.index("rod.angle")
    np.testing.assert_allclose(found.y[:, phi], known.y[:, 0], atol=1e-13)
    [mode] = mechanism.modes.values()
    q, v = np.split(found.y[-1], 2)
    assert abs(power_balance(mode, 1.0, q, v)) < 1e-12 * max(light, heavy)


@pytest.mark.parametrize("angle", [30, 77, -140])
def test_ten_digits_are_found_again(angle: int, tmp_path: Path):
    """A rod of 1e-10 of its bob's mass: one turn of refinement leaves 2e-12 and more."""
    text = PENDULUM.replace("LIGHT", "1.0e-10").replace("HEAVY", "1").replace("30", str(angle))
    mode = scenes.mechanism(scenes.typed(tmp_path, text)).base
    found = mode.accelerations(0.0, *mode.start())[mode.coordinates.index("rod.angle")]
    pull = 9.80665 * (1 + 1e-10 / 2) / (1 + 1e-10 / 3)
    assert found == pytest.approx(-pull * np.cos(np.radians(angle)), rel=1e-14)  # 45 roundings


def energies(tmp_path: Path) -> Array:
    case = scenes.typed(tmp_path, THROWN)
    mechanism = scenes.mechanism(case)
    found = follow(mechanism, case.times)
    assert len(found.changes) >= 1
    states = [(mechanism.base, *np.split(y, 2)) for y in found.y]
    return np.array([mode.T(0.0, q, v) + mode.U(0.0, q) for mode, q, v in states])


def test_a_bob_on_a_light_rod_bounces(tmp_path: Path):
    """e = 1 without friction: the energy stays, of the rod's milligram too."""
    found = energies(tmp_path)
    np.testing.assert_allclose(found, found[0], rtol=1e-14)


@pytest.mark.mutant("impact of uneven masses without refinement")
def test_rows_after_an_impact(monkeypatch: pytest.MonkeyPatch):
    """f_a q̇⁺ = what it shall be, to rounding of the velocities; without refinement it is not."""
    random = np.random.default_rng(seed=2)
    f = random.standard_normal((4, 6))
    masses = np.array([1e-6, 1e-6, 1e-7, 1.0, 1.0, 1.0])
    joints = [blow.Condition(row, 0.0) for row in f]
    v = random.standard_normal(6)
    taken, _ = impacts.impact(masses, joints, [], v)
    assert np.abs(f @ taken.v).max() < 1e-15 * 10
    monkeypatch.setattr(blow, "TURNS", 0)
    coarse, _ = impacts.impact(masses, joints, [], v)
    assert np.abs(f @ coarse.v).max() > 1e-12


FIELD = """\
scene:
  gravity: none
  bodies: {electron: {particle: {mass: 9.1093837e-31}}}
  forces: {field: {magnetic: electron, charge: 1.602176634e-19, along_z: 2.84e-11}}
initial: {electron: {x: 0, y: 0, vx: 2.0, vy: 0}}
allow: {electron.x: 1.0e-3, electron.vy: 1.0e-3, energy.kinetic: 1.0e-33}
"""


@pytest.mark.slow
def test_an_electron_moves_by_its_own_numbers(tmp_path: Path) -> None:
    """Exercise 2.4's particle: round in 2 π m/(e B) = 1.26 s, and its speed stays."""
    case = scenes.typed(tmp_path, FIELD)
    solution = solve(case)
    assert [check for check in solution.checks if not check.holds] == []
    turned = 1.602176634e-19 * 2.84e-11 / 9.1093837e-31 * case.times  # clockwise: v × B
    state = solution.trajectory.states["electron"]
    np.testing.assert_allclose(state[:, 3], 2.0 * np.cos(turned), atol=1e-12)
    np.testing.assert_allclose(state[:, 4], -2.0 * np.sin(turned), atol=1e-12)


@pytest.mark.mutant("an electron is too light to be computed with")
def test_a_limit_above_an_electrons_mass_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(number, "SMALLEST", 1e-30)
    with pytest.raises(CaseError, match=r"must be 0 or from 1e-30 to 1e\+30 in SI"):
        scenes.typed(tmp_path, FIELD)
