"""A pin joint that is laid anew before each step, along a direction that turns with its body.

A pin joint acts along its own line and along nothing else; with error_bias = 0 a step ends with
the velocity along it that closes its whole gap. So a gap is opened before each step, by moving its
far end on the ground.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from pymunk.constraints import PinJoint

from .chipmunk_state import State, forced, reading

LENGTH = 1.0  # m, of the pin joint: of no effect, as it is laid anew

Way = tuple[float, float]


def laid(state: State, at: Way, way: Way, speed: float, h: float, before: State) -> tuple[Way, Way]:
    """Where the far end is to lie so that it acts along `way` in the middle of the step to come.

    The body's point `at`, and `way`, are given in the axes of the body. At the end of the step the
    point will have the velocity `speed` [m/s] along the way as it then lies: what the rates would
    leave there, if they went on as in the step from the state `before`, is what the joint takes
    away. Answers with the far end and the way in the middle, in ground axes.
    """
    (x, y, angle, vx, vy, omega), (a, b), (p, q) = state, at, way
    *_, was_vx, was_vy, was_omega = before
    ux, uy, turning = 2 * vx - was_vx, 2 * vy - was_vy, 2 * omega - was_omega
    middle = angle + h * omega
    end = middle + h / 2 * turning
    cos, sin, cos_end, sin_end = math.cos(middle), math.sin(middle), math.cos(end), math.sin(end)
    dx, dy, ex, ey = (
        cos * a - sin * b,
        sin * a + cos * b,
        cos_end * a - sin_end * b,
        sin_end * a + cos_end * b,
    )
    wx, wy = cos * p - sin * q, sin * p + cos * q
    fx, fy = cos_end * p - sin_end * q, sin_end * p + cos_end * q
    error = fx * (ux - turning * ey) + fy * (uy + turning * ex) - speed
    goal = wx * (ux - turning * dy) + wy * (uy + turning * dx) - error / (wx * fx + wy * fy)
    far = LENGTH + h * goal
    return (x + h * vx + dx + far * wx, y + h * vy + dy + far * wy), (wx, wy)


@dataclass
class Pin:
    """The joint, the direction that it holds in the axes of its body, and the law of its speed."""

    joint: PinJoint
    way: Way
    law: Callable[[float], tuple[float, ...]]  # of the velocity along `way` [m/s]
    before: State = field(init=False)
    along: Way = (0.0, 0.0)  # `way` in ground axes in the last step
    without: Way = (0.0, 0.0)  # N s: the body's momentum after the step, if it were not held

    def __post_init__(self) -> None:
        body = self.joint.a
        self._read, self._forced = reading(body), forced(body)
        self._at, self._mass = self.joint.anchor_a, body.mass
        self.before = self._read()  # there is no step before the first

    def lay(self, t: float, h: float, gravity: Way) -> None:
        """For the step from t to t + h [s]; all that pymunk is told of forces has been told."""
        state, speed = self._read(), self.law(t + h)[0]
        far, self.along = laid(state, self._at, self.way, speed, h, self.before)
        self.joint.anchor_b, self.before = far, state
        (_, _, _, vx, vy, _), (fx, fy), m = state, self._forced(), self._mass
        self.without = m * (vx + h * gravity[0]) + h * fx, m * (vy + h * gravity[1]) + h * fy

    def impulse(self) -> float:
        """[N s] on the body along `way` in the last step: pymunk knows its size, and its sign is
        that of what changed the momentum of a body without joints."""
        (_, _, _, vx, vy, _), m = self._read(), self._mass
        x, y = m * vx - self.without[0], m * vy - self.without[1]
        return math.copysign(self.joint.impulse, x * self.along[0] + y * self.along[1])
