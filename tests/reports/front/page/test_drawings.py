"""A mechanism that is drawn: its outlines, its motion as it was computed, and its letters."""

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.otherwise import otherwise
from given.scenes import SHIPPED, cases_of

from textmech import engines
from textmech.cases.case import Case
from textmech.cases.scene.motion import Motion as Looked
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Array
from textmech.reports.front.page import digits, drawing, picture, poses, sketch
from textmech.reports.front.page.digits import CURVE, POSE, few_digits, few_digits_of_each
from textmech.reports.front.page.drawing import thinned
from textmech.reports.front.page.motions import motion
from textmech.reports.front.page.picture import _placed
from textmech.reports.front.page.poses import read
from textmech.reports.front.page.sketch import sketch as sketched
from textmech.reports.runs.selection import choose_cases

# A mechanism that is drawn: its outlines, its springs, and each body in its own motion.

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
def case() -> Case:
    return cases_of(TEXT)[0]


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
    """By body its poses at the samples, of those that are kept and rounded."""
    reaches, moves = dict.fromkeys(moved(case), 0.3), module.moves(moved(case))
    found = module.drawn(case.scene.frame, reaches, case.times, moves, module.CLOSE)
    assert len(found.times) == 2  # cubics hold all of it
    return module.read(found.rounded()).at(case.times)


@pytest.mark.mutant("every body moves as the first one")
def test_each_body_moves_by_itself(case: Case) -> None:
    for body, rows in moved(case).items():
        assert drawn(case)[body] == pytest.approx(rows[:, :3], abs=1e-3)
    was = "part: [_columns(pose, POSE), _columns(rates)]"
    first = "[*self.moves.values()][0]"
    alike = otherwise(poses, was, f"part: [_columns({first}[0], POSE), _columns(rates)]")
    assert drawn(case, alike)["crate"] != pytest.approx(moved(case)["crate"][:, :3], abs=1e-3)


def covers(case: Case, off: Callable[[Array], Array], module: Any = drawing) -> bool:
    """Whether a crate that is otherwise by so much looks as the reference's."""
    states = moved(case)
    other = {"crate": off(states["crate"].copy())}
    return module.Drawing(case.scene.frame, 1.0, {}, {}).covers(other, states)


def turned(by: float) -> Callable[[Array], Array]:
    return lambda rows: rows + np.array([0.0, 0.0, by, 0.0, 0.0, 0.0])


@pytest.mark.mutant("a body that only turns otherwise is covered")
def test_what_only_turns_otherwise_is_seen(case: Case) -> None:
    assert covers(case, turned(0.0))
    assert covers(case, turned(0.9 * drawing.SEEN))
    assert not covers(case, turned(1.1 * drawing.SEEN))
    assert not covers(case, lambda rows: rows + np.array([1.1 * drawing.SEEN, *[0.0] * 5]))
    blind = otherwise(drawing, " or np.max(turns) > SEEN", "")
    assert covers(case, turned(1.0), blind)


def test_an_attitude_in_space_is_seen_and_its_opposite_quaternion_is_the_same() -> None:
    covers = drawing.Drawing(SHIPPED["heavy_top.cusp"].scene.frame, 1.0, {}, {}).covers
    one = np.array([[0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0]])
    other = np.array([[0.0, 0.0, 0.0, np.cos(0.05), np.sin(0.05), 0.0, 0.0]])
    assert covers({"top": -one}, {"top": -one})
    assert covers({"top": one * (1, 1, 1, -1, -1, -1, -1)}, {"top": one})
    assert not covers({"top": other}, {"top": one})


def placed(module: Any = picture) -> Array:
    """Where a quarter of a turn takes a point to the right of the centre: up."""
    return module._placed(np.array([1.0, 2.0, np.pi / 2]), np.array([[0.5, 0.0]]))[0]


@pytest.mark.mutant("bodies are drawn turned the other way")
def test_a_turned_body_is_drawn_turned() -> None:
    assert placed() == pytest.approx([1.0, 2.5])
    back = otherwise(picture, "[[cos, sin], [-sin, cos]]", "[[cos, -sin], [sin, cos]]")
    assert placed(back) == pytest.approx([1.0, 1.5])


# What a drawing is made of: outlines in own axes, rails, blades, and how far all of it reaches.

