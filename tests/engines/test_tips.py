"""A point of a body that turns stands, slides or pivots on the floor: where it is, and its forces.

Forces are compared at every sample, the first included: nothing settles first.
"""

import math
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np
import pytest
from given.closed_motions import leaning_bar, pivoting
from given.engine_scenes import G, incline, leaning, machine, pin, touching
from given.planning import TUNED, moved
from given.scenes import tail, typed

from textmech.cases.scene import Scene
from textmech.cases.scene.observe import observe
from textmech.cases.scene.shape import bar
from textmech.cases.trajectory import ANGLE, Array, X
from textmech.engines.engine import Start
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

RELEASED = math.radians(72.8)
LENGTH = 1.0  # m
ROD = bar(name="rod", mass=1.0, length=LENGTH, points={})
NORMAL, TANGENT = "touch_start.normal", "touch_start.tangent"
STEPS = (1e-3, 1e-4)  # s


@dataclass(frozen=True)
class Near:
    """How near a tuned engine comes with each of STEPS; measured values stand beside."""

    angle: tuple[float, float]  # rad
    normal: tuple[float, float]  # N of about 8
    tangent: tuple[float, float] = (1e-15, 1e-15)  # N
    x: tuple[float, float] = (1e-15, 1e-15)  # m


# pymunk's errors are of h² too, but where it sticks; its contact knows rounding in its own units.
# MuJoCo's floor gives way by 1e-6 m at 1e-4 s, an error of h²; what sticks creeps, an error of h.
FREE = {
    "mujoco": Near(
        angle=(3e-4, 3e-6),  # 9.9e-5, 1.1e-6
        normal=(2.4e-2, 5e-4),  # 7.8e-3, 1.5e-4
    ),
    "pymunk": Near(
        angle=(1e-4, 4.5e-7),  # 3.2e-5, 1.5e-7
        normal=(4e-3, 4e-5),  # 1.3e-3, 1.3e-5
        tangent=(3e-12, 3e-12),  # 9e-13
    ),
}
SLIDES = {
    "mujoco": Near(
        angle=(1.6e-4, 1.6e-6),  # 5.3e-5, 5.4e-7
        normal=(3e-3, 1.5e-4),  # 1.1e-3, 4.7e-5
        tangent=(3e-4, 1.5e-5),
        x=(6e-6, 6e-8),  # 2.0e-6, 2.1e-8
    ),
    "pymunk": Near(
        angle=(6e-5, 3e-7),  # 1.9e-5, 1.1e-7
        normal=(2.5e-3, 2.5e-5),  # 8.3e-4, 8.3e-6
        tangent=(2.5e-4, 2.5e-6),
        x=(2.5e-6, 2.2e-8),  # 8.3e-7, 7.4e-9
    ),
}
STICKS = {
    "mujoco": Near(
        angle=(7e-5, 1.8e-5),  # 2.4e-5, 5.9e-6
        normal=(1.5e-2, 1.5e-3),  # 5.0e-3, 4.8e-4
        tangent=(1.5e-2, 1.5e-3),  # 4.9e-3, 4.7e-4
    ),
    "pymunk": Near(
        angle=(1.2e-4, 1e-5),  # 4.0e-5, 3.4e-6
        normal=(6e-3, 6e-4),  # 2.1e-3, 2.0e-4
        tangent=(6e-3, 6e-4),  # 1.9e-3, 2.1e-4
    ),
}
LEANS = {
    "mujoco": Near(
        angle=(2.2e-5, 2.4e-7),  # 7.0e-6, 8.0e-8
        normal=(8e-3, 1.2e-4),  # 2.4e-3, 3.6e-5
    ),
    "pymunk": Near(
        angle=(3e-5, 1.7e-7),  # 1.0e-5, 5.6e-8
        normal=(5e-4, 4e-5),  # 1.6e-4, 1.4e-5
    ),
}

# It sticks until it slips, which takes a whole step: rad and N at 1e-4 s.
SLIPS = {
    "mujoco": (5e-5, 1.5e-3),  # 1.7e-5, 4.9e-4
    "pymunk": (3e-5, 6e-4),  # 9.3e-6, 2.1e-4
}
LEANING = """\
scene:
  bodies: {rod: {bar: {mass: 2, length: 0.8}}}
  contacts: {tip: {between: [rod.start, ground.floor], friction: 0.3}}
initial: {rod: {start: [0, 0], angle: 80 deg}}
allow: {rod.angle: 1.0e-3}
"""


def off(found: Array, wanted: Array | float) -> float:
    """The largest difference."""
    return float(np.abs(found - wanted).max())


