"""Hand-written systems that answer for states, by the names that cases give them."""

from ..stated import Stated
from .arm_states import ArmStates
from .hung_shapes import HungShapes
from .moving_body import MovingBody
from .planar_bodies import PlanarBodies
from .sliding_points import SlidingPoints

STATED: dict[str, type[Stated]] = {
    "arm_states": ArmStates,
    "hung_shapes": HungShapes,
    "moving_body": MovingBody,
    "planar_bodies": PlanarBodies,
    "sliding_points": SlidingPoints,
}
