"""Friction of a generated slide, dry and smooth, against closed forms and a written system."""

from pathlib import Path

import numpy as np
import pytest
from given import random_scenes, scenes

from textmech.cases.mistake import CaseError
from textmech.cases.scene import (
    Anchor,
    Bounds,
    DryFriction,
    GroundPoint,
    Scene,
    Smooth,
    Spring,
    planar_joint,
    shape,
)
from textmech.reference.formalisms import lagrange
from textmech.reference.mechanism.constraints.factorization import Full
from textmech.reference.mechanism.modes import mode
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.mechanism.modes.smooth import SmoothMultibody
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve
from textmech.reference.system import Only
from textmech.reference.systems.friction.smooth_friction import SmoothDynamometer


def guided(mass: float, smooth: Smooth | None) -> Scene:
    """A particle on a slide of the ground, thrown along it."""
    friction = DryFriction(Bounds(3.0, 4.0), Bounds(2.0, 2.5), smooth)
    slide = planar_joint(
        "rail",
        "slide",
        Anchor("ground", "O"),
        Anchor("dot", "center"),
        along=(0.6, 0.8),
        dry_friction=friction,
    )
    return Scene(
        gravity=(0.0, 0.0),
        points=random_scenes.scene(np.random.default_rng(1)).points,
        bodies={"dot": shape.particle(name="dot", mass=mass)},
        joints={"rail": slide},
        contacts={},
        forces={},
    )


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_slide_brakes_by_its_own_bound(way: float) -> None:
    """(2.89) v₀ m / F₊ forward, v₀ m / F₋ backward; then it rests, by no force."""
    q, v = np.array([0.1, -0.2]), way * np.array([0.6, 0.8])
    system = PlanarMechanism(guided(1.3, None), (q, v), 1.0)
    followed = follow(system, np.linspace(0.0, 1.0, 11))
    (stop,) = followed.changes
    assert stop.time == pytest.approx(1.3 / (2.0 if way > 0 else 2.5), abs=1e-12)
    assert stop.mode_after == "rail sticks"
    forces = system.modes["rail sticks"].reactions(0.0, *np.split(followed.y[-1], 2))
    assert forces["rail.friction"] == pytest.approx(0.0, abs=1e-12)


def test_smooth_friction_of_a_slide_by_the_formalisms() -> None:
    """(2.95) outside the band is −F₊; the residual by superposition is the sum of the forces."""
    law = Smooth(band=0.05, sharpness=100.0)
    start = np.array([0.1, -0.2]), np.zeros(2)
    system = PlanarMechanism(guided(1.3, law), start, 1.0)
    mechanism = system.modes[system.start()[0]]
    assert isinstance(mechanism, SmoothMultibody)
    for speed in (-1.0, -0.05, 0.0, 0.02, 0.05, 1.0):
        q, v = np.array([0.1, -0.2]), speed * np.array([0.6, 0.8])
        a = mechanism.accelerations(0.0, q, v)
        assert lagrange.multipliers(mechanism, 0.0, q, v)[0] == pytest.approx(a, abs=1e-12)
    v = np.array([0.6, 0.8])
    assert mechanism.accelerations(0.0, q, v) == pytest.approx(-2.0 / 1.3 * v, abs=1e-12)


@pytest.mark.slow
def test_smooth_friction_on_an_oblique_slide_of_odd_mass() -> None:
    """Forces that cancel leave no rounding behind: from rest, steps would shrink to nothing."""
    friction = DryFriction(Bounds(6.0, 6.0), Bounds(3.0, 3.0), Smooth(band=0.0005, sharpness=1e5))
    ends = Anchor("ground", "O"), Anchor("dot", "center")
    scene = Scene(
        gravity=(0.0, 0.0),
        points={"O": GroundPoint((0.0, 0.0)), "hook": GroundPoint((0.6, 0.8), (1.2, 1.6))},
        bodies={"dot": shape.particle(name="dot", mass=1.3)},
        joints={
            "rail": planar_joint("rail", "slide", *ends, along=(0.6, 0.8), dry_friction=friction)
        },
        contacts={},
        forces={"coil": Spring("coil", Anchor("ground", "hook"), ends[1], 2.0, 1.0)},
    )
    times = np.linspace(0.0, 5.0, 26)
    y = follow(PlanarMechanism(scene, (np.zeros(2), np.zeros(2)), 1.0), times).y
    block = SmoothDynamometer(1.3, 2.0, 2.0, 3.0, 3.0, 6.0, 6.0, 5e-4, 1e5)
    exact = follow(Only(block), times).y
    assert y[:, :2] @ [0.6, 0.8] == pytest.approx(exact[:, 0], abs=1e-9)


