"""Slots, massless rods, drives and blades, against equations by hand and with mistakes planted."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.multibody_laws import EXACT, balance, lagrangian
from given.scenes import edges, rods
from scipy.integrate import simpson, solve_ivp

from textmech.cases.mistake import CaseError
from textmech.cases.scene import Scene
from textmech.cases.scene.joint import FREEDOMS
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import ANGLE, OMEGA, VX, Trajectory, X
from textmech.reference.mechanism.constraints import constraint_terms as rows
from textmech.reference.mechanism.constraints import joint_constraints as permanent
from textmech.reference.mechanism.constraints.constraint_terms import (
    FIRST,
    SECOND,
    Carried,
    Given,
    Turning,
)
from textmech.reference.mechanism.kinematics import signal
from textmech.reference.mechanism.kinematics.kinematics import Row
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.solve import solve
from textmech.reference.system import Array

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
def test_a_rod_in_a_slot_moves_as_derived_by_hand() -> None:
    case = scenes.parsed(SCENE)
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
    lost: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The mutant: the word in the table is all that the generated reference knows."""
    case = scenes.parsed(SCENE)
    t, q, v = 0.0, np.array([0.5, 0.1, PHI0]), np.array([V0, 0.0, 0.0])
    free = Multibody(case.scene, (q, v)).accelerations(t, q, v)
    left = tuple(freedom for freedom in FREEDOMS["slot"] if freedom.kind != lost)
    monkeypatch.setitem(FREEDOMS, "slot", left)
    held = Multibody(scenes.parsed(SCENE).scene, (q, v)).accelerations(t, q, v)
    assert np.abs(free - held).max() > 1e-2


def violated(scene: str) -> float:
    """(2.60) and (2.51) at the start, with any rates that the rods allow."""
    mode: Multibody = scenes.mechanism(scenes.parsed(scene)).base
    q, v = mode.start()
    f, any_rates = mode.f_a(0.0, q), np.random.default_rng(1).normal(size=len(v))
    v = any_rates - np.linalg.pinv(f) @ (f @ any_rates - mode.g(0.0, q))
    return max(lagrangian(mode, 0.0, q, v), balance(mode, 0.0, q, v))


@pytest.mark.slow
@pytest.mark.parametrize("scene", [rods.CHAIN, rods.SWING])
def test_rods_keep_their_length(scene: str) -> None:
    case = scenes.parsed(scene)
    solution = solve(case)
    assert solution.holds
    assert violated(scene) < EXACT
    for name in case.scene.joints:
        gap = observe(case.scene, solution.trajectory, f"{name}.gap")
        assert np.max(np.abs(gap)) < 1e-13


@pytest.mark.slow
@pytest.mark.mutant("γ of a massless rod without a part of its turn")
def test_a_lost_term_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """γ without the turn of the rod: (|Δ̇|² − λ̇²)/λ."""
    sound = rows.Distance.row

    def lost(self: Any, k: Any, ends: Any) -> Row:
        row, rate = sound(self, k, ends), ends[self.b].r_dot - ends[self.a].r_dot
        return Row(row.loads, row.g, row.gamma - 0.1 * (rate @ rate))

    monkeypatch.setattr(rows.Distance, "row", lost)
    assert violated(rods.CHAIN) > 1e-3


LEG = """\
scene:
  points: {O: [0, 0]}
  bodies:
    shank: {bar: {mass: 1.2, length: 0.8}}
    foot: {block: {mass: 0.4, width: 0.1, height: 0.1}}
  joints:
    knee: {pin: [ground.O, shank.start]}
    ankle: {slide: [shank.end, foot.center], along: [0.6, 0.8]}
  forces: {coil: {torsion: knee, stiffness: 10.0, rest_angle: 0}}
  drive:
    knee.omega: {table: {times: [0, 0.3, 0.8], values: [0, 2.0, -1.0]}}
    ankle.speed: {polynomial: {coefficients: [0.2, 0, -1.5]}}
initial: {knee: {angle: 0}, ankle: {shift: 0.1}}
allow: {knee.angle: 1.0e-2, knee.torque: 1.0, ankle.shift: 1.0e-2, ankle.drive: 1.0, ankle.fx: 1.0}
"""


def unbalanced() -> float:
    """(2.51) What the energy gains beside the work of both drives [J]; without corners."""
    smooth = LEG.replace("{table: {times: [0, 0.3, 0.8], values: [0, 2.0, -1.0]}}", "{ramp: 1.5}")
    case = scenes.parsed(smooth, tail=scenes.tail(1.0, 201))
    motion = solve(case).trajectory
    names = ("knee.torque", "knee.omega", "ankle.drive", "ankle.speed", "energy.total")
    torque, omega, force, speed, energy = (observe(case.scene, motion, name) for name in names)
    work = simpson(torque * omega + force * speed, x=case.times)
    return abs(float(work - (energy[-1] - energy[0])))


@pytest.mark.slow
def test_drives_hold_their_rates_and_do_the_work() -> None:
    case = scenes.parsed(LEG)
    motion = solve(case).trajectory
    t = case.times
    angle, shift = (observe(case.scene, motion, name) for name in ("knee.angle", "ankle.shift"))
    known = np.interp(0.2, [0, 0.3], [0, 2.0])
    assert observe(case.scene, motion, "knee.omega")[5] == pytest.approx(known, rel=1e-13)
    assert angle[-1] == pytest.approx(0.3 + 0.25 - 0.2, abs=1e-13)  # the table's area, and after it
    assert shift == pytest.approx(0.1 + 0.2 * t - 0.5 * t**3, abs=1e-13)
    assert unbalanced() < 1e-7  # Simpson's h⁴


