"""Hand-written systems that answer for states, by the names that cases give them."""

from collections.abc import Mapping

from ..stated import Stated
from . import Listed

STATED: Mapping[str, type[Stated]] = Listed(
    {
        "arm_states": "arm_states:ArmStates",
        "hung_shapes": "hung_shapes:HungShapes",
        "moving_body": "moving_body:MovingBody",
        "planar_bodies": "planar_bodies:PlanarBodies",
        "sliding_points": "sliding_points:SlidingPoints",
    }
)
