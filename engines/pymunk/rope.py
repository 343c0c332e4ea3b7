"""Ropes: slide joints without a least length, which pull where it is beyond their largest.

A step finds one too long by how far its ends have parted in it. With error_bias = 0 it takes all of
that back at once, and throws back what it has caught by up to its whole speed: so a rope has a bias
of its own, and the stops of joints have the same.
"""

import math

from pymunk.constraints import SlideJoint

from ..engine import Choice
from .world import World

RATE = 150.0  # 1/s


def add_ropes(world: World) -> None:
    """In the order of the case file."""
    for rope in world.scene.ropes():
        a, b = world.body(rope.a), world.body(rope.b)
        ends = world.local(rope.a), world.local(rope.b)
        world.ropes[rope.name] = joint = SlideJoint(a, b, *ends, 0.0, rope.length)
        world.space.add(joint)


EASES = Choice(
    "limit.error_bias",
    math.exp(-RATE),
    f"what is too long of a rope, or beyond a stop, falls as exp(−{RATE:g} t/s): with 0 it is "
    "taken back in one step, and throws back what was caught; the default takes a tenth of a "
    "second",
)
