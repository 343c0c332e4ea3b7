"""Elements that hold on one side: ropes, and stops of a joint's turn."""

import math

from pymunk.constraints import RotaryLimitJoint, SlideJoint

from ....cases.scene.forces.limit import Rope, Stops
from ...engine import Choice
from .world import World

# Ropes: slide joints without a least length, which pull where it is beyond their largest.
#
# A step finds one too long by how far its ends have parted in it. With error_bias = 0 it takes
# all of that back at once, and throws back what it has caught by up to its whole speed: so a rope
# has a bias of its own, and the stops of joints have the same.


FASTEST = 150.0  # 1/s: at 0.1 ms a ball that swings on a rope is ten times nearer than with 20/s
SLOWING = 1.5  # s^-1/2: it meets FASTEST at 0.1 ms; at 1 ms a ball that is caught is caught once


def rope_joint(world: World, rope: Rope) -> SlideJoint:
    """Between its ends."""
    ends = world.local(rope.a), world.local(rope.b)
    return SlideJoint(world.body(rope.a), world.body(rope.b), *ends, 0.0, rope.length)


def rope_numbers(joint: SlideJoint, rope: Rope) -> dict[str, float]:
    """How long it is."""
    return {"length": joint.max}


def pulled(joint: SlideJoint, side: str) -> float:
    """The impulse [N s] of the last step."""
    return joint.impulse


def eases(step: float) -> Choice:
    """How fast what is too long of a rope, or beyond a stop, is taken back.

    A step overshoots by up to v h, and what is taken back at a rate r throws with up to v h r: 15 %
    of the speed with 150/s at 1 ms, where a ball that was caught bounces. Slower, a taut rope stays
    too long instead. With r ~ h^-1/2 both fall with the step (measured, 0.1 to 1 ms).
    """
    rate = min(FASTEST, SLOWING / math.sqrt(step))
    return Choice(
        "limit.error_bias",
        math.exp(-rate),
        f"what is too long of a rope, or beyond a stop, falls as exp(−{rate:.3g} t/s): with 0 it "
        "is taken back in one step, and throws back what was caught; the default takes a sixth of "
        "a second",
    )


# Stops of a joint's turn: rotary limit joints, which count the second body against the first.


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
