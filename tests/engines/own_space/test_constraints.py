"""Constraints of a Space move as the textbook says: each beside its closed form, of body 0."""

import math
from collections.abc import Callable, Mapping

import numpy as np
import pymunk
import pytest
from given.otherwise import otherwise
from pymunk import Body, Space
from scipy.special import ellipj, ellipk

from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.engines.own_space import constraints, reading, space
from textmech.reference.solve import solve
from textmech.reports.runs.spaces import space_case

Closed = Mapping[str, Callable[[np.ndarray], np.ndarray]]
"""By quantity how it goes by the times [s]."""
Made = Callable[[], tuple[Space, Closed]]
CLOSE = 1e-9  # m and rad: the reference certifies 1e-12 and better of these


def here(x: float = 0.0, angle: float = 0.0, omega: float = 0.0, vx: float = 0.0) -> Body:
    """A body of 2 kg and 0.5 kg m² on the x axis."""
    body = Body(2.0, 0.5)
    body.position, body.angle = (x, 0.0), angle
    body.velocity, body.angular_velocity = (vx, 0.0), omega
    return body


def holding(gravity: tuple[float, float], *parts: Body | pymunk.Constraint) -> Space:
    made = Space()
    made.gravity = gravity
    made.add(*parts)
    return made


def turned() -> Body:
    """A part of the ground that stands askew, by 0.3 rad."""
    static = Body(body_type=Body.STATIC)
    static.position, static.angle = (0.5, 0.2), 0.3
    return static


def pivot() -> tuple[Space, Closed]:
    """(2.60) a pendulum from 90°, J_O = 0.5 + 2 kg m², by the elliptic functions."""
    body = here(1.0)
    joint = pymunk.PivotJoint(turned(), body, (0.0, 0.0))
    k, rate = math.sqrt(0.5), math.sqrt(2.0 * 9.81 / 2.5)
    return holding((0.0, -9.81), body, joint), {
        "body0.angle": lambda t: (
            2 * np.arcsin(k * ellipj(ellipk(k**2) - rate * t, k**2)[0]) - np.pi / 2
        )
    }


def pin() -> tuple[Space, Closed]:
    """Without gravity a rod turns evenly, with v/l."""
    body = here(0.8)
    body.velocity = (0.0, 1.2)
    joint = pymunk.PinJoint(body, turned(), (0.0, 0.0), (0.0, 0.0))
    joint.anchor_b = joint.b.world_to_local((0.0, 0.0))
    joint.distance = 0.8
    return holding((0.0, 0.0), body, joint), {"body0.y": lambda t: 0.8 * np.sin(1.5 * t)}


def rope() -> tuple[Space, Closed]:
    """What flies outward stops where the rope is taut."""
    body = here(0.2, vx=1.0)
    joint = pymunk.SlideJoint(Body(body_type=Body.STATIC), body, (0, 0), (0, 0), 0.0, 0.7)
    return holding((0.0, 0.0), body, joint), {"body0.x": lambda t: np.minimum(0.2 + t, 0.7)}


def groove() -> tuple[Space, Closed]:
    """A bead slides down a line at 30°, and turns on evenly."""
    body, along = here(omega=2.0), (math.cos(math.pi / 6), -0.5)
    ends = (-1.0 * along[0], -1.0 * along[1]), (4.0 * along[0], 4.0 * along[1])
    joint = pymunk.GrooveJoint(Body(body_type=Body.STATIC), body, *ends, (0.0, 0.0))
    return holding((0.0, -9.81), body, joint), {
        "body0.x": lambda t: 0.25 * 9.81 * along[0] * t**2,
        "body0.angle": lambda t: 2.0 * t,
    }


def slide() -> tuple[Space, Closed]:
    """A gear of ratio 1 beside a groove: it does not turn, however it is pulled."""
    body, wall = here(angle=0.4), Body(body_type=Body.STATIC)
    line = pymunk.GrooveJoint(wall, body, (-1.0, 0.0), (9.0, 0.0), body.world_to_local((0, 0)))
    push = pymunk.DampedSpring(wall, body, (9.0, 0.0), (0.0, 0.1), 0.0, 1.0, 0.0)
    return holding((0.0, -9.81), body, line, pymunk.GearJoint(body, wall, -0.4, 1.0), push), {
        "body0.angle": lambda t: 0.4 + 0.0 * t,
    }


