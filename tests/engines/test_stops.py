"""Stops of joints in every engine: both ends, joints named backward, and what is refused."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.planning import TUNED, moved, refused

from textmech.cases.case import Case
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Trajectory
from textmech.engines.engine import Tunable
from textmech.engines.mujoco.model import limit as of_mujoco
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

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
END = scenes.tail(1.2, 61)
# rad and N m; measured: MuJoCo's spring and damper takes 0.2 s to come out of a stop, 3e-4 rad,
# pymunk's bias 7 ms.
REACHED = {"mujoco": (2e-3, 0.2), "pymunk": (2e-3, 0.2)}
AWAY = 0.05  # s


def known(tmp_path: Path, text: str) -> tuple[Case, Trajectory]:
    case = scenes.typed(tmp_path, text, tail=END)
    solution = solve(case)
    assert solution.holds
    return case, solution.trajectory


def off(engine: str, case: Case, motion: Trajectory) -> tuple[float, float]:
    found = moved(
        TUNED[engine],
        case.scene,
        first(motion),
        case.times,
        1e-4,
        reactions=("ends.low", "ends.high"),
    )
    away = np.min(np.abs(case.times[:, None] - motion.switches), axis=1) > AWAY
    angles = [np.abs(found.states[b] - rows)[:, 2].max() for b, rows in motion.states.items()]
    torque = observe(case.scene, found, "ends.torque") - observe(case.scene, motion, "ends.torque")
    return max(angles), float(np.abs(torque)[away].max())


@pytest.mark.slow
def test_the_reference_presses_on_both_stops_alike(tmp_path: Path) -> None:
    """Of a joint that is named backward all signs turn, and the motion stays."""
    (case, motion), (turned, same) = (known(tmp_path, text) for text in (FORWARD, BACKWARD))
    for body, rows in motion.states.items():
        assert np.max(np.abs(same.states[body] - rows)) < 1e-12
    torque = observe(case.scene, motion, "ends.torque")
    assert np.max(np.abs(torque + observe(turned.scene, same, "ends.torque"))) < 1e-12
    assert min(torque) < -0.1 < 0.1 < max(torque)
    angle = observe(case.scene, motion, "ends.angle")
    assert np.ptp(angle) == pytest.approx(np.radians(60.0), abs=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("text", [FORWARD, BACKWARD], ids=["forward", "backward"])
@pytest.mark.parametrize("engine", REACHED)
def test_engines_stop_as_the_reference(engine: str, text: str, tmp_path: Path) -> None:
    angles, torque = off(engine, *known(tmp_path, text))
    assert angles < REACHED[engine][0]
    assert torque < REACHED[engine][1]


@pytest.mark.slow
@pytest.mark.mutant("range of a stop not turned round with its joint")
def test_a_range_that_is_not_turned_round_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def as_it_is(stops: Any) -> tuple[float, float]:
        return -stops.high, -stops.low

    case, motion = known(tmp_path, BACKWARD)
    monkeypatch.setattr(of_mujoco, "_ends", as_it_is)
    assert off("mujoco", case, motion)[0] > 0.1


@pytest.mark.slow
def test_what_engines_hold(tmp_path: Path) -> None:
    for text in (FORWARD, BACKWARD):
        case, motion = known(tmp_path, text)
        for engine in REACHED:
            held = TUNED[engine].measure(case.scene, first(motion))
            for name, angle in case.scene.forces["ends"].numbers().items():
                assert held[f"ends.{name}"] == pytest.approx(angle, rel=1e-14)


def test_refusals(tmp_path: Path) -> None:
    lively = FORWARD.replace("HIGH", "35").replace("high: 35 deg", "high: 35 deg, restitution: 0.5")
    scene = scenes.typed(tmp_path, lively, tail=END).scene
    assert refused(TUNED["pymunk"], scene) == (
        "engine: pymunk's rotary limit throws nothing back, and ends has the restitution 0.5"
    )
    again = FORWARD.replace("    hand:", "    more: {stops: elbow, low: -9 rad}\n    hand:")
    assert refused(TUNED["mujoco"], scenes.typed(tmp_path, again, tail=END).scene) == (
        "adapter: more is not the only stops of elbow"
    )


@pytest.mark.slow
@pytest.mark.mutant("every stop with the spring of the one that throws back most")
def test_stops_that_throw_back_differently_have_springs_of_their_own(tmp_path: Path) -> None:
    """The shaft's stop, which throws nothing back, beside that of the elbow."""
    lively = FORWARD.replace("high: HIGH", "high: 35").replace("deg}", "deg, restitution: 0.5}", 1)
    shaft = "    more: {stops: hinge, high: 12 deg}\n    hand:"
    case, motion = known(tmp_path, lively.replace("    hand:", shaft, 1))
    assert [limit.back for limit in case.scene.limits()] == [0.5, 0.0]
    scene = case.scene

    def apart(**restitution: float) -> float:
        stops = {n: replace(scene.forces[n], restitution=e) for n, e in restitution.items()}
        told = replace(scene, forces={**scene.forces, **stops})
        found = moved(TUNED["mujoco"], told, first(motion), case.times, 1e-4)
        return max(
            float(np.abs(found.states[body] - rows)[:, 2].max())
            for body, rows in motion.states.items()
        )

    assert apart() < 0.02 < 0.1 < apart(more=0.5)  # rad: the elbow's spring keeps 0.5 to 1 %


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
    case, motion = known(tmp_path, text)
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
        solve(scenes.typed(tmp_path, FORWARD.replace(old, new), tail=END))
