"""Torques between the two parts of a joint, ahead of the step in which they act."""

from collections.abc import Callable, Iterator

from pymunk.body import Body

from ....cases.turning import Motor, Turning
from ...law import turning
from ...signal import acting, value
from ..world import World
from .line import Exerted, Load


def twist(world: World, force: Turning, name: str) -> Exerted:
    """What a torsion spring or damper exerts on the body `name`, which is the second part.

    Friction by law knows loads of what one joint alone holds, to the ground.
    """
    a, b = _parts(world, force)
    assert b is world.bodies[name]

    def exerted(t: float, drift: float) -> Load:
        rate = b.angular_velocity - a.angular_velocity
        return 0.0, 0.0, turning(force, b.angle - a.angle + drift * rate, rate)

    return exerted


def twisted(world: World, force: Turning, step: float) -> Callable[[float], None]:
    """Its torque at the midpoint, with the rate extrapolated to 3/2 vₙ − 1/2 vₙ₋₁.

    Of second order, explicit, and indifferent to joints, as `told` is of lines.
    """
    a, b = _parts(world, force)
    before = b.angular_velocity - a.angular_velocity  # there is no step before the first

    def apply(t: float) -> None:
        nonlocal before
        rate = b.angular_velocity - a.angular_velocity
        angle = b.angle - a.angle + step * rate
        _couple(a, b, turning(force, angle, 1.5 * rate - 0.5 * before))
        before = rate

    return apply


def motor(world: World, force: Motor, step: float, drift: float) -> Callable[[float], None]:
    """Its torque in the middle of the step, or at its start."""
    (a, b), torque = _parts(world, force), acting(force.signal, drift)
    return lambda t: _couple(a, b, torque(t)[0])


def motor_load(world: World, force: Motor, name: str) -> Exerted:
    """What it exerts on the body `name`, the second part as in `twist`."""
    assert _parts(world, force)[1] is world.bodies[name]
    return lambda t, drift: (0.0, 0.0, value(force.signal, t)[0])


def couple_as_text(
    world: World, force: Turning, of: Callable[[Body], str], torque: str
) -> Iterator[str]:
    """Lines of Python; the ground is not told."""
    for part, sign in zip(_parts(world, force), "-+", strict=True):
        if part is not world.space.static_body:
            yield f"    {of(part)}.torque {sign}= {torque}"


def _parts(world: World, force: Turning) -> tuple[Body, Body]:
    a, b = (world.body(at) for at in world.scene.ends(force))
    return a, b


def _couple(a: Body, b: Body, torque: float) -> None:
    a.torque -= torque  # of the ground it is nothing
    b.torque += torque
