"""Ropes in every engine: against the reference, in the script, and beside what is not built."""

import subprocess
import sys
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.adapters.planning import SHIPPED, TUNED, apart, moved, planned, refused, ways
from given.scenes import ropes

from textmech.cases.case import Case
from textmech.cases.scene import Scene, Spring
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Trajectory
from textmech.engines.engine import Realised, Start, Tunable
from textmech.engines.law import TENSIONS
from textmech.engines.mujoco.model import limit as of_mujoco
from textmech.engines.mujoco.model.force import ELEMENTS
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

END = scenes.tail(1.0, 26)
STEP = 1e-4
AWAY = 0.03  # s: from what comes taut; a soft limit needs 4 ms to come to what it carries
# m and rad, N; measured: MuJoCo's own throws back up to 1.5 % of what it catches, 7.5e-3 m later,
# pymunk's up to 1 %.
REACHED = {"mujoco": (2e-2, 0.1), "pymunk": (2e-2, 0.2)}


def known(tmp_path: Path, name: str) -> tuple[Case, Trajectory, Start]:
    case = scenes.typed(tmp_path, ropes.EVERY[name], tail=END)
    motion = solve(case).trajectory
    return case, motion, first(motion)


def off(case: Case, motion: Trajectory, found: Trajectory, forces: tuple[str, ...]) -> Any:
    """How far places are, and forces."""
    away = np.min(np.abs(case.times[:, None] - motion.switches), axis=1) > AWAY
    places = [np.abs(found.states[b] - rows)[away, :3].max() for b, rows in motion.states.items()]
    pulls = [
        np.abs(found.reactions[name] - observe(case.scene, motion, name))[away].max()
        for name in forces
    ]
    return max(places), max(pulls)


@pytest.mark.slow
@pytest.mark.parametrize("name", ropes.EVERY)
@pytest.mark.parametrize("engine", REACHED)
def test_engines_move_as_the_reference(engine: str, name: str, tmp_path: Path) -> None:
    case, motion, start = known(tmp_path, name)
    forces = tuple(quantity for quantity in case.allow if quantity.endswith("force"))
    found = moved(TUNED[engine], case.scene, start, case.times, STEP, reactions=forces)
    places, pulls = off(case, motion, found, forces)
    assert places < REACHED[engine][0]
    if name != "pair":  # a pull of 0.04 N, which their own ropes lose to what they throw back
        assert pulls < REACHED[engine][1]


@pytest.mark.slow
def test_a_rope_that_swings_pulls_rightly_from_the_start() -> None:
    """Without the stretch with which it begins, MuJoCo's limit would not pull at all at t = 0."""
    case = scenes.SHIPPED["ball_on_rope.let_go"]
    motion = scenes.solved(case.name).trajectory
    found = moved(
        TUNED["mujoco"], case.scene, first(motion), case.times, STEP, reactions=("rope.force",)
    )
    (begins,) = motion.reactions["rope.force"][:1]
    assert begins == pytest.approx(0.6 * (9.80665 + 6.3**2), rel=1e-12)
    assert found.reactions["rope.force"][0] == pytest.approx(begins, abs=0.2)


HANGS = """\
scene:
  points: {O: [0, 1]}
  bodies: {a: {particle: {mass: 2}}}
  forces:
    r: {rope: [ground.O, a.center], length: 1}
    p: {push: a.center, sine: {amplitude: [0.1, 0], angular_frequency: 3}}
initial: {a: {x: 0, y: 0}}
allow: {a.x: 1.0e-3, r.force: 0.1}
"""


@pytest.mark.slow
@pytest.mark.parametrize("engine", TUNED)
def test_what_hangs_at_rest_is_held_from_the_first_sample_on(engine: str, tmp_path: Path) -> None:
    """A limit that is just met pulls nothing in MuJoCo."""
    case = scenes.typed(tmp_path, HANGS, tail=END)
    motion = solve(case).trajectory
    found = moved(
        TUNED[engine], case.scene, first(motion), case.times, STEP, reactions=("r.force",)
    )
    assert motion.reactions["r.force"][0] == pytest.approx(2 * 9.80665, rel=1e-12)
    assert found.reactions["r.force"] == pytest.approx(motion.reactions["r.force"], abs=0.02)


