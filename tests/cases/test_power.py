"""Work: the quadrature against known integrals, and the powers of all forces against the energy."""

import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Scene
from textmech.cases.scene import observe as looking
from textmech.cases.scene.forces.drag import Drag, Viscous
from textmech.cases.scene.forces.force import Couple, Damper, Force, Push, Spring, Torque
from textmech.cases.scene.forces.muscle import LinearMuscle, Muscle
from textmech.cases.scene.forces.turning import Motor, Torsion, TorsionDamper
from textmech.cases.scene.joint import Joint
from textmech.cases.scene.motion import Motion
from textmech.cases.scene.observe import observe
from textmech.cases.scene.power import pieces, work_done
from textmech.cases.trajectory import Trajectory
from textmech.reference.solve import Solution, solve

# Nothing slips, strikes or is carried by the ground: forces and drives do all the work. Beside each
# what a sum over its samples leaves, measured within a factor of 3: the least are smooth.
MOVING = {
    "driven_knee.damped": 4e-9, "driven_robot": 1e-7, "drag_stops.quadratic": 1e-4,
    "driven_wheel.circle": 1e-10, "elastic_pendulum.swings": 2e-4, "falling_drag": 5e-8,
    "linear_muscle_load": 2e-3, "muscle_load": 2e-3, "paired_rotors": 4e-5,
    "pushed_cart.polynomial": 4e-7, "rolling_wheel.pushed": 1e-14,
    "spring_mass_damper.underdamped": 2e-5, "sprung_gimbal.driven": 4e-3,
    "torsion_pendulum.driven": 5e-5, "viscous_drift": 4e-3,
}  # fmt: skip
WRONG = 0.1  # of what is done, at least: where a sign is turned


def summed(times: Any, power: Callable[[Any], Any], *corners: float) -> Any:
    """Work of a power in time alone."""
    return work_done(Trajectory(times, {}, {}), corners, lambda rows: power(rows.times))


def test_polynomials_of_the_fifth_degree_are_summed_exactly() -> None:
    times = np.linspace(0.3, 2.3, 21)
    for degree in range(6):
        known = (times ** (degree + 1) - 0.3 ** (degree + 1)) / (degree + 1)
        assert np.max(np.abs(summed(times, lambda t, n=degree: t**n) - known)) < 1e-12 * known[-1]


@pytest.mark.parametrize("samples", [1, 2, 3, 4, 5])
def test_few_samples_have_a_polynomial_of_their_own(samples: int) -> None:
    times = np.linspace(0.0, 1.0, samples)
    assert summed(times, lambda t: t ** (samples - 1))[-1] == pytest.approx(
        1.0 / samples if samples > 1 else 0.0, abs=1e-14
    )


def test_it_falls_with_the_sixth_order() -> None:
    errors = []
    for samples in (41, 81):
        times = np.linspace(0.0, 2.0, samples)
        known = (1 - np.cos(5.0 * times)) / 5.0
        errors.append(np.max(np.abs(summed(times, lambda t: np.sin(5.0 * t)) - known)))
    assert 2**5.5 < errors[0] / errors[1] < 2**7.5


@pytest.mark.parametrize("begin", [0.0, 0.31, 0.4, 0.401, 0.449, 0.3 + 1e-13, 0.1 + 0.2])
@pytest.mark.parametrize("length", [1e-3, 0.02, 0.05, 0.3, 0.6 - 1e-13])
def test_a_power_that_jumps_is_summed_to_the_jump(begin: float, length: float) -> None:
    """Of t in a pulse alone, which two rows tell: samples in it and its ends, wherever they are."""
    times, end = np.linspace(0.0, 1.0, 21), begin + length

    def power(t: Any) -> Any:
        return np.where((t >= begin) & (t < end), t, 0.0)

    known = (np.clip(times, begin, end) ** 2 - begin**2) / 2
    assert np.max(np.abs(summed(times, power, begin, end, 0.3) - known)) < 1e-14