@pytest.mark.parametrize("name", FREE)
@pytest.mark.parametrize("k", range(len(STEPS)))
def test_a_pencil_falls_on_a_smooth_floor(k: int, name: str) -> None:
    """Its centre falls straight down, and the floor never lets go."""
    times, near = np.linspace(0.0, 0.5, 26), FREE[name]
    scene, start = incline(ROD, touching("rod", 0.0, point="start")), leaning(LENGTH, RELEASED)
    run = moved(TUNED[name], scene, start, times, STEPS[k], reactions=(NORMAL, TANGENT))
    _, angle, normal = leaning_bar(times, LENGTH, RELEASED, 0.0)
    rows = run.states["rod"]
    assert off(rows[:, ANGLE], angle) < near.angle[k]
    assert off(run.reactions[NORMAL], normal) < near.normal[k]
    assert off(rows[:, X], rows[0, X]) < near.x[k]
    assert off(run.reactions[TANGENT], 0.0) < near.tangent[k]


@pytest.mark.parametrize("name", SLIDES)
@pytest.mark.parametrize("k", range(len(STEPS)))
def test_a_pencil_slides_away(k: int, name: str) -> None:
    times, near, mu = np.linspace(0.0, 0.28, 15), SLIDES[name], 0.1
    scene, start = incline(ROD, touching("rod", mu, point="start")), leaning(LENGTH, RELEASED)
    run = moved(TUNED[name], scene, start, times, STEPS[k], reactions=(NORMAL, TANGENT))
    x, angle, normal = leaning_bar(times, LENGTH, RELEASED, mu)
    rows = run.states["rod"]
    assert off(rows[:, ANGLE], angle) < near.angle[k]
    assert off(rows[:, X], x) < near.x[k]
    assert off(run.reactions[NORMAL], normal) < near.normal[k]
    assert off(run.reactions[TANGENT], mu * normal) < near.tangent[k]


@pytest.mark.parametrize("name", STICKS)
@pytest.mark.parametrize("k", range(len(STEPS)))
def test_a_rod_pivots_about_a_tip_that_sticks(k: int, name: str) -> None:
    times, near = np.linspace(0.0, 0.3, 16), STICKS[name]
    scene, start = incline(ROD, touching("rod", 0.9, point="start")), leaning(LENGTH, RELEASED)
    run = moved(TUNED[name], scene, start, times, STEPS[k], reactions=(NORMAL, TANGENT))
    angle, ax, ay = pivoting(times, LENGTH, RELEASED)
    assert off(run.states["rod"][:, ANGLE], angle) < near.angle[k]
    assert off(run.reactions[NORMAL], G + ay) < near.normal[k]
    assert off(run.reactions[TANGENT], ax) < near.tangent[k]


def a_frame() -> tuple[Scene, Start]:
    """Two bars, pinned at their upper ends, that slide apart on a smooth floor."""
    left, right = (bar(name=name, mass=1.0, length=LENGTH, points={}) for name in ("left", "right"))
    tips = [touching(name, 0.0, point="start") for name in ("left", "right")]
    contacts = [tips[0], replace(tips[1], name="other")]
    scene = machine([left, right], [pin("top", "left.end", "right.end")], contacts=contacts)
    x, y, *_ = leaning(LENGTH, RELEASED)["rod"]
    return scene, {
        "left": (-x, y, RELEASED, 0.0, 0.0, 0.0),
        "right": (x, y, math.pi - RELEASED, 0.0, 0.0, 0.0),
    }


@pytest.mark.slow
@pytest.mark.parametrize("name", LEANS)
@pytest.mark.parametrize("k", range(len(STEPS)))
def test_two_bars_slide_apart(k: int, name: str) -> None:
    times, near = np.linspace(0.0, 0.4, 21), LEANS[name]
    wanted = (NORMAL, "other.normal")
    run = moved(TUNED[name], *a_frame(), times, STEPS[k], reactions=wanted)
    angle, _, ay = pivoting(times, LENGTH, RELEASED)
    assert off(run.states["left"][:, ANGLE], angle) < near.angle[k]
    assert off(run.states["right"][:, ANGLE], math.pi - angle) < near.angle[k]
    for each in wanted:
        assert off(run.reactions[each], G + ay) < near.normal[k]


@pytest.mark.slow
@pytest.mark.parametrize("name", SLIPS)
def test_a_tip_sticks_and_then_slips(name: str, tmp_path: Path) -> None:
    """A contact that opened now and then carried nothing or the double: 15 N of 4.8."""
    case = typed(tmp_path, LEANING, tail=tail(0.5, 26))
    exact = solve(case).trajectory
    run = moved(TUNED[name], case.scene, first(exact), case.times, 1e-4, reactions=("tip.normal",))
    angle, normal = SLIPS[name]
    for quantity, near in (("rod.angle", angle), ("tip.normal", normal)):
        wanted = observe(case.scene, exact, quantity)
        assert off(observe(case.scene, run, quantity), wanted) < near
