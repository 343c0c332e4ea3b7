"""A scene's joints as a spanning tree, the pins that close loops, and joint coordinates.

Slides and welds go into the tree first, so that what closes a loop is a massless rod or a pin
wherever it can be: MuJoCo has a tendon for a rod, `connect` for a pin, and nothing for a slide.
"""

import math
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Generic, TypeVar

from ....cases.scene import GROUND, Anchor, Joint, Scene, Vector
from ....cases.scene.joint import FreedomKind
from ...engine import Start

J = TypeVar("J", Joint, Joint)


@dataclass(frozen=True)
class Branch(Generic[J]):
    """How a body hangs on its parent: by a joint, or freely on the ground (joint None)."""

    body: str
    parent: str  # a body, `ground`, or a driven point such as `ground.hook`
    joint: J | None

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
class Tree(Generic[J]):
    """Branches from the ground outward, and the joints that close loops."""

    branches: tuple[Branch[J], ...]
    loops: tuple[J, ...]

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
class Left:
    """The freedoms that a joint leaves here."""

    turns: bool
    shifts: bool


def built_as(scene: Scene, joint: Joint) -> Left:
    """The freedoms that the joint leaves; welded to a particle, which has no angle, it is a pin."""
    ends = (joint.a.body, joint.b.body)
    held = all(end == GROUND or scene.bodies[end].turns for end in ends)
    shifts = bool(joint.shifts)
    return Left(bool(joint.turns) or not (held or shifts), shifts)


def freedoms(scene: Scene, branch: Branch) -> list[FreedomKind]:
    """The body's freedoms on its parent, in the order of MuJoCo's joints, outer first.

    The line of a shift stands in the joint's first part: it turns with the body, or does not.
    """
    if branch.joint is None:
        return []
    left = built_as(scene, branch.joint)
    turn: list[FreedomKind] = ["turn"] if left.turns and scene.bodies[branch.body].turns else []
    shift: list[FreedomKind] = ["shift"] if left.shifts else []
    return shift + turn if branch.forward else turn + shift


def called(body: str) -> str:
    """MuJoCo's name of a body: its own `world` cannot be another's."""
    return f"{body}." if body == "world" else body  # no name of a case ends in a dot


def coordinate(joint: Joint, freedom: FreedomKind) -> str:
    """MuJoCo's joint for a freedom: the joint's name, and for the turn of a slot one more."""
    return f"{joint.name}.turn" if freedom == "turn" and joint.shifts else joint.name


def node(scene: Scene, anchor: Anchor) -> str:
    """The tree's node of an anchor: a body, `ground`, or the driven point itself."""
    if anchor.body == GROUND and scene.points[anchor.point].driven:
        return str(anchor)
    return anchor.body


_LAST: list[tuple[Scene, Tree[Joint]]] = []  # one at most: a run asks for it twenty times


def spanning_tree(scene: Scene) -> Tree[Joint]:
    """The tree over the joints, pins last that do not rub, each kind in the scene's order.

    What is driven comes before other pins: only a joint of the tree can be.
    """
    for known, tree in _LAST:
        if known is scene:
            return tree
    tree = _over(scene)
    _LAST[:] = [(scene, tree)]
    return tree


def _over(scene: Scene) -> Tree[Joint]:
    prescribed = {quantity.rpartition(".")[0] for quantity in scene.drives}

    def closes(joint: Joint) -> bool:
        loose = joint.dry_friction is None and joint.name not in prescribed
        return loose and built_as(scene, joint) == Left(turns=True, shifts=False)

    by_kind = sorted(scene.joints.values(), key=lambda joint: (joint.swings, closes(joint)))
    return spanned(scene, by_kind)


def spanned(scene: Scene, joints: Iterable[J]) -> Tree[J]:
    """Kruskal's tree: the joints in the order in which they are taken into it."""
    group = {name: name for name in (GROUND, *driven(scene), *scene.bodies)}

    def root(name: str) -> str:
        while group[name] != name:
            name = group[name]
        return name

    kept: list[J] = []
    loops: list[J] = []
    for joint in joints:
        ends = sorted((root(node(scene, joint.a)), root(node(scene, joint.b))), key=_is_body)
        if ends[0] == ends[1] or not _is_body(ends[1]):  # both fixed: closes through the ground
            loops.append(joint)
        else:
            group[ends[1]] = ends[0]
            kept.append(joint)
    return Tree(tuple(_outward(scene, kept)), tuple(loops))


def driven(scene: Scene) -> Iterator[str]:
    """Nodes of the driven points."""
    return (f"{GROUND}.{name}" for name, point in scene.points.items() if point.driven)


def _is_body(name: str) -> bool:
    return name != GROUND and "." not in name


def _outward(scene: Scene, joints: list[J]) -> Iterator[Branch[J]]:
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


def coordinates(
    scene: Scene, tree: Tree, branch: Branch, start: Start
) -> list[tuple[float, float]]:
    """(position, rate) of the branch's joint coordinates at the start, in MuJoCo's order."""
    x, y, angle, vx, vy, omega = start[branch.body]
    turns = scene.bodies[branch.body].turns
    if branch.joint is None:
        return [(x, vx), (y, vy), *([(angle, omega)] if turns else [])]
    ways = {"turn": _turn, "shift": _shift}
    return [ways[freedom](scene, tree, branch, start) for freedom in freedoms(scene, branch)]


def _turn(scene: Scene, tree: Tree, branch: Branch, start: Start) -> tuple[float, float]:
    _, _, angle, _, _, omega = start[branch.body]
    parent = start.get(tree.frame(scene, branch.parent), (0.0,) * 6)
    return angle - parent[2], omega - parent[5]


def _shift(scene: Scene, tree: Tree, branch: Branch, start: Start) -> tuple[float, float]:
    joint = branch.joint
    assert joint is not None
    first, second = (place(scene, end, start) for end in (joint.a, joint.b))
    base = 0.0 if joint.a.body == GROUND else start[joint.a.body][2]
    u = turned(joint.along, base)
    d = [after - before for before, after in zip(first, second, strict=True)]
    return d[0] * u[0] + d[1] * u[1], d[2] * u[0] + d[3] * u[1]


def place(scene: Scene, anchor: Anchor, start: Start) -> tuple[float, float, float, float]:
    """x, y, vx, vy of a point at the start."""
    if anchor.body == GROUND:
        return scene.points[anchor.point].state(0.0)  # type: ignore[return-value]
    x, y, angle, vx, vy, omega = start[anchor.body]
    dx, dy = turned(scene.bodies[anchor.body].points[anchor.point], angle)
    return (x + dx, y + dy, vx - omega * dy, vy + omega * dx)