@pytest.mark.slow
@pytest.mark.mutant("a drive about a pin with the wrong sign")
def test_a_drive_with_the_wrong_sign_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    sound = permanent.driven

    def wrong(scene: Scene, quantity: str, *given: object) -> object:
        found = sound(scene, quantity, *given)  # type: ignore[arg-type]
        if quantity == "ankle.speed":
            return found
        row = (Turning(FIRST), Turning(SECOND, -1.0), Given(scene.drives[quantity], angular=True))
        return type(found)(found.part, found.ends, (row,), found.names, None, found.where)

    monkeypatch.setattr(permanent, "driven", wrong)
    assert unbalanced() > 1e-2


SCENES = {"free": edges.FREE, "train": edges.TRAIN, **edges.DRIVEN}


def mode(name: str) -> Multibody:
    return scenes.mechanism(scenes.parsed(SCENES[name])).base


def states(mode: Multibody) -> list[tuple[float, Array, Array]]:
    """Any places on which joints close, with rates that meet all rows."""
    random, (q0, _) = np.random.default_rng(5), mode.start()
    found = []
    for _ in range(10):
        t, q = random.uniform(0.0, 2.0), q0.copy()
        if len(q) == 3:
            q += random.uniform(-2.0, 2.0, 3)
        v = random.uniform(-3.0, 3.0, len(q))
        f, g = mode.f_a(t, q), mode.g(t, q)
        found.append((t, q, v - np.linalg.pinv(f) @ (f @ v - g)))
    return found


def law_of(mode: Multibody) -> float:
    """(2.60) and (2.51): γ against the derivative of the rows, power against reactions."""
    found = [max(lagrangian(mode, *state), balance(mode, *state)) for state in states(mode)]
    return float(np.max(found))


def observed(mode: Multibody, name: str) -> float:
    """The rows as slips and speeds that the bodies have, against what is prescribed."""
    case = scenes.parsed(SCENES[name])
    worst = 0.0
    for t, q, v in states(mode):
        rows = {body: np.array([pose]) for body, pose in mode.poses(t, q, v).items()}
        motion = Trajectory(np.array([t]), rows, {})
        for edge in case.scene.constraints.values():
            worst = max(worst, abs(float(observe(case.scene, motion, f"{edge.name}.slip")[0])))
            if edge.speed is not None:
                A, w, p = (edge.speed.amplitude[0], edge.speed.angular_frequency, edge.speed.phase)
                s = {"constant": A, "ramp": A * t, "sine": A * np.sin(w * t + p)}[edge.speed.law]
                speed = float(observe(case.scene, motion, f"{edge.name}.speed")[0])
                worst = max(worst, abs(speed - s))
    return worst


def force_of(mode: Multibody) -> float:
    """The momentum that the reactions give: on one body m r̈ = force left + drive along."""
    worst = 0.0
    for t, q, v in states(mode):
        a, found = mode.accelerations(t, q, v), mode.reactions(t, q, v)
        cos, sin = np.cos(q[2]), np.sin(q[2])
        u = np.array([0.8 * cos - 0.6 * sin, 0.8 * sin + 0.6 * cos])
        left = np.array([-u[1], u[0]])
        force = found["blade.force"] * left + found.get("blade.drive", 0.0) * u
        worst = max(worst, float(np.max(np.abs(1.7 * a[:2] - force))))
    return worst


@pytest.mark.parametrize("name", SCENES)
def test_edges_obey(name: str) -> None:
    found = mode(name)
    assert law_of(found) < EXACT
    assert observed(found, name) < EXACT
    if name != "train":
        assert force_of(found) < EXACT


def turning_lost(row: Row) -> Row:
    """γ = 0: the blade would not turn."""
    return Row(row.loads, row.g, 0.0)


def gamma_reversed(row: Row) -> Row:
    return Row(row.loads, row.g, -row.gamma)


def row_reversed(row: Row) -> Row:
    """The sign of the row without that of its lever."""
    loads = [(part, None if F is None else -F, M) for part, F, M in row.loads]
    return Row(loads, row.g, -row.gamma)


PLANTED: dict[str, Callable[[Row], Row]] = {
    "no γ": turning_lost, "γ with the wrong sign": gamma_reversed,
    "the row's sign": row_reversed,
}  # fmt: skip


@pytest.mark.mutant("the row of a blade: {planted}")
@pytest.mark.parametrize("planted", PLANTED)
def test_planted_rows_are_seen(planted: str, monkeypatch: pytest.MonkeyPatch) -> None:
    sound = Carried.row
    monkeypatch.setattr(Carried, "row", lambda *given: PLANTED[planted](sound(*given)))
    found = mode("free")
    assert max(law_of(found), observed(found, "free")) > 1e-3


@pytest.mark.mutant("a blade that holds along and lets go across")
def test_along_for_across_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Such an edge would hold its body where it has a speed, and let it go across."""
    monkeypatch.setattr(permanent.Edge, "across", property(lambda self: self.along))
    with pytest.raises(CaseError, match="the rates violate blade"):
        mode("free")


@pytest.mark.mutant("a driven blade's speed with the wrong sign")
def test_a_speed_with_the_wrong_sign_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    sound = Given.row
    monkeypatch.setattr(Given, "row", lambda *given: -sound(*given))
    assert observed(mode("sine"), "sine") > 0.1


@pytest.mark.mutant("a driven blade's speed without its rate")
def test_a_speed_without_its_rate_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(signal, "SLOPES", dict.fromkeys(signal.SLOPES, lambda law, t: 0.0))
    assert law_of(mode("sine")) > 1e-3
