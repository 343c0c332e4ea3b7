"""Prescribed rates of planar joints: the book's knee, a drive that does work, planted mistakes."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes
from scipy.integrate import simpson

from textmech.cases.scene import Scene
from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.constraints import joint_constraints as permanent
from textmech.reference.mechanism.constraints.constraint_terms import FIRST, SECOND, Given, Turning
from textmech.reference.solve import solve

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


def unbalanced(folder: Path) -> float:
    """(2.51) What the energy gains beside the work of both drives [J]; without corners."""
    smooth = LEG.replace("{table: {times: [0, 0.3, 0.8], values: [0, 2.0, -1.0]}}", "{ramp: 1.5}")
    case = scenes.typed(folder, smooth, tail=scenes.tail(1.0, 201))
    motion = solve(case).trajectory
    names = ("knee.torque", "knee.omega", "ankle.drive", "ankle.speed", "energy.total")
    torque, omega, force, speed, energy = (observe(case.scene, motion, name) for name in names)
    work = simpson(torque * omega + force * speed, x=case.times)
    return abs(float(work - (energy[-1] - energy[0])))


@pytest.mark.slow
def test_drives_hold_their_rates_and_do_the_work(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, LEG)
    motion = solve(case).trajectory
    t = case.times
    angle, shift = (observe(case.scene, motion, name) for name in ("knee.angle", "ankle.shift"))
    known = np.interp(0.2, [0, 0.3], [0, 2.0])
    assert observe(case.scene, motion, "knee.omega")[5] == pytest.approx(known, rel=1e-13)
    assert angle[-1] == pytest.approx(0.3 + 0.25 - 0.2, abs=1e-13)  # the table's area, and after it
    assert shift == pytest.approx(0.1 + 0.2 * t - 0.5 * t**3, abs=1e-13)
    assert unbalanced(tmp_path) < 1e-7  # Simpson's h⁴


@pytest.mark.slow
@pytest.mark.mutant("a drive about a pin with the wrong sign")
def test_a_drive_with_the_wrong_sign_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = permanent.driven

    def wrong(scene: Scene, quantity: str, *given: object) -> object:
        found = sound(scene, quantity, *given)  # type: ignore[arg-type]
        if quantity == "ankle.speed":
            return found
        row = (Turning(FIRST), Turning(SECOND, -1.0), Given(scene.drives[quantity], angular=True))
        return type(found)(found.part, found.ends, (row,), found.names, None, found.where)

    monkeypatch.setattr(permanent, "driven", wrong)
    assert unbalanced(tmp_path) > 1e-2


@pytest.mark.slow
def test_a_knee_bend_returns_what_its_spring_stores() -> None:
    """After a cycle of 2π/Ω the spring has given all back, and the damper has lost ½ d A² T."""
    for variant, d in (("spring", 0.0), ("damped", 1.5)):
        case = scenes.SHIPPED[f"driven_knee.{variant}"]
        motion = solve(case).trajectory
        torque, omega = (
            observe(case.scene, motion, f"knee.{field}") for field in ("torque", "omega")
        )
        period = 2 * np.pi / 5.0
        t = np.linspace(0.0, period, 2001)
        put_in = simpson(np.interp(t, case.times, torque * omega), x=t)
        lost = d * 2.5**2 / 2 * period
        assert put_in == pytest.approx(lost, abs=0.05)  # lines between samples 0.04 s apart
        stored = observe(case.scene, motion, "energy.potential")
        assert np.max(stored) == pytest.approx(0.5 * 40.0 * 1.0**2, rel=1e-3)
