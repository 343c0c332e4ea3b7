"""A mechanism that is drawn: its outlines, its springs, and each body in its own motion."""

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given.otherwise import otherwise
from given.scenes import SHIPPED

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.cases.trajectory import Array
from textmech.reports.page import motions, picture, poses, sketch

TEXT = """\
title: A block and a particle, free of each other, with a spring between their edges
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies:
    box: {rigid: {mass: 1.0, inertia: 1.0}, points: {edge: [0.3, 0.1]}}
    crate: {block: {mass: 1.0, width: 0.4, height: 0.2}}
  forces: {link: {spring: [box.edge, crate.center], stiffness: 1.0, rest_length: 1.0}}
initial: {box: {x: 0, y: 0, vx: 1, vy: 0, angle: 0, omega: 1}, crate: {x: 1, y: 0, angle: 0}}
duration: 1.0
samples: 11
step: 1 ms
allow: {box.x: 1 mm}
"""


@pytest.fixture(scope="module")
def case(tmp_path_factory: pytest.TempPathFactory) -> Case:
    file = tmp_path_factory.mktemp("drawn") / "drawn.yaml"
    file.write_text(TEXT, encoding="utf-8")
    (found,) = load(file)
    return found


def extents(case: Case, module: Any = sketch) -> list[float]:
    """Width and height of the crate as it is drawn."""
    (line,) = module.outline(case.scene.bodies["crate"], 1.0)["lines"]
    return [float(x) for x in np.ptp(line, axis=0)]


@pytest.mark.mutant("blocks are drawn twice as large")
def test_a_block_is_drawn_as_large_as_it_is(case: Case) -> None:
    assert extents(case) == [0.4, 0.2]
    twice = otherwise(sketch, "_box(np.asarray(body.size) / 2)", "_box(np.asarray(body.size))")
    assert extents(case, twice) == [0.8, 0.4]


def ends(case: Case, module: Any = sketch) -> list[Any]:
    (link,) = module.sketch(case.scene, 1.0)["links"]
    return link["ends"]


@pytest.mark.mutant("springs end in the centres of bodies")
def test_a_spring_ends_where_it_is_fixed(case: Case) -> None:
    assert ends(case) == [["box", [0.3, 0.1]], ["crate", [0.0, 0.0]]]
    was = "rounded(scene.bodies[anchor.body].points[anchor.point])"
    centred = otherwise(sketch, was, 'rounded(scene.bodies[anchor.body].points["center"])')
    assert ends(case, centred)[0] == ["box", [0.0, 0.0]]


def top(module: Any = sketch) -> tuple[float, list[float]]:
    """How high the rim of the heavy top stands over its centre at most, and its radius."""
    body: Any = SHIPPED["heavy_top.cusp"].scene.bodies["top"]
    rim = np.array(module.outline(body, 1.0)["lines"][0])
    return float(np.max(np.abs(rim[:, 2]))), np.linalg.norm(rim, axis=1).tolist()


@pytest.mark.mutant("a top whose disk stands along its axis")
def test_a_top_is_a_disk_as_hard_to_turn_on_its_point() -> None:
    """Of 0.5 kg and 0.0006 kg m² about its axis: J = m r²/2."""
    body: Any = SHIPPED["heavy_top.cusp"].scene.bodies["top"]
    height, radii = top()
    assert height < 1e-6
    assert radii == pytest.approx([np.sqrt(2 * 0.0006 / 0.5)] * len(radii), rel=1e-3)
    lines = sketch.outline(body, 1.0)["lines"]
    assert [line for line in lines if line[0] == [0.0, 0.0, -0.05]]  # its cone ends in its tip
    assert top(otherwise(sketch, "k = 2 if alike[0] else 0", "k = 0"))[0] > 0.01


def box(module: Any = sketch) -> list[float]:
    """The sides of the box that the torque-free body is drawn as, about as long as it reaches."""
    body: Any = SHIPPED["torque_free.thrown"].scene.bodies["body"]
    return np.ptp(np.concatenate(module.outline(body, 1.0)["lines"]), axis=0).tolist()