def test_what_jumps_in_a_motion_is_told_from_both_sides() -> None:
    """A place goes on through a corner, between samples or on one; a reaction need not."""
    times, corners = np.linspace(0.0, 1.0, 21), (0.26, 0.5)
    force = np.where(times < 0.26, times, np.where(times < 0.5, 2.0, times**3))
    place = np.abs(times - 0.26)
    motion = Trajectory(times, {"body": np.stack([place, -place], axis=1)}, {"push": force})
    first, second, third = (piece.motion for piece in pieces(motion, corners))
    assert first.times[-1] == np.nextafter(0.26, 0)
    assert [len(each.times) for each in (first, second, third)] == [7, 6, 11]
    np.testing.assert_allclose([first.states["body"][-1], second.states["body"][0]], 0, atol=1e-14)
    assert first.reactions["push"][-1] == pytest.approx(0.26)
    ends = [second.reactions["push"][-1], third.reactions["push"][0]]
    np.testing.assert_allclose(ends, [2.0, 0.125], rtol=1e-14)


def balance(scene: Scene, motion: Trajectory) -> float:
    """How far the energy of the bodies in gravity is from the work of all else, of its size."""
    works = [f"{name}.work" for name in scene.working()]
    done_by = np.array([observe(scene, motion, name) for name in works])
    given = np.sum(done_by, axis=0) if works else np.zeros_like(motion.times)
    held = observe(scene, motion, "energy.kinetic") - sum(
        body.mass * motion.states[name][:, : len(scene.gravity)] @ np.array(scene.gravity)
        for name, body in scene.bodies.items()
    )
    sizes = [np.ptp(x) for x in (held, *done_by)]
    return float(np.max(np.abs(held - held[0] - given)) / max(sizes))


@pytest.mark.slow
@pytest.mark.parametrize(("name", "left"), MOVING.items())
def test_the_energy_is_the_work_that_was_done(name: str, left: float) -> None:
    assert balance(scenes.SHIPPED[name].scene, scenes.solved(name).trajectory) < left


LOST: list[tuple[type[Any], str]] = [
    (Spring, "elastic_pendulum.swings"), (Damper, "spring_mass_damper.underdamped"),
    (Push, "pushed_cart.polynomial"), (Couple, "paired_rotors"),
    (Torsion, "sprung_gimbal.driven"), (TorsionDamper, "driven_knee.damped"),
    (Motor, "sprung_gimbal.driven"), (Drag, "falling_drag"), (Viscous, "viscous_drift"),
    (Muscle, "muscle_load"), (LinearMuscle, "linear_muscle_load"),
    (Joint, "driven_knee.damped"), (Joint, "driven_robot"),
]  # fmt: skip


def turned(power: Callable[[Any, Motion], Any]) -> Callable[[Any, Motion], Any]:
    return lambda of, motion: -power(of, motion)


