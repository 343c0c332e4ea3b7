"""A groove that lies oblique to what pymunk inverts, held by a pin joint across it.

pymunk turns a groove's relative velocity v into the impulse n · K⁻¹(v_bias − v) along its normal n,
and comes to rest where n · K⁻¹(v_bias − v) = 0: with a sliding speed v_u along the groove the point
then still crosses it, by K_nu/K_uu v_u. A pin joint is solved along its own line and along nothing
else. Laid across the groove, its far end carried beside the point in every step, it holds the same
line exactly.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from pymunk.body import Body
from pymunk.constraints import Constraint, PinJoint
from pymunk.space import Space
from pymunk.vec2d import Vec2d

from ....cases.scene import GROUND, Anchor, Joint, Scene

LENGTH = 1.0  # m, of the pin joint: of no effect, as its direction is set anew in every step


@dataclass(frozen=True)
class Line:
    """A groove: a point of it and its direction u, in the axes of the body that it is cut in."""

    point: Vec2d
    along: Vec2d

    @property
    def across(self) -> Vec2d:
        """The normal n."""
        return self.along.perpendicular()


def line(first: tuple[float, float], last: tuple[float, float]) -> Line:
    """The line between a groove's ends, from its middle."""
    a, b = Vec2d(*first), Vec2d(*last)
    return Line((a + b) / 2, (b - a).normalized())


def pinned(a: Body, b: Body, cut: Line, anchor: tuple[float, float]) -> PinJoint:
    """The joint that keeps a point of b, given in b's axes, on a line cut in a."""
    joint = PinJoint(a, b, cut.point + LENGTH * cut.across, anchor)
    joint.distance = LENGTH
    joint.pre_solve = carried(cut.point, cut.along)
    return joint


def carried(point: Vec2d, along: Vec2d) -> Callable[[Constraint, Space], None]:
    """The function that pymunk calls when a step has moved bodies, before it solves joints."""
    end = point + LENGTH * along.perpendicular()

    def carry(joint: Constraint, space: Space) -> None:
        assert isinstance(joint, PinJoint)
        there = joint.a.world_to_local(joint.b.local_to_world(joint.anchor_b))
        joint.anchor_a = end + along * (there - point).dot(along)

    return carry


def oblique(scene: Scene, joint: Joint) -> bool:
    """Whether a groove has to lie where K is oblique to it: beside a turning centre.

    There the solver settles with the second point off the line by c h times its sliding speed, and
    with other joints nowhere near it.
    """
    if not joint.shifts or (not joint.turns and holds_angle(scene, joint)):
        return False
    second = scene.bodies[joint.b.body].points[joint.b.point] if turns(scene, joint.b) else ()
    if joint.turns and any(second):
        return True
    if not turns(scene, joint.a):
        return False
    (x, y), (ux, uy) = scene.bodies[joint.a.body].points[joint.a.point], joint.along
    return abs(ux * y - uy * x) > 1e-12 * math.hypot(x, y)


def holds_angle(scene: Scene, joint: Joint) -> bool:
    """Whether both parts have an angle and one of them can turn; a particle has none."""
    bodies = [scene.bodies[p.body] for p in (joint.a, joint.b) if p.body != GROUND]
    return all(body.turns for body in bodies)


def turns(scene: Scene, anchor: Anchor) -> bool:
    """Whether the anchor is of a body that can turn: neither the ground nor a particle."""
    return anchor.body != GROUND and scene.bodies[anchor.body].turns
