"""Textbook systems written out by hand, in the book's letters, grouped by physics.

One a file, or two where one is built on the other. Each file carries its own inertias and its own g
and states its own start, so that an agreement with the generated motion or with an engine is not an
agreement of one line of code with itself.
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
        "anisotropic_drift": "friction.anisotropic_drift:AnisotropicDrift",
        "ball_on_rope": "pendula.ball_on_rope:BallOnRope",
        "bar_pendulum": "pendula.bar_pendulum:BarPendulum",
        "bearing": "friction.bearing:Bearing",
        "bouncing_disk": "contact.bouncing_disk:BouncingDisk",
        "charge_in_field": "bodies.charge_in_field:ChargeInField",
        "compass_walker": "walkers.compass_walker:CompassWalker",
        "cradle": "contact.cradle:Cradle",
        "disk_on_disk": "contact.disk_on_disk:DiskOnDisk",
        "double_pendulum": "pendula.double_pendulum:DoublePendulum",
        "drag_stops": "bodies.drag_stops:DragStops",
        "driven_robot": "robots.driven_robot:DrivenRobot",
        "driven_wheel": "rolling.driven_wheel:DrivenWheel",
        "driven_edge": "rolling.driven_edge:DrivenEdge",
        "driven_knee": "walkers.driven_knee:DrivenKnee",
        "dynamometer": "friction.dynamometer:Dynamometer",
        "falling_drag": "bodies.falling_drag:FallingDrag",
        "elastic_pendulum": "pendula.elastic_pendulum:ElasticPendulum",
        "five_axis_robot": "robots.five_axis_robot:FiveAxisRobot",
        "four_bar": "linkages.four_bar:FourBar",
        "friction_cone": "friction.friction_cone:FrictionCone",
        "friction_of_rest": "friction.friction_of_rest:FrictionOfRest",
        "growing_force": "friction.growing_force:GrowingForce",
        "heavy_top": "bodies.heavy_top:HeavyTop",
        "knife_edge": "rolling.knife_edge:KnifeEdge",
        "light_feet": "walkers.compass_walker:LightFeet",
        "muscle_isometric": "muscles.muscle_load:MuscleIsometric",
        "muscle_load": "muscles.muscle_load:MuscleLoad",
        "linear_muscle_load": "muscles.muscle_load:LinearMuscleLoad",
        "paired_rotors": "bodies.paired_rotors:PairedRotors",
        "particle_pendulum": "pendula.particle_pendulum:ParticlePendulum",
        "rhombus": "linkages.rhombus:Rhombus",
        "rimless_wheel": "walkers.rimless_wheel:RimlessWheel",
        "robot_knife": "robots.robot_knife:RobotKnife",
        "rolling_wheel": "rolling.rolling_wheel:RollingWheel",
        "running_gait": "walkers.running_gait:RunningGait",
        "sleigh": "rolling.sleigh:Sleigh",
        "sliding_block": "friction.sliding_block:SlidingBlock",
        "sliding_disk": "contact.sliding_disk:SlidingDisk",
        "sliding_ladder": "contact.sliding_ladder:SlidingLadder",
        "smooth_dynamometer": "friction.smooth_friction:SmoothDynamometer",
        "smooth_growing_force": "friction.smooth_friction:SmoothGrowingForce",
        "spring_mass_damper": "bodies.spring_mass_damper:SpringMassDamper",
        "stacked_blocks": "contact.stacked_blocks:StackedBlocks",
        "stopped_pendulum": "pendula.stopped_pendulum:StoppedPendulum",
        "stribeck_brake": "friction.stribeck_brake:StribeckBrake",
        "stribeck_drive": "friction.stribeck_drive:StribeckDrive",
        "sprung_gimbal": "bodies.sprung_gimbal:SprungGimbal",
        "spring_mass_jump": "walkers.running_gait:SpringMassJump",
        "tilting_disk": "rolling.tilting_ring:TiltingDisk",
        "tilting_ring": "rolling.tilting_ring:TiltingRing",
        "tipping_block": "contact.tipping_block:TippingBlock",
        "torque_free": "bodies.torque_free:TorqueFree",
        "torsion_pendulum": "pendula.torsion_pendulum:TorsionPendulum",
        "trunk_on_legs": "walkers.trunk_on_legs:TrunkOnLegs",
        "turning_sled": "friction.turning_sled:TurningSled",
        "upright_wheel": "rolling.upright_wheel:UprightWheel",
        "viscous_drift": "friction.viscous_guide:ViscousDrift",
        "viscous_growing_force": "friction.viscous_guide:ViscousGrowingForce",
        "wheel_from_above": "rolling.wheel_from_above:WheelFromAbove",
    }
)


def written(name: str, parameters: Mapping[str, float]) -> System:
    """The hand-written system of this name; a smooth one is its only mode.

    Raises KeyError for an unknown name, TypeError for other parameters than the system's.
    """
    system = SYSTEMS[name](**parameters)
    return Only(system) if isinstance(system, Mode) else system
