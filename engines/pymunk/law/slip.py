"""What slips in a joint of the ground, as the law of friction sees it: a mass, a speed, a force."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from ....cases.scene import Joint
from ..direct import State, reading, turning
from ..force import load
from ..world import World


@dataclass(frozen=True)
class Slip:
    """mass: what resists the slip [kg; of a pin kg m²]. read: the state of what slips, by which
    the others know. applied: all else that acts along it [N or N m], at t + ahead. speed: [m/s or
    rad/s]. push: friction as a force of ours."""

    mass: float
    read: Callable[[], State]
    applied: Callable[[float, float, State], float]
    speed: Callable[[State], float]
    push: Callable[[float, State], None]


def turn(world: World, joint: Joint, step: float) -> Slip:
    """About a pin: its inertia there, and the moment there of all that acts at the centre."""
    part, body = world.scene.bodies[joint.b.body], world.bodies[joint.b.body]
    acting, (a, b) = load(world, joint.b.body, step), world.local(joint.b)

    def about(t: float, ahead: float, state: State) -> float:
        fx, fy, moment = acting(t, ahead, state)
        _, _, angle, _, _, omega = state
        angle += (ahead + step / 2) * omega  # which is h/2 behind
        cos, sin = math.cos(angle), math.sin(angle)
        return moment - (cos * a - sin * b) * fy + (sin * a + cos * b) * fx

    twist = turning(body)

    def push(moment: float, state: State) -> None:
        twist(moment)

    return Slip(part.about(joint.b.point), reading(body), about, lambda state: state[5], push)
