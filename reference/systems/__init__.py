"""Textbook systems written out by hand: one a file, in the book's letters.

Each carries its own inertias and its own g and states its own start, so that an agreement with
the generated motion or with an engine is not an agreement of one line of code with itself.
"""

from collections.abc import Iterator, Mapping
from importlib import import_module
from typing import Any

from ..system import Mode, Only, System


class Listed(Mapping[str, Any]):
    """Systems by name, each written as `module:Class`; imported when it is asked for."""

    def __init__(self, places: Mapping[str, str]) -> None:
        self._places = places

    def __getitem__(self, name: str) -> Any:
        module, _, system = self._places[name].partition(":")
        return getattr(import_module(f".{module}", __name__), system)

    def __contains__(self, name: object) -> bool:
        return name in self._places

    def __iter__(self) -> Iterator[str]:
        return iter(self._places)

    def __len__(self) -> int:
        return len(self._places)


SYSTEMS: Mapping[str, type[Mode] | type[System]] = Listed(
    {
        "anisotropic_drift": "anisotropic_drift:AnisotropicDrift",
        "ball_on_rope": "ball_on_rope:BallOnRope",
        "bar_pendulum": "bar_pendulum:BarPendulum",
        "bearing": "bearing:Bearing",
        "bouncing_disk": "bouncing_disk:BouncingDisk",
        "charge_in_field": "charge_in_field:ChargeInField",
        "compass_walker": "compass_walker:CompassWalker",
        "cradle": "cradle:Cradle",
        "disk_on_disk": "disk_on_disk:DiskOnDisk",
        "double_pendulum": "double_pendulum:DoublePendulum",
        "drag_stops": "drag_stops:DragStops",
        "driven_robot": "driven_robot:DrivenRobot",
        "driven_wheel": "driven_wheel:DrivenWheel",
        "driven_edge": "driven_edge:DrivenEdge",
        "driven_knee": "driven_knee:DrivenKnee",
        "dynamometer": "dynamometer:Dynamometer",
        "falling_drag": "falling_drag:FallingDrag",
        "elastic_pendulum": "elastic_pendulum:ElasticPendulum",
        "five_axis_robot": "five_axis_robot:FiveAxisRobot",
        "four_bar": "four_bar:FourBar",
        "friction_cone": "friction_cone:FrictionCone",
        "friction_of_rest": "friction_of_rest:FrictionOfRest",
        "growing_force": "growing_force:GrowingForce",
        "heavy_top": "heavy_top:HeavyTop",
        "knife_edge": "knife_edge:KnifeEdge",
        "light_feet": "light_feet:LightFeet",
        "muscle_isometric": "muscle_isometric:MuscleIsometric",
        "muscle_load": "muscle_load:MuscleLoad",
        "linear_muscle_load": "muscle_load:LinearMuscleLoad",
        "paired_rotors": "paired_rotors:PairedRotors",
        "particle_pendulum": "particle_pendulum:ParticlePendulum",
        "rhombus": "rhombus:Rhombus",
        "rimless_wheel": "rimless_wheel:RimlessWheel",
        "robot_knife": "robot_knife:RobotKnife",
        "rolling_wheel": "rolling_wheel:RollingWheel",
        "running_gait": "running_gait:RunningGait",
        "sleigh": "sleigh:Sleigh",
        "sliding_block": "sliding_block:SlidingBlock",
        "sliding_disk": "sliding_disk:SlidingDisk",
        "sliding_ladder": "sliding_ladder:SlidingLadder",
        "smooth_dynamometer": "smooth_friction:SmoothDynamometer",
        "smooth_growing_force": "smooth_friction:SmoothGrowingForce",
        "spring_mass_damper": "spring_mass_damper:SpringMassDamper",
        "stacked_blocks": "stacked_blocks:StackedBlocks",
        "stopped_pendulum": "stopped_pendulum:StoppedPendulum",
        "stribeck_brake": "stribeck_brake:StribeckBrake",
        "stribeck_drive": "stribeck_drive:StribeckDrive",
        "sprung_gimbal": "sprung_gimbal:SprungGimbal",
        "spring_mass_jump": "spring_mass_jump:SpringMassJump",
        "tilting_disk": "tilting_disk:TiltingDisk",
        "tilting_ring": "tilting_ring:TiltingRing",
        "tipping_block": "tipping_block:TippingBlock",
        "torque_free": "torque_free:TorqueFree",
        "torsion_pendulum": "torsion_pendulum:TorsionPendulum",
        "trunk_on_legs": "trunk_on_legs:TrunkOnLegs",
        "turning_sled": "turning_sled:TurningSled",
        "upright_wheel": "upright_wheel:UprightWheel",
        "viscous_drift": "viscous_guide:ViscousDrift",
        "viscous_growing_force": "viscous_guide:ViscousGrowingForce",
        "wheel_from_above": "wheel_from_above:WheelFromAbove",
    }
)


def written(name: str, parameters: Mapping[str, float]) -> System:
    """The hand-written system of this name; a smooth one is its only mode.

    Raises KeyError for an unknown name, TypeError for other parameters than the system's.
    """
    found = SYSTEMS[name](**parameters)
    return Only(found) if isinstance(found, Mode) else found
