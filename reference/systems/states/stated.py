"""Hand-written systems that answer for states, by the names that cases give them."""

from collections.abc import Mapping

from ...stated import Stated
from .. import Listed

STATED: Mapping[str, type[Stated]] = Listed(
    {
        "arm_states": "states.arm_states:ArmStates",
        "hung_shapes": "states.hung_shapes:HungShapes",
        "moving_body": "states.moving_body:MovingBody",
        "planar_bodies": "states.planar_bodies:PlanarBodies",
        "sliding_points": "states.sliding_points:SlidingPoints",
    }
)
