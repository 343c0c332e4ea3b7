"""A push onto a stop ends, and what is left of all forces is rounding: the body stays there."""

from pathlib import Path

import pytest
from given.scenes import typed

from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.modes.modes import Modes
from textmech.reference.solve import solve

PRESSED = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {a: {bar: {mass: 1.0, length: 0.6}}}
  joints: {j: {pin: [ground.O, a.start]}}
  forces:
    s: {stops: j, low: 0, restitution: 0}
    m: {motor: j, pulse: {amplitude: -4, from: 0.2, until: UNTIL}}
    w: {torsion: j, stiffness: STIFFNESS, rest_angle: 0}
initial: {j: {angle: START, omega: 0}}
allow: {s.torque: 1.0}
"""


def pressed(folder: Path, start: float, stiffness: float, until: float) -> float:
    """[N m] the stop's last torque, of a motion that is certified."""
    text = PRESSED.replace("START", repr(start)).replace("STIFFNESS", repr(stiffness))
    case = typed(folder, text.replace("UNTIL", repr(until)))
    solution = solve(case)
    assert solution.holds
    return float(observe(case.scene, solution.trajectory, "s.torque")[-1])


@pytest.mark.slow
@pytest.mark.parametrize("stiffness", [1.1843525281307231, 0.7])
@pytest.mark.parametrize("start", [0.0, 0.5])
def test_what_is_pressed_on_a_stop_stays_when_the_push_ends(
    start: float, stiffness: float, tmp_path: Path
) -> None:
    """A spring without a load at the stop leaves 1e-30 N m of either sign, and no friction is."""
    assert pressed(tmp_path, start, stiffness, 0.8) == pytest.approx(0.0, abs=1e-12)
    assert pressed(tmp_path, start, stiffness, 2.0) == pytest.approx(4.0, rel=1e-12)


@pytest.mark.slow
@pytest.mark.mutant("rounding as small as what is left of forces that have ended")
def test_rounding_of_what_is_left_is_seen(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    monkeypatch.setattr(Modes, "_usual", 0.0)
    with pytest.raises((CaseError, AssertionError)):
        pressed(tmp_path, 0.5, 1.1843525281307231, 0.8)
