"""A scene's joints as a spanning tree, and a body's freedoms as MuJoCo's joints.

MuJoCo is spatial: a scene of the plane moves in its xy plane, by slides along x and y and hinges
about z. It applies the joints of one body in their order, each along or about an axis in the axes
that the joints before it leave: what a `Freedom` is.

What closes a loop comes into the tree last, so that it is a massless rod, for which MuJoCo has a
tendon, or what `connect` holds, wherever it can be. That holds one point: in the plane a pin, in
space a ball; two are a hinge, three a weld. For a slide there is nothing.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from typing import Any

from ....cases.scene import GROUND, Anchor, Force, Joint, Scene, Vector, cached_by_scene
from ....cases.scene.frame import PLANE
from ....cases.scene.joint import Freedom
from ....cases.scene.rotation import Vector3
from ...engine import Start
from .number_text import lifted

AXES: tuple[Vector3, ...] = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
"""x, y and z of the ground, or of a body."""


@dataclass(frozen=True)
class Branch:
    """How a body hangs on its parent: by a joint, or freely on the ground (joint None)."""

    body: str
    parent: str  # a body, `ground`, or a driven point such as `ground.hook`
    joint: Joint | None

    @property
    def forward(self) -> bool:
        """Whether the body is the joint's second part."""
        return self.joint is None or self.joint.b.body == self.body

    def ends(self) -> tuple[Anchor, Anchor]:
        """The joint's points on the parent and on the body."""
        assert self.joint is not None
        a, b = self.joint.a, self.joint.b
        return (a, b) if self.forward else (b, a)


@dataclass(frozen=True)
class Tree:
    """Branches from the ground outward, and the joints that close loops."""

    branches: tuple[Branch, ...]
    loops: tuple[Joint, ...]

    def subtree(self, body: str) -> set[str]:
        """The body and all that hangs on it."""
        held = {body}
        for branch in self.branches:
            if branch.parent in held:
                held.add(branch.body)
        return held

    def frame(self, scene: Scene, name: str) -> str:
        """The body with which a node's axes turn: a particle's turn with what carries it."""
        branches = {branch.body: branch for branch in self.branches}
        while name in branches and not scene.bodies[name].turns:
            name = branches[name].parent
        return name if name in branches else GROUND


@dataclass(frozen=True)
class Native:
    """One of MuJoCo's joints; of: the number of the joint's freedom that it is."""

    name: str
    type: str
    axis: Vector3 = AXES[2]
    of: int = 0


def freedoms_left(scene: Scene, joint: Any) -> tuple[Freedom, ...]:
    """The freedoms that the joint leaves here: a particle has no axes by which one is held.

    Welded to a particle it is a pin in the plane, and a ball in space.
    """
    ends = (joint.a.body, joint.b.body)
    rigid = all(end == GROUND or scene.bodies[end].turns for end in ends)
    if scene.frame is not PLANE:
        return joint.freedoms if rigid else (*joint.shifts, Freedom("ball"))
    shifts = tuple(replace(shift, axis=(*shift.axis, 0.0)) for shift in joint.shifts)
    turns = joint.turns or not (rigid or shifts)
    return (*shifts, *((Freedom.turn(AXES[2], "angle"),) if turns else ()))


def held_angle(scene: Scene, branch: Branch) -> float:
    """The angle [rad] about z at which a joint of the plane holds the body against its parent."""
    joint = branch.joint
    if joint is None or scene.frame is not PLANE or not scene.bodies[branch.body].turns:
        return 0.0
    if any(freedom.kind == "turn" for freedom in freedoms_left(scene, joint)):
        return 0.0
    return joint.angle if branch.forward else -joint.angle


def held_points(scene: Scene, joint: Joint) -> int | None:
    """By how many points `connect` can hold what the joint holds; None: by no number."""
    kinds = [freedom.kind for freedom in freedoms_left(scene, joint)]
    if "shift" in kinds:
        return None
    if scene.frame is PLANE:
        return 1 if kinds else None
    if len(kinds) == 3 or "ball" in kinds:
        return 1
    return {0: 3, 1: 2}.get(len(kinds))


def natives(scene: Scene, branch: Branch) -> list[Native]:
    """The body's freedoms on its parent, as MuJoCo's joints in their order, outer first.

    A body that is its joint's first part undoes the freedoms, the last one first: its axes are the
    opposite, so that MuJoCo counts what the scene does.
    """
    body, joint = scene.bodies[branch.body], branch.joint
    if joint is None:
        return _free(scene, body.name, turns=body.turns)
    joints = [
        Native(
            coordinate(scene, joint, number),
            _TYPES[freedom.kind],
            _axis(scene, branch, freedom),
            number,
        )
        for number, freedom in enumerate(freedoms_left(scene, joint))
        if body.turns or freedom.kind == "shift"
    ]
    return joints if branch.forward else joints[::-1]


_TYPES = {"shift": "slide", "turn": "hinge", "ball": "ball"}


def _free(scene: Scene, body: str, *, turns: bool) -> list[Native]:
    if turns and scene.frame is not PLANE:
        return [Native(body, "free")]
    slides = [
        Native(f"{body}.{name}", "slide", AXES[i], i) for i, name in enumerate(scene.frame.axes)
    ]
    return [*slides, Native(f"{body}.angle", "hinge", of=len(slides))] if turns else slides