@pytest.mark.mutant("a box whose longest side is along its largest moment of inertia")
def test_a_body_of_space_is_a_box_as_hard_to_turn() -> None:
    """J_1 = m (b² + c²)/12 and so on, of 1.3 kg and (0.09, 0.06, 0.04) kg m²."""
    a, b, c = box()
    inertia = [1.3 * (b**2 + c**2) / 12, 1.3 * (a**2 + c**2) / 12, 1.3 * (a**2 + b**2) / 12]
    assert inertia == pytest.approx([0.09, 0.06, 0.04], rel=1e-3)
    wrong = otherwise(sketch, "np.sum(moments) - 2 * moments", "0.5 * moments")
    assert box(wrong) != pytest.approx([a, b, c], rel=0.1)


def moved(case: Case) -> dict[str, Array]:
    """The states (N, 6) of two bodies that move in ways that are nothing alike."""
    t, of = case.times, np.ones_like(case.times)
    return {
        "box": np.stack([t, 0.2 * t, 2.0 * t, of, 0.2 * of, 2.0 * of], axis=1),
        "crate": np.stack([1.0 - 0.5 * t, t * t, -t, -0.5 * of, 2 * t, -of], axis=1),
    }


def drawn(case: Case, module: Any = poses) -> dict[str, Array]:
    """By body its poses at the samples, of those that are kept and packed."""
    found = module.drawn(case, case.times, module.moves(moved(case)), module.CLOSE)
    assert len(found.times) == 2  # cubics hold all of it
    return module.read(found.packed()).at(case.times)


@pytest.mark.mutant("every body moves as the first one")
def test_each_body_moves_by_itself(case: Case) -> None:
    for body, rows in moved(case).items():
        assert drawn(case)[body] == pytest.approx(rows[:, :3], abs=1e-3)
    was = "part: [_columns(pose, POSE), _columns(rates, CURVE)]"
    first = "[*self.moves.values()][0]"
    alike = otherwise(poses, was, f"part: [_columns({first}[0], POSE), _columns(rates, CURVE)]")
    assert drawn(case, alike)["crate"] != pytest.approx(moved(case)["crate"][:, :3], abs=1e-3)


def covers(case: Case, off: Callable[[Array], Array], module: Any = motions) -> bool:
    """Whether a crate that is otherwise by so much looks as the reference's."""
    states = moved(case)
    return module._covered({"crate": off(states["crate"].copy())}, states, case, 1.0)


def turned(by: float) -> Callable[[Array], Array]:
    return lambda rows: rows + np.array([0.0, 0.0, by, 0.0, 0.0, 0.0])


@pytest.mark.mutant("a body that only turns otherwise is covered")
def test_what_only_turns_otherwise_is_seen(case: Case) -> None:
    assert covers(case, turned(0.0))
    assert covers(case, turned(0.9 * motions.SEEN))
    assert not covers(case, turned(1.1 * motions.SEEN))
    assert not covers(case, lambda rows: rows + np.array([1.1 * motions.SEEN, *[0.0] * 5]))
    blind = otherwise(motions, " or np.max(turns) > SEEN", "")
    assert covers(case, turned(1.0), blind)


def test_an_attitude_in_space_is_seen_and_its_opposite_quaternion_is_the_same() -> None:
    case: Any = SimpleNamespace(scene=SHIPPED["heavy_top.cusp"].scene)
    one = np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]])
    other = np.array([[0.0, 0.0, 0.0, np.cos(0.05), np.sin(0.05), 0.0, 0.0]])
    assert motions._covered({"top": -one}, {"top": -one}, case, 1.0)
    assert motions._covered({"top": one * (1, 1, 1, -1, -1, -1, -1)}, {"top": one}, case, 1.0)
    assert not motions._covered({"top": other}, {"top": one}, case, 1.0)


def placed(module: Any = picture) -> Array:
    """Where a quarter of a turn takes a point to the right of the centre: up."""
    return module._placed(np.array([1.0, 2.0, np.pi / 2]), np.array([[0.5, 0.0]]))[0]


@pytest.mark.mutant("bodies are drawn turned the other way")
def test_a_turned_body_is_drawn_turned() -> None:
    assert placed() == pytest.approx([1.0, 2.5])
    back = otherwise(picture, "[[cos, sin], [-sin, cos]]", "[[cos, -sin], [sin, cos]]")
    assert placed(back) == pytest.approx([1.0, 1.5])