def spring() -> tuple[Space, Closed]:
    """(2.82) with ω² = c/m = 20/s² and 2 D = d/m = 1/s: a damped sine about where it hangs."""
    body = here()
    body.position = (0.0, -1.0)
    part = pymunk.DampedSpring(Body(body_type=Body.STATIC), body, (0, 0), (0, 0), 0.8, 40.0, 2.0)
    rest = -0.8 - 2.0 * 9.81 / 40.0
    nu = math.sqrt(20.0 - 0.25)

    def y(t: np.ndarray) -> np.ndarray:
        swings = np.cos(nu * t) + 0.5 / nu * np.sin(nu * t)
        return rest + (-1.0 - rest) * np.exp(-0.5 * t) * swings

    return holding((0.0, -9.81), body, part), {"body0.y": y}


def rotary(*, swapped: bool) -> Made:
    """(2.45) It rests where b.angle − a.angle = −rest_angle; ω² = c/J = 14/s², 2 D = d/J = 1/s."""

    def made() -> tuple[Space, Closed]:
        body, static = here(0.5, angle=0.1), turned()
        hinge = pymunk.PivotJoint(*((body, static) if swapped else (static, body)), (0.5, 0.0))
        spring = pymunk.DampedRotarySpring(static, body, 0.7, 7.0, 0.5)
        rest, nu = 0.3 - 0.7, math.sqrt(14.0 - 0.25)
        return holding((0.0, 0.0), body, hinge, spring), {
            "body0.angle": lambda t: (
                rest
                + (0.1 - rest) * np.exp(-0.5 * t) * (np.cos(nu * t) + 0.5 / nu * np.sin(nu * t))
            )
        }

    return made


def motor(*, swapped: bool) -> Made:
    """Its rate is that of a against b, whichever of them the pin has first."""

    def made() -> tuple[Space, Closed]:
        body, static = here(0.5, omega=2.0), turned()
        hinge = pymunk.PivotJoint(body, static, (0.5, 0.0))
        drive = (
            pymunk.SimpleMotor(body, static, 2.0)
            if swapped
            else pymunk.SimpleMotor(static, body, -2.0)
        )
        return holding((0.0, -9.81), body, hinge, drive), {"body0.angle": lambda t: 2.0 * t}

    return made


def brake() -> tuple[Space, Closed]:
    """(2.89) A motor that stands still with a max_force: 0.5 kg m² lose 2 rad/s by 1 N m in 1 s."""
    body, static = here(0.5, omega=1.0), turned()
    joint = pymunk.SimpleMotor(static, body, 0.0)
    joint.max_force = 1.0
    stops = lambda t: np.where(t < 0.5, t - t**2, 0.25)  # noqa: E731
    return holding((0.0, -9.81), body, pymunk.PivotJoint(static, body, (0.5, 0.0)), joint), {
        "body0.angle": stops
    }


def limit(*, swapped: bool) -> Made:
    """(2.14) b.angle − a.angle grows by 1/s from −0.3 on, to 0.1: there it stops."""

    def made() -> tuple[Space, Closed]:
        body, static = here(0.5, omega=1.0), turned()
        hinge = pymunk.PivotJoint(static, body, (0.5, 0.0))
        ends = (
            pymunk.RotaryLimitJoint(body, static, -0.1, 0.5)
            if swapped
            else pymunk.RotaryLimitJoint(static, body, -0.5, 0.1)
        )
        return holding((0.0, 0.0), body, hinge, ends), {"body0.angle": lambda t: np.minimum(t, 0.4)}

    return made


def weld() -> tuple[Space, Closed]:
    """A gear of ratio 1 beside a pivot: two bodies turn as one about what both have as centre."""
    one, other = here(), here(1.0, angle=0.2, omega=3.0)
    one.angular_velocity, one.velocity, other.velocity = 3.0, (0.0, -1.5), (0.0, 1.5)
    hinge = pymunk.PivotJoint(one, other, (1.0, 0.3))
    return holding((0.0, 0.0), one, other, hinge, pymunk.GearJoint(other, one, -0.2, 1.0)), {
        "body0.x": lambda t: 0.5 - 0.5 * np.cos(3.0 * t),
        "body1.angle": lambda t: 0.2 + 3.0 * t,
    }


