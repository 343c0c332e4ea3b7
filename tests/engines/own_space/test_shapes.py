"""Shapes of a Space touch as the textbook says, and what touches otherwise is refused."""

import math
from collections.abc import Callable

import numpy as np
import pymunk
import pytest
from given.otherwise import otherwise
from pymunk import Body, Space

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.engines.own_space import shapes, space
from textmech.reference.solve import solve
from textmech.reports.runs.spaces import space_case

G = 900.0
Times = np.ndarray
Closed = tuple[str, Callable[[Times], np.ndarray]]
CLOSE = 1e-6  # px and rad: the reference certifies 1e-12


def game(*, down: bool = True) -> Space:
    """Pixels, and y down as on a screen: gravity is (0, 900)."""
    made = Space()
    made.gravity = (0.0, G if down else -G)
    return made


def floor(made: Space, y: float = 500.0, radius: float = 5.0, ends: float = 1000.0) -> None:
    """A line of friction 0.8 and elasticity 0.9 whose upper side is at y."""
    line = pymunk.Segment(made.static_body, (-ends, y + radius), (ends, y + radius), radius)
    line.friction, line.elasticity = 0.8, 0.9
    made.add(line)


def box(made: Space, x: float, y: float, mass: float = 2.0, moment: float = 0.0) -> Body:
    """A box of 40 × 20 with friction 0.5."""
    body = Body(mass, moment or pymunk.moment_for_box(mass, (40, 20)))
    body.position = x, y
    shape = pymunk.Poly.create_box(body, (40, 20))
    shape.friction = 0.5
    made.add(body, shape)
    return body


def ball(made: Space, x: float, y: float, radius: float = 20.0) -> Body:
    """A disk with friction 0.5 and elasticity 0.8."""
    body = Body(1.0, pymunk.moment_for_circle(1.0, 0, radius))
    body.position = x, y
    shape = pymunk.Circle(body, radius)
    shape.friction, shape.elasticity = 0.5, 0.8
    made.add(body, shape)
    return body


def braked(t: Times) -> np.ndarray:
    """Of 300 px/s on µ = 0.8 · 0.5, as pymunk multiplies: 300 t − µ g t²/2, until it stands."""
    until = np.minimum(t, 300.0 / (0.4 * G))
    return 300.0 * until - 0.2 * G * until**2


def sliding_box() -> tuple[Space, Closed]:
    made = game()
    floor(made)
    box(made, 0.0, 490.0).velocity = 300.0, 0.0
    return made, ("body0.x", braked)


def sliding_box_with_y_up() -> tuple[Space, Closed]:
    made = game(down=False)
    floor(made, -510.0)
    box(made, 0.0, -490.0).velocity = 300.0, 0.0
    return made, ("body0.x", braked)


def sliding_player() -> tuple[Space, Closed]:
    """What cannot turn, as the player of a game, with its lowest corner at the same place."""
    made = game()
    floor(made)
    body = box(made, 0.0, 490.0, moment=math.inf)
    body.velocity = 300.0, 0.0
    return made, ("body0.x", braked)


def box_on_a_slope() -> tuple[Space, Closed]:
    """A static box that stands askew, by 30°: g (sin − µ cos) along it, with µ = 0.4."""
    made, slope = game(), Body(body_type=Body.STATIC)
    slope.angle = math.pi / 6
    ground = pymunk.Poly.create_box(slope, (4000, 100))
    ground.friction = 0.8
    made.add(slope, ground)
    body = box(made, *slope.local_to_world((0.0, -60.0)))
    body.angle, x = slope.angle, body.position.x
    cos, sin = math.cos(slope.angle), math.sin(slope.angle)
    return made, ("body1.x", lambda t: x + cos * G * (sin - 0.4 * cos) * t**2 / 2)


def bouncing_ball() -> tuple[Space, Closed]:
    """From 90 px above: elasticities multiply, to 0.72."""
    made, falls = game(), math.sqrt(2 * 90.0 / G)
    floor(made)
    ball(made, 0.0, 390.0)
    back = 0.72 * G * falls

    def y(t: Times) -> np.ndarray:
        up, again = t - falls, falls + 2 * back / G
        rises = 480.0 - back * up + G * up**2 / 2
        later = t - again
        third = 480.0 - 0.72 * back * later + G * later**2 / 2
        return np.select([t < falls, t < again], [390.0 + G * t**2 / 2, rises], third)

    return made, ("body0.y", lambda t: np.where(t < 1.6, y(t), np.nan))


def rolling_ring() -> tuple[Space, Closed]:
    """(2.18) With J = m R² it slips until it rolls with half of its speed."""
    made = game()
    floor(made)
    ring = ball(made, 0.0, 480.0)
    ring.velocity, ring.moment = (300.0, 0.0), 400.0
    rolls = 150.0 / (0.4 * G)

    def x(t: Times) -> np.ndarray:
        slips = np.minimum(t, rolls)
        return 300.0 * slips - 0.2 * G * slips**2 + 150.0 * np.maximum(t - rolls, 0.0)

    return made, ("body0.x", x)


def balls_that_meet() -> tuple[Space, Closed]:
    """Two alike: of 100 px/s the second takes (1 + e)/2, with e = 0.8²."""
    made = game()
    made.gravity = (0.0, 0.0)
    ball(made, 0.0, 0.0).velocity = 100.0, 0.0
    ball(made, 60.0, 0.0)
    return made, ("body1.x", lambda t: 60.0 + 82.0 * np.maximum(t - 0.2, 0.0))