@pytest.mark.slow
@pytest.mark.mutant("what slips at the last instant, followed behind the end")
def test_a_slip_that_begins_at_the_last_sample_is_none(tmp_path: Path) -> None:
    """c u t = F_s, 2 · 0.3 · 10 N: all samples find it at rest."""
    text = """\
scene:
  gravity: none
  points: {O: [0, 0], hook: {at: [5, 0], velocity: [0.3, 0]}}
  bodies: {block: {particle: {mass: 0.8}}}
  joints:
    guide:
      slide: [ground.O, block.center]
      along: [1, 0]
      dry_friction: {static: 6.0, kinetic: 5.1, stribeck: {speed: 0.55}}
  forces: {scale: {spring: [block.center, ground.hook], stiffness: 2.0, rest_length: 5}}
initial: {block: {x: 0, vx: 0}}
rests: true
allow: {block.x: 1.0e-3, guide.friction: 1.0e-2}
"""
    motion = solve(scenes.typed(tmp_path, text, tail=scenes.tail(10.0, 101)))
    assert motion.holds
    assert np.all(motion.trajectory.states["block"][:, 0] == 0.0)


STACKED = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {low: {rigid: {mass: 3.21, inertia: 1}}, top: {rigid: {mass: 3.27, inertia: 1}}}
  joints:
    r1: {slide: [ground.O, low.center], along: [1, 0], dry_friction: {kinetic: 4.8}}
    r2: {slide: [low.center, top.center], along: [1, 0], dry_friction: {kinetic: 3.98}}
  forces: {pull: {push: top.center, ramp: [10.0, 0]}}
initial: {r1: {shift: 0, speed: 0}, r2: {shift: 0, speed: 0}}
stays: [low.x]
allow: {low.x: 1.0e-3, r2.shift: 1.0e-3}
"""


@pytest.mark.slow
def test_what_two_slides_hold_at_zero_rests(tmp_path: Path) -> None:
    """Nothing but friction acts on the lower one; the upper slips from t₀ = 0.398 s on.

    x = 10 N/s (t − t₀)³/6 m.
    """
    motion = solve(scenes.typed(tmp_path, STACKED, tail=scenes.tail(1.0, 41)))
    assert motion.holds
    slips = np.maximum(motion.trajectory.times - 0.398, 0.0)
    x = motion.trajectory.states["top"][:, 0]
    assert x == pytest.approx(10.0 * slips**3 / 6 / 3.27, abs=1e-14)


@pytest.mark.slow
@pytest.mark.mutant("what forces leave of no more than their rounding, beside applied ones alone")
def test_rounding_that_moves_what_is_held_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Full, "pulls", lambda self, multipliers: 0.0)
    with pytest.raises(CaseError, match="the steps shrink to nothing"):
        solve(scenes.typed(tmp_path, STACKED, tail=scenes.tail(1.0, 41)))


def rested(*a: float) -> list[float]:
    """What is left of accelerations beside forces that would give 10 m/s² each."""
    held = Full(np.zeros((0, len(a))), np.zeros(0), np.zeros((0, len(a))), False, ())
    return mode._at_rest(held, np.array(a), np.full(len(a), 10.0), np.zeros(0)).tolist()


def test_only_what_is_rounding_rests() -> None:
    """One of 1e-16 m/s² is what two of 10 leave of each other, and one of 1e-13 is not."""
    assert rested(5.0, 1e-16, -1e-16, 1e-13, 0.0) == [5.0, 0.0, 0.0, 1e-13, 0.0]
    assert rested(5.0, 1e-13) == [5.0, 1e-13]


@pytest.mark.mutant("rounding beside what moves is looked at where nothing moves alone")
def test_rounding_beside_what_moves_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mode, "min", max, raising=False)
    assert rested(5.0, 1e-16) == [5.0, 1e-16]
    assert rested(1e-16, 1e-16) == [0.0, 0.0]
