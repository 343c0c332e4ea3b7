"""Textbook systems written out by hand: one a file, in the book's letters.

Each carries its own inertias and its own g and states its own start, so that an agreement with
the generated motion or with an engine is not an agreement of one line of code with itself.
"""

from collections.abc import Mapping

from ..system import Mode, Only, System
from .anisotropic_drift import AnisotropicDrift
from .bar_pendulum import BarPendulum
from .bearing import Bearing
from .bouncing_disk import BouncingDisk
from .charge_in_field import ChargeInField
from .compass_walker import CompassWalker
from .cradle import Cradle
from .disk_on_disk import DiskOnDisk
from .double_pendulum import DoublePendulum
from .drag_stops import DragStops
from .driven_edge import DrivenEdge
from .driven_knee import DrivenKnee
from .driven_robot import DrivenRobot
from .driven_wheel import DrivenWheel
from .dynamometer import Dynamometer
from .elastic_pendulum import ElasticPendulum
from .falling_drag import FallingDrag
from .five_axis_robot import FiveAxisRobot
from .four_bar import FourBar
from .friction_cone import FrictionCone
from .friction_of_rest import FrictionOfRest
from .growing_force import GrowingForce
from .heavy_top import HeavyTop
from .knife_edge import KnifeEdge
from .light_feet import LightFeet
from .muscle_isometric import MuscleIsometric
from .muscle_load import LinearMuscleLoad, MuscleLoad
from .particle_pendulum import ParticlePendulum
from .rhombus import Rhombus
from .rimless_wheel import RimlessWheel
from .robot_knife import RobotKnife
from .rolling_wheel import RollingWheel
from .running_gait import RunningGait
from .sleigh import Sleigh
from .sliding_block import SlidingBlock
from .sliding_disk import SlidingDisk
from .sliding_ladder import SlidingLadder
from .smooth_friction import SmoothDynamometer, SmoothGrowingForce
from .spring_mass_damper import SpringMassDamper
from .spring_mass_jump import SpringMassJump
from .sprung_gimbal import SprungGimbal
from .stacked_blocks import StackedBlocks
from .stribeck_brake import StribeckBrake
from .stribeck_drive import StribeckDrive
from .tilting_disk import TiltingDisk
from .tilting_ring import TiltingRing
from .tipping_block import TippingBlock
from .torque_free import TorqueFree
from .torsion_pendulum import TorsionPendulum
from .trunk_on_legs import TrunkOnLegs
from .turning_sled import TurningSled
from .upright_wheel import UprightWheel
from .viscous_guide import ViscousDrift, ViscousGrowingForce
from .wheel_from_above import WheelFromAbove

SYSTEMS: dict[str, type[Mode] | type[System]] = {
    "anisotropic_drift": AnisotropicDrift,
    "bar_pendulum": BarPendulum,
    "bearing": Bearing,
    "bouncing_disk": BouncingDisk,
    "charge_in_field": ChargeInField,
    "compass_walker": CompassWalker,
    "cradle": Cradle,
    "disk_on_disk": DiskOnDisk,
    "double_pendulum": DoublePendulum,
    "drag_stops": DragStops,
    "driven_robot": DrivenRobot,
    "driven_wheel": DrivenWheel,
    "driven_edge": DrivenEdge,
    "driven_knee": DrivenKnee,
    "dynamometer": Dynamometer,
    "falling_drag": FallingDrag,
    "elastic_pendulum": ElasticPendulum,
    "five_axis_robot": FiveAxisRobot,
    "four_bar": FourBar,
    "friction_cone": FrictionCone,
    "friction_of_rest": FrictionOfRest,
    "growing_force": GrowingForce,
    "heavy_top": HeavyTop,
    "knife_edge": KnifeEdge,
    "light_feet": LightFeet,
    "muscle_isometric": MuscleIsometric,
    "muscle_load": MuscleLoad,
    "linear_muscle_load": LinearMuscleLoad,
    "particle_pendulum": ParticlePendulum,
    "rhombus": Rhombus,
    "rimless_wheel": RimlessWheel,
    "robot_knife": RobotKnife,
    "rolling_wheel": RollingWheel,
    "running_gait": RunningGait,
    "sleigh": Sleigh,
    "sliding_block": SlidingBlock,
    "sliding_disk": SlidingDisk,
    "sliding_ladder": SlidingLadder,
    "smooth_dynamometer": SmoothDynamometer,
    "smooth_growing_force": SmoothGrowingForce,
    "spring_mass_damper": SpringMassDamper,
    "stacked_blocks": StackedBlocks,
    "stribeck_brake": StribeckBrake,
    "stribeck_drive": StribeckDrive,
    "sprung_gimbal": SprungGimbal,
    "spring_mass_jump": SpringMassJump,
    "tilting_disk": TiltingDisk,
    "tilting_ring": TiltingRing,
    "tipping_block": TippingBlock,
    "torque_free": TorqueFree,
    "torsion_pendulum": TorsionPendulum,
    "trunk_on_legs": TrunkOnLegs,
    "turning_sled": TurningSled,
    "upright_wheel": UprightWheel,
    "viscous_drift": ViscousDrift,
    "viscous_growing_force": ViscousGrowingForce,
    "wheel_from_above": WheelFromAbove,
}


def written(name: str, parameters: Mapping[str, float]) -> System:
    """The hand-written system of this name; a smooth one is its only mode.

    Raises KeyError for an unknown name, TypeError for other parameters than the system's.
    """
    found = SYSTEMS[name](**parameters)
    return Only(found) if isinstance(found, Mode) else found
