"""Textbook systems written out by hand: one a file, in the book's letters.

Each carries its own inertias and its own g and states its own start, so that an agreement with
the generated motion or with an engine is not an agreement of one line of code with itself.
"""

from ..mode import Switching
from ..system import System
from .anisotropic_drift import AnisotropicDrift
from .bar_pendulum import BarPendulum
from .bouncing_disk import BouncingDisk
from .double_pendulum import DoublePendulum
from .dynamometer import Dynamometer
from .four_bar import FourBar
from .growing_force import GrowingForce
from .rhombus import Rhombus
from .rolling_wheel import RollingWheel
from .sliding_block import SlidingBlock
from .sliding_disk import SlidingDisk
from .smooth_friction import SmoothDynamometer, SmoothGrowingForce
from .spring_mass_damper import SpringMassDamper

SYSTEMS: dict[str, type[System]] = {
    "bar_pendulum": BarPendulum,
    "double_pendulum": DoublePendulum,
    "four_bar": FourBar,
    "rhombus": Rhombus,
    "rolling_wheel": RollingWheel,
    "spring_mass_damper": SpringMassDamper,
}

SWITCHING: dict[str, type[Switching]] = {
    "anisotropic_drift": AnisotropicDrift,
    "bouncing_disk": BouncingDisk,
    "dynamometer": Dynamometer,
    "growing_force": GrowingForce,
    "sliding_block": SlidingBlock,
    "sliding_disk": SlidingDisk,
    "smooth_dynamometer": SmoothDynamometer,
    "smooth_growing_force": SmoothGrowingForce,
}
