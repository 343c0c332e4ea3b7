"""What an engine is asked for, so that every force of a row can be told."""

import numpy as np
import pytest
from given import scenes
from given.engine_space import LOPSIDED, G, hinge, rigid, simulated, spatial, state

from textmech.cases.scene import Signal
from textmech.cases.scene.frame import PLANE
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import table
from textmech.reports.compare.trial.ladder import wanted_reactions

DRIVEN = spatial(
    [rigid("rod", 1.3, LOPSIDED, {"end": (0.2, 0.1, 0.0)})],
    [hinge("q1", "ground.O", "rod.end", (0.0, 0.0, 1.0))],
    drives={"q1.omega": Signal("constant", (2.0,))},
)


def test_in_the_plane_each_force_is_asked_for_by_itself() -> None:
    for one in (case for case in scenes.SHIPPED.values() if case.scene.frame is PLANE):
        forces = [
            q.name
            for q in table(one.scene).values()
            if q.kind in ("force", "acceleration") and q.part not in one.scene.forces
        ]
        rods = {f"{joint.name}.force" for joint in one.scene.joints.values() if joint.swings}
        told = tuple(name for name in forces if name not in rods)
        inner = one.scene.inner()
        limits = [force for limit in one.scene.limits() for force in limit.reactions()]
        assert wanted_reactions(one.scene, forces) == (*told, *inner)
        assert wanted_reactions(one.scene, table(one.scene)) == (*told, *limits, *inner)


def test_work_is_told_by_what_drives_and_stops_by_both() -> None:
    knee = scenes.SHIPPED["driven_knee.spring"].scene
    assert wanted_reactions(knee, ["knee.work", "coil.work"]) == ("knee.torque",)
    stopped = scenes.SHIPPED["stopped_pendulum.rests"].scene
    assert wanted_reactions(stopped, ["stop.torque", "stop.angle"]) == ("stop.low", "stop.high")
    assert wanted_reactions(DRIVEN, ["q1.work"]) == ("q1.torque",)


def test_in_space_sizes_are_told_by_components_and_each_is_asked_for_once() -> None:
    names = ("q1.angle", "q1.force", "q1.fx", "q1.moment", "q1.torque", "energy.total", "e.time")
    components = ("q1.fx", "q1.fy", "q1.fz", "q1.mx", "q1.my", "q1.mz", "q1.torque")
    assert wanted_reactions(DRIVEN, names) == components


def test_a_rim_tells_along_and_side_by_its_force() -> None:
    disk = scenes.SHIPPED["tilting_disk.circle"].scene
    names = ("touch.side", "touch.along", "touch.normal", "touch.slip")
    assert wanted_reactions(disk, names) == ("touch.fx", "touch.fy", "touch.normal")


@pytest.mark.parametrize("name", ["q1.force", "q1.moment", "q1.fz", "q1.torque"])
def test_what_is_asked_for_is_enough(name: str) -> None:
    """An engine that is asked so gives what `observe` needs. Turning evenly about z, it carries."""
    start = {"rod": state((-0.2, -0.1, 0.0), (1, 0, 0, 0), (0.2, -0.4, 0.0), (0, 0, 2.0))}
    times = np.linspace(0.0, 0.1, 3)
    motion = simulated(DRIVEN, start, times, 1e-3, wanted_reactions(DRIVEN, [name]))
    found = observe(DRIVEN, motion, name)
    assert found.shape == times.shape
    if name == "q1.fz":
        assert np.allclose(found, 1.3 * G, atol=1e-9)  # N, of 13: the engine's rounding
