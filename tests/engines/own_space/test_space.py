"""What of a Space has no word is refused, by its place; so is what only its motion shows."""

import math
from collections.abc import Callable

import pymunk
import pytest
from given.otherwise import otherwise
from pymunk import Body, Space

from textmech.cases.mistake import CaseError
from textmech.engines.own_space import space
from textmech.reports.runs.spaces import space_case

Changed = Callable[[Space, Body], None]


def pendulum(change: Changed = lambda made, body: None) -> Space:
    """A body with a disk, on a pivot: all of it has words."""
    made, body = Space(), Body(2.0, 0.5)
    made.gravity, body.position = (0.0, -9.81), (1.0, 0.0)
    made.add(body, pymunk.Circle(body, 0.1), pymunk.PivotJoint(made.static_body, body, (0, 0)))
    change(made, body)
    return made


def places(made: Space) -> list[str]:
    """What is refused of it, in the words of the messages."""
    with pytest.raises(CaseError) as caught:
        space_case(made, "space", "space")
    return [f"{mistake.where}: {mistake.what}" for mistake in caught.value.mistakes]


def calls(*_: object) -> None:
    raise AssertionError("nothing of the user's is called")


def joined(joint: Callable[[Body, Body], pymunk.Constraint]) -> Changed:
    return lambda made, body: made.add(joint(made.static_body, body))


def changed(owner: str, name: str, value: object) -> Changed:
    def change(made: Space, body: Body) -> None:
        owners = {"space": made, "body": body}
        owners |= {"shape": next(iter(body.shapes)), "joint": next(iter(made.constraints))}
        setattr(owners[owner], name, value)

    return change


def pushed(made: Space, body: Body) -> None:
    body.apply_force_at_local_point((1.0, 0.0))


def handled(made: Space, body: Body) -> None:
    made.on_collision(1, 2, begin=calls)


def carried(kind: int) -> Changed:
    """On a belt, which pymunk moves, or on ground that only says that it moves."""

    def change(made: Space, body: Body) -> None:
        belt = Body(body_type=kind)
        belt.velocity = 1.0, 0.0
        made.add(belt, pymunk.Segment(belt, (-9, -9), (9, -9), 0.1))

    return change


def hung(kind: int) -> Changed:
    """On a body that is not in the Space, or does not move: with a velocity."""

    def change(made: Space, body: Body) -> None:
        hook = Body(body_type=kind)
        hook.velocity = 1.0, 0.0
        made.add(pymunk.DampedSpring(hook, body, (0, 0), (0, 0), 1.0, 1.0, 0.0))

    return change


def braked(made: Space, body: Body) -> None:
    """By two brakes: each has a moment of its own."""
    for most in (1.0, 2.0):
        brake = pymunk.SimpleMotor(made.static_body, body, 0.0)
        brake.max_force = most
        made.add(brake)


def geared(made: Space, body: Body) -> None:
    made.add(*(pymunk.GearJoint(made.static_body, body, 0.0, 1.0) for _ in range(2)))


def sprung(made: Space, body: Body) -> None:
    spring = pymunk.DampedSpring(made.static_body, body, (0, 0), (0, 0), 1.0, 1.0, 0.0)
    spring.force_func = calls  # type: ignore[assignment]
    made.add(spring)


def weak(made: Space, body: Body) -> None:
    spring = pymunk.DampedSpring(made.static_body, body, (0, 0), (0, 0), 1.0, 1.0, 0.0)
    spring.max_force = 3.0
    made.add(spring)


