"""The joint of the tree that a force acts about or along, or that has dry friction."""

from dataclasses import dataclass
from xml.etree import ElementTree as ET

from ...cases.joint import Freedom
from ...cases.scene import Joint, Scene
from .tree import coordinate, spanning_tree
from .written import written


@dataclass(frozen=True)
class Hinge:
    """MuJoCo's joint; way: 1.0 if it counts the second part's turn on the first, else −1: of a
    shift, which counts the second part's in any tree, it is of no use.

    element: as it stands in the file, while that is written.
    """

    name: str
    way: float
    element: ET.Element | None

    def give(self, key: str, value: float) -> None:
        """An attribute, which it has once; see `taken`."""
        assert self.element is not None
        self.element.set(key, written(value))


def hinge(
    scene: Scene, joint: str, root: ET.Element | None = None, freedom: Freedom = "turn"
) -> Hinge:
    """That of a joint in the tree. Raises KeyError for one that closes a loop."""
    for branch in spanning_tree(scene).branches:
        if branch.joint is not None and branch.joint.name == joint:
            name = coordinate(branch.joint, freedom)
            built = () if root is None else root.iter("joint")
            found = next((element for element in built if element.get("name") == name), None)
            return Hinge(name, 1.0 if branch.forward else -1.0, found)
    raise KeyError(joint)


def way(scene: Scene, joint: Joint) -> float:
    """1.0 if MuJoCo counts the joint's one freedom as it slips, else −1; a slide's always."""
    return 1.0 if joint.shifts else hinge(scene, joint.name).way


def taken(scene: Scene) -> str | None:
    """The first torsion spring or damper for which its joint has no attribute left, or no hinge."""
    loops = {joint.name for joint in spanning_tree(scene).loops}
    seen: set[tuple[str, str]] = set()
    for force in scene.forces.values():
        if force.about is None:
            continue
        if force.about in loops:
            return f"{force.name} acts about {force.about}, which closes a loop and has no hinge"
        kind = (force.about, force.word)
        if force.numbers() and kind in seen:  # a motor is an actuator, of which there may be many
            return f"{force.name} is not the only {force.word} of {force.about}"
        seen.add(kind)
    return None
