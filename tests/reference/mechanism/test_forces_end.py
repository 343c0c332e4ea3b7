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


FREE = """\
scene:
  gravity: none
  points: {O: [0.1928, -0.4271]}
  bodies: {b: {bar: {mass: 1, length: 1}}}
  joints: {q: {pin: [ground.O, b.start]}}
  forces: {ends: {stops: q, low: -1, high: 1}}
initial: {q: {angle: 0, omega: RATE}}
allow: {b.x: 0.1, ends.torque: 0.1}
"""


@pytest.mark.slow
@pytest.mark.parametrize("rate", [4.0, 3.0, 2.0])
@pytest.mark.mutant("nothing as small as rounding where no force acts")
def test_what_no_force_moves_stays_at_its_stop(rate: float, tmp_path: Path) -> None:
    """To stay and to leave are one motion, whatever the blow has left of its rate."""
    case = typed(tmp_path, FREE.replace("RATE", repr(rate)))
    solution = solve(case)
    assert solution.holds
    last = solution.trajectory.states["b"][-1]
    assert last[2:] == pytest.approx([1.0, 0.0, 0.0, 0.0], abs=1e-14)
    assert observe(case.scene, solution.trajectory, "ends.torque")[-1] == pytest.approx(
        0, abs=1e-14
    )
