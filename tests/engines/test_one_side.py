"""Springs of one side in every engine: against the reference, in the script, and refused."""

import subprocess
import sys
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.planning import SHIPPED, TUNED, moved, planned, refused, ways

from textmech.cases.case import Case
from textmech.cases.scene import Scene, Spring
from textmech.cases.trajectory import Trajectory
from textmech.engines.engine import Realised, Start
from textmech.engines.law import TENSIONS
from textmech.engines.mujoco.model.force import ELEMENTS
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

BOTH = """\
scene:
  points: {foot: [0, 0], hook: [-0.4, 2.2]}
  bodies: {rod: {bar: {mass: 1.5, length: 0.6}}}
  forces:
    leg: {spring: [ground.foot, rod.start], stiffness: 900, rest_length: 0.5, only: compression}
    band: {spring: [rod.end, ground.hook], stiffness: 60, rest_length: 1.1, only: tension}
initial: {rod: {x: 0.3, y: 0.9, angle: 70 deg, vx: -0.2, vy: -1.5, omega: 1.0}}
allow: {rod.x: 1.0e-3, rod.angle: 1.0e-2, leg.force: 1.0, band.force: 1.0}
"""
END = scenes.tail(0.6, 13)
STEP = 5e-4
WAY: dict[str, Realised] = {"mujoco": "native", "pymunk": "law"}
REACHED = {"mujoco": 1e-5, "pymunk": 5e-5}  # m, rad; measured at this step: 1.8e-6 and 1.2e-5


@dataclass(frozen=True)
class Moving:
    """A case, its certified motion, and where that starts."""

    case: Case
    known: Trajectory

    @property
    def scene(self) -> Scene:
        return self.case.scene

    @property
    def start(self) -> Start:
        return first(self.known)


@pytest.fixture(scope="module")
def both(tmp_path_factory: pytest.TempPathFactory) -> Moving:
    """A bar that is caught by a band, and falls on its leg."""
    case = scenes.typed(tmp_path_factory.mktemp("both"), BOTH, tail=END)
    return Moving(case, solve(case).trajectory)


def off(both: Moving, engine: str) -> float:
    times = both.case.times
    run = moved(TUNED[engine], both.scene, both.start, times, STEP, realised=WAY[engine])
    return float(np.max(np.abs(run.states["rod"][:, :3] - both.known.states["rod"][:, :3])))


@pytest.mark.slow
@pytest.mark.parametrize("engine", REACHED)
def test_engines_follow_the_reference(engine: str, both: Moving) -> None:
    switches = len(both.known.switches)
    assert switches >= 2  # or nothing is tried
    assert off(both, engine) < REACHED[engine]


def two_sided(force: Spring, length: float, rate: float) -> float:
    return force.stiffness * (length - force.rest_length)


@pytest.mark.mutant(
    "a one-sided spring that acts on both sides, in pymunk",
    "a one-sided spring that acts on both sides, in mujoco",
)
def test_a_spring_of_both_sides_is_seen(both: Moving, monkeypatch: pytest.MonkeyPatch) -> None:
    """In the law that pymunk is told, and in the dead band that MuJoCo is."""
    monkeypatch.setitem(TENSIONS, Spring, two_sided)
    assert off(both, "pymunk") > 1e-2
    element = ELEMENTS[Spring]

    def without_band(sections: Any, force: Spring) -> None:
        element.write(sections, replace(force, only=None))

    monkeypatch.setitem(ELEMENTS, Spring, replace(element, write=without_band))
    assert off(both, "mujoco") > 1e-2


def test_pymunk_has_none_of_its_own(both: Moving) -> None:
    begin = both.start
    for engine in (TUNED["pymunk"], SHIPPED["pymunk"]):
        said = refused(engine, both.scene, begin)
        assert said == "engine: a spring of pymunk's own acts both ways"
    assert ways(TUNED["pymunk"], both.scene, begin) == ("native", "law")
    assert ways(SHIPPED["pymunk"], both.scene, begin) == ("native",)
    assert ways(TUNED["mujoco"], both.scene, begin) == ("native",)
    for engine, way in WAY.items():
        assert planned(TUNED[engine], both.scene, begin, way).held == (1, 2)  # corners: no order


def test_pymunks_script_makes_the_same_motion(both: Moving) -> None:
    engine, begin = TUNED["pymunk"], both.start
    plan = planned(engine, both.scene, begin, "law")
    text = engine.script(both.scene, begin, 1e-3, plan)
    assert text.count("force_func") == 2
    done = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    (row,) = (line.split() for line in done.stdout.splitlines())
    second = np.array([0.0, 1.0])
    run = moved(engine, both.scene, begin, second, 1e-3, realised="law")
    assert [float(x) for x in row[1:]] == pytest.approx(run.states["rod"][-1].tolist(), abs=1e-10)