ON_A_SLIDE = """\
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
def sliding() -> Case:
    return cases_of(ON_A_SLIDE)[0]


@pytest.mark.mutant("a bar is drawn to its centre")
def test_a_bar_is_drawn_from_end_to_end(sliding: Case) -> None:
    rod = sliding.scene.bodies["rod"]
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
def test_a_rail_lies_on_the_first_body(sliding: Case) -> None:
    (joint,) = sketch.sketch(sliding.scene, 1.0)["joints"]
    assert joint == {"at": ["rod", [-0.3, 0.0]], "rail": ["cart", [0.3, 0.1], [0.0, 1.0]]}
    other = otherwise(sketch, "_end(scene, ends[0]), rounded", "_end(scene, ends[-1]), rounded")
    assert other.sketch(sliding.scene, 1.0)["joints"] != [joint]


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
def test_a_drawing_is_as_large_as_the_motion_or_a_body(sliding: Case) -> None:
    still = {name: np.zeros((3, 3)) for name in sliding.scene.bodies}
    far = {**still, "rod": np.array([[0.0, 0.0, 0.0], [0.0, 5.0, 0.0]])}
    edge = float(np.hypot(0.3, 0.1))  # of the cart: further out than the bar's end
    assert sketch.extent(sliding.scene, still) == pytest.approx(2 * edge)
    assert sketch.extent(sliding.scene, far) == 5.0
    half = otherwise(sketch, "2 * reach(body) for", "reach(body) for")
    assert half.extent(sliding.scene, still) == pytest.approx(edge)


@pytest.mark.mutant("a driven point of the ground stands still")
def test_a_driven_point_is_drawn_where_it_is(sliding: Case) -> None:
    ((name, (places, rates)),) = poses.driven(sliding, sliding.times).items()
    assert name == "ground.hook"
    assert pytest.approx(np.array([sliding.times, 1.0 + 0 * sliding.times])) == places.T
    assert rates[1:-1].tolist() == [[1.0, 0.0]] * 9
    still = otherwise(poses, "(point.states(times)[:, :n]", "(point.states(0 * times)[:, :n]")
    assert still.driven(sliding, sliding.times)[name][0][:, 0] == pytest.approx(0.0 * sliding.times)


# What is drawn is what was computed: poses, curves and the joints between bodies.

LEVEL = 1e-3  # of a range: half of it is rounded


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
    assert curves["reference"] == pytest.approx(wanted, abs=LEVEL * np.ptp(wanted))
    ran = [one for one in made.report.tried if one.pair.case.name == "swing"]
    assert len(curves["off"]) == len(ran) == sum(len(engines.settings(e)) for e in engines.names())
    for one in ran:
        key = f"{one.pair.engine.name}.{one.pair.engine.setting}.{one.realised}"
        off = one.outcome.samples["rod.angle"] - wanted
        assert curves["off"][key]["curve"] == pytest.approx(
            off, rel=0.006, abs=1e-9 * np.max(np.abs(off))
        )


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
        drawn = sketched(case.scene, 1.0)
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
    x, y = (np.array(column) for column in motion(case, trajectory, [])["trail"][:2])
    for found, axis in ((x, "x"), (y, "y")):
        right = observe(case.scene, trajectory, quantity + axis)
        assert found[[0, -1]] == pytest.approx(right[[0, -1]], abs=2 * LEVEL * np.ptp(found) + 1e-6)


# Numbers of few digits: what is drawn is what was meant.


@pytest.mark.parametrize("kept", [CURVE, POSE])
@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e9])
def test_a_curve_keeps_its_digits(scale: float, kept: int) -> None:
    curve = scale * np.random.default_rng(1).normal(size=77)
    shown = few_digits(curve, kept)
    assert np.max(np.abs(shown - curve)) <= 5.01 * 10**-kept * np.ptp(curve)
    written = [str(x).strip("-").partition("e")[0].replace(".", "") for x in shown]
    assert max(len(digits.strip("0")) for digits in written) <= kept + 1


def test_an_error_comes_back_to_half_a_percent_of_itself() -> None:
    errors = np.array([0.0, 1e-300, -3.3333, 2.0, -1.2345e-3, 1e12])
    assert few_digits_of_each(errors) == pytest.approx(errors, rel=0.005, abs=0.0)


@pytest.mark.mutant("a curve is rounded by its size, however narrow its range is")
@pytest.mark.parametrize("share", [1e-3, 1e-5, 1e-7])
def test_a_narrow_curve_far_from_zero_is_no_line(share: float) -> None:
    curve = 1234.5671 * (1.0 + share * np.random.default_rng(3).uniform(size=77))

    def off(module: Any = digits) -> float:
        return float(np.max(np.abs(module.few_digits(curve) - curve)) / np.ptp(curve))

    assert off() < 1e-3
    if share < 1e-3:
        assert off(otherwise(digits, "float(np.ptp(numbers))", "float(np.max(numbers))")) > 1e-3


@pytest.mark.parametrize("value", [0.0, 2.5, 1e-320])
def test_what_stays_stays(value: float) -> None:
    assert few_digits(np.full(4, value)) == pytest.approx([value] * 4, abs=1e-300)


@pytest.mark.parametrize("rounded", [few_digits, few_digits_of_each])
@pytest.mark.parametrize("wrong", [np.nan, np.inf])
def test_what_is_not_finite_is_refused(wrong: float, rounded: Callable[..., Any]) -> None:
    with pytest.raises(ValueError, match="not finite"):
        rounded(np.array([0.0, wrong]))
