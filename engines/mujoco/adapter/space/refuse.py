"""Scenes in space that MuJoCo has no element for, or the adapter does not build."""

from .....cases.scene import GROUND, Scene
from .....cases.scene.joint import Joint
from ...model.space.drive import drives
from ...model.spatial_tree import freedoms_left, held_points, natives, spanning_tree
from ...model.tree import Tree
from ..refuse import touching_twice, unbuilt


def unbuildable(scene: Scene) -> str | None:
    """The first element that has no counterpart."""
    tree = spanning_tree(scene)
    loops = tree.loops
    if what := unbuilt(scene, [part.name for part in (*loops, *scene.contacts.values())]):
        return what
    for joint in loops:
        if all(_stands(scene, tree, end.body) for end in (joint.a, joint.b)):
            return f"engine: MuJoCo leaves out {joint.name}, for nothing that it holds can move"
        if held_points(scene, joint) is None:
            what = f"{joint.kind} {joint.name}"
            instead = "a loop needs a ball, a hinge or a weld that is not driven"
            return f"engine: MuJoCo has no constraint that closes a loop by the {what}: {instead}"
    for joint in scene.joints.values():
        first = joint.a.body
        if joint.shifts and first != GROUND and not scene.bodies[first].turns:
            return f"adapter: {joint.name} starts at a particle, which has no axes"
    for drive in drives(scene):
        if drive.joint in loops:
            what = f"{drive.joint.name} is driven, and closes a loop of driven joints"
            return f"adapter: {what}: drive fewer"
        if drive.number >= len(freedoms_left(scene, drive.joint)) or (
            freedoms_left(scene, drive.joint)[drive.number].kind == "ball"
        ):
            return f"adapter: {drive.joint.name} would have to turn a particle, which has no axes"
    return touching_twice(scene)


def _stands(scene: Scene, tree: Tree[Joint], body: str) -> bool:
    """Whether the body is the ground, or held on it rigidly."""
    branches = {branch.body: branch for branch in tree.branches}
    while body in branches and not natives(scene, branches[body]):
        body = branches[body].parent
    return body == GROUND