COARSE = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {ball: {particle: {mass: 1}}}
  forces: {rope: {rope: [ground.O, ball.center], length: 1}}
initial: {ball: {x: BEGIN, y: 0, vx: 2, vy: 0}}
allow: {ball.x: 1.0e-2}
"""


@pytest.mark.slow
def test_what_a_coarse_step_catches_is_hardly_thrown_back(tmp_path: Path) -> None:
    """pymunk finds a rope too long by up to v h, and takes it back at the rate r: v h r."""
    begins = (0.5, 0.5004, 0.5009, 0.5014, 0.5019)  # wherever in a step it comes taut
    for begin in begins:
        text = COARSE.replace("BEGIN", str(begin))
        case = scenes.typed(tmp_path, text, tail=scenes.tail(0.5, 6))
        start = first(solve(case).trajectory)
        found = moved(TUNED["pymunk"], case.scene, start, case.times, 1e-3)
        speed = found.states["ball"][-1, 3]
        assert abs(speed) < 0.05 * 2.0  # with 150/s at any step: up to 0.15


# Springs of one side in every engine: against the reference, in the script, and refused.


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
SIDED_END = scenes.tail(0.6, 13)
SIDED_STEP = 5e-4
WAY: dict[str, Realised] = {"mujoco": "native", "pymunk": "law"}
SIDED = {"mujoco": 1e-5, "pymunk": 5e-5}  # m, rad; measured at this step: 1.8e-6 and 1.2e-5


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
    case = scenes.typed(tmp_path_factory.mktemp("both"), BOTH, tail=SIDED_END)
    return Moving(case, solve(case).trajectory)


def sided_off(both: Moving, engine: str) -> float:
    times = both.case.times
    run = moved(TUNED[engine], both.scene, both.start, times, SIDED_STEP, realised=WAY[engine])
    return float(apart(both.known, run)[:3].max())


@pytest.mark.slow
@pytest.mark.parametrize("engine", SIDED)
def test_engines_follow_the_reference(engine: str, both: Moving) -> None:
    switches = len(both.known.switches)
    assert switches >= 2  # or nothing is tried
    assert sided_off(both, engine) < SIDED[engine]


def two_sided(force: Spring, length: float, rate: float) -> float:
    return force.stiffness * (length - force.rest_length)


@pytest.mark.mutant(
    "a one-sided spring that acts on both sides, in pymunk",
    "a one-sided spring that acts on both sides, in mujoco",
)
def test_a_spring_of_both_sides_is_seen(both: Moving, monkeypatch: pytest.MonkeyPatch) -> None:
    """In the law that pymunk is told, and in the dead band that MuJoCo is."""
    monkeypatch.setitem(TENSIONS, Spring, two_sided)
    assert sided_off(both, "pymunk") > 1e-2
    element = ELEMENTS[Spring]

    def without_band(sections: Any, force: Spring) -> None:
        element.write(sections, replace(force, only=None))

    monkeypatch.setitem(ELEMENTS, Spring, replace(element, write=without_band))
    assert sided_off(both, "mujoco") > 1e-2


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


# Stops of joints in every engine: both ends, joints named backward, and what is refused.


# A driven arm that is swung against both stops of its elbow, which names the arm first or last.
ARM = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {rod: {bar: {mass: 1.2, length: 0.8}}, arm: {bar: {mass: 0.7, length: 0.5}}}
  joints: {hinge: {pin: [ground.O, rod.start]}, elbow: {pin: [PARTS]}}
  forces:
    ends: {stops: elbow, low: LOW deg, high: HIGH deg}
    hand: {torque: arm, pulse: {amplitude: 1.0, from: 0, until: 0.5}}
    back: {torque: arm, pulse: {amplitude: -2.0, from: 0.5, until: 1.5}}
initial: {rod: {angle: 0, omega: 0}, arm: {angle: 10 deg, omega: 0}}
allow: {rod.angle: 1.0e-2, arm.angle: 1.0e-2, ends.torque: 1.0, hinge.force: 1.0}
"""
FORWARD = ARM.replace("PARTS", "rod.end, arm.start").replace("LOW", "-25").replace("HIGH", "35")
BACKWARD = ARM.replace("PARTS", "arm.start, rod.end").replace("LOW", "-35").replace("HIGH", "25")
STOP_END = scenes.tail(1.2, 61)
# rad and N m; measured: MuJoCo's spring and damper takes 0.2 s to come out of a stop, 3e-4 rad,
# pymunk's bias 7 ms.
STOPPED = {"mujoco": (2e-3, 0.2), "pymunk": (2e-3, 0.2)}
STOP_AWAY = 0.05  # s


