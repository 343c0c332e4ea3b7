"""Prescribed rates of joints' freedoms: motions that no force of the scene can hold back.

As a driven point is a heavy mass, a driven freedom has a heavy armature, and actuators that give it
the acceleration of the law: right at every RK4 stage, and all forces follow.
"""

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from xml.etree import ElementTree as ET

from ....cases.fields.signal import Signal
from ....cases.scene import GROUND, Joint, Scene
from ....cases.scene.frame import PLANE
from ...signal import derivative
from .force import signals
from .number_text import written
from .tree import coordinate, freedoms_left

HEAVY = 1e15  # kg m² (kg of a slide): what a scene exerts changes the rate by 1e-15 of it


@dataclass(frozen=True)
class Drive:
    """One prescribed rate as MuJoCo has it; effort: what it exerts, such as `hinge.torque`."""

    joint: Joint
    number: int  # of the freedom
    name: str  # MuJoCo's joint
    law: Signal
    effort: str


def drives(scene: Scene) -> Iterator[Drive]:
    """In the scene's order. Raises KeyError for a rate that no joint in space has."""
    for quantity, law in scene.drives.items():
        part, _, rate = quantity.rpartition(".")
        joint = scene.joints[part]
        freedom = joint.rates[rate]
        flat = scene.frame is PLANE  # where a slot's freedoms stand in MuJoCo's order
        freedoms = freedoms_left(scene, joint) if flat else joint.freedoms
        number = [each.rate for each in freedoms].index(rate)
        name = coordinate(scene, joint, number)
        yield Drive(joint, number, name, law, f"{part}.{freedom.effort}")


def controls(scene: Scene) -> list[Signal]:
    """The laws of all actuators' controls, in MuJoCo's order."""
    return [*signals(scene), *(law for *_, law in _accelerations(scene))]


def _accelerations(scene: Scene) -> Iterator[tuple[str, float, Signal]]:
    """MuJoCo's joint, how large its acceleration is, and the law that it follows."""
    for drive in drives(scene):
        for law in derivative(drive.law):
            yield drive.name, law.amplitude[0], law
    for name, point in scene.points.items():
        rates = derivative(point.moves) if point.moves else []
        for law in (law for rate in rates for law in derivative(rate)):
            for axis, size in zip(scene.frame.axes, law.amplitude, strict=True):
                yield f"{GROUND}.{name}.{axis}", size, law


def write(root: ET.Element, scene: Scene) -> None:
    """Armatures, and actuators after those of the scene's forces."""
    joints = {joint.attrib["name"]: joint for joint in root.iter("joint")}
    for drive in drives(scene):
        joints[drive.name].set("armature", written(HEAVY))
    numbers = Counter[str]()
    for joint, size, _ in _accelerations(scene):
        section = root.find("actuator")
        section = ET.SubElement(root, "actuator") if section is None else section
        name = "drive" if scene.frame is PLANE else f"{joint}.drive"
        # The gear is what is heavy: a control above 1e10 would be "huge".
        ET.SubElement(
            section, "general", name=f"{name}.{numbers[name]}", joint=joint,
            gear=written(HEAVY * size),
        )  # fmt: skip
        numbers[name] += 1
