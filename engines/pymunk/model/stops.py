"""Stops of a joint's turn: rotary limit joints, which count the second body against the first."""

from pymunk.constraints import RotaryLimitJoint

from ....cases.scene import Scene
from ....cases.scene.forces.stops import Stops
from .world import World

NEVER = 1e6  # rad: where no turn ends


def add_stops(world: World) -> None:
    """In the order of the case file."""
    for stops in world.scene.stops():
        a, b = (world.body(at) for at in world.scene.ends(stops))
        low = -NEVER if stops.low is None else stops.low
        high = NEVER if stops.high is None else stops.high
        world.stops[stops.name] = joint = RotaryLimitJoint(a, b, low, high)
        world.space.add(joint)


def pressed(joint: RotaryLimitJoint, side: str) -> float:
    """The impulse [N m s] of the last step at one of its ends."""
    below = joint.b.angle - joint.a.angle < (joint.min + joint.max) / 2
    return joint.impulse if below == (side == "low") else 0.0


def stop_numbers(joint: RotaryLimitJoint, stops: Stops) -> dict[str, float]:
    """Where they are."""
    held = {"low": joint.min, "high": joint.max}
    return {side: held[side] for side in stops.sides}


def throws_back(scene: Scene) -> str | None:
    """Why pymunk's joint cannot throw back as the scene's stops do; None if none of them does."""
    for stops in scene.stops():
        if stops.restitution:
            return (
                f"engine: pymunk's rotary limit throws nothing back, and {stops.name} has the "
                f"restitution {stops.restitution:g}"
            )
    return None
