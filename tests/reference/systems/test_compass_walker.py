"""The compass walker: its equations, its impact by impulses, and its scene."""

import math
from dataclasses import asdict, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.mutants import mutant
from given.scenes import tail, typed
from given.walkers import UNEVEN, WALKER, Legs

from textmech.reference.formalisms import energy, lagrange, newton_euler
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array
from textmech.reference.systems.walkers.compass_walker import CompassWalker


def states(count: int = 20) -> list[tuple[Array, Array]]:
    random = np.random.default_rng(1)
    q, v = random.uniform(-1.0, 1.0, (count, 3)), random.uniform(-3.0, 3.0, (count, 3))
    v[:, 0] = 0.0
    return list(zip(q, v, strict=True))


@pytest.mark.parametrize("walker", [WALKER, UNEVEN], ids=["bars", "uneven"])
@pytest.mark.parametrize("name", ["left stands", "right stands"])
def test_accelerations_and_reactions_by_every_formalism(name: str, walker: CompassWalker):
    mode = walker.modes[name]
    for q, v in states():
        a = mode.accelerations(0.0, q, v)
        derived, friction = lagrange.multipliers(mode, 0.0, q, v)
        written, foot = mode.reactions(0.0, q, v), f"{name.split()[0]}_foot"
        size, force = np.abs(a).max(), max(map(abs, written.values()))
        assert a == pytest.approx(derived, abs=1e-12 * size)
        assert friction[0] == pytest.approx(written[f"{foot}.tangent"], abs=1e-12 * force)
        found = newton_euler.balance(mode, 0.0, q, v, a)
        assert found.share() < 1e-12
        assert found.reactions == pytest.approx(written, abs=1e-12 * force)
        assert abs(energy.power_balance(mode, 0.0, q, v)) < 1e-10


def _wrong(lost: str) -> Any:
    """Accelerations with a term that is lost or turned round."""

    def accelerations(self: Any, t: float, q: Array, v: Array) -> Array:
        other = {"gravity": 0.0 * v, "coupling": v}[lost]
        p = self.walker if lost == "coupling" else replace(self.walker, gamma=-self.walker.gamma)
        stance: Any = type(WALKER.modes["left stands"])
        sound = stance(p, self.k)
        a = sound.accelerations(t, q, v)
        if lost == "coupling":  # without what the legs' rates do
            still = sound.accelerations(t, q, 0.0 * other)
            a = 0.5 * (a + still)
        return a

    return accelerations


@pytest.mark.mutant(
    "compass walker on a slope the other way", "half of what the compass walker's rates do left out"
)
@pytest.mark.parametrize("lost", ["gravity", "coupling"])
def test_a_lost_term_is_seen(lost: str):
    off: Any = mutant(WALKER.modes["left stands"], accelerations=_wrong(lost))
    q, v = states(1)[0]
    assert np.abs(off.accelerations(0, q, v) - lagrange.multipliers(off, 0, q, v)[0]).max() > 1e-3
    assert newton_euler.balance(off, 0.0, q, v, off.accelerations(0, q, v)).share() > 1e-4


def impulsive(walker: CompassWalker, k: int, q: Array, v: Array) -> Array:
    """q̇⁺ by (2.60) over the instant: free bodies, pinned at the hip and at the new foot.

    Nine rates, each leg's x, y and angle, and the hip's x, y; six rows; nothing of one walker's
    coordinates.
    """
    name = ("left", "right")[k]
    poses = walker.modes[f"{name} stands"].poses(0.0, q, v)
    before = np.array([*poses["left"][3:], *poses["right"][3:], *poses["hip"][3:5]])
    M = np.diag([*[walker.m, walker.m, walker.J] * 2, walker.M, walker.M])
    rows = []

    def moves(leg: str, r: float) -> Array:
        """How a point r up a leg from its centre moves, (2, 8)."""
        column = 0 if leg == "left" else 3
        angle = poses[leg][2]
        dx, dy = r * math.cos(angle), r * math.sin(angle)
        row = np.zeros((2, 8))
        row[0, column], row[1, column + 1] = 1.0, 1.0
        row[:, column + 2] = -dy, dx
        return row

    hip = np.zeros((2, 8))
    hip[0, 6] = hip[1, 7] = 1.0
    rows = [moves(leg, walker.c) - hip for leg in ("left", "right")]
    rows.append(moves(("left", "right")[1 - k], walker.c - walker.l))
    F = np.vstack(rows)
    by_mass = np.linalg.solve(M, F.T)
    after = before - by_mass @ np.linalg.solve(F @ by_mass, F @ before)
    return -after[[2, 5]]


