"""pymunk as shipped: attributes of its Space and constraints."""

from typing import Any

from pymunk.body import Body
from pymunk.constraints import GearJoint
from pymunk.space import Space

from .options import CONSTRAINT, full

SHIPPED_STEP = 0.01  # s; pymunk has no step of its own, and its examples use 1/50 to 1/100
DEFAULT = "pymunk's default"
_SPACE = (
    "iterations",
    "damping",
    "collision_slop",
    "collision_bias",
    "collision_persistence",
)


def defaults() -> dict[str, Any]:
    """As pymunk has them: some are single precision, and typed ones would change the motion."""
    space, joint = Space(), GearJoint(Body(1.0, 1.0), Body(1.0, 1.0), 0.0, 1.0)
    first = {full(name): getattr(space, name) for name in _SPACE[:2]}
    of_joints = {full(name): getattr(joint, name) for name in CONSTRAINT}
    return first | of_joints | {full(name): getattr(space, name) for name in _SPACE[2:]}
