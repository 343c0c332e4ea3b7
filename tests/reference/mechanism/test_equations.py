"""The equations (2.60) of long chains by their band, and of masses that differ by powers of ten."""

from contextlib import suppress
from dataclasses import replace

import mpmath
import numpy as np
import pytest
from given import scenes
from given.adapters.engine_scenes import chain
from given.machines import random_machines

from textmech.cases.fields import number
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Anchor, Body, Scene, planar_joint
from textmech.reference.formalisms import lagrange
from textmech.reference.formalisms.energy import power_balance
from textmech.reference.integrators.explicit import dormand_prince
from textmech.reference.mechanism.constraints.constraint_solver import band
from textmech.reference.mechanism.constraints.equation_table import Rows, Table
from textmech.reference.mechanism.constraints.joint_constraints import constraints
from textmech.reference.mechanism.kinematics.coordinates import Coordinates
from textmech.reference.mechanism.modes import blow
from textmech.reference.mechanism.modes import impact as impacts
from textmech.reference.mechanism.modes import mode as module
from textmech.reference.mechanism.modes.mode import Multibody, SingularPose
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve
from textmech.reference.system import Array

BAND = 1e-11  # of the largest: the condition of long chains is up to 1e4


def shuffled(scene: Scene, seed: int = 1) -> Scene:
    """The same joints in another order."""
    names = np.random.default_rng(seed).permutation(list(scene.joints)).tolist()
    return replace(scene, joints={name: scene.joints[name] for name in names})


def ring(n: int) -> Scene:
    """A chain with a slide from its last bar to the ground: a loop."""
    scene, _ = chain(n)
    end = planar_joint(
        "end", "slide", Anchor(f"b{n - 1}", "end"), Anchor("ground", "O"), (0.6, 0.8)
    )
    return replace(scene, joints={**scene.joints, "end": end})


def assembled(scene: Scene, where: Coordinates) -> Rows:
    parts = constraints(scene, where)
    return Rows(Table(where, parts), parts)


HUB = Anchor("b0", "end")
SCENES = {
    "chain": chain(20)[0],
    "shuffled": shuffled(chain(20)[0]),
    "ring": ring(20),
    "tree": random_machines.mechanism(random_machines.tree(3, count=16, driven=True)).scene,
}


State = tuple[Multibody, float, Array, Array]


def made(name: str) -> State:
    """A mechanism, and any state of it."""
    scene = SCENES[name]
    n = len(Coordinates(scene).names)
    mechanism = Multibody(scene, (np.zeros(n), np.zeros(n)))
    return mechanism, *random_machines.state(np.random.default_rng(4), mechanism, 2.0)


@pytest.fixture(params=SCENES)
def found(request: pytest.FixtureRequest) -> State:
    return made(request.param)


def difference(found: State) -> float:
    """Of the accelerations and multipliers by the band and by (2.60) as one matrix, relative."""
    mechanism, t, q, v = found
    pairs = zip(mechanism.solve(t, q, v), lagrange.multipliers(mechanism, t, q, v), strict=True)
    return max(float(np.abs(a - b).max() / np.abs(b).max()) for a, b in pairs)


def test_the_band_gives_what_the_whole_matrix_gives(found: State):
    assert band(found[0].holding.rows, np.array(found[0].where.masses)) is not None
    assert difference(found) < BAND


def test_neither_length_nor_the_order_of_joints_makes_the_band_wider():
    """Twice the bars are twice the products, so that work grows with their number, not its cube."""
    widths = []
    for scene in (chain(20)[0], chain(40)[0], SCENES["shuffled"]):
        where = Coordinates(scene)
        widths.append(band(assembled(scene, where), np.array(where.masses)).width)  # type: ignore[union-attr]
    assert widths[:2] == [3, 3]  # two rows of a joint, and the two of the next
    assert widths[2] <= 5


def test_a_star_is_no_band():
    """Forty joints on one body: each of their rows meets all others."""
    scene = SCENES["chain"]
    joints = {
        f"j{i}": planar_joint(f"j{i}", "pin", HUB, Anchor(f"b{i}", "start")) for i in range(1, 20)
    }
    star = replace(scene, joints=joints)
    where = Coordinates(star)
    assert band(assembled(star, where), np.array(where.masses)) is None


