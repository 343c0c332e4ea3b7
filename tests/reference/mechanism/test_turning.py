"""What acts about a joint, in the generated mechanism: typed torques, laws, planted mistakes."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes, torsion
from given.multibody_laws import EXACT, balance, lagrangian

from textmech.cases.scene.observe import observe
from textmech.reference.laws import force
from textmech.reference.mechanism.forces import action, turning
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.solve import solve


def built(folder: Path) -> Multibody:
    return scenes.mechanism(scenes.typed(folder, torsion.ARM)).base


def violated(mode: Multibody) -> float:
    """(2.60) and (2.51) at the start and at times after it."""
    q, v = mode.start()
    return max(max(lagrangian(mode, t, q, v), balance(mode, t, q, v)) for t in (0.0, 0.7, 1.9))


def test_laws_and_signs(tmp_path: Path) -> None:
    """The second part of the elbow is the rod: its turn on the arm is 70°, and rises by 1 rad/s."""
    mode = built(tmp_path)
    assert violated(mode) < EXACT
    q, v = mode.start()
    t = np.pi / 8  # the sine is at its crest
    weights, turn = mode.applied(t, q, v), np.radians([50.0, 50.0])
    knee, oil, drive = -3.0 * turn[0], -0.12 * 1.0, 1.3
    wire, pull = -9.0 * turn[1], 0.8 * t
    about_elbow = knee + oil + drive
    assert weights[2] == pytest.approx(wire + pull + about_elbow, rel=1e-14)  # of the rod
    assert weights[5] == pytest.approx(-about_elbow, rel=1e-14)  # of the arm


@pytest.mark.slow
def test_quantities_and_certificate(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, torsion.ARM)
    solution = solve(case)
    assert solution.holds
    first = {name: observe(case.scene, solution.trajectory, name)[0] for name in case.allow}
    assert first["knee.angle"] == pytest.approx(np.radians(70.0), rel=1e-14)
    assert first["wire.torque"] == pytest.approx(-9.0 * np.radians(50.0), rel=1e-14)
    assert first["oil.torque"] == pytest.approx(-0.12, rel=1e-14)


def test_typed_values() -> None:
    assert force.torsion(9.0, -0.5, 0.25) == -6.75
    assert force.torsion_damper(0.4, 2.5) == -1.0


@pytest.mark.mutant("torque of a {law} with the wrong sign")
@pytest.mark.parametrize("law", ["torsion", "torsion_damper"])
def test_a_torque_with_the_wrong_sign_is_seen(
    law: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = getattr(action, law)
    monkeypatch.setattr(action, law, lambda *numbers: -sound(*numbers))
    assert violated(built(tmp_path)) > 1e-3


@pytest.mark.mutant("torque about a joint on one of its parts alone")
def test_a_torque_on_one_part_alone_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = turning.Between.couple
    monkeypatch.setattr(turning.Between, "couple", lambda *given: sound(*given)[1:])
    assert violated(built(tmp_path)) > 1e-3
