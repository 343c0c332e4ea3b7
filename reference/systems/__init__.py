"""Textbook systems written out by hand: one a file, in the book's letters.

Each carries its own inertias and its own g and states its own start, so that an agreement with
the generated motion or with an engine is not an agreement of one line of code with itself.
"""

from reference.mode import Switching
from reference.system import System
from reference.systems.anisotropic_drift import AnisotropicDrift
from reference.systems.bar_pendulum import BarPendulum
from reference.systems.bouncing_disk import BouncingDisk
from reference.systems.double_pendulum import DoublePendulum
from reference.systems.dynamometer import Dynamometer
from reference.systems.four_bar import FourBar
from reference.systems.growing_force import GrowingForce
from reference.systems.rhombus import Rhombus
from reference.systems.rolling_wheel import RollingWheel
from reference.systems.sliding_block import SlidingBlock
from reference.systems.sliding_disk import SlidingDisk
from reference.systems.smooth_friction import SmoothDynamometer, SmoothGrowingForce
from reference.systems.spring_mass_damper import SpringMassDamper

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
