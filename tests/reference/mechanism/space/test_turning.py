"""What acts about a turn in space, in the generated mechanism: values, laws, planted mistakes."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.multibody_laws import EXACT, balance, lagrangian
from given.scenes import torsion

from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.forces import action, turning
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.solve import solve

SHORT = scenes.tail(1.0, 6)


def built(scene: str = torsion.SPATIAL) -> Any:
    return scenes.mechanism(scenes.parsed(scene)).base


def violated(mode: SpatialMultibody) -> float:
    """(2.60) and (2.51) at the start, at three times: explicit forces against U, D and Q₄."""
    q, v = mode.start()
    times = (0.0, 0.7, 1.9)
    law: Any = (lagrangian, balance)
    return max(check(mode, t, q, v) for t in times for check in law)


@pytest.mark.slow
def test_laws() -> None:
    assert violated(built()) < EXACT


def test_signs() -> None:
    """About z as in the plane: the elbow's second part is the rod, turned by 70° on the arm."""
    mode = built(torsion.FLAT)
    q, v = mode.start()
    found = mode.ingredients.moments(np.pi / 8, q, v)
    alone = mode.forces(np.pi / 8, q, v)
    knee, oil, wire = -3.0 * np.radians(50.0), -0.12, -9.0 * np.radians(50.0)
    assert found["elbow.mz"] == pytest.approx(knee + oil + 1.3, rel=1e-14)  # and its motor
    assert found["hinge.mz"] == pytest.approx(wire + 0.8 * np.pi / 8, rel=1e-14)
    assert {found[f"{joint}.{axis}"] for joint in ("hinge", "elbow") for axis in ("mx", "my")} == {
        0
    }
    about_rod, about_arm = mode.where.slots["rod"].omega, mode.where.slots["arm"].omega
    for name, torque in (("knee", knee), ("oil", oil)):
        force = alone[name]
        assert force[about_rod : about_rod + 3] == pytest.approx([0, 0, torque], rel=1e-14)
        assert force[about_arm : about_arm + 3] == pytest.approx([0, 0, -torque], rel=1e-14)
    assert alone["wire"][about_rod : about_rod + 3] == pytest.approx([0, 0, wire], rel=1e-14)


def lost_couple(*given: Any) -> Any:
    return COUPLE(*given)[1:]


def torsion_backward(*numbers: float) -> float:
    return -TORSION(*numbers)


def damper_backward(*numbers: float) -> float:
    return -DAMPER(*numbers)


COUPLE, TORSION, DAMPER = turning.Between.couple, action.torsion, action.torsion_damper


@pytest.mark.slow
@pytest.mark.mutant("about a turn in space: {wrong}")
@pytest.mark.parametrize(
    ("room", "name", "wrong"),
    [
        (turning.Between, "couple", lost_couple),
        (action, "torsion", torsion_backward),
        (action, "torsion_damper", damper_backward),
    ],
)
def test_a_wrong_torque_is_seen(
    room: Any,
    name: str,
    wrong: Callable[..., Any],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(room, name, wrong)
    assert violated(built()) > 1e-3


def along_its_axis(turn: Any, *_: Any) -> Any:
    """As if skew axes did not share their moments."""
    return turn.first.u if turn.way > 0 else turn.last.u


def unsigned(turn: Any) -> Any:
    return turn.way * ANGLE(turn)


ANGLE: Any = turning.SpatialTurn.angle.fget  # type: ignore[attr-defined]


@pytest.mark.slow
@pytest.mark.mutant("{name} of a turn in space: {wrong}")
@pytest.mark.parametrize(
    ("name", "wrong"), [("m", along_its_axis), ("gradient", along_its_axis), ("angle", unsigned)]
)
def test_a_mistaken_axis_is_seen(
    name: str, wrong: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    own = wrong if name == "gradient" else property(wrong)
    monkeypatch.setattr(turning.SpatialTurn, name, own)
    assert violated(built()) > 1e-3


WINDING = torsion.FLAT.replace("pull: {motor: hinge, ramp: 0.8}", "pull: {motor: hinge, ramp: 120}")


@pytest.mark.slow
def test_what_needs_no_angle_may_turn_on() -> None:
    """A damper's angle has its turns counted; its torque is that of the rate."""
    wires = "    wire: {torsion: hinge, stiffness: 9.0, rest_angle: -30 deg}\n"
    free = WINDING.replace(wires, "    wire: {torsion_damper: hinge, damping: 0.1}\n")
    case = scenes.parsed(free)
    motion = solve(case).trajectory
    turned = observe(case.scene, motion, "wire.angle")
    assert turned[-1] > 2 * np.pi
    assert np.max(np.abs(np.diff(turned))) < np.pi
    rate = observe(case.scene, motion, "hinge.omega")
    np.testing.assert_allclose(observe(case.scene, motion, "wire.torque"), -0.1 * rate, rtol=1e-14)
