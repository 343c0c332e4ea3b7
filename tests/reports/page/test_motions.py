"""What is drawn is what was computed: poses, curves and the joints between bodies."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.otherwise import otherwise

from textmech import engines
from textmech.cases.case import Case
from textmech.cases.scene.motion import Motion as Looked
from textmech.cases.scene.observe import observe
from textmech.reports.batch.selection import choose_cases
from textmech.reports.page import poses
from textmech.reports.page.motions import POINTS, motion, thinned
from textmech.reports.page.pack import unpacked, unpacked_by_size
from textmech.reports.page.picture import _placed
from textmech.reports.page.poses import read
from textmech.reports.page.sketch import sketch

LEVEL = 1 / 4096  # of a range: half of it is rounded


def test_samples_are_thinned_evenly_with_both_ends() -> None:
    kept = thinned(251, 61)
    assert (kept[0], kept[-1], len(kept)) == (0, 250, 61)
    assert set(np.diff(kept)) <= {4, 5}
    assert thinned(26, 61).tolist() == list(range(26))


@pytest.mark.slow
def test_curves_are_the_reference_and_what_each_engine_is_off_it(made: SimpleNamespace) -> None:
    curves = made.motions["swing"]["curves"]["quantities"]["rod.angle"]
    (case,) = [case for case in made.cases if case.name == "swing"]
    wanted = observe(case.scene, made.report.solutions["swing"].trajectory, "rod.angle")
    assert unpacked(curves["reference"]) == pytest.approx(wanted, abs=LEVEL * np.ptp(wanted))
    ran = [one for one in made.report.tried if one.pair.case.name == "swing"]
    assert len(curves["off"]) == len(ran) == sum(len(engines.settings(e)) for e in engines.names())
    for one in ran:
        key = f"{one.pair.engine.name}.{one.pair.engine.setting}.{one.realised}"
        off = one.outcome.samples["rod.angle"] - wanted
        found = unpacked_by_size(curves["off"][key]["curve"])
        assert found == pytest.approx(off, rel=0.006, abs=1e-9 * np.max(np.abs(off)))


@pytest.mark.slow
def test_what_cannot_be_told_apart_is_no_ghost(made: SimpleNamespace) -> None:
    swing = made.motions["swing"]
    assert "mujoco.tuned.native" in swing["covered"]
    assert set(swing["ghosts"]) | set(swing["covered"]) == {
        f"{engine}.{setting}.native"
        for engine in engines.names()
        for setting in engines.settings(engine)
    }
    assert set(swing["ghosts"]).isdisjoint(swing["covered"])


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["four_bar", "slider_crank", "spatial_four_bar", "five_axis_robot.swinging"]
)
def test_drawn_bodies_hang_together_as_their_joints_hold_them(name: str) -> None:
    """The point of a joint on its second body, as drawn, is where its first body has it."""
    (case,), trajectory = choose_cases([name]), scenes.solved(name).trajectory
    drawn = motion(case, trajectory, [])
    frames = read(drawn).at(case.times)
    looked = Looked(case.scene.bodies, case.scene.points, trajectory)
    for joint, told in zip(case.scene.joints.values(), drawn["sketch"]["joints"], strict=True):
        part, place = told["at"]  # on the second part
        if "rail" in told:
            continue
        meant = looked.point(joint.a)[:, : drawn["axes"]]
        for k, right in enumerate(meant):
            found = _placed(frames[part][k], np.array([place]))[0] if part else np.array(place)
            assert found == pytest.approx(right, abs=1e-3 * drawn["size"])  # half a pixel


@pytest.mark.slow
def test_every_shipped_scene_can_be_drawn(shipped: list[Case]) -> None:
    """No element is of a kind that the drawing does not know."""
    for case in shipped:
        drawn = sketch(case.scene, 1.0)
        assert set(drawn["bodies"]) == set(case.scene.bodies)
        ends = [end for link in drawn["links"] for end in link["ends"]]
        ends += [joint["at"] for joint in drawn["joints"]]
        known = {"", *case.scene.bodies, *(f"ground.{point}" for point in case.scene.points)}
        assert {part for part, _ in ends} <= known
        lengths = {len(place) for _, place in ends}
        assert lengths <= {case.scene.frame.dimension}


@pytest.mark.mutant("a trail of straight lines between samples")
def test_a_trail_goes_round_between_its_samples() -> None:
    """A circle of eight samples stays one to a hundredth."""
    times = np.linspace(0.0, 2 * np.pi, 9)
    places = np.stack([np.cos(times), np.sin(times)], axis=1)
    velocities = np.stack([-np.sin(times), np.cos(times)], axis=1)

    def off(module: Any = poses) -> float:
        way = module.cubic(times, places, velocities, np.linspace(times[0], times[-1], 100))
        assert way[[0, -1]] == pytest.approx(places[[0, -1]])
        return float(np.max(np.abs(np.hypot(*way.T) - 1)))

    assert off() < 0.01
    was = "    return ends + h * (rates"
    straight = otherwise(poses, was, "    return ends + 0 * h * (rates")
    assert off(straight) > 0.05


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "quantity"), [("heavy_top.loops", "top."), ("driven_wheel.weave", "upright.")]
)
def test_a_trail_is_of_what_the_case_observes(name: str, quantity: str) -> None:
    """A body's place, or a joint's: it begins and ends where the reference says."""
    (case,), trajectory = choose_cases([name]), scenes.solved(name).trajectory
    x, y = (unpacked(column) for column in motion(case, trajectory, [])["trail"][:2])
    for found, axis in ((x, "x"), (y, "y")):
        right = observe(case.scene, trajectory, quantity + axis)
        assert found[[0, -1]] == pytest.approx(right[[0, -1]], abs=2 * LEVEL * np.ptp(found) + 1e-6)


def test_a_long_curve_has_no_more_points_than_are_seen() -> None:
    assert len(thinned(100_000, POINTS)) == POINTS
