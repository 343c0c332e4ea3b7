"""A block at rest breaks loose where static friction is kinetic friction, wherever it stands."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.reference.generated.mechanism import Mechanism
from textmech.reference.motion.follow import Followed, follow
from textmech.reference.system import System
from textmech.reference.systems.anisotropic_drift import AnisotropicDrift
from textmech.reference.systems.dynamometer import Dynamometer
from textmech.reference.systems.growing_force import GrowingForce

SLIDE = """\
scene:
  gravity: none
  points: {O: [0, 0], hook: {at: [5, 0], velocity: [1, 0]}}
  bodies: {block: {particle: {mass: 1}}}
  joints: {guide: {slide: [ground.O, block.center], along: [1, 0], dry_friction: {FRICTION}}}
  forces: {PULL}
initial: {block: {x: START, vx: 0}}
allow: {block.x: 1.0e-3}
"""
FLOOR = """\
scene:
  bodies: {block: {particle: {mass: 1}}}
  contacts: {touch: {between: [block, ground.floor], friction: 0.3}}
  forces: {PULL}
initial: {block: {x: START, y: 0, vx: 0, vy: 0}}
allow: {block.x: 1.0e-3}
"""
RAMP = "pull: {push: block.center, ramp: [1, 0]}"
SPRING = "pull: {spring: [block.center, ground.hook], stiffness: 2, rest_length: 5}"
TIMES = np.linspace(0.0, 6.0, 25)
SCENES = {
    "slide": (SLIDE, "kinetic: 3", RAMP),
    "slide 3.0001": (SLIDE, "static: 3.0001, kinetic: 3", RAMP),
    "spring": (SLIDE, "kinetic: 3", SPRING),
    "floor": (FLOOR, "", RAMP),
}


def moved(tmp_path: Path, name: str, start: float) -> tuple[Mechanism, Followed]:
    text, friction, pull = SCENES[name]
    text = text.replace("FRICTION", friction).replace("PULL", pull).replace("START", str(start))
    mechanism = scenes.mechanism(scenes.typed(tmp_path, text))
    return mechanism, follow(mechanism, TIMES)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["slide", "slide 3.0001", "floor"])
@pytest.mark.parametrize("start", [0.0, 0.1])
def test_from_anywhere_it_is_the_same_motion(tmp_path: Path, name: str, start: float):
    """x = (t³ − t₀³)/6 − (t − t₀) t₀²/2 − (F − t₀)(t − t₀)²/2 from t₀ = F_s on."""
    _, found = moved(tmp_path, name, start)
    static, kinetic = (3.0001, 3.0) if "3.0001" in name else (3.0, 3.0)
    if name == "floor":
        static = kinetic = 0.3 * 9.80665
    tau = np.maximum(TIMES - static, 0.0)
    known = tau**3 / 6 + (static - kinetic) * tau**2 / 2
    np.testing.assert_allclose(found.y[:, 0] - start, known, rtol=1e-13, atol=1e-13)
    assert len(found.changes) == 1


WEAK = "tow: {push: block.center, constant: [MOST, 0]}, pull: {push: block.center, ramp: [RATE, 0]}"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["slide", "floor"])
@pytest.mark.parametrize("rate", [0.1, 1e-3, 1e-5])
def test_a_weak_ramp_breaks_it_loose_when_it_should(tmp_path: Path, name: str, rate: float):
    """x = rate τ³/6 from 0.31 s on, where the force is the bound but for its rounding."""
    text, friction, _ = SCENES[name]
    bound = 3.0 if name == "slide" else 0.3 * 9.80665
    pull = WEAK.replace("MOST", repr(bound - rate * 0.31)).replace("RATE", f"{rate:.1e}")
    text = text.replace("FRICTION", friction).replace("PULL", pull).replace("START", "0.0")
    times = np.linspace(0.0, 1.0, 26)
    found = follow(scenes.mechanism(scenes.typed(tmp_path, text)), times)
    rounding = 4 * np.spacing(bound)  # N: of the force, the bound, and both of their sums
    known = rate * np.maximum(times - 0.31, 0.0) ** 3 / 6
    np.testing.assert_allclose(found.y[:, 0], known, rtol=0, atol=rounding)
    (slips,) = found.changes
    assert slips.time == pytest.approx(0.31, abs=1e-12 + rounding / rate)


@pytest.mark.slow
@pytest.mark.parametrize("start", [0.0, 0.1])
def test_a_spring_pulls_it_loose(tmp_path: Path, start: float):
    """(2.98) with F_s = F: x = u τ − (u/ω) sin ω τ, and v only touches zero at ω τ = 2 π."""
    _, found = moved(tmp_path, "spring", start)
    omega, tau = np.sqrt(2.0), np.maximum(TIMES - 1.5 - start, 0.0)
    np.testing.assert_allclose(found.y[:, 0] - start, tau - np.sin(omega * tau) / omega, atol=1e-12)
    assert [c.name for c in found.changes] == ["guide slips"]


@pytest.mark.parametrize(
    "system",
    [
        GrowingForce(m=1, b=1, F_minus=3, F_plus=3, Fs_minus=3, Fs_plus=3),
        Dynamometer(m=1, c=2, u=2, F_minus=3, F_plus=3, Fs_minus=3, Fs_plus=3),
        AnisotropicDrift(m=1, A=4.5, w=6, F_minus=3, F_plus=2, Fs_minus=3, Fs_plus=2),
    ],
)
def test_hand_written_systems_break_loose(system: System):
    found = follow(system, TIMES)
    assert len(found.changes) >= 1
    for t, y in zip(TIMES.tolist(), found.y, strict=True):
        closed = system.closed_form(t)
        if closed is not None:
            np.testing.assert_allclose(y, np.concatenate(closed), rtol=1e-12, atol=1e-12)
