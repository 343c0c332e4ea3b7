"""A machine in space in the making: poses come first, so that every loop closes."""

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np
from scipy.spatial.transform import Rotation

from textmech.cases.scene import CENTER, GROUND, Anchor, Force, GroundPoint, Scene, Signal
from textmech.cases.scene.body import Body
from textmech.cases.scene.constraint import Edge
from textmech.cases.scene.contact import Contact
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.joint import Joint
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.system import Array

from ..adapters.engine_space import point, unit, vector

GRAVITY = (0.8, -1.3, -9.6)  # not along an axis, so that no component can hide
T = 0.13  # s: laws in time are neither at zero nor at rest


@dataclass(eq=False)  # each is itself, so that answers to it can be kept
class Machine:
    """A scene in the making, and where its parts are at t: r (3,) and R (3, 3) of each."""

    kind: str
    rng: np.random.Generator
    t: float = T  # s: when the parts are where they are drawn
    bodies: dict[str, Body] = field(default_factory=dict)
    points: dict[str, GroundPoint] = field(default_factory=dict)
    joints: dict[str, Joint] = field(default_factory=dict)
    contacts: dict[str, Contact] = field(default_factory=dict)
    forces: dict[str, Force] = field(default_factory=dict)
    constraints: dict[str, Edge] = field(default_factory=dict)
    drives: dict[str, Signal] = field(default_factory=dict)
    poses: dict[str, tuple[Array, Array]] = field(
        default_factory=lambda: {GROUND: (np.zeros(3), np.eye(3))}
    )

    @cached_property
    def mode(self) -> SpatialMultibody:
        """Its generated mechanism, once it is made."""
        scene = Scene(
            GRAVITY, self.points, self.bodies, self.joints, self.contacts, self.forces,
            constraints=self.constraints, drives=self.drives, frame=SPACE,
        )  # fmt: skip
        return SpatialMultibody(scene, (np.zeros(0), np.zeros(0)))

    @cached_property
    def q(self) -> Array:
        """The drawn places (m,), with quaternions of the length 1."""
        found = []
        for name, body in self.bodies.items():
            r, R = self.poses[name]
            found += [
                *r,
                *(Rotation.from_matrix(R).as_quat(scalar_first=True) if body.turns else ()),
            ]
        return np.array(found)

    def v(self) -> Array:
        """Random rates (n,) that the rows allow."""
        v = self.rng.uniform(-3.0, 3.0, self.mode.where.size)
        rows, g, _ = self.mode.rows(self.t, self.q, v)
        return v - np.linalg.pinv(rows) @ (rows @ v - g) if len(rows) else v

    def number(self, low: float, high: float) -> float:
        return float(self.rng.uniform(low, high))

    def vector(self, size: float) -> Array:
        return self.rng.uniform(-size, size, 3)

    def axis(self) -> Array:
        return np.array(unit(self.rng.normal(size=3)))

    def turn(self) -> Array:
        return Rotation.random(rng=self.rng).as_matrix()

    def part(self, *but: str) -> str:
        """Any part that has axes."""
        names = [name for name, body in self.bodies.items() if body.turns and name not in but]
        return str(self.rng.choice([GROUND, *names]))

    def anchor(self, part: str, place: Array) -> Anchor:
        """A new named point of the part at a place on the ground's axes."""
        if part == GROUND:
            name, velocity = f"O{len(self.points)}", self.vector(0.5)
            self.points[name] = point(place - self.t * velocity, velocity)
            return Anchor(GROUND, name)
        body, (r, R) = self.bodies[part], self.poses[part]
        if not body.turns:
            return Anchor(part, CENTER)
        name = f"P{len(body.points)}"
        at = vector(R.T @ (place - r))
        self.bodies[part] = replace(body, points={**body.points, name: at})
        return Anchor(part, name)

    def near(self, part: str) -> Array:
        r, _ = self.poses[part]
        turns = part == GROUND or self.bodies[part].turns
        return r + self.vector(0.4) if turns else r
