"""Grooves that lie oblique to what the solver inverts, told before every step.

pymunk turns a groove's relative velocity v into the impulse n · K⁻¹(v_bias − v) along its normal n,
and comes to rest where n · K⁻¹(v_bias − v) = 0. With a sliding speed v_u along the groove the point
then still crosses it, by K_nu/K_uu v_u.
"""

from collections.abc import Callable

from pymunk.body import Body
from pymunk.constraints import GrooveJoint
from pymunk.vec2d import Vec2d

from ....cases.scene import Joint, Scene
from ..scene import carried_oblique, oblique
from ..world import World


def told_aside(scene: Scene, joint: Joint) -> bool:
    """Whether the joint is such a groove, and its next impulse is known: nothing else joins it."""
    return oblique(scene, joint) and not carried_oblique(scene, joint)


def straightened(world: World, step: float) -> list[Callable[[float], None]]:
    """What has to be called before each step, for each such groove."""
    return [
        lambda t, groove=part, ends=(part.groove_a, part.groove_b): straighten(groove, *ends, step)
        for joint in world.scene.joints.values()
        if told_aside(world.scene, joint)
        for part in world.joints[joint.name]
        if isinstance(part, GrooveJoint)
    ]


def straighten(groove: GrooveJoint, first: Vec2d, last: Vec2d, step: float) -> None:
    """Sets the groove's ends h K_nu/K_uu v_u aside of where they are, so that v_bias makes up for
    the crossing; a shift along n leaves every moment as it is. v_u is that after the impulse.
    """
    a, b, across = groove.a, groove.b, (last - first).normalized().perpendicular()
    n = across.rotated(a.angle + step * a.angular_velocity)
    u = Vec2d(n.y, -n.x)
    to_b = groove.anchor_b.rotated(b.angle + step * b.angular_velocity)
    to_a = to_b + b.position - a.position + step * (b.velocity - a.velocity)
    v, k_nn, k_nu, k_uu = Vec2d(0.0, 0.0), 0.0, 0.0, 0.0
    for body, lever, sign in ((a, to_a, -1), (b, to_b, 1)):
        v += sign * (body.velocity + body.angular_velocity * lever.perpendicular())
        if body.body_type == Body.DYNAMIC:
            about_n, about_u = lever.cross(n), lever.cross(u)
            k_nn += 1 / body.mass + about_n * about_n / body.moment
            k_nu += about_n * about_u / body.moment
            k_uu += 1 / body.mass + about_u * about_u / body.moment
    share = (1 - groove.error_bias**step) / step
    closing = -share * (n.dot(to_a) - across.dot(first))
    slides = v.dot(u) + k_nu / k_nn * (closing - v.dot(n))
    aside = -k_nu / k_uu * slides / share * across
    groove.groove_a, groove.groove_b = first + aside, last + aside