def test_the_joint_that_holds_nothing_is_named():
    """Of the ground to itself: its rows are zero, exactly."""
    scene = SCENES["shuffled"]
    ground = Anchor("ground", "O")
    joints = {"idle": planar_joint("idle", "pin", ground, ground), **scene.joints}
    mechanism, t, q, v = made("shuffled")
    idle = Multibody(replace(scene, joints=joints), mechanism.start())
    with pytest.raises(SingularPose, match="what idle holds"):
        idle.solve(t, q, v)


@pytest.mark.mutant("band of the equations with {lost!r} beside its place")
@pytest.mark.parametrize("lost", ["one", "two", "at"])
def test_a_mistake_in_the_band_is_seen(lost: str):
    """Each entry beside the right one, or each product beside its place."""
    found = made("shuffled")
    held = found[0].holding.band
    assert held is not None
    found[0].holding.band = replace(held, **{lost: np.roll(getattr(held, lost), 1)})
    with suppress(SingularPose):
        assert difference(found) > 1e-6


PENDULUM = """\
scene:
  points: {O: [0, 0]}
  bodies: {rod: {bar: {mass: LIGHT, length: 1}}, bob: {particle: {mass: HEAVY}}}
  joints: {top: {pin: [ground.O, rod.start]}, knot: {pin: [rod.end, bob.center]}}
initial: {rod: {angle: 30 deg}}
allow: {rod.angle: 1.0e-3}
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
    random = np.random.default_rng(7)
    for base in random_machines.machines(count):
        mode = Multibody(uneven(base.scene, random), base.start())
        if len(mode.f_a(0.0, mode.start()[0])) >= len(mode.coordinates):
            continue  # held: nothing is left to move
        t, q, v = random_machines.state(random, mode)
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
def test_a_pendulum_of_a_rod_and_a_bob(light: float, heavy: float):
    """(m_b + m_r/3) l φ̈ = −(m_b + m_r/2) g cos φ: one degree of freedom knows it as well."""
    text = PENDULUM.replace("LIGHT", str(light)).replace("HEAVY", str(heavy))
    case = scenes.parsed(text)
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
def test_ten_digits_are_found_again(angle: int):
    """A rod of 1e-10 of its bob's mass: one turn of refinement leaves 2e-12 and more."""
    text = PENDULUM.replace("LIGHT", "1.0e-10").replace("HEAVY", "1").replace("30", str(angle))
    mode = scenes.mechanism(scenes.parsed(text)).base
    found = mode.accelerations(0.0, *mode.start())[mode.coordinates.index("rod.angle")]
    pull = 9.80665 * (1 + 1e-10 / 2) / (1 + 1e-10 / 3)
    assert found == pytest.approx(-pull * np.cos(np.radians(angle)), rel=1e-14)  # 45 roundings


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


FIELD = """
scene: {forces: {field: {magnetic: ball, charge: 1.602176634e-19, along_z: 2.84e-11}}}
allow: {energy.kinetic: 1.0e-33}
"""


@pytest.mark.slow
def test_an_electron_moves_by_its_own_numbers() -> None:
    """Exercise 2.4's particle: round in 2 π m/(e B) = 1.26 s, and its speed stays."""
    case = scenes.scene("free_particle", FIELD, m=9.1093837e-31, vx=2.0)
    solution = solve(case)
    assert [check for check in solution.checks if not check.holds] == []
    turned = 1.602176634e-19 * 2.84e-11 / 9.1093837e-31 * case.times  # clockwise: v × B
    state = solution.trajectory.states["ball"]
    np.testing.assert_allclose(state[:, 3], 2.0 * np.cos(turned), atol=1e-12)
    np.testing.assert_allclose(state[:, 4], -2.0 * np.sin(turned), atol=1e-12)


@pytest.mark.mutant("an electron is too light to be computed with")
def test_a_limit_above_an_electrons_mass_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(number, "SMALLEST", 1e-30)
    with pytest.raises(CaseError, match=r"must be 0 or from 1e-30 to 1e\+30 in SI"):
        scenes.scene("free_particle", FIELD, m=9.1093837e-31, vx=2.0)
