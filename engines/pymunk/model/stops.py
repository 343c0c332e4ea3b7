"""Stops of a joint's turn: rotary limit joints, which count the second body against the first."""

from pymunk.constraints import RotaryLimitJoint

from ....cases.scene.forces.stops import Stops
from .world import World

NEVER = 1e6  # rad: where no turn ends


def stops_joint(world: World, stops: Stops) -> RotaryLimitJoint:
    """Between the bodies of the joint."""
    a, b = (world.body(at) for at in world.scene.ends(stops))
    low = -NEVER if stops.low is None else stops.low
    return RotaryLimitJoint(a, b, low, NEVER if stops.high is None else stops.high)


def pressed(joint: RotaryLimitJoint, side: str) -> float:
    """The impulse [N m s] of the last step at one of its ends."""
    below = joint.b.angle - joint.a.angle < (joint.min + joint.max) / 2
    return joint.impulse if below == (side == "low") else 0.0


def stop_numbers(joint: RotaryLimitJoint, stops: Stops) -> dict[str, float]:
    """Where they are."""
    held = {"low": joint.min, "high": joint.max}
    return {side: held[side] for side in stops.sides}
