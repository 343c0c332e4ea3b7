"""Edges of the generated mechanism: their rows, their forces, and the mistakes that would show."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from given import edges, scenes
from given.multibody_laws import EXACT, balance, lagrangian

from textmech.cases.mistake import CaseError
from textmech.cases.scene import Anchor, Signal
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Trajectory
from textmech.reference.formalisms import lagrange
from textmech.reference.mechanism.constraints import joint_constraints as permanent
from textmech.reference.mechanism.constraints.constraint import Constraint
from textmech.reference.mechanism.constraints.constraint_terms import FIRST, Carried, Given
from textmech.reference.mechanism.kinematics import signal
from textmech.reference.mechanism.kinematics.kinematics import Row
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.solve import solve
from textmech.reference.system import Array

SCENES = {"free": edges.FREE, "train": edges.TRAIN, **edges.DRIVEN}


def mode(folder: Path, name: str) -> Multibody:
    return scenes.mechanism(scenes.typed(folder, SCENES[name])).base


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


def observed(mode: Multibody, folder: Path, name: str) -> float:
    """The rows as slips and speeds that the bodies have, against what is prescribed."""
    case = scenes.typed(folder, SCENES[name])
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
def test_edges_obey(name: str, tmp_path: Path) -> None:
    found = mode(tmp_path, name)
    assert law_of(found) < EXACT
    assert observed(found, tmp_path, name) < EXACT
    if name != "train":
        assert force_of(found) < EXACT


@pytest.mark.slow
@pytest.mark.parametrize("name", ["free", "sine", "train"])
def test_the_certificate_holds(name: str, tmp_path: Path) -> None:
    solution = solve(scenes.typed(tmp_path, SCENES[name]))
    assert [check for check in solution.checks if not check.holds] == []


def test_gamma_is_the_derivative_of_the_rows(tmp_path: Path) -> None:
    for name in SCENES:
        found = mode(tmp_path, name)
        for t, q, v in states(found):
            expected = lagrange.constraint_acceleration(found, t, q, v)
            np.testing.assert_allclose(found.rows(t, q, v)[2], expected, atol=EXACT)


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
def test_planted_rows_are_seen(
    planted: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = Carried.row
    monkeypatch.setattr(Carried, "row", lambda *given: PLANTED[planted](sound(*given)))
    found = mode(tmp_path, "free")
    assert max(law_of(found), observed(found, tmp_path, "free")) > 1e-3


@pytest.mark.mutant("a blade that holds along and lets go across")
def test_along_for_across_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Such an edge would hold its body where it has a speed, and let it go across."""
    monkeypatch.setattr(permanent.Edge, "across", property(lambda self: self.along))
    with pytest.raises(CaseError, match="the rates violate blade"):
        mode(tmp_path, "free")


@pytest.mark.mutant("a driven blade's speed with the wrong sign")
def test_a_speed_with_the_wrong_sign_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = Given.row
    monkeypatch.setattr(Given, "row", lambda *given: -sound(*given))
    assert observed(mode(tmp_path, "sine"), tmp_path, "sine") > 0.1


@pytest.mark.mutant("a driven blade's speed without its rate")
def test_a_speed_without_its_rate_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(signal, "SLOPES", dict.fromkeys(signal.SLOPES, lambda law, t: 0.0))
    assert law_of(mode(tmp_path, "sine")) > 1e-3


def test_a_blade_has_no_place(tmp_path: Path) -> None:
    free = mode(tmp_path, "free")
    where, at = free.where, (Anchor(next(iter(free.scene.bodies)), "center"),)
    for term in (Carried(FIRST, (1.0, 0.0)), Given(Signal("constant", (1.0,)))):
        row = Constraint("blade", at, ((term,),), ((),), None, where)
        assert np.isnan(row.places(0.0, [0.0, 0.0, 0.0])).all()