REFUSED = [
    (changed("space", "damping", 0.9), "space.damping: is 0.9"),
    (handled, "space.on_collision(1, 2): calls code of yours"),
    (changed("body", "velocity_func", calls), "space.bodies[0].velocity_func: calls code"),
    (changed("body", "position_func", calls), "space.bodies[0].position_func: calls code"),
    (pushed, "space.bodies[0]: has a force or a torque"),
    (changed("shape", "surface_velocity", (1, 0)), "space.shapes[0]: Circle: has a surface_vel"),
    (carried(Body.KINEMATIC), "space.shapes[1]: Segment: moves with its body"),
    (carried(Body.STATIC), "space.shapes[1]: Segment: moves with its body"),
    (hung(Body.STATIC), "space.constraints[1]: DampedSpring: holds a body with a velocity that"),
    (hung(Body.KINEMATIC), "space.constraints[1]: DampedSpring: holds a body with a velocity that"),
    (braked, "space.constraints[2]: SimpleMotor: is the second of its kind"),
    (geared, "space.constraints[2]: GearJoint: is the second of its kind"),
    (changed("joint", "pre_solve", calls), "space.constraints[0]: PivotJoint: calls code"),
    (changed("joint", "post_solve", calls), "space.constraints[0]: PivotJoint: calls code"),
    (sprung, "space.constraints[1]: DampedSpring: has a force_func"),
    (weak, "space.constraints[1]: DampedSpring: has a max_force, 3"),
    (joined(lambda a, b: pymunk.RatchetJoint(a, b, 0, 1)), "space.constraints[1]: RatchetJoint: h"),
    (joined(lambda a, b: pymunk.GearJoint(a, b, 0, 2)), "space.constraints[1]: GearJoint: has the"),
    (joined(lambda a, b: pymunk.SimpleMotor(a, b, 3)), "space.constraints[1]: SimpleMotor: asks"),
    (changed("body", "position", (1.0, 0.3)), "initial: the initial state violates a constraint"),
    (changed("body", "mass", 1e31), "space.bodies[0] (scene.bodies.body0.rigid.mass): must be"),
    (changed("body", "moment", math.inf), "space.constraints[0]: PivotJoint: body0 has an inf"),
]


@pytest.mark.parametrize(("change", "told"), REFUSED)
def test_what_has_no_word_is_refused_by_its_place(change: Changed, told: str) -> None:
    assert [text for text in places(pendulum(change)) if text.startswith(told)]


def test_all_that_has_no_word_is_told_at_once() -> None:
    def change(made: Space, body: Body) -> None:
        for one in (handled, pushed, carried(Body.KINEMATIC), sprung):
            one(made, body)

    assert len(places(pendulum(change))) == 4


@pytest.mark.parametrize("made", [Space(), pendulum(lambda made, body: made.remove(body))])
def test_where_nothing_is_dynamic_nothing_moves(made: Space) -> None:
    assert "space.bodies: none is dynamic: nothing moves" in places(made)


def test_what_turns_needs_a_pin() -> None:
    made = pendulum(joined(lambda a, b: pymunk.DampedRotarySpring(a, b, 0, 1, 0)))
    made.remove(next(iter(made.constraints)))
    (told,) = places(made)
    assert told.startswith("space.constraints[0]: DampedRotarySpring: has a word only beside")


@pytest.mark.mutant("a callback of a constraint that is left out in silence")
def test_a_callback_that_is_left_out_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    from textmech.engines.own_space import constraints

    silent = otherwise(constraints, "if c.pre_solve or c.post_solve:", "if c.post_solve:")
    monkeypatch.setattr(space, "read_constraints", silent.read_constraints)
    space_case(pendulum(changed("joint", "pre_solve", calls)), "space", "space")


# What only the motion shows.


def falling(*shapes: Callable[[Body], pymunk.Shape], vx: float = 0.0) -> Space:
    """A ball of 1 cm at the height 0, above what the ground has."""
    made, body = Space(), Body(1.0, 1.0)
    made.gravity, body.velocity = (0.0, -9.81), (vx, 0.0)
    made.add(body, pymunk.Circle(body, 0.01), *(shape(made.static_body) for shape in shapes))
    return made


def line(a: float, b: float) -> Callable[[Body], pymunk.Shape]:
    return lambda ground: pymunk.Segment(ground, (a, -0.5), (b, -0.5), 0.0)