@pytest.mark.mutant("power of a {kind.name} with the wrong sign, in {name}")
@pytest.mark.slow
@pytest.mark.parametrize(("kind", "name"), LOST, ids=lambda x: getattr(x, "__name__", x))
def test_a_power_of_the_wrong_sign_is_seen(
    kind: type[Force], name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(kind, "power", turned(kind.power))
    assert balance(scenes.SHIPPED[name].scene, scenes.solved(name).trajectory) > WRONG


SPUN = """\
scene:
  bodies: {sled: {rigid: {mass: 1.0, inertia: 0.2}}}
  forces: {spin: {torque: sled, constant: 0.3}}
initial: {sled: {x: 0, y: 0, angle: 0, vx: 1, vy: 0, omega: 1.0}}
allow: {spin.work: 1.0e-2}
"""
SPUN_IN_SPACE = """\
scene:
  space: 3
  gravity: none
  bodies: {top: {rigid: {mass: 1.0, inertia: [0.2, 0.3, 0.4, 0.01, 0.02, 0.03]}}}
  forces: {spin: {torque: top, constant: [0.3, -0.2, 0.1]}}
initial:
  top:
    {x: 0, y: 0, z: 0, vx: 1, vy: 0, vz: 0, attitude: {axis: [1, 2, 3], angle: 1},
     omega: [3, 1, -2]}
allow: {spin.work: 1.0e-2}
"""


@pytest.mark.slow
@pytest.mark.mutant("power of a Torque with the wrong sign")
@pytest.mark.parametrize("scene", [SPUN, SPUN_IN_SPACE], ids=["plane", "space"])
def test_a_torque_does_what_the_energy_of_the_turn_gains(
    scene: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = scenes.parsed(scene)
    motion = solve(case).trajectory
    assert balance(case.scene, motion) < 1e-6
    monkeypatch.setattr(Torque, "power", turned(Torque.power))
    assert balance(case.scene, motion) > WRONG


@pytest.mark.slow
def test_work_over_knee_bends_by_known_functions() -> None:
    """φ = (A/Ω)(1 − cos Ωt): what the spring takes and returns, and what the damper keeps."""
    m, length, c, d, A, Omega = 3.5, 0.45, 40.0, 1.5, 2.5, 5.0
    case, motion = scenes.SHIPPED["driven_knee.damped"], scenes.solved("driven_knee.damped")
    t = case.times
    phi, phi_dot = A / Omega * (1 - np.cos(Omega * t)), A * np.sin(Omega * t)
    lost = d * A**2 * (t / 2 - np.sin(2 * Omega * t) / (4 * Omega))
    stored, kinetic = c * phi**2 / 2, m * length**2 / 6 * phi_dot**2
    known = {"coil": -stored, "oil": -lost, "knee": stored + kinetic + lost}
    for name, work in known.items():
        found = observe(case.scene, motion.trajectory, f"{name}.work")
        certified = {check.name: check.certified for check in motion.checks}
        off = np.max(np.abs(found - work))
        assert off < (certified[f"error of {name}.work"] or 0.0) < 1e-5  # J, of 20


FLAT = """\
scene:
  bodies: {cart: {particle: {mass: 1.0}}}
  forces: {hand: {push: cart.center, pulse: {amplitude: [5.0, 0], from: 0.11, until: 0.53}}}
initial: {cart: {x: 0, y: 0, vx: 1, vy: 0}}
allow: {hand.work: ALLOWED}
"""


def stated(motion: Solution, name: str) -> float:
    """What the reference says of its own error."""
    return next(c.certified or 0.0 for c in motion.checks if c.name == f"error of {name}")


@pytest.mark.slow
def test_the_samples_do_not_have_to_lie_on_jumps() -> None:
    """F = m v̇: 5 N for 0.42 s from 1 m/s on, between 26 samples in a second."""
    case = scenes.parsed(FLAT.replace("ALLOWED", "1.0e-2"))
    motion = solve(case)
    work = observe(case.scene, motion.trajectory, "hand.work")[-1]
    known = ((1 + 5 * 0.42) ** 2 - 1) / 2
    assert abs(work - known) <= stated(motion, "hand.work") < 1e-9


@pytest.mark.slow
@pytest.mark.mutant("corners of laws left out of a work")
def test_a_work_that_takes_no_heed_of_corners_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """The reference says of itself that it knows the work no better than a part of a sample."""
    case = scenes.parsed(FLAT.replace("ALLOWED", "100.0"))
    monkeypatch.setattr(looking, "corners", lambda *_: set[float]())
    motion = solve(case)
    work = observe(case.scene, motion.trajectory, "hand.work")[-1]
    off = abs(work - ((1 + 5 * 0.42) ** 2 - 1) / 2)
    assert 1e-3 < off <= stated(motion, "hand.work")


SWUNG = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {cart: {particle: {mass: 1.0}}}
  joints: {rail: {slide: [ground.O, cart.center], along: [1, 0]}}
  forces:
    hand: {push: cart.center, pulse: {amplitude: [5.0, 0], from: BEGIN, until: END}}
    coil: {spring: [ground.O, cart.center], stiffness: STIFF, rest_length: 0}
initial: {cart: {x: 2.0, y: 0, vx: 1, vy: 0}}
allow: {hand.work: 1.0e+9, coil.work: 1.0e+9}
"""


def swung(begin: float, end: float, stiffness: float, times: Any) -> dict[str, Any]:
    """Work by known functions: F times the way in the pulse, and what the spring lost."""
    w = math.sqrt(stiffness)

    def after(x: float, v: float, force: float, t: Any) -> tuple[Any, Any]:
        at, c, s = force / stiffness, np.cos(w * t), np.sin(w * t)
        return at + (x - at) * c + v / w * s, (at - x) * w * s + v * c

    one = after(2.0, 1.0, 0.0, begin)
    two = after(*one, 5.0, end - begin)
    pulse, beyond = after(*one, 5.0, times - begin)[0], after(*two, 0.0, times - end)[0]
    x = np.where(times < begin, after(2.0, 1.0, 0.0, times)[0], pulse)
    x = np.where(times < end, x, beyond)
    hand = np.where(times < begin, 0.0, 5 * (np.where(times < end, x, two[0]) - one[0]))
    return {"hand": hand, "coil": stiffness / 2 * (4.0 - x**2)}


@pytest.mark.slow
@pytest.mark.parametrize("samples", [9, 26, 76])
@pytest.mark.parametrize(
    ("begin", "end", "stiffness"),
    [(0.56, 0.76, 1.0), (0.015, 0.019, 400.0), (0.546, 0.855, 400.0), (0.772, 0.858, 1.0),
     (0.112, 0.115, 400.0), (0.368, 0.370, 1.0), (0.158, 0.161, 400.0), (0.554, 0.953, 30.0),
     (0.84, 1.04, 400.0)],
)  # fmt: skip
def test_the_stated_error_of_work_is_true_at_any_samples(
    begin: float, end: float, stiffness: float, samples: int
) -> None:
    """Pulses shorter and longer than a sample, on samples and between them."""
    text = SWUNG.replace("BEGIN", repr(begin)).replace("END", repr(end))
    text = text.replace("STIFF", repr(stiffness))
    case = scenes.parsed(text, tail=scenes.tail(1.0, samples))
    motion = solve(case)
    for name, known in swung(begin, end, stiffness, case.times).items():
        work = observe(case.scene, motion.trajectory, f"{name}.work")
        rounded = 2e-15  # of the known one: 5 N by what places of 2 m are apart
        assert np.max(np.abs(work - known)) <= stated(motion, f"{name}.work") + rounded, name


HELD = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {cart: {particle: {mass: 1.0}}}
  joints: {rail: {slide: [ground.O, cart.center], along: [1, 0]}}
  drive: {rail.speed: {constant: 1.0}}
  forces: {hand: {push: cart.center, pulse: {amplitude: [5.0, 0], from: 0.11, until: END}}}
initial: {rail: {shift: 0}}
allow: {rail.work: 1.0}
"""


@pytest.mark.slow
def test_a_drive_beside_a_pulse_that_no_sample_sees_is_a_mistake() -> None:
    """Its effort jumps twice between two samples; seen there, it gives what the hand takes."""
    with pytest.raises(CaseError) as told:
        solve(scenes.parsed(HELD.replace("END", "0.115")))
    (mistake,) = told.value.mistakes
    assert mistake.where == "allow.rail.work"
    assert mistake.what.endswith("take more samples")
    case = scenes.parsed(HELD.replace("END", "0.53"))
    motion = solve(case)
    work = observe(case.scene, motion.trajectory, "rail.work")[-1]
    assert abs(work + 5 * 0.42) <= stated(motion, "rail.work") < 1e-9


def test_it_is_none_at_an_event(tmp_path: Path) -> None:
    text = FLAT.replace("hand.work: ALLOWED", "top.hand.work: 1.0")
    path = tmp_path / "typed.yaml"
    events = "events: {top: {cart.x: {rises to: 0.5}}}\n"
    path.write_text(f"{scenes.HEAD}{text}{events}{scenes.TAIL}")
    with pytest.raises(CaseError, match=r"unknown quantity 'top\.hand\.work'"):
        load(path)
