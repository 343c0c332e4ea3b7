"""A trajectory as elements look at it: the states of bodies and points, and lines between them."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..trajectory import ANGLE, OMEGA, Array, Trajectory
from .frame import PLANE, SPACE
from .point import GROUND, Anchor, GroundPoint
from .rotation import turned as rotated

MEETING = 16 * float(np.finfo(np.float64).eps)  # of the ends' places: nearer is rounding


@dataclass(frozen=True)
class Motion:
    """The samples of a scene's bodies and ground points, and the joints about which forces act."""

    bodies: Mapping[str, Any]  # of the plane or of space
    points: Mapping[str, GroundPoint]
    trajectory: Trajectory
    joints: Mapping[str, Any] = field(default_factory=dict)
    drives: Mapping[str, Any] = field(default_factory=dict)  # the rates that are prescribed

    def point(self, anchor: Anchor) -> Array:
        """(N, 4): x, y, vx, vy of a point (2.1), (2.6); in space (N, 6)."""
        if anchor.body == GROUND:
            return self.points[anchor.point].states(self.trajectory.times)
        states = self.trajectory.states[anchor.body]
        return self.bodies[anchor.body].point(states, anchor.point)

    def line(self, a: Anchor, b: Anchor) -> tuple[Array, Array]:
        """Length (N,) of the line from a to b, and its rate; where they meet, as they part."""
        (from_, v_a), (to, v_b) = (np.hsplit(self.point(end), 2) for end in (a, b))
        place, velocity = to - from_, v_b - v_a
        length, speed = (np.sqrt(np.sum(x * x, axis=1)) for x in (place, velocity))
        apart = length > MEETING * np.max(np.abs(np.hstack([from_, to])), axis=1)
        rate = np.sum(place * velocity, axis=1) / np.where(apart, length, 1.0)
        return length, np.where(apart, rate, speed)

    def turned(self, body: str) -> tuple[Array | float, Array | float]:
        """Angle [rad] and rate [rad/s] of a body's axes, (N,) each; 0 of the ground's."""
        if body == GROUND:
            return 0.0, 0.0
        states = self.trajectory.states[body]
        return states[:, ANGLE], states[:, OMEGA]

    def spin(self, body: str) -> Array:
        """(N, 1) how fast a body turns [rad/s]; in space (N, 3), in ground axes."""
        states = self.trajectory.states[body]
        if states.shape[1] == PLANE.width:
            return states[:, PLANE.spin]
        return rotated(states[:, SPACE.attitude], states[:, SPACE.spin])

    def turn(self, joint: str, freedom: str) -> tuple[Array, Array]:
        """(N,) the angle [rad] of a joint's second part against its first, and its rate [rad/s].

        freedom: which turn, in space where the joint names its freedoms.
        """
        turn: tuple[Array, Array] = self.joints[joint].turn(self, freedom)
        return turn

    def reaction(self, quantity: str) -> Array:
        """(N,) as the producer gives it. Raises KeyError if it does not."""
        return self.trajectory.reactions[quantity]
