"""A scene's joints in space as a spanning tree, and a body's freedoms as MuJoCo's joints.

MuJoCo applies the joints of one body in their order, each along or about an axis in the axes that
the joints before it leave: what a `Freedom` is. Loops close by `connect`, which holds one point:
one of them is a ball, two are a hinge, three a weld.
"""

from dataclasses import dataclass

from ....cases.scene import GROUND, Scene
from ....cases.scene.joint import Freedom, Joint
from ....cases.scene.rotation import Vector3
from .tree import Branch, Tree, spanned


@dataclass(frozen=True)
class Native:
    """One of MuJoCo's joints: of: the number of the joint's freedom that it is."""

    name: str
    type: str
    axis: Vector3 = (0.0, 0.0, 1.0)
    of: int = 0


def spanning_tree(scene: Scene) -> Tree[Joint]:
    """The tree over the joints; what `connect` closes best, or at all, comes last."""

    def closes(joint: Joint) -> int:
        driven = any(quantity.startswith(f"{joint.name}.") for quantity in scene.drives)
        acted = any(force.about == joint.name for force in scene.forces.values())
        return -4 if driven or acted else -(held_points(scene, joint) or 4)

    return spanned(scene, sorted(scene.joints.values(), key=closes))


def freedoms_left(scene: Scene, joint: Joint) -> tuple[Freedom, ...]:
    """The freedoms that the joint leaves here: a particle has no axes, so none are held."""
    ends = (joint.a.body, joint.b.body)
    rigid = all(end == GROUND or scene.bodies[end].turns for end in ends)
    return joint.freedoms if rigid else (*joint.shifts, Freedom("ball"))


def held_points(scene: Scene, joint: Joint) -> int | None:
    """By how many points `connect` can hold what the joint holds; None: by no number."""
    freedoms = freedoms_left(scene, joint)
    if any(freedom.kind == "shift" for freedom in freedoms):
        return None
    if len(freedoms) == 3 or any(freedom.kind == "ball" for freedom in freedoms):
        return 1
    return {0: 3, 1: 2}.get(len(freedoms))


def natives(scene: Scene, branch: Branch[Joint]) -> list[Native]:
    """The body's freedoms on its parent, as MuJoCo's joints in their order, outer first.

    A body that is its joint's first part undoes the freedoms, the last one first.
    """
    body, joint = scene.bodies[branch.body], branch.joint
    if joint is None and body.turns:
        return [Native(body.name, "free")]
    if joint is None:
        axes = zip("xyz", ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)), strict=True)
        return [Native(f"{body.name}.{name}", "slide", axis) for name, axis in axes]
    freedoms = [
        (number, freedom)
        for number, freedom in enumerate(freedoms_left(scene, joint))
        if body.turns or freedom.kind == "shift"
    ]
    sign = 1.0 if branch.forward else -1.0
    kinds = {"shift": "slide", "turn": "hinge", "ball": "ball"}
    return [
        Native(
            coordinate(joint, number),
            kinds[freedom.kind],
            (sign * freedom.axis[0], sign * freedom.axis[1], sign * freedom.axis[2]),
            number,
        )
        for number, freedom in (freedoms if branch.forward else reversed(freedoms))
    ]


def coordinate(joint: Joint, number: int) -> str:
    """MuJoCo's joint for a freedom: the joint's name, and where there are several its number."""
    return joint.name if len(joint.freedoms) < 2 else f"{joint.name}.{number}"