@pytest.mark.slow
def test_what_meets_without_a_word_is_refused_with_the_time() -> None:
    """A ball falls on a static one: from 1 m less both radii at t = √(2 · 0.7/g) = 0.378 s."""
    (told,) = places(falling(lambda ground: pymunk.Circle(ground, 0.29, (0.001, -1.0))))
    start = "space.shapes[0]: Circle: meets space.shapes[1]: Circle at t = 0.378 s"
    assert told == f"{start}, in a way that has no word"


@pytest.mark.slow
def test_the_end_of_a_line_is_seen_where_it_is_passed() -> None:
    """It lands at 0.319 · 2 = 0.629 m, and slides past 0.8 m at 0.4 s."""
    (told,) = places(falling(line(-1.0, 0.8), vx=2.0))
    assert "at t = 0.401 s, and goes past its end" in told
    beside = space_case(falling(line(-1.0, -0.5), vx=2.0), "space", "space")
    assert not beside.scene.contacts


@pytest.mark.slow
@pytest.mark.mutant("a line that goes on beyond its ends")
def test_a_line_without_ends_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(space, "past_end_times", lambda *_: {})
    case = space_case(falling(line(-1.0, 0.8), vx=2.0), "space", "space")
    assert case.scene.contacts


@pytest.mark.slow
def test_what_overlaps_at_the_start_is_refused() -> None:
    (told,) = places(falling(lambda ground: pymunk.Circle(ground, 0.02, (0.025, 0.0))))
    assert told.startswith("space.shapes[0]: Circle: is 0.005 deep in space.shapes[1]: Circle")


def grooved(end: float) -> Space:
    made, body = Space(), Body(1.0, 1.0)
    made.gravity = 0.0, -9.81
    made.add(body, pymunk.GrooveJoint(made.static_body, body, (0, 0.1), (0, -end), (0, 0)))
    return made


@pytest.mark.slow
def test_the_end_of_a_groove_is_seen_where_it_is_reached() -> None:
    """g t²/2 = 1 m at 0.4515 s."""
    (told,) = places(grooved(1.0))
    assert told.startswith("space.constraints[0]: GrooveJoint: comes to an end")
    assert told.endswith("at t = 0.452 s")
    assert space_case(grooved(9.0), "space", "space")


@pytest.mark.slow
def test_a_force_is_seen_that_is_larger_than_a_joint_can_exert() -> None:
    """A pendulum of 2 kg at 1 m with J = 0.5: at its lowest it holds 2 (g + ω²) = 51 N."""
    (told,) = places(pendulum(changed("joint", "max_force", 30.0)))
    assert told.startswith("space.constraints[0]: PivotJoint: needs more than its max_force, 30")
    assert space_case(pendulum(changed("joint", "max_force", 60.0)), "space", "space")


# The claim that a Space becomes.


@pytest.mark.slow
def test_tolerances_follow_the_size_of_the_motion() -> None:
    """The same in metres and in hundredths: places a hundred times as far off, angles as far."""
    near, far = pendulum(), Space()
    body = Body(2.0, 5000.0)
    far.gravity, body.position = (0.0, -981.0), (100.0, 0.0)
    far.add(body, pymunk.Circle(body, 10.0), pymunk.PivotJoint(far.static_body, body, (0, 0)))
    small, large = (space_case(made, "space", "space").allow for made in (near, far))
    assert large["body0.x"] == pytest.approx(100 * (small["body0.x"] or 0.0))
    assert large["body0.angle"] == small["body0.angle"] == 1e-3


def test_the_title_says_how_it_is_read() -> None:
    def change(made: Space, body: Body) -> None:
        made.iterations, made.sleep_time_threshold = 30, 0.5

    title = space_case(pendulum(change), "space", "space").title
    assert "its units are written as m and kg" in title
    assert "--settings FILE: pymunk: {iterations: 30}; nothing falls asleep" in title
    assert "settings" not in space_case(pendulum(), "space", "space").title
