"""The joint of the tree that a force acts about or along."""

from dataclasses import dataclass
from xml.etree import ElementTree as ET

from ....cases.scene import Force, Scene
from .number_text import written
from .tree import coordinate, number_of, spanning_tree


@dataclass(frozen=True)
class Hinge:
    """MuJoCo's joint, which counts what the scene's does; element: while the file is written."""

    name: str
    element: ET.Element | None

    def give(self, key: str, value: float) -> None:
        """An attribute, which it has once; see `attribute_conflict`."""
        assert self.element is not None
        self.element.set(key, written(value))


def hinge(scene: Scene, force: Force, root: ET.Element | None = None) -> Hinge:
    """The joint about which a force acts. Raises KeyError of a joint that closes a loop."""
    joint = scene.joints[force.about or ""]
    if joint in spanning_tree(scene).loops:
        raise KeyError(joint.name)
    name = coordinate(scene, joint, number_of(scene, force))
    built = () if root is None else root.iter("joint")
    return Hinge(name, next((e for e in built if e.get("name") == name), None))


def attribute_conflict(scene: Scene) -> str | None:
    """The first torsion spring or damper for which its joint has no attribute left, or no hinge."""
    loops = {joint.name for joint in spanning_tree(scene).loops}
    seen: set[tuple[str, str, str]] = set()
    for force in scene.forces.values():
        if force.about is None:
            continue
        if force.about in loops:
            return f"{force.name} acts about {force.about}, which closes a loop and has no hinge"
        kind = (force.about, force.turn or "angle", force.word)
        if force.numbers() and kind in seen:  # a motor is an actuator, of which there may be many
            turn = f"{force.about}.{force.turn}" if force.turn else force.about
            return f"{force.name} is not the only {force.word} of {turn}"
        seen.add(kind)
    return None
