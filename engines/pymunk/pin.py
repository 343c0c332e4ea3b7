"""A pin joint that is laid anew before each step, along a direction that turns with its body.

A pin joint acts along its own line and along nothing else; with error_bias = 0 a step ends with
the velocity along it that closes its whole gap. So a gap is opened before each step, by moving its
far end on the ground.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass, field

from pymunk.body import Body
from pymunk.constraints import PinJoint

LENGTH = 1.0  # m, of the pin joint: of no effect, as it is laid anew

Way = tuple[float, float]
Rates = tuple[float, float, float]
"""vx, vy [m/s], omega [rad/s]."""


def laid(joint: PinJoint, way: Way, speed: float, h: float, before: Rates) -> tuple[Way, Rates]:
    """Lays it along `way`, given in the axes of its body, in the middle of the step to come.

    At the end of the step its point will have the velocity `speed` [m/s] along the way as it then
    lies: what the rates would leave there, if they went on as in the step from `before`, is what
    the joint takes away. Answers with the way in the middle, in ground axes, and the present rates.
    """
    body = joint.a
    (x, y), (vx, vy), omega = body.position, body.velocity, body.angular_velocity
    (a, b), (p, q) = joint.anchor_a, way
    ux, uy, turning = 2 * vx - before[0], 2 * vy - before[1], 2 * omega - before[2]
    middle = body.angle + h * omega
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
    left = fx * (ux - turning * ey) + fy * (uy + turning * ex) - speed
    goal = wx * (ux - turning * dy) + wy * (uy + turning * dx) - left / (wx * fx + wy * fy)
    far = LENGTH + h * goal
    joint.anchor_b = x + h * vx + dx + far * wx, y + h * vy + dy + far * wy
    return (wx, wy), (vx, vy, omega)


@dataclass
class Pin:
    """The joint, the direction that it holds in the axes of its body, and the law of its speed."""

    joint: PinJoint
    way: Way
    law: Callable[[float], tuple[float, ...]]  # of the velocity along `way` [m/s]
    before: Rates = field(init=False)
    along: Way = (0.0, 0.0)  # `way` in ground axes in the last step
    without: Way = (0.0, 0.0)  # N s: the body's momentum after the step, if it were not held

    def __post_init__(self) -> None:
        (vx, vy), omega = self.joint.a.velocity, self.joint.a.angular_velocity
        self.before = vx, vy, omega  # there is no step before the first

    def lay(self, t: float, h: float, gravity: Way) -> None:
        """For the step from t to t + h [s]; all that pymunk is told of forces has been told."""
        speed = self.law(t + h)[0]
        self.along, self.before = laid(self.joint, self.way, speed, h, self.before)
        self.without = _momentum(self.joint.a, h, gravity)

    def impulse(self) -> float:
        """[N s] on the body along `way` in the last step: pymunk knows its size, and its sign is
        that of what changed the momentum of a body without joints."""
        x, y = _momentum(self.joint.a, 0.0, (0.0, 0.0))
        changed = (x - self.without[0]) * self.along[0] + (y - self.without[1]) * self.along[1]
        return math.copysign(self.joint.impulse, changed)


def _momentum(body: Body, h: float, gravity: Way) -> Way:
    """[N s] after h [s] of the forces that it is told."""
    m, (vx, vy), (fx, fy) = body.mass, body.velocity, body.force
    return m * (vx + h * gravity[0]) + h * fx, m * (vy + h * gravity[1]) + h * fy
