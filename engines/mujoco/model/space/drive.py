"""Prescribed rates of joints' freedoms: motions that no force of the scene can hold back.

As a driven point is a heavy mass, a driven freedom has a heavy armature, and an actuator that gives
it the acceleration of the law: right at every RK4 stage, and all forces follow.
"""

from dataclasses import dataclass
from xml.etree import ElementTree as ET

from .....cases.fields.signal import Signal
from .....cases.scene import Scene
from .....cases.scene.joint import Joint
from ....signal import derivative
from ..number_text import written
from ..scene import HEAVY
from ..spatial_tree import coordinate


@dataclass(frozen=True)
class Drive:
    """One prescribed rate as MuJoCo has it; quantity: what it exerts, such as `q1.torque`."""

    joint: Joint
    number: int  # of the freedom
    rate: Signal

    @property
    def name(self) -> str:
        """MuJoCo's joint."""
        return coordinate(self.joint, self.number)

    @property
    def quantity(self) -> str:
        """`q1.torque` of a hinge, `upright.theta_torque`, `rail.x_force`."""
        return f"{self.joint.name}.{self.joint.freedoms[self.number].effort}"

    @property
    def accelerations(self) -> list[Signal]:
        """The derivative of the law, as a sum; of a constant rate nothing is left."""
        return derivative(self.rate)


def drives(scene: Scene) -> list[Drive]:
    """In the scene's order. Raises KeyError for a rate that no joint has."""
    found = []
    for quantity, signal in scene.drives.items():
        part, _, rate = quantity.rpartition(".")
        joint = scene.joints[part]
        rates = {f.rate: i for i, f in enumerate(joint.freedoms) if f.name}
        found.append(Drive(joint, rates[rate], signal))
    return found


def signals(scene: Scene) -> list[Signal]:
    """The laws of the drives' actuators, in MuJoCo's order."""
    return [law for drive in drives(scene) for law in drive.accelerations]


def write(root: ET.Element, scene: Scene) -> None:
    """Armatures, and actuators after those of the scene's forces."""
    joints = {joint.attrib["name"]: joint for joint in root.iter("joint")}
    for drive in drives(scene):
        joints[drive.name].set("armature", written(HEAVY))
        for i, law in enumerate(drive.accelerations):
            section = root.find("actuator")
            section = ET.SubElement(root, "actuator") if section is None else section
            # The gear is what is heavy: a control above 1e10 would be "huge".
            ET.SubElement(
                section, "general", name=f"{drive.name}.drive.{i}", joint=drive.name,
                gear=written(HEAVY * law.amplitude[0]),
            )  # fmt: skip
