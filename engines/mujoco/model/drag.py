"""Linear drag of a body as MuJoCo's damping of the slides by which its centre moves."""

from ....cases.scene import CENTER, GROUND, Drag, Scene, Viscous
from ....cases.scene.forces.force import of_kind
from .tree import natives, spanning_tree

NO_DRAG = "engine: MuJoCo has no drag at a point of a body"


def damped_slides(scene: Scene, force: Drag) -> tuple[str, ...]:
    """MuJoCo's names of the joints whose damping the force is; none where it is no such damping."""
    return () if not_damping(scene, force) else _slides(scene, force.at.body)


def not_damping(scene: Scene, force: Drag) -> str | None:
    """Why no damping of slides is this force, or None."""
    if force.exponent != 1.0 or force.along is not None or force.at.point != CENTER:
        return NO_DRAG
    slides = _slides(scene, force.at.body)
    if not slides:
        return f"{NO_DRAG}, but a damping of joints, and {force.at.body} moves by no slides alone"
    for other in of_kind(Drag, scene.forces.values()):
        if other is force:
            break
        if other.at == force.at:  # which has that damping, or none has
            return f"engine: MuJoCo damps a slide once, and {force.name} is beside {other.name}"
    for other in of_kind(Viscous, scene.forces.values()):
        if other.joint in slides:
            return f"engine: MuJoCo damps a slide once, and {force.name} is beside {other.name}"
    driven = next((name for name in slides if f"{name}.speed" in scene.drives), None)
    return f"adapter: {force.name} is a damping of {driven}, which is driven" if driven else None


def _slides(scene: Scene, body: str) -> tuple[str, ...]:
    """The slides on the ground by which alone the centre of the body moves; else none."""
    branch = next(b for b in spanning_tree(scene).branches if b.body == body)
    joint, own = branch.joint, natives(scene, branch)
    centred = joint is None or not joint.turns or joint.b.point == CENTER
    moved = branch.parent == GROUND and branch.forward and centred
    return tuple(native.name for native in own if native.type == "slide") if moved else ()