@pytest.mark.parametrize("walker", [WALKER, UNEVEN], ids=["bars", "uneven"])
@pytest.mark.parametrize("k", [0, 1])
def test_impact_by_impulsive_multipliers(k: int, walker: CompassWalker):
    for s, s_dot, w_dot in ((0.2, 1.1, -0.3), (0.35, 0.7, 1.4)):
        q = np.array([0.7, s, -s] if k == 0 else [0.7, -s, s])
        v = np.array([0.0, s_dot, w_dot] if k == 0 else [0.0, w_dot, s_dot])
        mode, after, rates = walker.struck(k, q, v)
        assert rates[1:] == pytest.approx(impulsive(walker, k, q, v), rel=1e-12)
        assert mode == f"{('right', 'left')[k]} stands"
        for body, place in walker.modes[mode].poses(0.0, after, v).items():  # none jumps
            before = walker.modes[f"{('left', 'right')[k]} stands"].poses(0.0, q, v)[body]
            assert place[:3] == pytest.approx(before[:3], abs=1e-15)


@pytest.mark.mutant(
    "legs' inertia left out of the walker's impact",
    "legs' inertia counted twice in the walker's impact",
)
@pytest.mark.parametrize("inertia", [0.0, 2 * WALKER.J])
def test_another_impact_is_seen(inertia: float):
    """Legs whose inertia is lost, or counted twice."""
    wrong = Legs(**asdict(WALKER), center=WALKER.c, inertia=inertia)
    q, v = np.array([0.0, 0.2, -0.2]), np.array([0.0, 1.1, -0.3])
    assert np.abs(wrong.struck(0, q, v)[2][1:] - impulsive(WALKER, 0, q, v)).max() > 1e-2


SCENE = """\
scene:
  incline: 0.02
  points: {O: [0, 0]}
  bodies:
    left: {bar: {mass: 5, length: 1}}
    right: {bar: {mass: 5, length: 1}}
    hip: {particle: {mass: 10}}
  joints:
    foot: {pin: [ground.O, left.start]}
    left_hip: {pin: [left.end, hip.center]}
    right_hip: {pin: [right.end, hip.center]}
initial:
  left: {angle: A, omega: -0.8617}
  right: {angle: B, omega: -0.6753}
allow: {left.angle: 1.0e-3}
"""


def test_between_strikes_it_is_the_mechanism_of_its_scene(tmp_path: Path):
    """Two bars and a mass, pinned: in maximal coordinates, with multipliers."""
    text = SCENE.replace("A,", f"{WALKER.left0!r},").replace("B,", f"{WALKER.right0!r},")
    case = typed(tmp_path, text, tail=tail(0.85, 18))
    mechanism = scenes.mechanism(case)
    found, own = follow(mechanism, case.times), follow(WALKER, case.times)
    assert own.events == ()
    for t, y, mode, x in zip(case.times.tolist(), found.y, own.modes, own.y, strict=True):
        poses = WALKER.modes[mode].poses(t, *np.split(x, 2))
        q, v = mechanism.base.place(poses)
        assert np.split(y, 2)[0] == pytest.approx(q, abs=1e-11)
        assert np.split(y, 2)[1] == pytest.approx(v, abs=1e-11)


@pytest.mark.mutant("a foot that passes the other one behind it strikes")
def test_no_foot_strikes_behind_the_other():
    """However far forward the leg leans that stands: behind, the other is above the floor."""
    (guard,) = WALKER.guards("left stands")
    random = np.random.default_rng(2)
    for s in random.uniform(-1.0, 1.0, 100).tolist():
        w = random.uniform(s, 1.5)  # against the normal: its foot is behind
        assert guard.g(0.0, np.array([0.0, s, w]), np.zeros(3)) > 0.0
    with pytest.raises(ArithmeticError, match="leans forward where the other passes"):
        WALKER.struck(0, np.array([0.0, 0.05, 0.049]), np.zeros(3))


def test_what_cannot_walk_is_said():
    q = np.array([0.0, -0.2, 0.2])
    says = WALKER.possible("left stands", 0.0, q, np.array([0.0, 9.0, 0.0]))
    assert "would have to pull" in str(says)
    says = replace(WALKER, mu=0.1).possible("left stands", 0.0, q, np.array([0.0, 0.8, 0.6]))
    assert "to pivot it needs friction" in str(says)
