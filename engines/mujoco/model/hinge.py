"""The joint of the tree that a force acts about or along, or that has dry friction."""

from dataclasses import dataclass
from xml.etree import ElementTree as ET

from ....cases.scene import Force, Joint, Scene
from ....cases.scene.frame import SPACE
from ....cases.scene.joint import FreedomKind
from .number_text import written
from .spatial_tree import coordinate as coordinate_in_space
from .spatial_tree import spanning_tree as spanning_tree_in_space
from .tree import coordinate, spanning_tree


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


def hinge(scene: Scene, force: Force, root: ET.Element | None = None) -> Hinge:
    """The joint about which a force acts. Raises KeyError of a joint that closes a loop."""
    if scene.frame is SPACE:
        name, way = _spatial(scene, force)
    else:
        name, way = _flat(scene, force.about or "", force.freedom)
    built = () if root is None else root.iter("joint")
    return Hinge(name, way, next((e for e in built if e.get("name") == name), None))


def _flat(scene: Scene, joint: str, freedom: FreedomKind) -> tuple[str, float]:
    for branch in spanning_tree(scene).branches:
        if branch.joint is not None and branch.joint.name == joint:
            return coordinate(branch.joint, freedom), 1.0 if branch.forward else -1.0
    raise KeyError(joint)


def _spatial(scene: Scene, force: Force) -> tuple[str, float]:
    """The name of MuJoCo's joint, and its way, 1.0. Raises KeyError of a joint that closes a loop.

    Of a body that is the first part MuJoCo's axis is the opposite, and the angle the same.
    """
    if force.about in {joint.name for joint in spanning_tree_in_space(scene).loops}:
        raise KeyError(force.about)
    joint = scene.joints[force.about or ""]
    return coordinate_in_space(joint, joint.turning(force.turn)), 1.0


def way(scene: Scene, joint: Joint) -> float:
    """1.0 if MuJoCo counts the joint's one freedom as it slips, else −1; a slide's always."""
    return 1.0 if joint.shifts else _flat(scene, joint.name, "turn")[1]


def attribute_conflict(scene: Scene) -> str | None:
    """The first torsion spring or damper for which its joint has no attribute left, or no hinge."""
    spatial = scene.frame is SPACE
    found = spanning_tree_in_space(scene) if spatial else spanning_tree(scene)
    loops = {joint.name for joint in found.loops}
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
