"""What slips in a joint of the ground, as the law of friction sees it: a mass, a speed, a force."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from ....cases.scene import Joint
from ..force import load
from ..world import World


@dataclass(frozen=True)
class Slip:
    """mass: what resists the slip [kg; of a pin kg m²]. applied: all else that acts along it
    [N or N m], at t + ahead. speed: [m/s or rad/s]. push: friction as a force of ours."""

    mass: float
    applied: Callable[[float, float], float]
    speed: Callable[[], float]
    push: Callable[[float], None]


def turn(world: World, joint: Joint, step: float) -> Slip:
    """About a pin: its inertia there, and the moment there of all that acts at the centre."""
    part, body = world.scene.bodies[joint.b.body], world.bodies[joint.b.body]
    acting, (a, b) = load(world, joint.b.body, step), world.local(joint.b)

    def about(t: float, ahead: float) -> float:
        fx, fy, moment = acting(t, ahead)
        angle = body.angle + (ahead + step / 2) * body.angular_velocity  # which is h/2 behind
        cos, sin = math.cos(angle), math.sin(angle)
        return moment - (cos * a - sin * b) * fy + (sin * a + cos * b) * fx

    def push(moment: float) -> None:
        body.torque += moment

    return Slip(part.about(joint.b.point), about, lambda: body.angular_velocity, push)