def _axis(scene: Scene, branch: Branch, freedom: Freedom) -> Vector3:
    """The freedom's axis in the axes of the body; a shift's stands in the joint's first part."""
    x, y, z = freedom.axis
    if not branch.forward:
        return -x, -y, -z
    if freedom.kind == "shift" and (held := held_angle(scene, branch)):
        return *turned((x, y), -held), z
    return x, y, z


def called(body: str) -> str:
    """MuJoCo's name of a body: its own `world` cannot be another's."""
    return f"{body}." if body == "world" else body  # no name of a case ends in a dot


def coordinate(scene: Scene, joint: Any, number: int) -> str:
    """MuJoCo's joint for a freedom: the joint's name, and where there are several which it is.

    In the plane that is a slot's turn, in space its number.
    """
    if scene.frame is PLANE:
        return f"{joint.name}.turn" if number else joint.name
    return joint.name if len(joint.freedoms) < 2 else f"{joint.name}.{number}"


def number_of(scene: Scene, force: Force) -> int:
    """The number of the freedom about or along which a force acts, among those of its joint."""
    joint: Any = scene.joints[force.about or ""]
    if scene.frame is PLANE:
        return [freedom.kind for freedom in freedoms_left(scene, joint)].index(force.freedom)
    return joint.turning(force.turn)


def node(scene: Scene, anchor: Anchor) -> str:
    """The tree's node of an anchor: a body, `ground`, or the driven point itself."""
    if anchor.body == GROUND and scene.points[anchor.point].driven:
        return str(anchor)
    return anchor.body


def local(scene: Scene, anchor: Anchor) -> Vector3:
    """A point in the axes of its body, or of the ground; a driven point is its own body."""
    if anchor.body != GROUND:
        return lifted(scene.bodies[anchor.body].points[anchor.point])
    point = scene.points[anchor.point]
    return (0.0, 0.0, 0.0) if point.driven else lifted(point.at)


@cached_by_scene
def spanning_tree(scene: Scene) -> Tree:
    """The tree over the joints: what closes a loop best comes last, else in the scene's order.

    What is driven or rubs comes before what else is like it, and in space what a force acts about:
    only in a joint of the tree they can be.
    """
    return spanned(scene, sorted(scene.joints.values(), key=lambda joint: _closes(scene, joint)))


def _closes(scene: Scene, joint: Joint) -> tuple[bool, int]:
    driven = any(quantity.startswith(f"{joint.name}.") for quantity in scene.drives)
    acted = any(force.about == joint.name for force in scene.forces.values())
    needed = driven or acted or joint.dry_friction is not None
    return joint.swings, -4 if needed else -(held_points(scene, joint) or 4)


def spanned(scene: Scene, joints: Iterable[Joint]) -> Tree:
    """Kruskal's tree: the joints in the order in which they are taken into it."""
    group = {name: name for name in (GROUND, *driven(scene), *scene.bodies)}

    def root(name: str) -> str:
        while group[name] != name:
            name = group[name]
        return name

    kept: list[Joint] = []
    loops: list[Joint] = []
    for joint in joints:
        ends = sorted((root(node(scene, joint.a)), root(node(scene, joint.b))), key=_is_body)
        if ends[0] == ends[1] or not _is_body(ends[1]):  # both fixed: closes through the ground
            loops.append(joint)
        else:
            group[ends[1]] = ends[0]
            kept.append(joint)
    return Tree(tuple(_outward(scene, kept)), tuple(loops))


def dry_joints(scene: Scene) -> list[Joint]:
    """The joints with dry friction, in the scene's order."""
    return [joint for joint in scene.joints.values() if joint.dry_friction is not None]


def driven(scene: Scene) -> Iterator[str]:
    """Nodes of the driven points."""
    return (f"{GROUND}.{name}" for name, point in scene.points.items() if point.driven)


def _is_body(name: str) -> bool:
    return name != GROUND and "." not in name


def _outward(scene: Scene, joints: list[Joint]) -> Iterator[Branch]:
    reached = {GROUND, *driven(scene)}
    waiting = list(scene.bodies)
    while waiting:
        branch = next(
            (
                Branch(body, parent, joint)
                for joint in joints
                for parent, body in (
                    (node(scene, joint.a), node(scene, joint.b)),
                    (node(scene, joint.b), node(scene, joint.a)),
                )
                if parent in reached and body in waiting
            ),
            None,
        ) or Branch(min(waiting, key=lambda name: not scene.bodies[name].turns), GROUND, None)
        yield branch
        reached.add(branch.body)
        waiting.remove(branch.body)


def turned(vector: Vector, angle: float) -> Vector:
    """The vector turned by an angle [rad]."""
    cos, sin = math.cos(angle), math.sin(angle)
    return (cos * vector[0] - sin * vector[1], sin * vector[0] + cos * vector[1])


def place(scene: Scene, anchor: Anchor, start: Start) -> tuple[float, float, float, float]:
    """x, y, vx, vy of a point of the plane at the start."""
    if anchor.body == GROUND:
        return scene.points[anchor.point].state(0.0)  # type: ignore[return-value]
    x, y, angle, vx, vy, omega = start[anchor.body]
    dx, dy = turned(scene.bodies[anchor.body].points[anchor.point], angle)
    return (x + dx, y + dy, vx - omega * dy, vy + omega * dx)