def box_that_carries() -> tuple[Space, Closed]:
    """A box slides on a longer one that stands: µ = 0.5² while it is on it."""
    made = game()
    floor(made)
    long = Body(50.0, pymunk.moment_for_box(50.0, (400, 20)))
    long.position = 0.0, 490.0
    shape = pymunk.Poly.create_box(long, (400, 20))
    shape.friction = 0.5
    made.add(long, shape)
    box(made, -100.0, 470.0).velocity = 150.0, 0.0

    def x(t: Times) -> np.ndarray:
        until = np.minimum(t, 150.0 / (0.25 * G))
        return -100.0 + 150.0 * until - 0.125 * G * until**2

    return made, ("body1.x", x)


def triangle() -> tuple[Space, Closed]:
    """Any convex polygon stands on its corners."""
    made, outline = game(), [(-20, 10), (20, 10), (0, -20)]
    floor(made)
    body = Body(1.0, pymunk.moment_for_poly(1.0, outline))
    body.position, body.velocity = (0.0, 490.0), (300.0, 0.0)
    shape = pymunk.Poly(body, outline)
    shape.friction = 0.5
    made.add(body, shape)
    return made, ("body0.x", braked)


KINDS = [
    sliding_box,
    sliding_box_with_y_up,
    sliding_player,
    box_on_a_slope,
    bouncing_ball,
    rolling_ring,
    balls_that_meet,
    box_that_carries,
    triangle,
]


def off(made: Callable[[], tuple[Space, Closed]]) -> float:
    """The largest difference from the closed form; inf where what is read is no motion."""
    built, (name, form) = made()
    try:
        case = read(built)
        motion = solve(case).trajectory
    except CaseError:
        return math.inf
    return float(np.nanmax(np.abs(observe(case.scene, motion, name) - form(motion.times))))


def read(built: Space) -> Case:
    return space_case(built, "space", "space")


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_moves_as_its_closed_form(kind: Callable[[], tuple[Space, Closed]]) -> None:
    assert off(kind) < CLOSE


WRONG = [
    (sliding_box, "first.shape.friction * second.shape.friction", "first.shape.friction"),
    (bouncing_ball, "first.shape.elasticity * second.shape.elasticity", "second.shape.elasticity"),
    (sliding_box_with_y_up, "outline.radius * normal", "0.0 * normal"),
    (sliding_player, "first.radius - min(arms)", "first.radius"),
    (box_on_a_slope, "rotated(-pi / 2)", "rotated(pi / 2)"),
    (rolling_ring, "body.mass * radius**2 / 2", "body.moment"),
    (box_that_carries, "side.normal.rotated(-body.angle)", "(-side.normal).rotated(-body.angle)"),
    (triangle, "own_points[name][point] = (x, y)", "own_points[name][point] = (x, -y)"),
]


@pytest.mark.slow
@pytest.mark.mutant("a shape of a Space that is read with a friction, a side or a place wrong")
@pytest.mark.parametrize(("kind", "was", "now"), WRONG)
def test_a_shape_that_is_misread_is_seen(
    kind: Callable[[], tuple[Space, Closed]],
    was: str,
    now: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    changed = otherwise(shapes, was, now)
    for name in ("outlines", "collisions", "find_contacts", "body_shapes"):
        monkeypatch.setattr(space, name, getattr(changed, name))
    assert off(kind) > 1e3 * CLOSE


# What collides and what does not is as pymunk has it.


def contacts(built: Space) -> set[str]:
    scene = read(built).scene
    return {*scene.contacts, *scene.pairs}


def fallen(change: Callable[[Space, Body], None]) -> Space:
    made = game()
    floor(made)
    body = ball(made, 0.0, 470.0)
    change(made, body)
    return made


@pytest.mark.slow
def test_what_pymunk_lets_pass_has_no_contact() -> None:
    def named(group: int, categories: int, mask: int) -> Callable[[Space, Body], None]:
        def change(made: Space, body: Body) -> None:
            line, disk = made.shapes
            line.filter = pymunk.ShapeFilter(group=group, categories=categories)
            disk.filter = pymunk.ShapeFilter(group=group, mask=mask)

        return change

    def sensor(made: Space, body: Body) -> None:
        next(iter(body.shapes)).sensor = True

    def jointed(made: Space, body: Body) -> None:
        spring = pymunk.DampedSpring(made.static_body, body, (0, 0), (0, 0), 1.0, 1.0, 0.0)
        spring.collide_bodies = False
        made.add(spring)

    assert contacts(fallen(named(0, 1, 1))) == {"shape1_on_shape0"}
    for change in (named(1, 1, 1), named(0, 2, 1), sensor, jointed):
        assert contacts(fallen(change)) == set()


@pytest.mark.slow
def test_only_contacts_that_come_to_be_are_said() -> None:
    """A wall that is far, a platform beside the way, and the corners that stay above."""
    made = game()
    floor(made)
    for x in (-400.0, 400.0):
        made.add(pymunk.Segment(made.static_body, (x, 0.0), (x, 400.0), 1.0))
    made.add(pymunk.Segment(made.static_body, (100.0, 450.0), (200.0, 450.0), 1.0))
    box(made, 0.0, 440.0)
    case = read(made)
    assert set(case.scene.contacts) == {
        "shape4_on_shape0_upper_left",
        "shape4_on_shape0_upper_right",
    }
    assert {event.quantity for event in case.events.values()} == {
        f"{name}.gap" for name in case.scene.contacts
    }
