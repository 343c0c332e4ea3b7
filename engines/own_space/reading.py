"""Reads the bodies of a Space, in the words of a case file, and notes what has no word.

All numbers stay as they are: a unit of length of the user's is written as 1 m, one of mass as 1 kg.
So gravity may be (0, 900), with y down: mechanics does not mind.
"""

from dataclasses import dataclass, field
from typing import Any

from pymunk.body import Body
from pymunk.space import Space
from pymunk.vec2d import Vec2d

from ...cases.scene import CENTER, GROUND

Words = dict[str, Any]
"""A map of a case file."""


@dataclass(frozen=True)
class Within:
    """A quantity that has to stay from `low` to `high`: beyond, the Space is another scene.

    place: of the Space, whose bound it is; at: what it reaches there, in words.
    """

    quantity: str
    low: float
    high: float
    place: str
    at: str


@dataclass
class Reading:
    """The scene as far as it is read. refused: (place, why) of what has no word."""

    space: Space
    names: dict[Body, str]
    points: Words = field(default_factory=Words)  # of the ground
    own_points: dict[str, Words] = field(default_factory=dict[str, Words])  # by body
    joints: Words = field(default_factory=Words)
    forces: Words = field(default_factory=Words)
    drive: Words = field(default_factory=Words)
    initial: Words = field(default_factory=Words)
    withins: list[Within] = field(default_factory=list[Within])
    refused: list[tuple[str, str]] = field(default_factory=list[tuple[str, str]])

    def refuse(self, place: str, why: str) -> None:
        """Notes what has no word, by its place in the Space."""
        self.refused.append((place, why))

    def moves(self, body: Body) -> bool:
        """Whether it is one of the scene's bodies, and no part of the ground."""
        return body in self.names

    def anchor(self, body: Body, local: Vec2d, name: str, place: str) -> str:
        """Returns the word for a point of a body in its own axes; name: what it is called."""
        if body not in self.names:
            self.points[name] = self.on_ground(body, local, place)
            return f"{GROUND}.{name}"
        own, arm = self.names[body], local - body.center_of_gravity
        if not arm.length:
            return f"{own}.{CENTER}"
        if not turns(body):
            self.refuse(place, f"{own} has an infinite moment, and can be held by its centre only")
        self.own_points[own][name] = tuple(arm)
        return f"{own}.{name}"

    def on_ground(self, body: Body, local: Vec2d, place: str) -> Any:
        """Returns the ground's point in words; of a kinematic body one that moves evenly."""
        if body.body_type == Body.DYNAMIC:
            self.refuse(place, "holds a body that is not in the space")
        at = tuple(body.local_to_world(local))
        if not travels(body):
            return at
        if body.body_type != Body.KINEMATIC or body not in self.space.bodies:
            self.refuse(place, "holds a body with a velocity that goes nowhere")
        if body.angular_velocity:
            self.refuse(place, "holds a kinematic body that turns: a point of the ground does not")
        return {"at": at, "velocity": tuple(body.velocity)}


def turns(body: Body) -> bool:
    """Whether it can turn: its moment is finite."""
    return body.moment < float("inf")


def travels(body: Body) -> bool:
    """Whether it has a velocity: that of a static body is felt by what touches it, as of a belt."""
    return bool(body.velocity.length or body.angular_velocity)


def read_bodies(space: Space) -> Reading:
    """Returns the Space's bodies and their start; what acts on all of them is refused."""
    dynamic = [(k, body) for k, body in enumerate(space.bodies) if body.body_type == Body.DYNAMIC]
    reading = Reading(space, {body: f"body{k}" for k, body in dynamic})
    if not dynamic:
        reading.refuse("space.bodies", "none is dynamic: nothing moves")
    if space.damping != 1.0:
        reading.refuse(
            "space.damping", f"is {space.damping:g}: it slows all turns, and has no word"
        )
    for types in getattr(space, "_handlers", ()):  # which pymunk tells nobody
        reading.refuse(f"space.on_collision{types}", "calls code of yours, which has no word")
    for k, body in enumerate(space.bodies):
        place = f"space.bodies[{k}]"
        for name in ("velocity_func", "position_func"):
            plain = getattr(Body, f"update_{name.removesuffix('_func')}")
            if getattr(body, name) != plain:
                reading.refuse(f"{place}.{name}", "calls code of yours, which has no word")
    for k, body in dynamic:
        _read_start(reading, f"space.bodies[{k}]", body)
    return reading


def _read_start(reading: Reading, place: str, body: Body) -> None:
    name = reading.names[body]
    reading.own_points[name] = {}
    (x, y), (vx, vy) = body.local_to_world(body.center_of_gravity), body.velocity
    start = {"x": x, "y": y, "vx": vx, "vy": vy}
    if turns(body):
        start |= {"angle": f"{body.angle} rad", "omega": body.angular_velocity}
    elif body.angular_velocity:
        reading.refuse(place, "turns with an infinite moment")
    reading.initial[name] = start
    if body.force.length or body.torque:
        reading.refuse(place, "has a force or a torque, which pymunk forgets after one step")
    if body.is_sleeping:
        reading.refuse(place, "is asleep, and would not move")
