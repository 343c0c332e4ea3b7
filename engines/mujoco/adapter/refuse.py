"""Scenes that MuJoCo has no element for, the adapter does not build, or that do not compile."""

from collections.abc import Callable, Sequence

from ....cases.scene import GROUND, Joint, Scene
from ...engine import Plan, Start
from ...foot_contact import NO_STRIDE, strides
from ..model.bounce import LEAST_BOUNCE
from ..model.force import ELEMENTS, lacking
from ..model.hinge import attribute_conflict
from ..model.tree import Branch, Tree, built_as, spanning_tree
from .compilation import NOMINAL

NO_EDGE = "engine: MuJoCo has no constraint of a velocity across a line that turns with a body"


def not_native(scene: Scene) -> list[str]:
    """Why MuJoCo has nothing of its own for the scene; our laws have."""
    edges = [NO_EDGE] if scene.constraints else []
    strode = [NO_STRIDE] if strides(scene) else []
    return [*edges, *strode, *(why for _, why in lacking(scene))][:1]


def unbuildable(scene: Scene) -> str | None:
    """The first joint or contact that has no counterpart."""
    tree = spanning_tree(scene)
    soft = [*tree.loops, *scene.contacts.values(), *scene.pairs.values()]
    soft += [*scene.ropes(), *scene.stops()]
    soft += [joint for joint in scene.joints.values() if joint.dry_friction]
    if what := unbuilt(scene, [part.name for part in soft]):
        return what
    for quantity in scene.drives:
        part = quantity.rpartition(".")[0]
        if scene.joints[part] in tree.loops:
            return f"adapter: {part} is driven and closes a loop, where MuJoCo has no joint"
    if strides(scene) and any(joint.dry_friction for joint in scene.joints.values()):
        return "adapter: feet that pass the floor, beside a slide's dry friction, need one driver"
    if ours := lacking(scene):
        smooth = (j.name for j in scene.joints.values() if (d := j.dry_friction) and d.smooth)
        if beside := [*scene.constraints, *smooth]:
            force, _ = ours[0]
            return f"adapter: {force.name} by our law beside {beside[0]}, which does not count it"
    for joint in tree.loops:
        if built_as(scene, joint).shifts:
            what = f"{joint.kind} {joint.name}"
            instead = "a loop needs a pin"
            return f"engine: MuJoCo has no constraint that closes a loop by the {what}: {instead}"
        if joint.dry_friction is not None:
            return f"engine: {joint.name} closes a loop, and MuJoCo rubs in the tree's joints only"
        if not built_as(scene, joint).turns:
            return f"adapter: {joint.name} closes a loop by a weld, loops are closed by pins only"
    for branch in tree.branches:
        if branch.joint is not None and branch.joint.shifts:
            reason = _slide(scene, tree, branch, branch.joint)
            if reason is not None:
                return reason
    if what := touching_twice(scene):
        return what
    touching = [*scene.contacts.values(), *scene.pairs.values()]
    for contact in touching:
        if 0 < contact.restitution < LEAST_BOUNCE:
            return (
                "engine: MuJoCo's floor is a spring and damper, and the damper that throws "
                f"{contact.body} back with only {contact.restitution:g} of its speed is unstable"
            )
    return None


def unbuilt(scene: Scene, soft: Sequence[str]) -> str | None:
    """The first force or edge that is not built; soft: names of what gives way by itself."""
    for force in scene.forces.values():
        if type(force) not in ELEMENTS:
            return f"adapter: {force.name} is a {force.word}, which it does not build"
    if what := attribute_conflict(scene):
        return f"adapter: {what}"
    for edge in scene.constraints.values():
        if soft:
            return f"adapter: {edge.name} beside {soft[0]}, whose force gives way by itself"
    return None


def touching_twice(scene: Scene) -> str | None:
    """The first contact of a point that has another."""
    touching = [(contact.at, contact.on) for contact in scene.contacts.values()]
    for name, contact in scene.contacts.items():
        if touching.count((contact.at, contact.on)) > 1:
            return f"adapter: {name} is not the only contact of {contact.at} with the {contact.on}"
    return None


def _slide(scene: Scene, tree: Tree, branch: Branch, joint: Joint) -> str | None:
    turns = {name: body.turns for name, body in scene.bodies.items()}
    locked = not joint.turns and turns[branch.body]
    if locked and not turns.get(branch.parent, True):
        return f"adapter: {joint.name} would have to let {branch.body} both shift and turn"
    particle = not turns.get(joint.a.body, True)
    if particle and tree.frame(scene, branch.parent) != GROUND:
        return f"adapter: {joint.name} starts at a particle, which has no axes"
    return None


def uncompilable(
    compiled: Callable[..., object], scene: Scene, start: Start, plan: Plan
) -> str | None:
    """The reason why MuJoCo's compiler does not take the scene; None if it does."""
    try:
        compiled(scene, start, NOMINAL, plan)
    except ValueError as refusal:
        return f"engine: MuJoCo does not take the scene: {' '.join(str(refusal).split())}"
    return None
