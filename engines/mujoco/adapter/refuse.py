"""Scenes that MuJoCo has no element for, the adapter does not build, or that do not compile."""

from collections.abc import Iterator

from ....cases.scene import GROUND, Joint, Scene
from ....cases.scene.frame import SPACE
from ...engine import Plan, Start
from ...foot_contact import NO_STRIDE, strides
from ..model.bounce import LEAST_BOUNCE
from ..model.drive import drives
from ..model.force import ELEMENTS, lacking
from ..model.hinge import attribute_conflict
from ..model.tree import (
    Branch,
    Tree,
    dry_joints,
    freedoms_left,
    held_points,
    natives,
    spanning_tree,
)
from .compilation import NOMINAL, compiled

NO_EDGE = "engine: MuJoCo has no constraint of a velocity across a line that turns with a body"


def why_not_native(scene: Scene) -> list[str]:
    """Why MuJoCo has nothing of its own for the scene; our laws have."""
    edges = [NO_EDGE] if scene.constraints else []
    strode = [NO_STRIDE] if strides(scene) else []
    return [*edges, *strode, *(why for _, why in lacking(scene))][:1]


def why_unbuildable(scene: Scene) -> str | None:
    """The first element that has no counterpart."""
    return next(_lacks(scene), None)


def _lacks(scene: Scene) -> Iterator[str]:
    tree = spanning_tree(scene)
    yield from _unbuilt(scene, tree)
    yield from (_in_space if scene.frame is SPACE else _in_the_plane)(scene, tree)
    yield from _touching_twice(scene)
    for contact in (*scene.contacts.values(), *scene.pairs.values()):
        if 0 < contact.restitution < LEAST_BOUNCE:
            yield (
                "engine: MuJoCo's floor is a spring and damper, and the damper that throws "
                f"{contact.body} back with only {contact.restitution:g} of its speed is unstable"
            )


def _unbuilt(scene: Scene, tree: Tree) -> Iterator[str]:
    """Forces that are not built, and edges beside what gives way by itself."""
    for force in scene.forces.values():
        if type(force) not in ELEMENTS:
            yield f"adapter: {force.name} is a {force.word}, which it does not build"
    if what := attribute_conflict(scene):
        yield f"adapter: {what}"
    soft = [*tree.loops, *scene.contacts.values(), *scene.pairs.values()]
    soft += [*scene.limits(), *dry_joints(scene)]
    for edge in scene.constraints.values() if soft else ():
        yield f"adapter: {edge.name} beside {soft[0].name}, whose force gives way by itself"


def _touching_twice(scene: Scene) -> Iterator[str]:
    """Contacts of a point that has another."""
    touching = [(contact.at, contact.on) for contact in scene.contacts.values()]
    for name, contact in scene.contacts.items():
        if touching.count((contact.at, contact.on)) > 1:
            yield f"adapter: {name} is not the only contact of {contact.at} with the {contact.on}"


def _in_the_plane(scene: Scene, tree: Tree) -> Iterator[str]:
    for quantity in scene.drives:
        part = quantity.rpartition(".")[0]
        if scene.joints[part] in tree.loops:
            yield f"adapter: {part} is driven and closes a loop, where MuJoCo has no joint"
    if strides(scene) and dry_joints(scene):
        yield "adapter: feet that pass the floor, beside a slide's dry friction, need one driver"
    if ours := lacking(scene):
        smooth = (j.name for j in dry_joints(scene) if j.dry_friction and j.dry_friction.smooth)
        if beside := [*scene.constraints, *smooth]:
            force, _ = ours[0]
            yield f"adapter: {force.name} by our law beside {beside[0]}, which does not count it"
    for joint in tree.loops:
        if joint.shifts:
            yield _no_constraint(joint, "a loop needs a pin")
        if joint.dry_friction is not None:
            yield f"engine: {joint.name} closes a loop, and MuJoCo rubs in the tree's joints only"
        if held_points(scene, joint) is None:
            yield f"adapter: {joint.name} closes a loop by a weld, loops are closed by pins only"
    for branch in tree.branches:
        if branch.joint is not None and branch.joint.shifts:
            yield from _slide(scene, tree, branch, branch.joint)


def _no_constraint(joint: Joint, instead: str) -> str:
    what = f"{joint.kind} {joint.name}"
    return f"engine: MuJoCo has no constraint that closes a loop by the {what}: {instead}"


def _slide(scene: Scene, tree: Tree, branch: Branch, joint: Joint) -> Iterator[str]:
    turns = {name: body.turns for name, body in scene.bodies.items()}
    locked = not joint.turns and turns[branch.body]
    if locked and not turns.get(branch.parent, True):
        yield f"adapter: {joint.name} would have to let {branch.body} both shift and turn"
    particle = not turns.get(joint.a.body, True)
    if particle and tree.frame(scene, branch.parent) != GROUND:
        yield _no_axes(joint)


def _no_axes(joint: Joint) -> str:
    return f"adapter: {joint.name} starts at a particle, which has no axes"


def _in_space(scene: Scene, tree: Tree) -> Iterator[str]:
    for joint in tree.loops:
        if all(_stands(scene, tree, end.body) for end in (joint.a, joint.b)):
            yield f"engine: MuJoCo leaves out {joint.name}, for nothing that it holds can move"
        if held_points(scene, joint) is None:
            yield _no_constraint(joint, "a loop needs a ball, a hinge or a weld that is not driven")
    for joint in scene.joints.values():
        first = joint.a.body
        if joint.shifts and first != GROUND and not scene.bodies[first].turns:
            yield _no_axes(joint)
    for drive in drives(scene):
        if drive.joint in tree.loops:
            what = f"{drive.joint.name} is driven, and closes a loop of driven joints"
            yield f"adapter: {what}: drive fewer"
        freedoms = freedoms_left(scene, drive.joint)
        if drive.number >= len(freedoms) or freedoms[drive.number].kind == "ball":
            yield f"adapter: {drive.joint.name} would have to turn a particle, which has no axes"


def _stands(scene: Scene, tree: Tree, body: str) -> bool:
    """Whether the body is the ground, or held on it rigidly."""
    branches = {branch.body: branch for branch in tree.branches}
    while body in branches and not natives(scene, branches[body]):
        body = branches[body].parent
    return body == GROUND


def uncompilable(scene: Scene, start: Start, plan: Plan) -> str | None:
    """The reason why MuJoCo's compiler does not take the scene; None if it does."""
    try:
        compiled(scene, start, NOMINAL, plan)
    except ValueError as refusal:
        return f"engine: MuJoCo does not take the scene: {' '.join(str(refusal).split())}"
    return None
