"""Scenes in space that MuJoCo has no element for, or the adapter does not build."""

from ....cases.scene import GROUND
from ....cases.space.joint import SpatialJoint
from ....cases.space.scene import SpatialScene
from ..force import ELEMENTS
from ..hinge import taken
from ..tree import Tree
from .drive import drives
from .tree import held_points, left, natives, spanning_tree


def unbuildable(scene: SpatialScene) -> str | None:
    """The first element that has no counterpart."""
    for force in scene.forces.values():
        if type(force) not in ELEMENTS:
            return f"adapter: {force.name} is a {force.word}, which it does not build"
    if what := taken(scene):
        return f"adapter: {what}"
    tree = spanning_tree(scene)
    loops = tree.loops
    soft = [*loops, *scene.contacts.values()]
    for edge in scene.constraints.values():
        if soft:
            return f"adapter: {edge.name} beside {soft[0].name}, whose force gives way by itself"
    for joint in loops:
        if all(_stands(scene, tree, end.body) for end in (joint.a, joint.b)):
            return f"engine: MuJoCo leaves out {joint.name}, for nothing that it holds can move"
        if held_points(scene, joint) is None:
            what = f"{joint.kind} {joint.name}"
            return f"engine: MuJoCo has no constraint that closes a loop by the {what}"
    for joint in scene.joints.values():
        first = joint.a.body
        if joint.shifts and first != GROUND and not scene.bodies[first].turns:
            return f"adapter: {joint.name} starts at a particle, which has no axes"
    for drive in drives(scene):
        if drive.joint in loops:
            return f"adapter: {drive.joint.name} is driven, and closes a loop of driven joints"
        if drive.number >= len(left(scene, drive.joint)) or (
            left(scene, drive.joint)[drive.number].kind == "ball"
        ):
            return f"adapter: {drive.joint.name} would have to turn a particle, which has no axes"
    touching = [contact.at for contact in scene.contacts.values()]
    for name, contact in scene.contacts.items():
        if touching.count(contact.at) > 1:
            return f"adapter: {name} is not the only contact of {contact.at} with the floor"
    return None


def _stands(scene: SpatialScene, tree: Tree[SpatialJoint], body: str) -> bool:
    """Whether the body is the ground, or held on it rigidly."""
    branches = {branch.body: branch for branch in tree.branches}
    while body in branches and not natives(scene, branches[body]):
        body = branches[body].parent
    return body == GROUND