def stopped(tmp_path: Path, text: str) -> tuple[Case, Trajectory]:
    case = scenes.typed(tmp_path, text, tail=STOP_END)
    solution = solve(case)
    assert solution.holds
    return case, solution.trajectory


def stop_off(engine: str, case: Case, motion: Trajectory) -> tuple[float, float]:
    found = moved(
        TUNED[engine],
        case.scene,
        first(motion),
        case.times,
        1e-4,
        reactions=("ends.low", "ends.high"),
    )
    away = np.min(np.abs(case.times[:, None] - motion.switches), axis=1) > STOP_AWAY
    torque = observe(case.scene, found, "ends.torque") - observe(case.scene, motion, "ends.torque")
    return float(apart(motion, found)[2]), float(np.abs(torque)[away].max())


@pytest.mark.slow
def test_the_reference_presses_on_both_stops_alike(tmp_path: Path) -> None:
    """Of a joint that is named backward all signs turn, and the motion stays."""
    (case, motion), (turned, same) = (stopped(tmp_path, text) for text in (FORWARD, BACKWARD))
    for body, rows in motion.states.items():
        assert np.max(np.abs(same.states[body] - rows)) < 1e-12
    torque = observe(case.scene, motion, "ends.torque")
    assert np.max(np.abs(torque + observe(turned.scene, same, "ends.torque"))) < 1e-12
    assert min(torque) < -0.1 < 0.1 < max(torque)
    angle = observe(case.scene, motion, "ends.angle")
    assert np.ptp(angle) == pytest.approx(np.radians(60.0), abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("text", [FORWARD, BACKWARD], ids=["forward", "backward"])
@pytest.mark.parametrize("engine", STOPPED)
def test_engines_stop_as_the_reference(engine: str, text: str, tmp_path: Path) -> None:
    angles, torque = stop_off(engine, *stopped(tmp_path, text))
    assert angles < STOPPED[engine][0]
    assert torque < STOPPED[engine][1]


@pytest.mark.slow
@pytest.mark.mutant("range of a stop not turned round with its joint")
def test_a_range_that_is_not_turned_round_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def as_it_is(stops: Any) -> tuple[float, float]:
        return -stops.high, -stops.low

    case, motion = stopped(tmp_path, BACKWARD)
    monkeypatch.setattr(of_mujoco, "_ends", as_it_is)
    assert stop_off("mujoco", case, motion)[0] > 0.1


@pytest.mark.slow
def test_what_engines_hold(tmp_path: Path) -> None:
    for text in (FORWARD, BACKWARD):
        case, motion = stopped(tmp_path, text)
        for engine in STOPPED:
            held = TUNED[engine].measure(case.scene, first(motion))
            for name, angle in case.scene.forces["ends"].numbers().items():
                assert held[f"ends.{name}"] == pytest.approx(angle, rel=1e-14)


def test_refusals(tmp_path: Path) -> None:
    lively = FORWARD.replace("HIGH", "35").replace("high: 35 deg", "high: 35 deg, restitution: 0.5")
    scene = scenes.typed(tmp_path, lively, tail=STOP_END).scene
    assert refused(TUNED["pymunk"], scene) == (
        "engine: pymunk's rotary limit throws nothing back, and ends has the restitution 0.5"
    )
    again = FORWARD.replace("    hand:", "    more: {stops: elbow, low: -9 rad}\n    hand:")
    assert refused(TUNED["mujoco"], scenes.typed(tmp_path, again, tail=STOP_END).scene) == (
        "adapter: more is not the only stops of elbow"
    )


@pytest.mark.slow
@pytest.mark.mutant("every stop with the spring of the one that throws back most")
def test_stops_that_throw_back_differently_have_springs_of_their_own(tmp_path: Path) -> None:
    """The shaft's stop, which throws nothing back, beside that of the elbow."""
    lively = FORWARD.replace("high: HIGH", "high: 35").replace("deg}", "deg, restitution: 0.5}", 1)
    shaft = "    more: {stops: hinge, high: 12 deg}\n    hand:"
    case, motion = stopped(tmp_path, lively.replace("    hand:", shaft, 1))
    assert [limit.back for limit in case.scene.limits()] == [0.5, 0.0]
    scene = case.scene

    def off_by(**restitution: float) -> float:
        stops = {n: replace(scene.forces[n], restitution=e) for n, e in restitution.items()}
        told = replace(scene, forces={**scene.forces, **stops})
        found = moved(TUNED["mujoco"], told, first(motion), case.times, 1e-4)
        return float(apart(motion, found)[2])

    assert off_by() < 0.02 < 0.1 < off_by(more=0.5)  # rad: the elbow's spring keeps 0.5 to 1 %


PRESSED = """\
scene:
  points: {O: [0, 0]}
  bodies: {b: {bar: {mass: 1, length: 1}}}
  joints: {A: {pin: [PARTS]}}
  forces: {e: {stops: A, SIDE deg}, m: {motor: A, table: {times: [0, 1], values: [0, WAY8]}}}
initial: {b: {angle: -30 deg, omega: 0}}
allow: {b.angle: 1.0e-2, e.torque: 0.2}
"""
FIRST = PRESSED.replace("PARTS", "ground.O, b.start").replace("SIDE", "low: -30")
SECOND = PRESSED.replace("PARTS", "b.start, ground.O").replace("SIDE", "high: 30")


@pytest.mark.slow
@pytest.mark.parametrize(
    "text", [FIRST.replace("WAY", ""), SECOND.replace("WAY", "-")], ids=["low", "high"]
)
def test_what_starts_at_its_stop_is_held_from_the_first_sample_on(
    tmp_path: Path, text: str
) -> None:
    """The bar's weight presses it there, until a motor lifts it."""
    case, motion = stopped(tmp_path, text)
    (quantity,) = (f"e.{name}" for name in case.scene.forces["e"].numbers())
    found = moved(
        TUNED["mujoco"], case.scene, first(motion), case.times, 1e-3, reactions=(quantity,)
    )
    wanted = observe(case.scene, motion, "e.torque")
    assert abs(wanted[0]) > 4
    assert np.max(np.abs(observe(case.scene, found, "e.torque") - wanted)) < 2e-3  # 4e-4
    assert np.max(np.abs(found.states["b"][:, 2] - motion.states["b"][:, 2])) < 1e-4
    tuned = TUNED["mujoco"]
    assert isinstance(tuned, Tunable)
    assert tuned.recipe(case.scene, first(motion))["settled"] is True


@pytest.mark.parametrize(
    ("old", "new", "what"),
    [
        ("angle: 10 deg", "angle: 40 deg", "ends.high is passed by 5° at the start"),
        ("angle: 10 deg, omega: 0", "angle: 35 deg, omega: 2",
         "ends.high is where it starts, and it turns into it with 2 rad/s"),
    ],
)  # fmt: skip
def test_starts_that_no_stop_allows(tmp_path: Path, old: str, new: str, what: str) -> None:
    with pytest.raises(Exception, match=what):
        solve(scenes.typed(tmp_path, FORWARD.replace(old, new), tail=STOP_END))