def hook() -> tuple[Space, Closed]:
    """What hangs on a kinematic body goes with it, evenly."""
    moves, body = Body(body_type=Body.KINEMATIC), here(0.0, vx=0.7)
    moves.velocity, body.position = (0.7, 0.0), (0.0, -1.0)
    return holding((0.0, -9.81), body, moves, pymunk.PivotJoint(moves, body, (0.0, 0.0))), {
        "body0.x": lambda t: 0.7 * t,
        "body0.y": lambda t: -1.0 + 0.0 * t,
    }


def off_centre() -> tuple[Space, Closed]:
    """A body's place is not where its centre of mass is, and an anchor counts from that place."""
    body = here()
    body.center_of_gravity, body.velocity = (0.4, 0.0), (0.0, 0.0)
    hinge = pymunk.PivotJoint(turned(), body, (0.0, 0.0))
    hinge.anchor_b, hinge.anchor_a = (0.0, 0.0), hinge.a.world_to_local((0.0, 0.0))
    body.angular_velocity, body.velocity = 1.5, (0.0, 0.6)
    return holding((0.0, 0.0), body, hinge), {"body0.y": lambda t: 0.4 * np.sin(1.5 * t)}


KINDS: dict[str, Made] = {
    "pivot": pivot,
    "pin": pin,
    "rope": rope,
    "groove": groove,
    "slide": slide,
    "spring": spring,
    "rotary spring": rotary(swapped=False),
    "rotary spring, its pin the other way": rotary(swapped=True),
    "motor": motor(swapped=False),
    "motor the other way": motor(swapped=True),
    "brake": brake,
    "limit": limit(swapped=False),
    "limit the other way": limit(swapped=True),
    "weld": weld,
    "hook": hook,
    "centre of mass": off_centre,
}


def off(made: Made) -> float:
    """The largest difference from the closed form; inf where no motion satisfies what is read."""
    built, closed = made()
    try:
        case = space_case(built, "space", "space")
        motion = solve(case).trajectory
    except CaseError:
        return math.inf
    return max(
        float(np.max(np.abs(observe(case.scene, motion, name) - form(motion.times))))
        for name, form in closed.items()
    )


@pytest.mark.slow
@pytest.mark.parametrize("kind", KINDS)
def test_each_kind_moves_as_its_closed_form(kind: str) -> None:
    assert off(KINDS[kind]) < CLOSE


WRONG = [
    ("rotary spring", constraints, "-s * (c.rest_angle + o)", "s * (c.rest_angle + o)"),
    ("rotary spring", constraints, "-s * (c.rest_angle + o)", "-s * c.rest_angle"),
    (
        "rotary spring, its pin the other way",
        constraints,
        'self.turning.get((b, a), ""), -1.0',
        'self.turning.get((b, a), ""), 1.0',
    ),
    ("motor", constraints, "-s * c.rate", "s * c.rate"),
    ("limit the other way", constraints, "s * (c.min - o)", "s * (c.min + o)"),
    ("brake", constraints, '{"kinetic": c.max_force}', '{"kinetic": 2 * c.max_force}'),
    ("weld", constraints, "s * (c.phase - o)", "s * (o - c.phase)"),
    ("spring", constraints, '"rest_length": c.rest_length', '"rest_length": c.rest_length + 0.1'),
    ("groove", constraints, "tuple(direction.normalized())", "tuple(-direction.normalized())"),
    ("pin", constraints, "c.anchor_b, f", "c.anchor_b + (0.1, 0.0), f"),
    ("centre of mass", reading, "local - body.center_of_gravity", "local"),
    ("hook", reading, '"velocity": tuple(body.velocity)', '"velocity": (0.0, 0.0)'),
]


@pytest.mark.slow
@pytest.mark.mutant("a constraint of a Space that is read with a sign, a place or a number wrong")
@pytest.mark.parametrize(("kind", "module", "was", "now"), WRONG)
def test_a_constraint_that_is_misread_is_seen(
    kind: str, module: object, was: str, now: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    changed = otherwise(module, was, now)  # type: ignore[arg-type]
    if module is constraints:
        monkeypatch.setattr(space, "read_constraints", changed.read_constraints)
    else:
        monkeypatch.setattr(space, "read_bodies", changed.read_bodies)
    assert off(KINDS[kind]) > 1e6 * CLOSE
