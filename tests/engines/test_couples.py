"""A torque between two bodies: where a pin joins them it is the motor of the pin, everywhere."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes, torsion
from given.planning import TUNED, moved

from textmech.cases.case import Case
from textmech.cases.scene.forces.force import Couple
from textmech.engines.engine import Start
from textmech.engines.mujoco.model import force as mujoco_force
from textmech.engines.mujoco.model import force as of_mujoco
from textmech.engines.pymunk.callbacks import force as of_pymunk
from textmech.engines.pymunk.callbacks import force as pymunk_force
from textmech.reference.solve import solve

# The pin `elbow` has arm as its first part.
COUPLED = torsion.ARM.replace("drive: {motor: elbow,", "drive: {couple: [arm, rod],")
END = scenes.tail(0.4, 3)
STEP = {"mujoco": 1e-3, "pymunk": 5e-4}
SAME = 1e-12  # rad: one torque, entered at other places
LAWS = {
    "constant": "constant: 0.7",
    "ramp": "ramp: 0.7",
    "sine": "sine: {amplitude: 1.3, angular_frequency: 4.0}",
    "pulse": "pulse: {amplitude: 0.7, from: 0.11, until: 0.23}",
}


def cases(tmp_path: Path, law: str) -> tuple[Case, Case]:
    """The couple, and the motor."""
    texts = (text.replace(LAWS["sine"], LAWS[law]) for text in (COUPLED, torsion.ARM))
    coupled, motor = (scenes.typed(tmp_path, text, tail=END) for text in texts)
    assert isinstance(coupled.scene.forces["drive"], Couple)
    return coupled, motor


def angles(engine: str, case: Case) -> Any:
    start: Start = {"rod": _at(0.0, 20.0, 0.8, 1.0), "arm": _at(1.0, -50.0, 0.5, 0.0)}
    run = moved(TUNED[engine], case.scene, start, case.times, STEP[engine])
    return np.array([run.states[body][:, 2] for body in ("rod", "arm")])


def _at(ends: float, degrees: float, length: float, omega: float) -> Any:
    """A bar's centre by its angle: the rod from the origin on, the arm from the rod's end."""
    root = ends * 0.8 * np.array([np.cos(np.radians(20.0)), np.sin(np.radians(20.0))])
    along = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    x, y = root + length / 2 * along
    vx, vy = np.array([-root[1], root[0]]) + omega * length / 2 * np.array([-along[1], along[0]])
    return tuple(map(float, (x, y, np.radians(degrees), vx, vy, omega)))


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("engine", STEP)
def test_an_engine_turns_as_with_the_motor(engine: str, law: str, tmp_path: Path) -> None:
    coupled, motor = cases(tmp_path, law)
    assert np.max(np.abs(angles(engine, coupled) - angles(engine, motor))) < SAME


@pytest.mark.slow
def test_the_reference_moves_as_with_the_motor(tmp_path: Path) -> None:
    coupled, motor = (solve(case) for case in cases(tmp_path, "sine"))
    assert coupled.holds
    for body, rows in motor.trajectory.states.items():
        assert np.max(np.abs(coupled.trajectory.states[body] - rows)) < SAME
    hinge = [s.trajectory.reactions["hinge.fx"] for s in (coupled, motor)]
    assert np.max(np.abs(hinge[0] - hinge[1])) < 1e-10  # N


def alone(write: Callable[..., Any]) -> Callable[..., Any]:
    """MuJoCo's actuator without the body that takes the opposite."""

    def written(sections: Any, force: Couple) -> None:
        write(sections, force)
        del sections["actuator"][-1].attrib["refsite"]

    return written


def backward(tell: Callable[..., Any]) -> Callable[..., Any]:
    """pymunk's torque on the wrong body."""

    def told(world: Any, force: Couple, step: float, drift: float) -> Any:
        return tell(world, replace(force, first=force.second, second=force.first), step, drift)

    return told


@pytest.mark.mutant(
    "a couple without its opposite in mujoco", "a couple on the wrong bodies in pymunk"
)
@pytest.mark.parametrize("engine", STEP)
def test_a_lost_or_turned_opposite_is_seen(
    engine: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    elements = {"mujoco": mujoco_force, "pymunk": pymunk_force}[engine].ELEMENTS
    wrong = {
        "mujoco": {"write": alone(of_mujoco.write_couple)},
        "pymunk": {"tell": backward(of_pymunk.couple)},
    }[engine]
    monkeypatch.setitem(elements, Couple, replace(elements[Couple], **wrong))  # type: ignore[arg-type]
    coupled, motor = cases(tmp_path, "sine")
    assert np.max(np.abs(angles(engine, coupled) - angles(engine, motor))) > 1e-3
