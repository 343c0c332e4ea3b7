"""What a drawing is made of: outlines in own axes, rails, blades, and how far all of it reaches."""

from typing import Any

import numpy as np
import pytest
from given.otherwise import otherwise
from given.scenes import SHIPPED

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.reports.page import poses, sketch

TEXT = """\
title: A bar on a slide that another body carries, under a hook that moves
scene:
  gravity: none
  points: {hook: {at: [0, 1], moves: {ramp: [1, 0]}}}
  bodies:
    cart: {rigid: {mass: 1.0, inertia: 1.0}, points: {edge: [0.3, 0.1]}}
    rod: {bar: {mass: 1.0, length: 0.6}}
  joints: {rail: {slide: [cart.edge, rod.start], along: [0, 1]}}
  forces: {rope: {spring: [ground.hook, rod.end], stiffness: 1.0, rest_length: 1.0}}
initial: {cart: {x: 0, y: 0, angle: 0, vx: 1}, rail: {shift: 0.2}}
duration: 1.0
samples: 11
step: 1 ms
allow: {rod.y: 1 mm}
"""


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Case:
    file = tmp_path_factory.mktemp("drawn") / "drawn.yaml"
    file.write_text(TEXT, encoding="utf-8")
    (found,) = load(file)
    return found


@pytest.mark.mutant("a bar is drawn to its centre")
def test_a_bar_is_drawn_from_end_to_end(case: Case) -> None:
    rod = case.scene.bodies["rod"]
    assert sketch.outline(rod, 1.0)["lines"] == [[[-0.3, 0.0], [0.3, 0.0]]]
    half = otherwise(sketch, 'rounded(body.points["end"])', 'rounded(body.points["center"])')
    assert half.outline(rod, 1.0)["lines"] == [[[-0.3, 0.0], [0.0, 0.0]]]


@pytest.mark.mutant("a disk is drawn along its axle")
def test_a_disk_in_space_is_drawn_across_its_axle() -> None:
    disk: Any = SHIPPED["tilting_disk.circle"].scene.bodies["disk"]

    def along(module: Any = sketch) -> float:
        """How far its rim reaches along the axle, of its radius."""
        rim = np.array(module.outline(disk, 1.0)["lines"][0])
        assert np.linalg.norm(rim, axis=1) == pytest.approx(disk.radius, rel=1e-3)
        return float(np.max(np.abs(rim @ np.asarray(disk.axle)))) / disk.radius

    assert along() < 1e-3
    was = "np.array([first, np.cross(axle, first)])"
    assert along(otherwise(sketch, was, "np.array([first, axle])")) > 0.9


@pytest.mark.mutant("a rail on the second body")
def test_a_rail_lies_on_the_first_body(case: Case) -> None:
    (joint,) = sketch.sketch(case.scene, 1.0)["joints"]
    assert joint == {"at": ["rod", [-0.3, 0.0]], "rail": ["cart", [0.3, 0.1], [0.0, 1.0]]}
    other = otherwise(sketch, "_end(scene, ends[0]), rounded", "_end(scene, ends[-1]), rounded")
    assert other.sketch(case.scene, 1.0)["joints"] != [joint]


@pytest.mark.mutant("half a blade")
def test_a_blade_has_its_point_in_its_middle() -> None:
    scene = SHIPPED["sleigh.spin"].scene
    (edge,) = scene.constraints.values()
    point = np.asarray(scene.bodies[edge.at.body].points[edge.at.point])

    def middle(module: Any = sketch) -> Any:
        (blade,) = module.sketch(scene, 1.0)["blades"]
        return np.mean(blade["line"], axis=0)

    assert middle() == pytest.approx(point, abs=1e-4)
    half = otherwise(sketch, "[rounded(place - along), ", "[rounded(place), ")
    assert middle(half) != pytest.approx(point, abs=1e-4)


@pytest.mark.mutant("a body that does not move reaches half as far")
def test_a_drawing_is_as_large_as_the_motion_or_a_body(case: Case) -> None:
    still = {name: np.zeros((3, 3)) for name in case.scene.bodies}
    far = {**still, "rod": np.array([[0.0, 0.0, 0.0], [0.0, 5.0, 0.0]])}
    edge = float(np.hypot(0.3, 0.1))  # of the cart: further out than the bar's end
    assert sketch.extent(case.scene, still) == pytest.approx(2 * edge)
    assert sketch.extent(case.scene, far) == 5.0
    half = otherwise(sketch, "2 * reach(body) for", "reach(body) for")
    assert half.extent(case.scene, still) == pytest.approx(edge)


@pytest.mark.mutant("a driven point of the ground stands still")
def test_a_driven_point_is_drawn_where_it_is(case: Case) -> None:
    ((name, (places, rates)),) = poses.driven(case, case.times).items()
    assert name == "ground.hook"
    assert pytest.approx(np.array([case.times, 1.0 + 0 * case.times])) == places.T
    assert rates[1:-1].tolist() == [[1.0, 0.0]] * 9
    still = otherwise(poses, "(point.states(times)[:, :n]", "(point.states(0 * times)[:, :n]")
    assert still.driven(case, case.times)[name][0][:, 0] == pytest.approx(0.0 * case.times)
